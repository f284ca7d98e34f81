// SPDX-License-Identifier: MIT
#pragma once

#include "python/arguments.hpp"
#include "python/session_object.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

// Measurements of a session's range finders, and levels of its links, as NumPy arrays.

namespace rovernet::python {

using namespace py::literals;

/// Index of a robot's range finder that Python code selects by index or name.
inline std::size_t scanner_of(SessionObject& session, NodeId robot, const py::object& scanner) {
    const std::string name = session.network().name(robot);
    const auto all = session.run().session().range_finders(robot);
    if (all.empty()) {
        throw py::value_error(
            fmt::format("robot {} has no range finder; expected scan = {{ ... }} for this robot in "
                        "the scenario",
                        name));
    }
    if (py::isinstance<py::str>(scanner)) {
        const auto label = scanner.cast<std::string>();
        const auto found = std::ranges::find(all, label, &Scanner::label);
        if (found != all.end()) return static_cast<std::size_t>(found - all.begin());
        std::vector<std::string> labels;
        for (const Scanner& each : all) labels.push_back(each.label());
        throw py::value_error(fmt::format("robot {} has no range finder \"{}\"; expected one of {}",
                                          name, label, fmt::join(labels, ", ")));
    }
    const auto number = scanner.cast<std::int64_t>();
    if (number >= 0 && static_cast<std::size_t>(number) < all.size())
        return static_cast<std::size_t>(number);
    throw py::value_error(fmt::format("robot {} has no range finder {}; expected 0 to {}", name,
                                      number, all.size() - 1));
}

/// Distances measured by a range finder [m], as an array of shape (beams,) for one robot, or
/// (robots, beams) for all robots of the session.
inline py::array_t<double> scan(SessionObject& session, const OptionalRobotArgument& robot,
                                const py::object& scanner) {
    const Session& measured = session.run().session();
    const auto ranges_of = [&](NodeId each) {
        return measured.scan(each, scanner_of(session, each, scanner));
    };
    if (robot.value) {
        const auto ranges = ranges_of(robot_named(session.network(), *robot.value));
        return py::array_t<double>(static_cast<py::ssize_t>(ranges.size()), ranges.data());
    }
    const auto& robots = session.run().robots();
    std::vector<double> all;
    std::size_t beams = 0;
    for (std::size_t row = 0; row < robots.size(); ++row) {
        const auto ranges = ranges_of(robots[row]);
        if (row > 0 && ranges.size() != beams) {
            throw py::value_error(
                fmt::format("scan: robot {} has {} beams, but robot {} has {}; expected the name "
                            "of a single robot",
                            session.network().name(robots[0]), beams,
                            session.network().name(robots[row]), ranges.size()));
        }
        beams = ranges.size();
        all.insert(all.end(), ranges.begin(), ranges.end());
    }
    return py::array_t<double>(
        {static_cast<py::ssize_t>(robots.size()), static_cast<py::ssize_t>(beams)}, all.data());
}

/// Range finders of a robot, each as a dict.
inline py::list scanners(SessionObject& session, const RobotArgument& robot) {
    py::list all;
    const NodeId node = robot_named(session.network(), robot.value);
    for (const Scanner& scanner : session.run().session().range_finders(node)) {
        const auto beams = static_cast<py::ssize_t>(scanner.size());
        py::array_t<double> angles(beams);
        py::array_t<double> places({beams, py::ssize_t{2}});
        for (std::size_t i = 0; i < scanner.size(); ++i) {
            const ScannerPose beam = scanner.pose() * scanner.beam(i);
            angles.mutable_data()[i] = beam.heading.value;
            places.mutable_data()[2 * i] = beam.at.x;
            places.mutable_data()[2 * i + 1] = beam.at.y;
        }
        all.append(py::dict(
            "name"_a = scanner.label(), "kind"_a = std::string(name_of(scanner.finder.kind)),
            "range"_a = scanner.finder.range.value, "angles"_a = angles, "places"_a = places));
    }
    return all;
}

/// Received levels of all links [dBm], NaN without a link: one row for each receiver, one column
/// for each sender, over all robots of the scenario.
inline py::array_t<double> links(SessionObject& session) {
    const Network& network = session.network();
    const auto robots = static_cast<py::ssize_t>(network.size());
    py::array_t<double> all({robots, robots});
    double* row = all.mutable_data();
    std::fill(row, row + robots * robots, std::numeric_limits<double>::quiet_NaN());
    for (NodeId robot{0}; robot.index() < network.size(); ++robot.value, row += robots) {
        for (const Neighbour& each : network.links(robot, network.now()))
            row[each.node.index()] = each.level.value;
    }
    return all;
}

}  // namespace rovernet::python
