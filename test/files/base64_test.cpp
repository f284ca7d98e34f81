// SPDX-License-Identifier: MIT
#include "files/base64.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>

namespace base64_test {
using namespace rovernet;

TEST_CASE("base64: encodes and decodes the test vectors of RFC 4648, section 10") {
    const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                           {"f", "Zg=="},
                                                           {"fo", "Zm8="},
                                                           {"foo", "Zm9v"},
                                                           {"foob", "Zm9vYg=="},
                                                           {"fooba", "Zm9vYmE="},
                                                           {"foobar", "Zm9vYmFy"},
                                                           {"\xfb\xff", "+/8="}};
    for (const auto& [bytes, text] : vectors) {
        CHECK(base64(bytes) == text);
        CHECK(from_base64(text) == std::string(bytes));
    }
    const std::string zeros(3, '\0');
    CHECK(from_base64(base64(zeros)) == zeros);
}

TEST_CASE("base64: a text that is not base64 is refused") {
    for (const char* text : {"Z", "Zg", "Zg=", "Zh==", "Zm9=", "====", "=", "Z===", "Zg==Zg==",
                             "Zm 9v", "Zm9v\n", "Zm9-", "Zm9_", "\xc3\xa4\xc3\xa4"}) {
        CAPTURE(text);
        CHECK_FALSE(from_base64(text).has_value());
    }
}

}  // namespace base64_test
