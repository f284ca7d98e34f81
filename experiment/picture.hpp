// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/network.hpp"
#include "experiment/scenario.hpp"

#include <optional>
#include <string>

namespace rovernet {

/// What a picture of a scenario shows beyond map and robots.
struct PictureOptions {
    Time at = start_of_run;
    std::optional<std::string> coverage;  ///< robot whose received power is drawn as a heat map
    bool links = false;
    bool trails = false;
    int cells = 200'000;  ///< of the heat map, about
    int width = 1200;     ///< [px] of the picture
};

/// Runs the scenario until `at` and draws it. The same bytes on every machine.
/// @throws InputError, RunError; std::invalid_argument for a robot that there is not
std::string draw_svg(const Scenario& scenario, const PictureOptions& options);

/// The picture as a PNG, by rsvg-convert. @throws RunError if that is missing or fails
void write_png(const std::string& svg, const std::string& path);

}  // namespace rovernet
