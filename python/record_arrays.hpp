// SPDX-License-Identifier: MIT
#pragma once

#include "traces/row_sink.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstring>
#include <string>
#include <string_view>

// Conversion of record rows to NumPy structured arrays, and of a single row to a dict.

namespace rovernet::python {

namespace py = pybind11;

inline py::object text(std::string_view letters) { return py::str(letters.data(), letters.size()); }

inline py::array to_array(const RowSink::Table& table) {
    py::list names, formats, offsets;
    for (const RowColumn& column : table.columns) {
        names.append(text(column.name));
        formats.append(text(column.format));
        offsets.append(column.offset);
    }
    const py::dtype type(names, formats, offsets, static_cast<py::ssize_t>(table.row_size));
    return py::array(type, table.size(), table.bytes.data());  // a copy
}

inline py::object to_python(std::string_view format, const std::byte* cell) {
    const auto as = [cell]<class T>(T value) {
        std::memcpy(&value, cell, sizeof value);
        return value;
    };
    if (format == "<i8") return py::int_(as(std::int64_t{}));
    if (format == "<i4") return py::int_(as(std::int32_t{}));
    if (format == "<f8") return py::float_(as(double{}));
    if (format == "?") return py::bool_(as(bool{}));
    std::string letters;
    for (const char32_t letter : as(CodeCell{})) {
        if (letter != 0) letters += static_cast<char>(letter);
    }
    return py::str(letters);
}

inline py::dict row_of(const RowSink::Table& table, std::size_t row) {
    py::dict dict;
    const std::byte* at = table.bytes.data() + row * table.row_size;
    for (const RowColumn& column : table.columns) {
        dict[text(column.name)] = to_python(column.format, at + column.offset);
    }
    return dict;
}

}  // namespace rovernet::python
