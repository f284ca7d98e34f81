// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "scenario/tables/read_value.hpp"
#include "sim/fields.hpp"

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Reader of the tables of a scenario file. A mistake in the file causes an InputError with file,
// line and column:
//
//     TableReader table(value, "[radio]");
//     table.expect<Radio>();
//     table.read_fields(radio);

namespace rovernet {

/// Reports that a number is out of its range.
/// @throws InputError at the value
[[noreturn]] void throw_outside(const Value& value, std::string_view key, const Range& range);
/// Reports that a model lacks a parameter that has no default.
/// @throws InputError at `where`
[[noreturn]] void throw_not_given(const Location& where, std::string_view what,
                                  std::string_view model, std::string_view key,
                                  std::string_view meaning);

/// Error about an unknown key of a table.
class UnknownKey : public InputError {
  public:
    /// @param table  name of the table, such as "[radio]"
    UnknownKey(Location where, const std::string& message, std::string key, std::string table)
        : InputError(std::move(where), message), key_(std::move(key)), table_(std::move(table)) {}
    const std::string& key() const { return key_; }
    const std::string& table() const { return table_; }

  private:
    std::string key_, table_;
};

/// Reader of one table of a document, key by key. The reader records the keys that callers expect
/// or read, so that reject_unknown() finds misspelt keys. The value must outlive the reader.
class TableReader {
  public:
    /// @param name  name of the table, for error messages: "[radio]"
    /// @throws InputError if the value is no table
    TableReader(const Value& value, std::string name);

    /// Declares the keys of the table: the fields of the structs T, then `more`. To be called
    /// before any value is read, so that a misspelt key is reported before a value that it might
    /// explain.
    /// @throws InputError for the first other key; the message suggests a key
    template <Described... T>
    void expect(std::initializer_list<std::string_view> more = {}) {
        (for_each_field<T>([&](const auto& f) { take(f.name); }), ...);
        for (const std::string_view key : more) take(key);
        reject_unknown();
    }
    /// Value of `key`, or null if the table lacks the key. reject_unknown() accepts the key from
    /// now on.
    const Value* take(std::string_view key);
    /// Tables of the list `key`, each with the header [[key]]; empty if the table lacks the key.
    /// @throws InputError if the value is no list
    std::span<const Value> take_list(std::string_view key);
    /// Reads the value of `key` if the key is present. @return whether the key is present
    /// @param out    unchanged if the key is missing
    /// @param range  allowed range of the number
    /// @throws InputError for a wrong type or a number outside the range
    template <class T>
    bool read(std::string_view key, T& out, const Range& range = any) {
        const Value* value = take(key);
        if (!value) return false;
        read_value(*value, key, out);
        check(*value, key, out, range);
        return true;
    }
    /// Reads `key` if it is present and valid; otherwise `out` is unchanged.
    /// @return whether the key was read
    template <class T>
    bool read_if_valid(std::string_view key, T& out, const Range& range) {
        T given = out;
        try {
            if (!read(key, given, range)) return false;
            out = std::move(given);
            return true;
        } catch (const InputError&) {
            return false;
        }
    }
    /// Reads every key of a struct with fields(), and checks its range. A missing key leaves its
    /// field of `out` unchanged.
    /// @throws InputError as read()
    template <Described T>
    void read_fields(T& out) {
        for_each_field<T>([&](const auto& f) { read(f.name, out.*f.member, f.range); });
    }
    /// Checks that the table has no unknown keys, after the last key was read or taken. A table
    /// whose keys are known beforehand calls expect() instead.
    /// @throws InputError for the first key that no caller has read; the message suggests a key
    void reject_unknown() const;
    /// Reports that a required key is missing, or that its value is empty or too short.
    /// @param example  example line for the message
    /// @throws InputError at the value of the key if the table has it, at an unknown key that looks
    ///         like a misspelling of `key`, or else at the table
    [[noreturn]] void missing(std::string_view key, std::string_view example) const;

    /// Reports that the keys `key` and `other` exclude each other.
    /// @throws InputError at the file position of `other`
    [[noreturn]] void only_one_of(std::string_view key, std::string_view other) const;

    /// Table that is read, and its file position.
    const Table& table() const { return *table_; }
    const Location& where() const { return where_; }

  private:
    // Whether a caller has read or tested the key.
    bool is_known(std::string_view key) const;
    // Checks that the number in `out` is in the range, if `out` is a number or a quantity.
    template <class T>
    void check(const Value& value, std::string_view key, const T& out, const Range& range) {
        const auto number = number_in(out);
        if (number && !range.contains(*number)) throw_outside(value, key, range);
    }
    const Table* table_;
    Location where_;
    std::string name_;
    // Keys that callers have read or tested, in this order: the known keys of the table, which the
    // error about an unknown key lists.
    std::vector<std::string> known_;
};

/// Appends an entry to a table: the key `name` with the value `member`, a field of a struct. An
/// empty optional is omitted.
template <class M>
void append_field(Table& table, std::string_view name, const M& member) {
    if constexpr (requires { member.has_value(); }) {
        if (member) table.set(name, to_value(*member));
    } else {
        table.set(name, to_value(member));
    }
}

/// Appends to a table the entries of `given` that have a value, differ from the entry of `defaults`
/// with the same key, and are not yet in the table.
void append_differing(Table& table, const Table& given, const Table& defaults);

/// Appends every field of a struct with fields() to a table, for read_fields() to read back.
template <Described T>
void append_fields(Table& table, const T& value) {
    for_each_field<T>([&](const auto& f) { append_field(table, f.name, value.*f.member); });
}

}  // namespace rovernet
