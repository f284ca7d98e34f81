// SPDX-License-Identifier: MIT
#include "pictures/map/coverage.hpp"

#include "models/link_gain.hpp"
#include "models/medium/medium.hpp"
#include "sim/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace rovernet {
namespace {

/// A map with its cells laid out, levels to be filled in.
CoverageMap empty_map(Vec3 low, Vec3 high, int cells) {
    if (!(low.x < high.x && low.y < high.y)) {
        throw std::invalid_argument("coverage: the rectangle of the picture has no area");
    }
    if (cells < 1 || cells > most_coverage_cells) {
        throw std::invalid_argument(fmt::format("coverage: cells must be from 1 to {}, got {}",
                                                most_coverage_cells, cells));
    }
    const double width = high.x - low.x, height = high.y - low.y;
    const double columns = std::round(std::sqrt(cells * (width / height)));
    CoverageMap map;
    map.columns = static_cast<int>(std::clamp(columns, 1.0, static_cast<double>(cells)));
    map.rows = cells / map.columns;
    map.lower_left = low;
    map.cell_width = width / map.columns;
    map.cell_height = height / map.rows;
    map.dbm.resize(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows));
    return map;
}

}  // namespace

Transmitter transmitter(const Network& network, NodeId robot, Time at) {
    const NetworkSettings& settings = network.settings();
    return {.model = network.medium().stations().model(robot).median(),
            .radio = network.medium().stations().radio(robot),
            .receiver = network.medium().stations().radio(robot),
            .antenna = network.medium().stations().antenna(robot, at, network.legs()),
            .heading = Radians{network.legs().leg(robot).heading_at(at)},
            .key = name_key(network.name(robot)),
            .scene = &network.scene(),
            .floor_height = settings.floor_height,
            .seed = settings.seed,
            .replication = settings.replication};
}

Transmitter transmitter(const Network& network, NodeId robot, NodeId receiver, std::size_t storey,
                        Time at) {
    Transmitter out = transmitter(network, robot, at);
    const Transmitter there = transmitter(network, receiver, at);
    const Storeys& storeys = network.scene().storeys();
    const std::size_t its_own = storeys.number_at(network.position(receiver).z);
    const double above_floor = there.antenna.z - storeys.floor(its_own);
    out.receiver = there.radio;
    out.receivers_above = storeys.floor(storey) + above_floor - out.antenna.z;
    return out;
}

void received_levels(const Transmitter& transmitter, std::span<const Vec3> antennas,
                     std::span<double> out_dbm) {
    const Radio& radio = transmitter.radio;
    const std::vector<std::uint64_t> keys(antennas.size(), transmitter.key);
    const LinkBatch links{.frequency = radio.frequency,
                          .from = transmitter.antenna,
                          .to = antennas,
                          .from_key = transmitter.key,
                          .to_keys = keys,
                          .scene = transmitter.scene,
                          .floor_height = transmitter.floor_height,
                          .seed = transmitter.seed,
                          .replication = transmitter.replication};
    transmitter.model.loss(links, {std::numeric_limits<double>::infinity()}, out_dbm);
    for (double& v : out_dbm) v = received_power(radio, transmitter.receiver, Db{v}).value;
    if (!radio.is_directional()) return;
    const Pose pose{transmitter.antenna, transmitter.heading};
    for (std::size_t i = 0; i < antennas.size(); ++i) {
        out_dbm[i] += pattern_gain(radio, pose, antennas[i]).value;
    }
}

Vec3 CoverageMap::centre(int column, int row) const {
    return {lower_left.x + (column + 0.5) * cell_width, lower_left.y + (row + 0.5) * cell_height,
            lower_left.z};
}

CoverageMap coverage(const Transmitter& transmitter, Vec3 low, Vec3 high, int cells) {
    CoverageMap map =
        empty_map({low.x, low.y, transmitter.antenna.z + transmitter.receivers_above}, high, cells);
    std::vector<Vec3> antennas;
    antennas.reserve(map.dbm.size());
    for (int row = 0; row < map.rows; ++row) {
        for (int column = 0; column < map.columns; ++column) {
            antennas.push_back(map.centre(column, row));
        }
    }
    received_levels(transmitter, antennas, map.dbm);
    return map;
}

CoverageMap coverage(std::span<const Transmitter> transmitters, Vec3 low, Vec3 high, int cells) {
    CoverageMap best = coverage(transmitters.front(), low, high, cells);
    for (const Transmitter& each : transmitters.subspan(1)) {
        const CoverageMap other = coverage(each, low, high, cells);
        for (std::size_t i = 0; i < best.dbm.size(); ++i)
            best.dbm[i] = std::max(best.dbm[i], other.dbm[i]);
    }
    return best;
}

}  // namespace rovernet
