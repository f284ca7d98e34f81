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

/// A robot's radio on air, and what stands around it: all that its level at a place depends on.
struct Transmitter {
    Propagation model;
    Radio radio = {};
    Radio receiver = {};               ///< radio of the receivers
    Vec3 antenna = {};                 ///< [m]
    double receivers_above = 0;        ///< [m] by which receivers' antennas are higher than its own
    Radians heading{0};                ///< [rad] of the robot, for a directional antenna
    std::uint64_t key = 0;             ///< key of the robot, for random draws
    const Scene* scene = nullptr;      ///< not null; outlives the transmitter
    Meters floor_height = no_storeys;  ///< [m] of one storey
    std::uint64_t seed = 0;
    std::uint32_t replication = 0;
};

/// The robot as it stands at `at`, for receivers like its own. Its model is the median: shadowing
/// of links belongs to pairs of robots, and there is no robot at most places. A field of shadowing
/// belongs to places, and stays. The network outlives the transmitter.
Transmitter transmitter(const Network& network, NodeId robot, Time at);

/// Levels [dBm] at which the receivers' radio would receive it; a directional one turns to it.
/// @param antennas  [m] of the receivers
/// @param out_dbm   same size; every element written
void received_levels(const Transmitter& transmitter, std::span<const Vec3> antennas,
                     std::span<double> out_dbm);

/// Levels over an upright rectangle, on a grid of equal cells.
struct CoverageMap {
    Vec3 lower_left = {};    ///< [m] corner
    double cell_width = 1;   ///< [m]
    double cell_height = 1;  ///< [m]
    int columns = 0;
    int rows = 0;
    std::vector<double> dbm = {};  ///< levels at the cells' centres; row 0 is the bottom row

    Vec3 centre(int column, int row) const;
    double at(int column, int row) const {
        return dbm[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column)];
    }
};

/// The most cells that a map of the coverage may have.
inline constexpr int most_coverage_cells = 4'000'000;

/// Levels over the rectangle from `low` to `high` [m], for antennas `receivers_above` above the
/// transmitter's.
/// @param cells  about so many, nearly square
/// @throws std::invalid_argument for an empty rectangle, or cells outside 1 to most_coverage_cells
CoverageMap coverage(const Transmitter& transmitter, Vec3 low, Vec3 high, int cells);

}  // namespace rovernet
