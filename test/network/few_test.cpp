// SPDX-License-Identifier: MIT
#include "network/few.hpp"

#include <doctest/doctest.h>

namespace few_test {
using namespace rovernet;

TEST_CASE("list Few: an empty list is as small as a pointer, and values can be appended to it") {
    CHECK(sizeof(Few<int>) == sizeof(void*));
    Few<int> list;
    CHECK(list.empty());
    CHECK(list.size() == 0);
    for (int i = 0; i < 10; ++i) list.push_back(i * i);
    CHECK_FALSE(list.empty());
    REQUIRE(list.size() == 10);
    for (std::size_t i = 0; i < 10; ++i) CHECK(list[i] == static_cast<int>(i * i));
}

}  // namespace few_test
