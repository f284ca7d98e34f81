// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

// Documents: what a file says before it means anything. TOML, JSON, worlds and the command line all
// become Values; readers make structs of them, and printers make Values of structs.

namespace rovernet {

struct Value;
struct Entry;

/// List of values.
using Array = std::vector<Value>;

/// Keys and values, in the order of the file; keys are unique.
///
///   Table radio;
///   radio.set("power", "15 dBm");
///   if (const Value* power = radio.find("power")) use(power->string());
///
/// find() goes through them one by one: tables of files are short.
struct Table {
    /// Entries in their order. Readers go through them, for keys that nobody asked for.
    std::vector<Entry> entries;

    /// Value under `key`, or null; good until an entry is added.
    const Value* find(std::string_view key) const;
    Value* find(std::string_view key);
    /// Adds an entry, or replaces the value of the one that is there.
    void set(std::string_view key, Value value);

    // Out of line, as Entry is known only below.
    Table();
    Table(const Table&);
    Table(Table&&) noexcept;
    Table& operator=(const Table&);
    Table& operator=(Table&&) noexcept;
    ~Table();
};

/// Piece of a document, and the place where it was read. A default Value is empty: null in JSON.
///
/// Numbers are int64 or double, as they were written; a quantity is a string until somebody knows
/// its dimension, see read_quantity().
struct Value {
    /// Content; std::monostate: none.
    std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Table> data;
    /// Place of the value; without a line if it was made in code.
    Location where;

    Value();
    /// Values made in code have no place. Implicit, so that a list may be written as Array{1, 2.5,
    /// "3 m"}.
    Value(bool v);
    Value(int v);
    Value(std::int64_t v);
    Value(std::uint64_t v);
    Value(std::uint32_t v);
    Value(double v);
    Value(const std::optional<double>& v);  ///< empty if there is none
    Value(const char* v);
    Value(std::string_view v);
    Value(std::string v);
    Value(Array v);
    Value(Table v);

    /// Value as one of its types, or null if it is of another.
    const Table* table() const { return std::get_if<Table>(&data); }
    Table* table() { return std::get_if<Table>(&data); }
    const Array* array() const { return std::get_if<Array>(&data); }
    Array* array() { return std::get_if<Array>(&data); }
    const std::string* string() const { return std::get_if<std::string>(&data); }

    /// Words for it in an error: "the number 5", "a table"; a text is cut at 60 bytes.
    std::string description() const;
};

/// A value made in code, as if it stood at a place.
Value placed(Value value, const Location& where);

/// Key with its value, and the place of the key: that of the value may be another line.
struct Entry {
    std::string key;
    Value value;
    Location key_where;
};

}  // namespace rovernet
