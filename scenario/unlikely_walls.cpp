// SPDX-License-Identifier: MIT
#include "scenario/unlikely_walls.hpp"

#include "models/propagation/multi_wall.hpp"
#include "models/propagation/ray_materials.hpp"
#include "models/propagation/rays.hpp"
#include "models/propagation/raytrace_2007.hpp"
#include "scenario/affected.hpp"
#include "scene/faces.hpp"
#include "scene/scene.hpp"
#include "sim/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>

namespace rovernet {
namespace {

/// Calls look(propagation, where) for each choice of a propagation model that some robot uses.
template <class Look>
void for_each_used_model(const Scenario& scenario, Look look) {
    const auto& robots = scenario.robots;
    const auto has_own = [](const RobotTable& robot) { return robot.propagation.has_value(); };
    if (robots.empty() || !std::all_of(robots.begin(), robots.end(), has_own)) {
        look(scenario.propagation, scenario.propagation_where);
    }
    for (const RobotTable& robot : robots) {
        if (robot.propagation) look(*robot.propagation, robot.propagation_where);
    }
}

/// Walls without a material that are drawn thicker than a limit.
struct ThickWalls {
    const Face* first = nullptr;  ///< a face of the first one; null: none
    double thickest = 0;          ///< [m]
};

ThickWalls thick_walls(const Scene& scene, double limit) {
    ThickWalls out;
    for (const Face& face : scene.faces()->all()) {
        if (face.thickness <= limit || !scene.materials()[face.material].follows_model()) continue;
        const Vec3 inside =
            0.5 * (face.from + face.to) - (face.deviation + limit / 2) * face.normal;
        // The steps of a slanting wall are part of what is drawn.
        const double thick = scene.wall_thickness(inside).value - 2 * face.deviation;
        if (thick <= limit + 1e-6) continue;
        if (!out.first) out.first = &face;
        out.thickest = std::max(out.thickest, thick);
    }
    return out;
}

/// Limit of a model's thickness of walls without a material.
struct ThicknessLimit {
    double thickest;        ///< [m]
    std::string treatment;  ///< what the model makes of thicker walls
};

/// Limit of a model; none if each metre of wall counts.
std::optional<ThicknessLimit> thickness_limit(const Propagation& model, const Scene& scene) {
    const auto* rays = model.as<Rays>();
    if (rays && !rays->wall_loss) {
        constexpr double limit = thickest_default_wall.value;
        return ThicknessLimit{
            limit,
            fmt::format("rays treats walls without a material as at most {} m thick", limit)};
    }
    if (const auto* counted = model.as<MultiWall>()) {
        constexpr double thickest = 0.8;  // [m]: walls of buildings are thinner
        const double cell = std::max(scene.frame().cell_width(), scene.frame().cell_height());
        const double limit = std::max(thickest, 2 * cell);  // a coarse map has no thinner walls
        return ThicknessLimit{limit, fmt::format("multi_wall counts a wall without a material as "
                                                 "one wall of {} dB, however thick this wall is",
                                                 counted->heavy_wall.value)};
    }
    return std::nullopt;
}

}  // namespace

void note_walls_twice(Scenario& scenario, const Scene* scene) {
    if (!scene || scene->open_field()) return;
    constexpr double largest_without_walls = 22;  // ITU-R P.1238: commercial, open-plan
    Affected twice;
    for_each_used_model(scenario, [&](const PropagationTable& propagation, const Location& where) {
        const Propagation model = propagation.make();
        const auto* rays = model.as<Raytrace2007>();
        if (!rays || rays->coefficient <= largest_without_walls) return;
        twice.add([&] {
            return fmt::format(
                "{}: coefficient: N = {} of raytrace_2007 already includes the walls of an average "
                "building, so the walls of the map count twice; did you mean coefficient = 20?",
                where.text(), rays->coefficient);
        });
    });
    twice.note(scenario.notices);
}

void note_coherent_slants(Scenario& scenario, const Scene* scene) {
    if (!scene || !scene->faces()) return;
    Affected off;
    for_each_used_model(scenario, [&](const PropagationTable& propagation, const Location& where) {
        const Propagation model = propagation.make();
        const auto* rays = model.as<Rays>();
        if (!rays || rays->sum != RaySum::coherent) return;
        constexpr double least = 1;  // [m], of a face that counts
        const auto slants = [](const Face& face) {
            return face.deviation > 0 && face.length >= least;
        };
        const auto all = scene->faces()->all();
        const auto slanting = std::count_if(all.begin(), all.end(), slants);
        if (slanting == 0) return;
        off.add([&] {
            return fmt::format(
                "{}: sum: {} faces of walls are oblique to the cells of the map, so the positions "
                "of these faces are inaccurate by some centimetres; with sum = \"coherent\", "
                "levels then have errors of 3 to 5 dB (rms), and up to 30 dB; did you mean sum = "
                "\"power\"?",
                where.text(), slanting);
        });
    });
    off.note(scenario.notices);
}

void note_thick_walls(Scenario& scenario, const Scene* scene) {
    if (!scene || scene->open_field() || !scene->faces()) return;
    std::map<double, ThickWalls> found;  // by limit
    Affected doubtful;
    for_each_used_model(scenario, [&](const PropagationTable& propagation, const Location& where) {
        const auto limit = thickness_limit(propagation.make(), *scene);
        if (!limit) return;
        const auto [entry, is_new] = found.try_emplace(limit->thickest);
        ThickWalls& thick = entry->second;
        if (is_new) thick = thick_walls(*scene, limit->thickest);
        if (!thick.first) return;
        const Vec3 at = 0.5 * (thick.first->from + thick.first->to);
        doubtful.add([&] {
            return fmt::format(
                "{}: the wall drawn at x = {:.2f} m, y = {:.2f} m is thicker than {} m (thickest "
                "wall without a material in this scene: {:.2g} m), but {}; give furniture, pillars "
                "and shafts a colour and a material of their own in [scene.materials]",
                where.text(), at.x, at.y, limit->thickest, thick.thickest, limit->treatment);
        });
    });
    doubtful.note(scenario.notices);
}

}  // namespace rovernet
