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

// The validations, one function and one file each. Errors are the same in every run and on every
// machine; costs are not. Each appends the promises that it has looked at.

namespace rovernet {

/// Size of a validation: whole, or a quick look at the same with fewer samples.
struct ValidationSize {
    bool quick = false;

    Turns turns() const { return quick ? Turns{3, 0.002} : Turns{5, 0.05}; }
    std::size_t of(std::size_t whole, std::size_t few) const { return quick ? few : whole; }
};

using Promises = std::vector<Promise>;

/// Length of wall on a link: the scene against rasters and samples.
ValidationChart wall_length_chart(const ValidationSize& size, Promises& promises);
/// Reflections in a corridor, added by power or coherently, against exact sums.
ValidationChart corridor_chart(const ValidationSize& size);
/// Field in the shadow of an edge: knife edges and the uniform theory against exact solutions.
ValidationChart diffraction_chart(const ValidationSize& size, Promises& promises);
/// Times at which links come up and go down: found ahead against looked for at fixed steps.
ValidationChart link_changes_chart(const ValidationSize& size, Promises& promises);
/// Decisions without logarithms: ranges, tables of shadowed links, bounds of levels.
ValidationChart decisions_chart(const ValidationSize& size, Promises& promises);
/// Frames that are too weak to be counted as interference.
ValidationChart interference_cut_chart(const ValidationSize& size);
/// Reception models on the same floods.
ValidationChart reception_chart(const ValidationSize& size);
/// Shadowing that is redrawn, kept by link, or a field of both places: how often links flip.
ValidationChart shadowing_chart(const ValidationSize& size);
/// Path loss models as given and fitted: the delivery ratio, and wrong links.
/// @param field  folder of measurements, to say how wrong the model is that is taken as true
std::vector<ValidationChart> path_loss_charts(const ValidationSize& size,
                                              const std::optional<std::string>& field);
/// Cells and drawing of a map.
ValidationChart map_drawing_chart(const ValidationSize& size);
/// Losses measured in buildings. @param folder  with flat/ and lab/
ValidationChart measured_chart(const std::string& folder, const ValidationSize& size,
                               Promises& promises);
/// Closed forms and published values.
void check_closed_forms(Promises& promises);
/// Sums over everything, means over many draws, and solutions by hand.
void check_by_brute_force(Promises& promises);
/// Walls, doors and floors on a link, against how many there are.
void check_counts(Promises& promises);

/// Saturated cells, and the time of the next access.
void check_access(Promises& promises);
/// Places and speeds of robots: random waypoint, and arcs in the open and at a wall.
void check_motion(Promises& promises);
/// Shadows of the model `rays`: of walls' ends, of blocks, of walls drawn askew.
void check_ray_shadows(Promises& promises);

/// Draw in (0, 1) of a validation. @param what  its name, and what is drawn
double validation_draw(std::string_view what, std::uint64_t of, std::uint64_t index);

}  // namespace rovernet
