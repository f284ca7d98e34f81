// SPDX-License-Identifier: MIT
#include "scenario/tables/value_schema.hpp"

#include "scenario/document/json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace rovernet {
namespace {

constexpr const char* description = "description";

/// Takes the description out of a schema. @return the description; empty if there is none
std::string take_description(Table& schema) {
    std::string text;
    if (const Value* given = schema.find(description)) text = *given->string();
    std::erase_if(schema.entries, [](const Entry& entry) { return entry.key == description; });
    return text;
}

/// Whether a schema, or one of those that it joins by anyOf, equals another.
bool accepts_alike(const Table& schema, const Table& other) {
    const std::string text = to_json_line(Value(other));
    if (to_json_line(Value(schema)) == text) return true;
    const Value* joined = schema.find("anyOf");
    if (!joined) return false;
    for (const Value& each : *joined->array()) {
        if (to_json_line(each) == text) return true;
    }
    return false;
}

}  // namespace

Table schema_of_type(std::string_view type) {
    Table schema;
    schema.set("type", type);
    return schema;
}

Table schema_of_words(const Array& words) {
    Table schema;
    schema.set("enum", words);
    return schema;
}

Table schema_of_list(Table items, int least, int most) {
    Table schema = schema_of_type("array");
    schema.set("items", std::move(items));
    if (least > 0) schema.set("minItems", least);
    if (most > 0) schema.set("maxItems", most);
    return schema;
}

Table schema_of_quantity(Dimension dimension, bool any_sign) {
    Table schema = schema_of_type("string");
    schema.set("pattern", quantity_pattern(dimension, any_sign));
    return schema;
}

Table schema_of_either(Table one, Table other) {
    Array both;
    if (Value* joined = one.find("anyOf")) {
        both = *joined->array();
    } else {
        both.emplace_back(std::move(one));
    }
    both.emplace_back(std::move(other));
    Table schema;
    schema.set("anyOf", std::move(both));
    return schema;
}

void add_limits(Table& schema, const Range& range) {
    if (std::isfinite(range.low)) {
        schema.set("minimum", range.low);
        if (!range.low_included) schema.set("exclusiveMinimum", true);
    }
    if (std::isfinite(range.high)) schema.set("maximum", range.high);
}

void add_key(Table& properties, std::string_view key, Table schema, std::string_view meaning,
             std::string_view owner) {
    std::string text = owner.empty() ? std::string(meaning) : fmt::format("{}: {}", owner, meaning);
    if (const Value* old = properties.find(key)) {
        Table joined = *old->table();
        text = take_description(joined) + "; " + text;
        schema = accepts_alike(joined, schema)
                     ? std::move(joined)
                     : schema_of_either(std::move(joined), std::move(schema));
    }
    schema.set(description, std::move(text));
    properties.set(key, std::move(schema));
}

Table schema_of_table(Table properties, const Array& required) {
    Table schema = schema_of_type("object");
    schema.set("properties", std::move(properties));
    schema.set("additionalProperties", false);
    if (!required.empty()) schema.set("required", required);
    return schema;
}

}  // namespace rovernet
