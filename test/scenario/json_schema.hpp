// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"

#include <algorithm>
#include <map>
#include <regex>
#include <string>

namespace rovernet::test {

/// Whether a value is as a JSON Schema (draft 4) says: the part of draft 4 that scenario_schema()
/// uses. test/schema/check compares with a whole validator.
class JsonSchema {
  public:
    static bool accepts(const Table& schema, const Value& value) {
        return JsonSchema(schema).holds(schema, value);
    }

  private:
    explicit JsonSchema(const Table& root) : root_(root) {}

    bool holds(const Table& schema, const Value& value) const {
        return std::all_of(schema.entries.begin(), schema.entries.end(), [&](const Entry& entry) {
            return holds(schema, entry.key, entry.value, value);
        });
    }
    /// Part of the whole schema that a text such as "#/properties/study" names.
    const Table& part(const std::string& reference) const {
        const Table* at = &root_;
        for (std::size_t from = 2; from < reference.size();) {
            const std::size_t end = std::min(reference.find('/', from), reference.size());
            at = at->find(reference.substr(from, end - from))->table();
            from = end + 1;
        }
        return *at;
    }
    static double number(const Value& value) {
        const auto* whole = std::get_if<std::int64_t>(&value.data);
        return whole ? static_cast<double>(*whole) : std::get<double>(value.data);
    }
    static bool is_number(const Value& value) {
        return std::holds_alternative<std::int64_t>(value.data) ||
               std::holds_alternative<double>(value.data);
    }
    static bool is_of_type(const std::string& type, const Value& value) {
        if (type == "object") return value.table();
        if (type == "array") return value.array();
        if (type == "string") return value.string();
        if (type == "boolean") return std::holds_alternative<bool>(value.data);
        if (type == "integer") return std::holds_alternative<std::int64_t>(value.data);
        return type == "number" && is_number(value);
    }
    static bool matches(const std::string& pattern, const std::string& text) {
        static std::map<std::string, std::regex> known;
        const auto [at, is_new] = known.try_emplace(pattern);
        if (is_new) at->second = std::regex(pattern);
        return std::regex_search(text, at->second);
    }
    bool accepts_object(const Table& schema, const Table& object) const {
        const Value* keys = schema.find("properties");
        const Value* others = schema.find("additionalProperties");
        return std::all_of(object.entries.begin(), object.entries.end(), [&](const Entry& entry) {
            const Value* known = keys ? keys->table()->find(entry.key) : nullptr;
            if (known) return holds(*known->table(), entry.value);
            if (!others) return true;
            return others->table() ? holds(*others->table(), entry.value)
                                   : std::get<bool>(others->data);
        });
    }
    bool holds(const Table& schema, const std::string& key, const Value& rule,
               const Value& value) const {
        const Array* list = value.array();
        const auto each = [&](const Array& all, auto&& test) {
            return std::all_of(all.begin(), all.end(), test);
        };
        if (key == "$ref") return holds(part(*rule.string()), value);
        if (key == "type") return is_of_type(*rule.string(), value);
        if (key == "enum") {
            return !each(*rule.array(), [&](const Value& word) {
                return !value.string() || *word.string() != *value.string();
            });
        }
        if (key == "anyOf") {
            return !each(*rule.array(),
                         [&](const Value& one) { return !holds(*one.table(), value); });
        }
        if (key == "pattern") return !value.string() || matches(*rule.string(), *value.string());
        if (key == "properties") return !value.table() || accepts_object(schema, *value.table());
        if (key == "additionalProperties") {
            return schema.find("properties") || !value.table() ||
                   accepts_object(schema, *value.table());
        }
        if (key == "required") {
            return !value.table() || each(*rule.array(), [&](const Value& name) {
                return value.table()->find(*name.string()) != nullptr;
            });
        }
        if (key == "items") {
            return !list ||
                   each(*list, [&](const Value& item) { return holds(*rule.table(), item); });
        }
        if (key == "minItems") return !list || static_cast<double>(list->size()) >= number(rule);
        if (key == "maxItems") return !list || static_cast<double>(list->size()) <= number(rule);
        if (key == "minimum") {
            const bool excluded = schema.find("exclusiveMinimum");
            return !is_number(value) ||
                   (excluded ? number(value) > number(rule) : number(value) >= number(rule));
        }
        if (key == "maximum") return !is_number(value) || number(value) <= number(rule);
        return true;  // of description, title, $schema
    }

    const Table& root_;
};

}  // namespace rovernet::test
