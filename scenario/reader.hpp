// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/read_value.hpp"
#include "scenario/value.hpp"
#include "sim/fields.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Reads a table key by key, and then knows which of its keys nobody asked for.
class TableReader {
  public:
    /// @param name  of the table, for errors: "[radio]"
    /// @throws InputError if the value is no table
    TableReader(const Value& value, std::string name);

    /// The value under `key`, or null; the key counts as known.
    const Value* take(std::string_view key);
    /// Reads `key` if it is there. @throws InputError for a wrong type or outside the range
    template <class T>
    bool read(std::string_view key, T& out, const Range& range = any) {
        const Value* value = take(key);
        if (!value) return false;
        read_value(*value, key, out);
        check(*value, key, out, range);
        return true;
    }
    /// Reads every key of a described struct that is there.
    template <Described T>
    void read_fields(T& out) {
        for_each_field<T>([&](const auto& f) { read(f.name, out.*f.member, f.range); });
    }
    /// @throws InputError for the first key that was never asked for, with a suggestion
    void reject_unknown() const;
    /// @throws InputError at the table: `key` is missing; `example` shows one. If a key that
    /// nobody asked for yet looks like it: at that key, which is misspelt
    [[noreturn]] void missing(std::string_view key, std::string_view example) const;

    /// @throws InputError at `other`: only one of the two keys may be given
    [[noreturn]] void only_one_of(std::string_view key, std::string_view other) const;

    const Table& table() const { return *table_; }
    const Location& where() const { return where_; }

  private:
    bool is_known(std::string_view key) const;
    template <class T>
    void check(const Value& value, std::string_view key, const T& out, const Range& range) {
        const auto number = number_in(out);
        if (number && !range.contains(*number)) outside(value, key, range);
    }
    [[noreturn]] static void outside(const Value& value, std::string_view key, const Range& range);

    const Table* table_;
    Location where_;
    std::string name_;
    std::vector<std::string> known_;
};

/// One parameter as an entry; an optional one without a value is left out.
template <class M>
void append_field(Table& table, std::string_view name, const M& member) {
    if constexpr (requires { member.has_value(); }) {
        if (member) table.set(name, to_value(*member));
    } else {
        table.set(name, to_value(member));
    }
}

/// A described struct as a table.
template <Described T>
void append_fields(Table& table, const T& value) {
    for_each_field<T>([&](const auto& f) { append_field(table, f.name, value.*f.member); });
}

}  // namespace rovernet
