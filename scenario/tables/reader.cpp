// SPDX-License-Identifier: MIT
#include "scenario/tables/reader.hpp"

#include "scenario/document/toml.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace rovernet {
namespace {

/// Number without a unit that a user typed for a quantity: what it was read as, and the unit to
/// write; empty for anything else.
std::string unit_hint(const Value& value, std::string_view key, const Range& range) {
    const bool is_number = std::holds_alternative<double>(value.data) ||
                           std::holds_alternative<std::int64_t>(value.data);
    const std::string_view text = range.text;
    const std::string_view unit = text.substr(std::min(text.rfind(' ') + 1, text.size()));
    const bool has_unit =
        !unit.empty() && ((unit.front() | 0x20) >= 'a' && (unit.front() | 0x20) <= 'z');
    if (!value.where.is_option || !is_number || !has_unit) return "";
    return fmt::format(
        "; this number has no unit and was read in SI units; write the unit, such as "
        "{}=\"{} {}\"",
        key, plain_text(value), unit);
}

}  // namespace

TableReader::TableReader(const Value& value, std::string name)
    : table_(value.table()), where_(value.where), name_(std::move(name)) {
    if (!table_) {
        throw InputError(value.where,
                         fmt::format("{}: found {}; expected a table", name_, value.description()));
    }
}

bool TableReader::is_known(std::string_view key) const {
    return std::find(known_.begin(), known_.end(), key) != known_.end();
}

const Value* TableReader::take(std::string_view key) {
    if (!is_known(key)) known_.emplace_back(key);
    return table_->find(key);
}

std::span<const Value> TableReader::take_list(std::string_view key) {
    const Value* value = take(key);
    if (!value) return {};
    if (value->array()) return *value->array();
    const char* why =
        value->where.is_option ? " in the scenario file, because an option cannot add a table" : "";
    throw InputError(
        value->where,
        fmt::format("{}: found {}; expected a list of tables, each with the header [[{}]]{}", key,
                    value->description(), key, why));
}

void TableReader::reject_unknown() const {
    for (const auto& entry : table_->entries) {
        if (is_known(entry.key)) continue;
        const std::string near = did_you_mean(entry.key, known_);
        throw UnknownKey(
            entry.key_where,
            fmt::format("unknown key \"{}\" in {}; expected one of {}{}{}", entry.key, name_,
                        fmt::join(known_, ", "), near.empty() ? "" : "; ", near),
            entry.key, name_);
    }
}

void TableReader::missing(std::string_view key, std::string_view example) const {
    for (const auto& entry : table_->entries) {
        if (is_known(entry.key)) continue;
        const std::string near = did_you_mean(entry.key, {std::string(key)});
        if (near.empty()) continue;
        throw InputError(entry.key_where,
                         fmt::format("unknown key \"{}\" in {}; {}", entry.key, name_, near));
    }
    if (const Value* given = table_->find(key)) {
        const bool is_empty = given->array() && given->array()->empty();
        throw InputError(given->where,
                         fmt::format("{}: {}: found {}; expected for example {}", name_, key,
                                     is_empty ? "an empty list" : given->description(), example));
    }
    throw InputError(
        where_, fmt::format("{}: the key \"{}\" is missing; for example {}", name_, key, example));
}

void TableReader::only_one_of(std::string_view key, std::string_view other) const {
    throw InputError(table_->find(other)->where,
                     fmt::format("{}: found both \"{}\" and \"{}\"; expected only one of them",
                                 name_, key, other));
}

void throw_outside(const Value& value, std::string_view key, const Range& range) {
    throw InputError(value.where,
                     fmt::format("{}: found {}; expected a value {}{}", key, value.description(),
                                 range.text, unit_hint(value, key, range)));
}

void throw_not_given(const Location& where, std::string_view what, std::string_view model,
                     std::string_view key, std::string_view meaning) {
    throw InputError(
        where, fmt::format("{} \"{}\" needs the key \"{}\" ({}); for example {} = \"50 m\"", what,
                           model, key, meaning, key));
}

void append_differing(Table& table, const Table& given, const Table& defaults) {
    for (const Entry& entry : given.entries) {
        const Value* usual = defaults.find(entry.key);
        const bool is_unset = entry.value.string() && entry.value.string()->starts_with("nan");
        if (is_unset || table.find(entry.key)) continue;
        if (usual && usual->data.index() == entry.value.data.index() &&
            usual->description() == entry.value.description()) {
            continue;
        }
        table.set(entry.key, entry.value);
    }
}

}  // namespace rovernet
