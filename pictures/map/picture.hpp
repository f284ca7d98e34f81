// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/scenario.hpp"

#include <optional>
#include <string>

namespace rovernet {

/// Contents of a picture of a scenario, beyond map and robots.
struct PictureOptions {
    Time at = start_of_run;
    /// Robot whose level is drawn, as a heat map and with contours at the receivers' sensitivity
    /// and range_db, without shadowing.
    std::optional<std::string> coverage = std::nullopt;
    /// Robot whose radio receives it, at its antenna's height above the floor; the same if not
    /// given.
    std::optional<std::string> receiver = std::nullopt;
    bool links = false;   ///< links, coloured by margin
    bool trails = false;  ///< ways that the robots have gone
    int storey = 1;       ///< storey that is drawn, the lowest is 1
    int cells = 200'000;  ///< cells of the heat map, about; from 1 to most_coverage_cells
    bool axes = false;    ///< axes in metres, around the map
    int width = 1200;  ///< [px] of the picture at most, from 100 to 10000; a tall one is narrower
    /// Size of the texts [points], from 4 to 36; the picture is 1200 points wide, so that `width`
    /// changes its pixels and nothing else.
    double font_size = 12;
};

/// Runs the scenario until `at` and draws it, as a Scalable Vector Graphics document.
///
/// It shows the whole map and all robots; of several storeys one, with the robots that are on it,
/// the links between them, and its coverage at the antenna's height above its floor; of an open
/// field the robots, and as much of the reach of
/// the robot whose coverage is drawn as leaves the robots apart. The same bytes on every machine,
/// but for the heat map's compression, which is zlib's.
/// @throws InputError, RunError; std::invalid_argument for a robot that there is not, a time before
///         the start, or an option out of its range
std::string draw_svg(const Scenario& scenario, const PictureOptions& options);

}  // namespace rovernet
