// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Arguments of Python functions whose wrong types get an error message in plain words, in place of
// pybind11's list of C++ signatures:
//
//     TypeError: speed: expected a number of metres per second, got '1 m/s'

namespace rovernet::python {

namespace py = pybind11;

/// Text as a template argument.
template <std::size_t size>
struct Words {
    char text[size];
    consteval Words(const char (&given)[size]) { std::copy_n(given, size, text); }
    constexpr operator std::string_view() const { return {text, size - 1}; }
};

/// Argument of a Python function.
/// @tparam T         C++ type to which the Python object is converted
/// @tparam name      name of the argument, for the error message
/// @tparam expected  what the argument may be, for the error message
template <class T, Words name, Words expected>
struct Argument {
    T value{};
};

using RobotArgument = Argument<std::string, "robot", "the name of a robot, such as \"A\"">;
using OptionalRobotArgument =
    Argument<std::optional<std::string>, "robot", "the name of a robot, such as \"A\", or None">;
using RobotsArgument = Argument<std::optional<std::vector<std::string>>, "robots",
                                "a list of names, such as [\"A\", \"B\"], or None">;
using StepArgument = Argument<double, "step", "a number of seconds">;
using KindsArgument = Argument<std::vector<std::string>, "records",
                               "a list of kinds of records, such as [\"received\"]">;
using SeedArgument = Argument<std::optional<std::uint64_t>, "seed", "a whole number >= 0, or None">;

/// Text of a Python object for an error message, at most a line long.
inline std::string shown(py::handle object) {
    constexpr py::ssize_t longest = 60;
    const py::str text = py::repr(object);
    if (py::len(text) <= static_cast<std::size_t>(longest)) return text;
    return std::string(py::str(text[py::slice(0, longest, 1)])) + "...";
}

/// Checks that an argument can be called, or is None. @param name  of the argument
inline void check_callable(const py::object& function, std::string_view name) {
    if (function.is_none() || PyCallable_Check(function.ptr()) != 0) return;
    throw py::type_error(
        fmt::format("{}: expected a function, or None, got {}", name, shown(function)));
}

}  // namespace rovernet::python

namespace pybind11::detail {

template <class T, rovernet::python::Words name_, rovernet::python::Words expected>
struct type_caster<rovernet::python::Argument<T, name_, expected>> {
    using Argument = rovernet::python::Argument<T, name_, expected>;
    PYBIND11_TYPE_CASTER(Argument, make_caster<T>::name);

    bool load(handle given, bool /*convert*/) {
        make_caster<T> converted;
        if (!converted.load(given, true)) {
            throw type_error(fmt::format("{}: expected {}, got {}", std::string_view(name_),
                                         std::string_view(expected),
                                         rovernet::python::shown(given)));
        }
        value.value = cast_op<T>(std::move(converted));
        return true;
    }
};

}  // namespace pybind11::detail
