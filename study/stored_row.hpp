// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "sim/error.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace SQLite {
class Statement;
}  // namespace SQLite

namespace rovernet {

/// Result row of an SQL statement on a store. Columns are checked when read, since any program may
/// have written the store.
///
/// The statement must name each column "table.column". Its first columns are integers that identify
/// the row.
class StoredRow {
  public:
    /// @param path  path of the store, for errors
    /// @param keys  number of columns that identify the row, > 0
    StoredRow(const std::string& path, const SQLite::Statement& statement, int keys)
        : path_(path), statement_(statement), keys_(keys) {}

    /// Value in a column of this row.
    /// @throws InputError by refuse() if the value has a wrong type or is out of range
    std::string text(int column) const;
    std::uint32_t number(int column) const;                 ///< whole number, 0 ... 999,999
    double real(int column) const;                          ///< finite number
    std::optional<double> optional_real(int column) const;  ///< finite number; none: NULL
    Value document(int column) const;                       ///< value parsed from a JSON text

    /// Throws an InputError that reports a damaged store. The message names table, row, column, and
    /// the found and the expected value.
    [[noreturn]] void refuse(int column, const std::string& found,
                             const std::string& expected) const;

  private:
    const std::string& path_;
    const SQLite::Statement& statement_;
    int keys_;
};

/// Error that reports a damaged store. The message suggests a remedy to the user.
/// @param what  found and expected content
InputError damaged_store(const std::string& path, const std::string& what);

}  // namespace rovernet
