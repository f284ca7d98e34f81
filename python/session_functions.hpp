// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/summary.hpp"
#include "python/arguments.hpp"
#include "python/command_values.hpp"
#include "python/session_object.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Commands to a session, and queries of its robots' states, with Python arguments and NumPy arrays.

namespace rovernet::python {

using namespace py::literals;

using TimeoutArgument = Argument<std::optional<double>, "timeout", "a number of seconds, or None">;
using PlaceArgument = Argument<std::vector<double>, "to", "a place (x, y) or (x, y, z) in metres">;
using SpeedArgument = Argument<double, "speed", "a number of metres per second">;
using XArgument = Argument<double, "x", "a number of metres">;
using YArgument = Argument<double, "y", "a number of metres">;
using ZArgument = Argument<std::optional<double>, "z", "a number of metres, or None">;
using HeadingArgument = Argument<std::optional<double>, "heading", "a number of radians, or None">;
using DataArgument = Argument<py::bytes, "data", "bytes, such as b\"F\"">;
using ReceiverArgument = Argument<std::optional<std::string>, "to",
                                  "the name of a robot, such as \"A\", or None for everyone">;
using PortArgument = Argument<std::int64_t, "port", "a whole number">;
using SizeArgument = Argument<std::optional<std::int64_t>, "size", "a number of bytes, or None">;

inline std::optional<Duration> duration_in(const std::optional<double>& s) {
    return s ? std::optional(from_seconds(*s)) : std::nullopt;
}

inline void drive(SessionObject& session, const py::object& velocities,
                  const TimeoutArgument& timeout) {
    using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
    const auto robots = static_cast<py::ssize_t>(session.run().robots().size());
    const auto numbers = Numbers::ensure(velocities);
    if (!numbers || numbers.ndim() != 2 || numbers.shape(0) != robots || numbers.shape(1) != 2) {
        const py::object shape =
            numbers ? numbers.attr("shape") : py::object(py::str(py::type::of(velocities)));
        throw py::value_error(fmt::format("drive: expected numbers of shape ({}, 2), got {}",
                                          robots, std::string(py::str(shape))));
    }
    session.run().drive({numbers.data(), static_cast<std::size_t>(numbers.size())},
                        duration_in(timeout.value));
}

inline RobotState state_of(SessionObject& session, std::size_t row) {
    return session.network().robot(session.run().robots()[row]);
}

inline void go_to(SessionObject& session, const RobotArgument& robot, const PlaceArgument& place,
                  const SpeedArgument& speed) {
    const std::vector<double>& to = place.value;
    if (to.size() != 2 && to.size() != 3) {
        throw py::value_error(
            fmt::format("go_to: expected a place (x, y) or (x, y, z), got {} numbers", to.size()));
    }
    const std::size_t row = session.row(robot.value);
    const double z = to.size() == 3 ? to[2] : state_of(session, row).at.z;
    session.run().command(row, GoalCommand{{to[0], to[1], z}, {speed.value}});
}

inline void place(SessionObject& session, const RobotArgument& robot, const XArgument& x,
                  const YArgument& y, const HeadingArgument& heading, const ZArgument& z) {
    const std::size_t row = session.row(robot.value);
    const RobotState now = state_of(session, row);
    session.run().command(row, PlaceCommand{{x.value, y.value, z.value.value_or(now.at.z)},
                                            {heading.value.value_or(now.heading.value)}});
}

inline std::int64_t whole_in(std::string_view what, std::int64_t number) {
    if (number >= 0 && number <= 65'535) return number;
    throw py::value_error(fmt::format("send: {} must be from 0 to 65535, got {}", what, number));
}

inline void send(SessionObject& session, const RobotArgument& robot, const DataArgument& data,
                 const ReceiverArgument& to, const PortArgument& port, const SizeArgument& size) {
    SendCommand send{.port = static_cast<std::uint16_t>(whole_in("port", port.value)),
                     .payload = data.value};
    const std::size_t row = session.row(robot.value);
    if (to.value) send.to = robot_named(session.network(), *to.value);
    if (size.value) send.size = static_cast<std::uint32_t>(whole_in("size", *size.value));
    session.run().command(row, std::move(send));
}

inline void command(SessionObject& session, const RobotArgument& robot, const py::kwargs& fields) {
    const std::size_t row = session.row(robot.value);
    session.run().command(row,
                          command_of(AllCommands{}, session, session.run().robots()[row], fields));
}

/// NumPy array with a value for each of the session's robots, computed by `value`.
template <class T, class Value>
py::array_t<T> by_robot(SessionObject& session, Value value) {
    const auto& robots = session.run().robots();
    py::array_t<T> all(static_cast<py::ssize_t>(robots.size()));
    T* out = all.mutable_data();
    for (const NodeId robot : robots) *out++ = value(session.run().session(), robot);
    return all;
}

inline py::array_t<double> twist(SessionObject& session) {
    const auto& robots = session.run().robots();
    py::array_t<double> all({static_cast<py::ssize_t>(robots.size()), py::ssize_t{2}});
    double* out = all.mutable_data();
    for (const NodeId robot : robots) {
        const Twist twist = session.run().session().twist(robot);
        *out++ = twist.speed;
        *out++ = twist.turn_rate;
    }
    return all;
}

/// NumPy array of the robots' poses (x [m], y [m], heading [rad]), as a view that keeps the session
/// alive.
inline py::array pose(const py::object& self) {
    auto& session = self.cast<SessionObject&>();
    const std::span<const double> poses = session.run().poses();
    py::array_t<double> view({static_cast<py::ssize_t>(poses.size() / 3), py::ssize_t{3}},
                             poses.data(), self);
    view.attr("setflags")("write"_a = false);
    return view;
}

/// Row of the NumPy array of neighbours, in NumPy's memory layout.
struct NeighborRow {
    PyObject* name;
    double rssi, noise;
    std::int32_t quality;
};

inline py::array neighbors(SessionObject& session, const RobotArgument& robot) {
    static const auto* type =
        new py::dtype(  // never freed, since the interpreter may have ended before
            py::cast<py::list>(py::make_tuple("name", "rssi", "noise", "quality")),
            py::cast<py::list>(py::make_tuple("O", "<f8", "<f8", "<i4")),
            py::cast<py::list>(
                py::make_tuple(offsetof(NeighborRow, name), offsetof(NeighborRow, rssi),
                               offsetof(NeighborRow, noise), offsetof(NeighborRow, quality))),
            sizeof(NeighborRow));
    const Network& network = session.network();
    const auto found = network.links(robot_named(network, robot.value), network.now());
    py::array all(*type, found.size());
    auto* row = static_cast<NeighborRow*>(all.mutable_data());
    for (const Neighbour& each : found) {
        Py_XDECREF(row->name);
        row->name = py::object(session.names()[each.node.index()]).release().ptr();
        row->rssi = each.level.value;
        row->noise = each.noise.value;
        row->quality = each.quality;
        ++row;
    }
    return all;
}

inline py::list robots(SessionObject& session) {
    py::list names;
    for (const NodeId robot : session.run().robots()) names.append(session.names()[robot.index()]);
    return names;
}

inline py::dict metrics(SessionObject& session) {
    Table table;
    append_metrics(table, session.network().metrics());
    return to_python(table);
}

}  // namespace rovernet::python
