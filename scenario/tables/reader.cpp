// SPDX-License-Identifier: MIT
#include "scenario/tables/reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace rovernet {

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

void TableReader::reject_unknown() const {
    for (const auto& entry : table_->entries) {
        if (is_known(entry.key)) continue;
        const std::string near = did_you_mean(entry.key, known_);
        throw InputError(
            entry.key_where,
            fmt::format("unknown key \"{}\" in {}; expected one of {}{}{}", entry.key, name_,
                        fmt::join(known_, ", "), near.empty() ? "" : "; ", near));
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
    throw InputError(value.where, fmt::format("{}: found {}; expected a value {}", key,
                                              value.description(), range.text));
}

void throw_not_given(const Location& where, std::string_view what, std::string_view model,
                     std::string_view key, std::string_view meaning) {
    throw InputError(where, fmt::format("{} \"{}\" needs the key \"{}\", {}; for example {} = "
                                        "\"50 m\"",
                                        what, model, key, meaning, key));
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
