// SPDX-License-Identifier: MIT
#include "scenario/unknown_key.hpp"

#include "scenario/schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>
#include <vector>

namespace rovernet {
namespace {

/// Keys in the schema of a table, of a list of tables, or of either; null: none.
const Table* keys_in(const Table& schema) {
    for (const char* key : {"properties", "items"}) {
        const Value* found = schema.find(key);
        if (!found || !found->table()) continue;
        return key == std::string_view("items") ? keys_in(*found->table()) : found->table();
    }
    const Value* either = schema.find("anyOf");
    if (!either || !either->array()) return nullptr;
    for (const Value& each : *either->array()) {
        const Table* keys = each.table() ? keys_in(*each.table()) : nullptr;
        if (keys) return keys;
    }
    return nullptr;
}

/// Names of the tables of a scenario that have a key: "[scene]", "[[robot]]".
std::vector<std::string> tables_with(std::string_view key) {
    std::vector<std::string> names;
    const Table schema = scenario_schema();
    for (const Entry& entry : schema.find("properties")->table()->entries) {
        const Table* keys = keys_in(*entry.value.table());
        if (!keys || !keys->find(key)) continue;
        const bool is_list = entry.key == "robot" || entry.key == "traffic";
        names.push_back(
            fmt::format("{}{}{}", is_list ? "[[" : "[", entry.key, is_list ? "]]" : "]"));
    }
    return names;
}

}  // namespace

InputError with_tables(const UnknownKey& fault) {
    const bool is_main = fault.table().starts_with('[');
    const auto tables = is_main ? tables_with(fault.key()) : std::vector<std::string>();
    if (tables.empty()) return {fault.where(), fault.message()};
    return {fault.where(), fmt::format("{}; \"{}\" is a key of {}", fault.message(), fault.key(),
                                       fmt::join(tables, ", "))};
}

}  // namespace rovernet
