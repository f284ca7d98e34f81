// SPDX-License-Identifier: MIT
#include "pictures/viewer/view_file.hpp"

#include "pictures/viewer/view_page.hpp"
#include "test/pictures/viewer/view_reader.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace view_file_test {
using namespace rovernet;
using Numbers = std::vector<double>;

TEST_CASE("view file: written columns of every data type are read back unchanged") {
    ViewFile file;
    file.add("a", std::vector<std::uint8_t>{0, 255});
    file.add("b", std::vector<double>{-1.5, 1e300});
    file.add("c", std::vector<float>{0.25F});
    file.add("none", std::vector<std::uint32_t>{});
    file.add_indices("few", std::vector<std::uint32_t>{3, no_index}, 65'534);
    file.add_indices("many", std::vector<std::uint32_t>{70'000, no_index}, 70'001);
    file.add_times("t", std::vector<std::int64_t>{5, 5, 5'000'000'000, 9'000'000'000'000'000});
    file.add_texts("text", std::vector<std::string>{"", "h\u00e9", "</script>"});
    Table head;
    head.set("rvw", 1);
    const std::string bytes = file.bytes(std::move(head));
    const test::ViewReader read(bytes);
    CHECK(read.numbers("a") == Numbers{0, 255});
    CHECK(read.numbers("b") == Numbers{-1.5, 1e300});
    CHECK(read.numbers("c") == Numbers{0.25});
    CHECK(read.numbers("none").empty());
    CHECK(read.numbers("few") == Numbers{3, 65'535});
    CHECK(read.numbers("many") == Numbers{70'000, 4'294'967'295.0});
    CHECK(read.numbers("t") == Numbers{5, 5, 5e9, 9e15});
    CHECK(read.texts("text") == std::vector<std::string>{"", "h\u00e9", "</script>"});
    CHECK(test::ViewReader::integer(read.head(), "rvw") == 1);
}

TEST_CASE("view page: the data is in base64, and no placeholder of the page's template is left") {
    const std::string one = page_with("a"), two = page_with("ab"), three = page_with("abc");
    CHECK(one.find("id=\"run\">YQ==</script>") != one.npos);
    CHECK(two.find("id=\"run\">YWI=</script>") != two.npos);
    CHECK(three.find("id=\"run\">YWJj</script>") != three.npos);
    CHECK(page_with(std::string("\xff\xfe\x00", 3)).find(">//4A</script>") != one.npos);
    for (const std::string& page : {one, served_page()}) {
        for (const char* mark : {"<!--CSP-->", "<!--DATA-->", "<!--STYLE-->", "<!--SCRIPT-->"})
            CHECK(page.find(mark) == page.npos);
        CHECK(page.find("default-src 'none'; script-src 'sha256-") != page.npos);
    }
    CHECK(one.find("connect-src 'none'") != one.npos);
    CHECK(served_page().find("connect-src 'self'") != one.npos);
    CHECK(served_page().size() < 175'000);
}

}  // namespace view_file_test
