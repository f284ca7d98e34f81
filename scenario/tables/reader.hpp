// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/tables/read_value.hpp"
#include "scenario/document/value.hpp"
#include "sim/fields.hpp"

#include <string>
#include <string_view>
#include <vector>

// The reading of tables. A mistake anywhere is an InputError with its file, line and column:
//
//     TableReader table(value, "[radio]");
//     table.read_fields(radio);
//     table.reject_unknown();

namespace rovernet {

/// Reader of one table, key by key. It notes which keys were asked for, so that reject_unknown()
/// finds the misspelt ones. The value must outlive it.
class TableReader {
  public:
    /// @param name  of the table, for errors: "[radio]"
    /// @throws InputError if the value is no table
    TableReader(const Value& value, std::string name);

    /// Value under `key`, or null; the key counts as known from now on.
    const Value* take(std::string_view key);
    /// Reads `key` if it is there. @return whether it is
    /// @param out    stays as it is if the key is not there
    /// @param range  of the number in it
    /// @throws InputError for a wrong type or a number outside the range
    template <class T>
    bool read(std::string_view key, T& out, const Range& range = any) {
        const Value* value = take(key);
        if (!value) return false;
        read_value(*value, key, out);
        check(*value, key, out, range);
        return true;
    }
    /// Reads every key of a described struct that is there, each within its range. Defaults are
    /// what `out` has.
    /// @throws InputError as read()
    template <Described T>
    void read_fields(T& out) {
        for_each_field<T>([&](const auto& f) { read(f.name, out.*f.member, f.range); });
    }
    /// Ends the reading of a table.
    /// @throws InputError for the first key that was never asked for, with a suggestion
    void reject_unknown() const;
    /// Tells that a key is missing that the table cannot do without.
    /// @param example  a line that shows it
    /// @throws InputError at the table; or at a key that nobody asked for yet and looks like it,
    /// which is misspelt
    [[noreturn]] void missing(std::string_view key, std::string_view example) const;

    /// Tells that two keys are there that exclude each other.
    /// @throws InputError at `other`
    [[noreturn]] void only_one_of(std::string_view key, std::string_view other) const;

    /// Table that is read, and its place.
    const Table& table() const { return *table_; }
    const Location& where() const { return where_; }

  private:
    // Whether somebody asked for the key.
    bool is_known(std::string_view key) const;
    // Checks the number in `out`, if there is one, against its range.
    template <class T>
    void check(const Value& value, std::string_view key, const T& out, const Range& range) {
        const auto number = number_in(out);
        if (number && !range.contains(*number)) outside(value, key, range);
    }
    // Tells that a number is out of its range.
    [[noreturn]] static void outside(const Value& value, std::string_view key, const Range& range);

    const Table* table_;
    Location where_;
    std::string name_;
    // Keys that were asked for, in that order: an error lists them.
    std::vector<std::string> known_;
};

/// Appends one parameter as an entry; an optional one without a value is left out.
template <class M>
void append_field(Table& table, std::string_view name, const M& member) {
    if constexpr (requires { member.has_value(); }) {
        if (member) table.set(name, to_value(*member));
    } else {
        table.set(name, to_value(member));
    }
}

/// Appends every parameter of a described struct: what read_fields() reads back.
template <Described T>
void append_fields(Table& table, const T& value) {
    for_each_field<T>([&](const auto& f) { append_field(table, f.name, value.*f.member); });
}

}  // namespace rovernet
