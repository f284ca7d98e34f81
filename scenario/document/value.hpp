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

// Documents: the parsed content of a file, before it is interpreted. TOML, JSON, Stage worlds and
// the command line are parsed into Values; readers convert Values to structs, and printers convert
// structs to Values.

namespace rovernet {

struct Value;
struct Entry;

/// List of values.
using Array = std::vector<Value>;

/// Table of keys and values, in the order of the file; keys are unique.
///
///   Table radio;
///   radio.set("power", "15 dBm");
///   if (const Value* power = radio.find("power")) use(power->string());
///
/// find() is a linear search: tables in files are short.
struct Table {
    /// Entries in the order of the file. Readers of tables search the entries for unknown keys.
    std::vector<Entry> entries;

    /// Value of `key`, or null if the table lacks the key. The pointer is valid until an entry is
    /// added.
    const Value* find(std::string_view key) const;
    Value* find(std::string_view key);
    /// Adds an entry, or replaces the value of the entry with this key.
    void set(std::string_view key, Value value);

    // Special member functions, defined out of line, since Entry is an incomplete type here.
    Table();
    Table(const Table&);
    Table(Table&&) noexcept;
    Table& operator=(const Table&);
    Table& operator=(Table&&) noexcept;
    ~Table();
};

/// Value of a document, and the file position from which it was read. A default Value is empty:
/// null in JSON.
///
/// Numbers are int64 or double, as written in the file. A quantity ("2450 MHz") is a string until
/// read_quantity() converts it.
struct Value {
    /// Content of the value; std::monostate: the value is empty.
    std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Table> data;
    /// File position of the value; no line if the value was made in code.
    Location where;

    Value();
    /// Constructors of a value that is made in code and has no file position. They are implicit, so
    /// that a list may be written as Array{1, 2.5, "3 m"}.
    Value(bool v);
    Value(int v);
    Value(std::int64_t v);
    Value(std::uint64_t v);
    Value(std::uint32_t v);
    Value(double v);
    Value(const std::optional<double>& v);         ///< makes an empty Value if `v` is empty
    Value(const std::optional<std::uint64_t>& v);  ///< makes an empty Value if `v` is empty
    Value(const char* v);
    Value(std::string_view v);
    Value(std::string v);
    Value(Array v);
    Value(Table v);

    /// Pointer to the content if the content is a table; otherwise null. array() and string() are
    /// equal functions for a list and for a text.
    const Table* table() const { return std::get_if<Table>(&data); }
    Table* table() { return std::get_if<Table>(&data); }
    const Array* array() const { return std::get_if<Array>(&data); }
    Array* array() { return std::get_if<Array>(&data); }
    const std::string* string() const { return std::get_if<std::string>(&data); }

    /// Description of the value for an error message: "the number 5", "a table"; a text is cut at
    /// 60 bytes.
    std::string description() const;
};

/// Copy of a value that is made in code, with the file position `where` for error messages.
Value placed(Value value, const Location& where);

/// Key with its value. The key has its own file position, since its value may be on another line.
struct Entry {
    std::string key;
    Value value;
    Location key_where;
};

}  // namespace rovernet
