// SPDX-License-Identifier: MIT
#include "scenario/document/json.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace rovernet {
namespace {

using Json = nlohmann::ordered_json;

Json convert(const Value& value);

struct Convert {
    Json operator()(std::monostate) const { return nullptr; }
    Json operator()(bool v) const { return v; }
    Json operator()(std::int64_t v) const { return v; }
    Json operator()(double v) const { return std::isfinite(v) ? Json(v) : Json(nullptr); }
    Json operator()(const std::string& v) const { return v; }
    Json operator()(const Array& v) const {
        Json list = Json::array();
        for (const auto& item : v) list.push_back(convert(item));
        return list;
    }
    Json operator()(const Table& v) const {
        Json object = Json::object();
        for (const auto& entry : v.entries) object[entry.key] = convert(entry.value);
        return object;
    }
};

Json convert(const Value& value) { return std::visit(Convert{}, value.data); }

Value value_of(const Json& json) {
    if (json.is_boolean()) return json.get<bool>();
    if (json.is_number_integer()) return json.get<std::int64_t>();
    if (json.is_number()) return json.get<double>();
    if (json.is_string()) return json.get<std::string>();
    if (json.is_array()) {
        Array list;
        for (const auto& item : json) list.push_back(value_of(item));
        return list;
    }
    if (!json.is_object()) return {};
    Table table;
    for (const auto& [key, item] : json.items()) table.entries.push_back({key, value_of(item), {}});
    return table;
}

std::string dump(const Value& value, int indent) {
    return convert(value).dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string to_json(const Value& value) { return dump(value, 2) + "\n"; }

std::string to_json_line(const Value& value) { return dump(value, -1); }

void JsonObjectWriter::begin(std::string_view key) {
    write_(std::exchange(is_empty_, false) ? "{\n  " : ",\n  ");
    write_(dump(Value(key), -1));
    write_(": ");
}

void JsonObjectWriter::set(std::string_view key, const Value& value) {
    begin(key);
    // Ends of lines are between values only: those of texts are written as \\n.
    const std::string text = dump(value, 2);
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t to = std::min(text.find('\n', from), text.size() - 1) + 1;
        write_(std::string_view(text).substr(from, to - from));
        if (text[to - 1] == '\n') write_("  ");
        from = to;
    }
}

void JsonObjectWriter::set_list(std::string_view key, std::size_t size, const AppendItem& append) {
    begin(key);
    std::string piece = "[";
    for (std::size_t i = 0; i < size; ++i) {
        piece += i == 0 ? "\n    " : ",\n    ";
        append(i, piece);
        write_(std::exchange(piece, {}));
    }
    write_(piece + (size == 0 ? "]" : "\n  ]"));
}

Value parse_json(std::string_view text) {
    try {
        return value_of(Json::parse(text, [](int depth, Json::parse_event_t, Json&) {
            constexpr int deepest = 100;  // what we write has a few levels
            if (depth > deepest)
                throw InputError(
                    {}, "found more than 100 levels of brackets in JSON; expected at most 100");
            return true;
        }));
    } catch (const Json::exception& error) {
        throw InputError({}, std::string("not JSON: ") + error.what());
    }
}

}  // namespace rovernet
