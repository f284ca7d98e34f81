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

/// A row of a store as a statement answers it, its columns checked: anybody may have written it.
///
/// The statement names each column "table.column". Its first columns are integers that tell which
/// row of that table it is.
class StoredRow {
  public:
    /// @param path  of the store, for errors
    /// @param keys  number of columns that tell which row it is, > 0
    StoredRow(const std::string& path, const SQLite::Statement& statement, int keys)
        : path_(path), statement_(statement), keys_(keys) {}

    /// The value in a column.
    /// @throws InputError, as refuse() does, if it is of another type or out of range
    std::string text(int column) const;
    std::uint32_t number(int column) const;                 ///< whole, below a million
    double real(int column) const;                          ///< finite
    std::optional<double> optional_real(int column) const;  ///< number; none: NULL
    Value document(int column) const;                       ///< value of a text in JSON

    /// Says that the store is damaged: table, row, column, what was found and what was expected.
    /// @throws InputError
    [[noreturn]] void refuse(int column, const std::string& found,
                             const std::string& expected) const;

  private:
    const std::string& path_;
    const SQLite::Statement& statement_;
    int keys_;
};

/// The error of a damaged store, with what to do about it.
/// @param what  what is wrong, and what was expected
InputError damaged_store(const std::string& path, const std::string& what);

}  // namespace rovernet
