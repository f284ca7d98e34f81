// SPDX-License-Identifier: MIT
#include "scenario/document/json.hpp"

#include <doctest/doctest.h>

#include <string>
#include <string_view>

namespace json_test {
using namespace rovernet;

TEST_CASE("json: an object written key by key has the same bytes as an object written at once") {
    Table inner;
    inner.set("text", "two\nlines, \"quoted\"");
    inner.set("none", Table{});
    Table table;
    table.set("a \"key\"", 1.5);
    table.set("inner", inner);
    table.set("empty", Array{});
    table.set("list", Array{Value(inner), Value(2)});
    std::string text;
    JsonObjectWriter writer([&](std::string_view piece) { text += piece; });
    for (const Entry& entry : table.entries) writer.set(entry.key, entry.value);
    writer.set_list("nothing", 0, [](std::size_t, std::string&) {});
    writer.set_list("numbers", 2,
                    [](std::size_t i, std::string& out) { out += i == 0 ? "7" : "8"; });
    writer.end();
    table.set("nothing", Array{});
    table.set("numbers", Array{Value(7), Value(8)});
    CHECK(text == to_json(table));
    text.clear();
    JsonObjectWriter([&](std::string_view piece) { text += piece; }).end();
    CHECK(text == to_json(Table{}));
}

}  // namespace json_test
