// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/scenario.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Options of a picture of a scenario; map and robots are always drawn.
struct PictureOptions {
    Time at = start_of_run;
    /// Robots whose coverage is drawn, without link shadowing: a heat map of the level of the best
    /// robot at each place, and contours at the receivers' sensitivity and at range_db. Empty: no
    /// coverage.
    std::vector<std::string> coverage = {};
    /// Robot whose radio and antenna height are assumed for the receivers of the coverage; none:
    /// the first robot of `coverage`.
    std::optional<std::string> receiver = std::nullopt;
    /// Source and destination of a route to draw: the route in use, with the age of each hop's
    /// route.
    struct Route {
        std::string from, to;
    };
    std::optional<Route> route = std::nullopt;
    /// True: the robots that sent the last route request (its origin and forwarders) are marked.
    /// With `route`, only requests of the robot Route::from count, otherwise all requests.
    bool search = false;
    bool links = false;   ///< draw links, coloured by level above sensitivity (margin)
    bool trails = false;  ///< draw the robots' past paths
    /// Partners to which the other robots need a link, such as access points. A trail then shows
    /// the margin of the robot's link to the best partner, and the gaps without a link. Empty:
    /// trails have the robots' colours.
    std::vector<std::string> margin_to = {};
    /// Relays of a mesh: robots over which the links to partners may go, too. The margin of such a
    /// link is the margin of its weakest hop.
    std::vector<std::string> over = {};
    int storey = 1;  ///< storey to draw; the lowest is 1
    /// Approximate number of cells of the heat map, from 1 to most_coverage_cells.
    int cells = 200'000;
    bool axes = false;  ///< draw the axes of the map, in metres
    /// Largest width of the picture [px], from 100 to 10000; a tall picture is narrower.
    int width = 1200;
    /// Text size [points], from 4 to 36. The picture is 1200 points wide, so that `width` changes
    /// the number of pixels only.
    double font_size = 12;
};

/// Runs the scenario until time `at`, and draws the map and the robots at that time as an SVG
/// document.
///
/// The picture shows the whole map and all robots. If there are several storeys, the picture shows
/// one storey, the robots on it, the links between these robots, and the coverage at the height of
/// the receiver's antenna above the floor. If there is no map (open field), the coverage is shown
/// up to 4 times the extent of the robots, so that the robots stay distinguishable. The bytes are
/// the same on every machine, except for the heat map, which is compressed by zlib.
/// @throws InputError, RunError; std::invalid_argument for an unknown robot, a time before the
///         start, or an option out of range
std::string draw_svg(const Scenario& scenario, const PictureOptions& options);

}  // namespace rovernet
