// SPDX-License-Identifier: MIT
#include "study/stored_row.hpp"

#include "scenario/document/json.hpp"

#include <fmt/format.h>

#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Statement.h>
#include <cmath>
#include <utility>

namespace rovernet {
namespace {

/// Content of a column, for errors.
std::string description(const SQLite::Column& column) {
    if (column.isNull()) return "nothing (NULL)";
    if (column.isBlob()) return fmt::format("{} bytes that are not text", column.getBytes());
    const bool is_text = column.isText();  // asked before SQLite turns a number into a text
    std::string value = column.getString();
    constexpr std::size_t longest = 40;
    if (value.size() > longest) value = value.substr(0, longest) + "...";
    return is_text ? fmt::format("the text \"{}\"", value) : fmt::format("the number {}", value);
}

/// "point" and "number" of "point.number".
std::pair<std::string, std::string> table_and_column(const std::string& name) {
    const auto dot = name.find('.');
    return {name.substr(0, dot), name.substr(dot + 1)};
}

}  // namespace

InputError damaged_store(const std::string& path, const std::string& what) {
    return InputError({path},
                      fmt::format("the store is damaged: {}; restore a copy of the store, or sweep "
                                  "again with --fresh, which deletes the stored runs",
                                  what));
}

void StoredRow::refuse(int column, const std::string& found, const std::string& expected) const {
    const auto [table, name] = table_and_column(statement_.getColumnName(column));
    std::string row;
    for (int i = 0; i < keys_; ++i) {
        row += fmt::format("{}{} \"{}\"", row.empty() ? "" : ", ",
                           table_and_column(statement_.getColumnName(i)).second,
                           statement_.getColumn(i).getString());
    }
    throw damaged_store(
        path_, fmt::format("table \"{}\", row with {}, column \"{}\": found {}, expected {}", table,
                           row, name, found, expected));
}

std::string StoredRow::text(int column) const {
    const SQLite::Column value = statement_.getColumn(column);
    if (!value.isText()) refuse(column, description(value), "a text");
    return value.getString();
}

std::uint32_t StoredRow::number(int column) const {
    constexpr std::int64_t most = 999'999;  // a study has a million points and replications at most
    const SQLite::Column value = statement_.getColumn(column);
    if (!value.isInteger() || value.getInt64() < 0 || value.getInt64() > most) {
        refuse(column, description(value), fmt::format("a whole number from 0 to {}", most));
    }
    return static_cast<std::uint32_t>(value.getInt64());
}

double StoredRow::real(int column) const {
    const SQLite::Column value = statement_.getColumn(column);
    if ((!value.isFloat() && !value.isInteger()) || !std::isfinite(value.getDouble())) {
        refuse(column, description(value), "a finite number");
    }
    return value.getDouble();
}

std::optional<double> StoredRow::optional_real(int column) const {
    if (statement_.getColumn(column).isNull()) return std::nullopt;
    return real(column);
}

Value StoredRow::document(int column) const {
    const std::string json = text(column);
    try {
        return parse_json(json);
    } catch (const InputError& error) {
        refuse(column, "a text that is " + error.message(), "JSON");
    }
}

}  // namespace rovernet
