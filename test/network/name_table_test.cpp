// SPDX-License-Identifier: MIT
#include "network/name_table.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace name_table_test {
using namespace rovernet;
using namespace std::string_view_literals;

namespace {

/// "r0", "r1"...; every name is the beginning of others.
std::string numbered(int i) { return "r" + std::to_string(i); }

/// Adds `count` names and checks that all are found and that others are not.
void check_many(NameTable& table, int count) {
    std::map<std::string, std::uint32_t> expected;
    for (int i = 0; i < count; ++i) {
        CHECK_FALSE(table.find(numbered(i)));
        expected[numbered(i)] = static_cast<std::uint32_t>(table.size());
        table.add(numbered(i));
    }
    CHECK(table.size() == expected.size());
    for (const auto& [name, number] : expected) {
        CHECK(table.find(name) == number);
        CHECK(table[number] == name);
    }
    CHECK_FALSE(table.find(numbered(count)));
    CHECK_FALSE(table.find("r"));
}

}  // namespace

TEST_CASE("name table: names are numbered in order of insertion, and found again") {
    NameTable table;
    check_many(table, 5000);
}

TEST_CASE("name table: at every size, all names in the table are found, and no others") {
    NameTable table;
    for (int n = 0; n < 200; ++n) {
        for (int i = 0; i <= n; ++i) {
            CHECK(table.find(numbered(i)).has_value() == (i < n));
        }
        table.add(numbered(n));
    }
}

TEST_CASE(
    "name table: reserving memory, before or between insertions, has no effect on the result") {
    NameTable table;
    table.reserve(100);
    check_many(table, 300);
    NameTable other;
    other.add("ada");
    other.reserve(50);
    other.reserve(2);
    CHECK(other.find("ada") == 0);
    other.add("bob");
    CHECK(other.find("bob") == 1);
    CHECK(other[0] == "ada");
}

TEST_CASE("name table: a name may be empty, or consist of any bytes") {
    const std::vector<std::string_view> names = {""sv,     "\0"sv, "\0\0"sv,
                                                 "a\0b"sv, "a"sv,  "\xff\xfe"sv};
    NameTable table;
    for (const auto name : names) table.add(name);
    const std::string longest(100'000, 'x');
    table.add(longest);
    for (std::uint32_t i = 0; i < names.size(); ++i) {
        CHECK(table.find(names[i]) == i);
        CHECK(table[i] == names[i]);
    }
    CHECK(table[static_cast<std::uint32_t>(names.size())] == longest);
    CHECK_FALSE(table.find("ab"));
}

}  // namespace name_table_test
