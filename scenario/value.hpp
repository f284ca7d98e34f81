// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace rovernet {

struct Value;
struct Entry;

/// A list of values.
using Array = std::vector<Value>;

/// Keys and values in order; keys are unique.
struct Table {
    std::vector<Entry> entries;

    /// The value under `key`, or null.
    const Value* find(std::string_view key) const;
    Value* find(std::string_view key);
    /// Adds an entry, or replaces the value of the one that is there.
    void set(std::string_view key, Value value);

    Table();
    Table(const Table&);
    Table(Table&&) noexcept;
    Table& operator=(const Table&);
    Table& operator=(Table&&) noexcept;
    ~Table();
};

/// A piece of a document (TOML in, TOML or JSON out), and where it was read.
struct Value {
    std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Table> data;
    Location where;

    Value();
    Value(bool v);
    Value(int v);
    Value(std::int64_t v);
    Value(std::uint64_t v);
    Value(std::uint32_t v);
    Value(double v);
    Value(const char* v);
    Value(std::string_view v);
    Value(std::string v);
    Value(Array v);
    Value(Table v);

    const Table* table() const { return std::get_if<Table>(&data); }
    Table* table() { return std::get_if<Table>(&data); }
    const Array* array() const { return std::get_if<Array>(&data); }
    Array* array() { return std::get_if<Array>(&data); }
    const std::string* string() const { return std::get_if<std::string>(&data); }

    /// What it is, for errors: "the number 5", "a table".
    std::string description() const;
};

struct Entry {
    std::string key;
    Value value;
    Location key_where;
};

}  // namespace rovernet
