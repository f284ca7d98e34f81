// SPDX-License-Identifier: MIT
#include "files/csv_table.hpp"

#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <string>

namespace csv_table_test {
using namespace rovernet;

namespace {

std::string error_of(const std::string& text, const char* column = "b") {
    const test::TemporaryFolder folder;
    try {
        const CsvTable table(folder.write("t.csv", text));
        table.word(0, column);
        table.fail(0, column, "another");
    } catch (const InputError& error) {
        const std::string what = error.what();
        return what.substr(what.find("t.csv"));
    }
    return "";
}

}  // namespace

TEST_CASE("csv table: fields are found by column name, with their line and column in the file") {
    const test::TemporaryFolder folder;
    const CsvTable table(
        folder.write("t.csv", "# measured\n\na, b ,c\r\n1,,3\r\n\n# more\n  4 , 5,\n"));
    REQUIRE(table.size() == 2);
    CHECK(table.has("b"));
    CHECK_FALSE(table.has("d"));
    CHECK(table.text(0, "a") == "1");
    CHECK(table.text(0, "b").empty());
    CHECK(table.text(0, "c") == "3");
    CHECK(table.text(1, "a") == "4");
    CHECK(table.word(1, "b").column == 7);
    CHECK(table.text(1, "c").empty());
    CHECK(table.where(1).line == 7);
}

TEST_CASE(
    "csv table: errors have line and column, and for an unknown column name they suggest a known "
    "one") {
    CHECK(error_of("a,b\n1,2\n") == "t.csv:2:3: b: found \"2\", expected another");
    CHECK(error_of("a,b\n1\n").find("t.csv:2") == 0);
    CHECK(error_of("a,b\n1\n").find("found 1 fields; expected 2") != std::string::npos);
    CHECK(error_of("a,b\n1,2,\n").find("found 3 fields; expected 2") != std::string::npos);
    CHECK(error_of("# only\n").find("no line with the names of the columns") != std::string::npos);
    CHECK(error_of("level,b\n1,2\n", "levl")
              .find("no column \"levl\"; expected one of level, b; did you mean \"level\"?") !=
          std::string::npos);
}

}  // namespace csv_table_test
