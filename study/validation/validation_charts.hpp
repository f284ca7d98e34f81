// SPDX-License-Identifier: MIT
#pragma once

#include "study/validation/cases/turns.hpp"
#include "study/validation/validation_chart.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Validations, each with its own function and file. Errors are the same in every run and on every
// machine; costs differ. Each function appends its checks to `promises`: claimed error limit and
// largest error found.

namespace rovernet {

/// Size of a validation: full size, or quick with fewer samples.
struct ValidationSize {
    bool quick = false;

    Turns turns() const { return quick ? Turns{3, 0.002} : Turns{5, 0.05}; }
    std::size_t of(std::size_t whole, std::size_t few) const { return quick ? few : whole; }
};

using Promises = std::vector<Promise>;

/// Chart on methods for the length of a link inside walls: class Scene, rasters and sampling.
ValidationChart wall_length_chart(const ValidationSize& size, Promises& promises);
/// Chart on reflections in a corridor. Sums of paths by power and coherent sums are compared with
/// exact sums.
ValidationChart corridor_chart(const ValidationSize& size);
/// Chart on the field in the shadow of an edge. Knife-edge models and the uniform theory of
/// diffraction (UTD) are compared with exact solutions.
ValidationChart diffraction_chart(const ValidationSize& size, Promises& promises);
/// Chart on the times at which links go up and down. Predicted times are compared with sampling at
/// fixed steps.
ValidationChart link_changes_chart(const ValidationSize& size, Promises& promises);
/// Chart on fast methods for deciding without logarithms whether a link is up: ranges, tables of
/// shadowed links, and level bounds.
ValidationChart decisions_chart(const ValidationSize& size, Promises& promises);
/// Chart on the errors that arise if weak frames are neglected as interference (interference_cut).
ValidationChart interference_cut_chart(const ValidationSize& size);
/// Chart that compares reception models on the same floods.
ValidationChart reception_chart(const ValidationSize& size);
/// Chart on the rate at which shadowing switches a link between up and down while a robot moves. It
/// compares shadowing that is drawn at each observation, fixed for each link, or a spatial field.
ValidationChart shadowing_chart(const ValidationSize& size);
/// Charts on path loss models with given and with fitted parameters: errors of the delivery ratio
/// and of link decisions (up or down).
/// @param field  folder of measurements, for the error of the reference model itself; none: that
///               error is not shown
std::vector<ValidationChart> path_loss_charts(const ValidationSize& size,
                                              const std::optional<std::string>& field);
/// Chart on the effect of the cell size and the drawing of a map.
ValidationChart map_drawing_chart(const ValidationSize& size);
/// Chart that compares losses measured in buildings with models. @param folder  folder with the
/// measurements in flat/ and lab/
ValidationChart measured_chart(const std::string& folder, const ValidationSize& size,
                               Promises& promises);
/// Checks models against closed forms and published values.
void check_closed_forms(Promises& promises);
/// Checks results against brute force: complete sums, means over many draws, and manual solutions.
void check_by_brute_force(Promises& promises);
/// Checks the numbers of walls, doors and floors found on a link.
void check_counts(Promises& promises);

/// Checks the throughput of saturated 802.11 stations, and the predicted time of the next medium
/// access.
void check_access(Promises& promises);
/// Checks positions and speeds of robots: random waypoint, and arcs in the open and at a wall.
void check_motion(Promises& promises);
/// Checks shadows of the model `rays`: behind wall ends, blocks and oblique walls.
void check_ray_shadows(Promises& promises);

/// Random number in (0, 1) for a validation. The number depends only on the parameters.
/// @param what  name of the validation or of the drawn quantity
double validation_draw(std::string_view what, std::uint64_t of, std::uint64_t index);

}  // namespace rovernet
