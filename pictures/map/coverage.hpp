// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"
#include "models/radio.hpp"
#include "network/network.hpp"
#include "sim/geometry.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rovernet {

/// Transmitter of a coverage map: all quantities on which the received level at a position depends.
struct Transmitter {
    Propagation model;
    Radio radio = {};
    Radio receiver = {};  ///< radio of the assumed receivers
    Vec3 antenna = {};    ///< position of the transmitter's antenna [m]
    /// Height of receivers' antennas above the transmitter's antenna [m].
    double receivers_above = 0;
    Radians heading{0};                ///< heading of the robot [rad], for a directional antenna
    std::uint64_t key = 0;             ///< key of the transmitting robot, for random draws
    const Scene* scene = nullptr;      ///< scene with the walls; not null; outlives the transmitter
    Meters floor_height = no_storeys;  ///< height of one storey [m]
    std::uint64_t seed = 0;
    std::uint32_t replication = 0;
};

/// Transmitter of a robot at time `at`, for receivers with the same radio. Link shadowing is not
/// included, since it is defined for pairs of robots only. A shadowing field is included, since it
/// depends on positions. The network must outlive the transmitter.
Transmitter transmitter(const Network& network, NodeId robot, Time at);

/// Transmitter of a robot at time `at`, for receivers on a storey with the radio of the robot
/// `receiver`, at its height above the floor.
/// @param storey  number of the storey; the lowest is 0
Transmitter transmitter(const Network& network, NodeId robot, NodeId receiver, std::size_t storey,
                        Time at);

/// Computes the levels [dBm] at receivers; a directional receiver antenna points to the
/// transmitter.
/// @param antennas  positions of the receivers' antennas [m]
/// @param out_dbm   levels [dBm], same size as `antennas`; every element is written
void received_levels(const Transmitter& transmitter, std::span<const Vec3> antennas,
                     std::span<double> out_dbm);

/// Received levels over an axis-parallel rectangle, on a grid of equal cells.
struct CoverageMap {
    Vec3 lower_left = {};    ///< lower left corner of the rectangle [m]
    double cell_width = 1;   ///< width of a cell [m]
    double cell_height = 1;  ///< height of a cell [m]
    int columns = 0;
    int rows = 0;
    /// Levels at the centres of the cells [dBm], row by row; row 0 is at the bottom.
    std::vector<double> dbm = {};

    Vec3 centre(int column, int row) const;
    double at(int column, int row) const {
        return dbm[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column)];
    }
};

/// Largest number of cells of a coverage map.
inline constexpr int most_coverage_cells = 4'000'000;

/// Received levels over the rectangle from `low` to `high` [m], for receivers' antennas
/// Transmitter::receivers_above [m] above the transmitter's antenna.
/// @param cells  approximate number of cells, which are nearly square
/// @throws std::invalid_argument for an empty rectangle, or cells outside 1 to most_coverage_cells
CoverageMap coverage(const Transmitter& transmitter, Vec3 low, Vec3 high, int cells);
/// Level of the best transmitter at each place. @param transmitters  at least one
CoverageMap coverage(std::span<const Transmitter> transmitters, Vec3 low, Vec3 high, int cells);

}  // namespace rovernet
