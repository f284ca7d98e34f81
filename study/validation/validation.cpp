// SPDX-License-Identifier: MIT
#include "study/validation/validation.hpp"

#include "sim/random.hpp"

#include <algorithm>
#include <utility>

namespace rovernet {

double validation_draw(std::string_view what, std::uint64_t of, std::uint64_t index) {
    return uniform({.purpose = Purpose::placement, .a = name_key(what), .b = of, .index = index});
}

bool Validation::kept() const {
    return std::all_of(promises.begin(), promises.end(),
                       [](const Promise& promise) { return promise.kept(); });
}

Validation validate(const ValidationSize& size, const std::optional<std::string>& field,
                    const std::function<void(std::string_view)>& tell) {
    Validation out{.size = size};
    const auto begin = [&](std::string_view what) {
        if (tell) tell(what);
    };
    if (field) {
        begin("measured buildings");
        out.charts.push_back(measured_chart(*field, size, out.promises));
    } else {
        out.left_out.push_back(
            "models in measured buildings, because --field names no folder of measured levels");
    }
    begin("path loss models on three scenes");
    for (ValidationChart& chart : path_loss_charts(size, field))
        out.charts.push_back(std::move(chart));
    begin("lengths of walls");
    out.charts.push_back(wall_length_chart(size, out.promises));
    begin("cells of maps");
    out.charts.push_back(map_drawing_chart(size));
    begin("reflections in a corridor");
    out.charts.push_back(corridor_chart(size));
    begin("shadows of edges");
    out.charts.push_back(diffraction_chart(size, out.promises));
    begin("changes of links");
    out.charts.push_back(link_changes_chart(size, out.promises));
    begin("decisions on links");
    out.charts.push_back(decisions_chart(size, out.promises));
    begin("shadowing");
    out.charts.push_back(shadowing_chart(size));
    begin("interference");
    out.charts.push_back(interference_cut_chart(size));
    out.charts.push_back(reception_chart(size));
    begin("closed forms");
    check_closed_forms(out.promises);
    check_by_brute_force(out.promises);
    begin("counts of walls");
    check_counts(out.promises);
    begin("access to the medium");
    check_access(out.promises);
    begin("motion");
    check_motion(out.promises);
    check_ray_shadows(out.promises);
    return out;
}

}  // namespace rovernet
