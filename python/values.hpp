// SPDX-License-Identifier: MIT
#pragma once

#include "python/arguments.hpp"
#include "scenario/document/value.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "scenario/tables/read_value.hpp"

#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

// Conversion between Python objects and the class Value: scenarios as dicts, metrics as dicts.

namespace rovernet::python {

namespace py = pybind11;

inline py::object to_python(const Value& value);

inline py::dict to_python(const Table& table) {
    py::dict dict;
    for (const Entry& entry : table.entries) dict[py::str(entry.key)] = to_python(entry.value);
    return dict;
}

inline py::object to_python(const Value& value) {
    if (const Table* table = value.table()) return to_python(*table);
    if (const Array* array = value.array()) {
        py::list list;
        for (const Value& each : *array) list.append(to_python(each));
        return list;
    }
    if (const std::string* text = value.string()) return py::str(*text);
    if (const auto* truth = std::get_if<bool>(&value.data)) return py::bool_(*truth);
    if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return py::int_(*whole);
    if (const auto* number = std::get_if<double>(&value.data)) return py::float_(*number);
    return py::none();
}

inline std::int64_t whole_number(const py::object& index, const std::string& place) {
    int overflow = 0;
    const std::int64_t number = PyLong_AsLongLongAndOverflow(index.ptr(), &overflow);
    if (overflow == 0) return number;
    throw InputError({.source = place}, "expected a whole number below 2^63");
}

/// Whether an object is a scalar or an array of NumPy, or of a library with the same functions.
inline bool is_from_numpy(py::handle given) {
    return py::hasattr(given, "dtype") && py::hasattr(given, "tolist");
}

/// Python object with the value of a NumPy scalar or array: a number, bool, str or list.
inline py::object plain(py::handle given) {
    const py::object value = given.attr("tolist")();
    // A longdouble is a longdouble again.
    return py::type::of(value).is(py::type::of(given)) ? py::object(py::float_(value)) : value;
}

/// Scenario value from a Python object: dict, list, tuple, str, bool or number; a NumPy scalar or
/// array is converted by tolist(). Numbers without a unit are in SI units, as on the command line.
/// @param place  path of the value in Python notation, for errors: scenario["radio"]["power"]
/// @throws InputError for objects of other types, keys that are not texts, whole numbers that do
///         not fit into 64 bits, and more than 32 nesting levels
inline Value to_value(py::handle given, const std::string& place, int depth = 0) {
    constexpr int deepest = 32;
    const Location where{.source = place, .is_option = true};
    if (depth > deepest) {
        throw InputError(
            where,
            fmt::format("found dicts and lists nested too deeply; expected {} levels at most",
                        deepest));
    }
    if (is_from_numpy(given)) return to_value(plain(given), place, depth + 1);
    if (py::isinstance<py::dict>(given)) {
        Table table;
        for (const auto& [key, value] : py::cast<py::dict>(given)) {
            if (!py::isinstance<py::str>(key)) {
                throw InputError(where, fmt::format("found the key {}; expected texts as keys",
                                                    std::string(py::repr(key))));
            }
            const auto name = py::cast<std::string>(key);
            const std::string within = fmt::format("{}[\"{}\"]", place, name);
            table.entries.push_back(
                {name, to_value(value, within, depth + 1), {.source = within, .is_option = true}});
        }
        return placed(std::move(table), where);
    }
    const bool is_list = py::isinstance<py::list>(given) || py::isinstance<py::tuple>(given);
    if (is_list) {
        Array array;
        for (const py::handle each : py::reinterpret_borrow<py::sequence>(given)) {
            array.push_back(to_value(each, fmt::format("{}[{}]", place, array.size()), depth + 1));
        }
        return placed(std::move(array), where);
    }
    if (py::isinstance<py::bool_>(given)) return placed(py::cast<bool>(given), where);
    if (py::isinstance<py::str>(given)) return placed(py::cast<std::string>(given), where);
    if (PyFloat_Check(given.ptr())) return placed(py::cast<double>(given), where);
    const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(given.ptr()));
    if (index) return placed(whole_number(index, place), where);
    if (!PyErr_ExceptionMatches(PyExc_TypeError)) throw py::error_already_set();
    PyErr_Clear();
    throw InputError(where, fmt::format("found {}; expected a text, a number, True or False, a "
                                        "list or a dict",
                                        std::string(py::repr(given))));
}

/// Path as text, from a str or an object with __fspath__.
/// @param argument, expected  name of the Python argument and what it may be, for error messages
inline std::string path_in(const py::object& given, std::string_view argument,
                           std::string_view expected) {
    const auto name = py::reinterpret_steal<py::object>(PyOS_FSPath(given.ptr()));
    if (name) return py::cast<std::string>(name);
    if (!PyErr_ExceptionMatches(PyExc_TypeError)) throw py::error_already_set();
    PyErr_Clear();
    throw py::type_error(fmt::format("{}: expected {}, got {}", argument, expected, shown(given)));
}

/// Folder of the argument `out`; none for None.
inline std::optional<std::string> folder_in(const py::object& out) {
    if (out.is_none()) return std::nullopt;
    return path_in(out, "out", "the path of a folder, or None");
}

/// Scenario from the path of a file, or from a dict; notices become Python warnings.
/// @param set   dict of values by path, as for --set; or None
/// @param seed  seed of the run; or None
inline Scenario to_scenario(const py::object& given, const py::object& set,
                            const py::object& seed) {
    Table settings;
    const auto add = [&](const std::string& path, py::handle value, const std::string& place) {
        settings.entries.push_back(
            {path, to_value(value, place), {.source = place, .is_option = true}});
    };
    if (!set.is_none() && !py::isinstance<py::dict>(set)) {
        throw py::type_error("set: expected a dict, such as {\"radio.power\": \"15 dBm\"}");
    }
    if (!set.is_none()) {
        for (const auto& [path, value] : py::cast<py::dict>(set)) {
            if (!py::isinstance<py::str>(path)) {
                throw py::type_error("set: expected texts as keys, such as \"radio.power\"");
            }
            const auto text = py::cast<std::string>(path);
            add(text, value, fmt::format("set[\"{}\"]", text));
        }
    }
    if (!seed.is_none()) add("scenario.seed", seed, "argument seed");
    Value document;
    std::string path;
    if (py::isinstance<py::dict>(given)) {
        document = to_value(given, "scenario");
    } else {
        path = path_in(given, "scenario", "the path of a file or a dict");
    }
    Scenario scenario = [&] {
        const py::gil_scoped_release others_run;
        return load_scenario(path.empty() && document.table() ? ScenarioFile(document, path, {})
                                                              : ScenarioFile(path, {}),
                             settings);
    }();
    for (const std::string& notice : scenario.notices) {
        if (PyErr_WarnEx(PyExc_UserWarning, notice.c_str(), 1) != 0) throw py::error_already_set();
    }
    return scenario;
}

}  // namespace rovernet::python
