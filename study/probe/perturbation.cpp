// SPDX-License-Identifier: MIT
#include "study/probe/perturbation.hpp"

#include "experiment/build.hpp"
#include "scene/redrawing.hpp"
#include "scene/scene.hpp"
#include "study/probe/displaced.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

namespace rovernet {
namespace {

constexpr Meters widest_wall{1};
constexpr std::size_t most_cells = 16'000'000;
constexpr std::size_t most_materials = 8;
constexpr Db known_to{3};  // loss of a wall

/// Whether the loss of any robot's frames depends on walls.
bool sees_walls(const Scenario& scenario) {
    const auto sees = [](const PropagationTable& table) {
        const LossShape shape = table.make().shape();
        return shape == LossShape::by_walls || shape == LossShape::unknown;
    };
    return sees(scenario.propagation) ||
           std::any_of(scenario.robots.begin(), scenario.robots.end(),
                       [&](const RobotTable& r) { return r.propagation && sees(*r.propagation); });
}

/// Perturbation in which radio sees the given maps and materials.
Perturbation redrawn(const Scenario& scenario, std::string name, std::vector<OccupancyGrid> maps,
                     const std::vector<Material>& materials) {
    Perturbation out{.name = std::move(name), .scenario = scenario, .nothing = {}};
    const Scene& own = *scenario.walls;
    out.scenario.walls =
        std::make_shared<const Scene>(own.with_walls_of(Scene(std::move(maps), materials)));
    return out;
}

using Redrawing = OccupancyGrid (*)(const OccupancyGrid&);

OccupancyGrid fill_usual_walls(const OccupancyGrid& map) { return fill_walls(map, widest_wall); }

void add_redrawings(const Scenario& scenario, std::vector<Perturbation>& out) {
    struct Kind {
        const char *name, *nothing;
        Redrawing redraw;
    };
    constexpr Kind kinds[] = {
        {"resolution x2", "the map has no cells that can be split into smaller ones", split_cells},
        {"resolution x0.5", "the map has no cells that can be joined into larger ones", join_cells},
        {"walls outlined", "no wall is three cells thick", outline_walls},
        {"walls filled", "no wall is hollow", fill_usual_walls},
    };
    const std::vector<OccupancyGrid> maps = scenario.walls->maps();
    std::size_t cells = 0;
    for (const OccupancyGrid& map : maps) cells += map.cells.size();
    for (const Kind& kind : kinds) {
        if (cells > most_cells) {
            out.push_back({kind.name,
                           scenario,
                           {},
                           "the maps of the scenario have more than 16 million cells"});
            continue;
        }
        std::vector<OccupancyGrid> changed;
        for (const OccupancyGrid& map : maps) changed.push_back(kind.redraw(map));
        const bool is_same = std::equal(
            maps.begin(), maps.end(), changed.begin(), changed.end(),
            [](const OccupancyGrid& a, const OccupancyGrid& b) { return a.cells == b.cells; });
        if (is_same) {
            out.push_back({kind.name, scenario, {}, kind.nothing});
        } else {
            out.push_back(
                redrawn(scenario, kind.name, std::move(changed), scenario.walls->materials()));
        }
    }
}

/// Median drawn thickness of the walls of each material that has some [m].
std::map<std::size_t, double> thicknesses(const Scene& scene) {
    std::map<std::size_t, std::vector<double>> all;
    for (const WallRectangle& wall : scene.wall_rectangles()) {
        const Vec3 middle = 0.5 * (wall.corners[0] + wall.corners[2]);
        const double thickness = scene.wall_thickness(middle).value;
        if (thickness > 0) all[wall.material].push_back(thickness);
    }
    std::map<std::size_t, double> medians;
    for (auto& [material, some] : all) {
        const auto middle = some.begin() + static_cast<std::ptrdiff_t>(some.size() / 2);
        std::nth_element(some.begin(), middle, some.end());
        medians[material] = *middle;
    }
    return medians;
}

/// Thickness at which a slab takes `loss` [dB], the next to `thickness` in steps of 1 %; nothing if
/// none up to `most` times as thick or as thin does.
std::optional<Meters> slab_taking(double loss, ItuMaterial material, Meters thickness,
                                  Hertz frequency) {
    constexpr double most = 1e6;
    const auto too_much = [&](double t) {
        return slab_loss(material, Meters{t}, frequency).value - loss;
    };
    const bool thicker = too_much(thickness.value) < 0;
    const double step = thicker ? 1.01 : 1 / 1.01;
    double near = thickness.value;
    for (double grown = 1; grown < most; grown *= 1.01) {
        double far = near * step;
        if ((too_much(far) < 0) == thicker) {
            near = far;
            continue;
        }
        for (int i = 0; i < 60; ++i) {
            const double middle = (near + far) / 2;
            ((too_much(middle) < 0) == thicker ? near : far) = middle;
        }
        return Meters{far};
    }
    return std::nullopt;
}

/// Raises the loss of a crossing of the material's walls [dB]; the result is at least 0.
void change(Material& material, Db more, Hertz frequency, double thickness) {
    const WallRate rate = wall_rate(material, frequency, 0);
    const double wanted = std::max(0.0, rate.per_crossing + more.value);
    if (material.slab && !material.per_crossing && wanted > 0) {
        const auto found = slab_taking(wanted, *material.slab, material.thickness, frequency);
        if (found) {
            material.thickness = *found;
            return;
        }
    }
    if (rate.per_crossing > 0) {
        material.per_crossing = Db{wanted};
    } else {
        material.per_metre = DbPerMeter{std::max(0.0, rate.per_metre + more.value / thickness)};
    }
}

/// Changes the model's loss of walls without a material. @return whether the model has such a
/// parameter
bool change(PropagationTable& table, Db more, double thickness) {
    const std::string model(table.make().name());
    if (model == MultiWall::name) {
        MultiWall& walls = std::get<MultiWall>(table.parameters);
        for (Db* wall : {&walls.light_wall, &walls.heavy_wall}) {
            *wall = Db{std::max(0.0, wall->value + more.value)};
        }
        return true;
    }
    if (model != Raytrace2007::name) return false;
    double& per_cm = std::get<Raytrace2007>(table.parameters).wall_factor;
    per_cm = std::max(0.0, per_cm + more.value / (100 * thickness));
    return true;
}

/// Materials that change together, by their numbers in the scene; and the name of that.
struct Group {
    std::string name;
    std::vector<std::size_t> materials;
};

/// Materials with a loss of their own one by one, or all at once; then those that have none.
std::vector<Group> material_groups(const Scene& scene,
                                   const std::map<std::size_t, double>& thickness) {
    std::vector<Group> groups;
    Group following{"walls", {}};
    for (const auto& [number, unused] : thickness) {
        const Material& material = scene.materials()[number];
        if (material.follows_model()) {
            following.materials.push_back(number);
        } else {
            groups.push_back({material.name, {number}});
        }
    }
    if (groups.size() > most_materials) {
        Group all{"all materials", {}};
        for (const Group& each : groups) all.materials.push_back(each.materials.front());
        groups = {all};
    }
    if (!following.materials.empty()) groups.push_back(following);
    return groups;
}

Perturbation with_material(const Scenario& scenario, const Group& group, Db more,
                           const std::map<std::size_t, double>& thickness) {
    const std::string name = fmt::format("{} {:+g} dB", group.name, more.value);
    const Scene& scene = *scenario.walls;
    std::vector<Material> materials = scene.materials();
    const std::size_t first = group.materials.front();
    if (!materials[first].follows_model()) {
        for (const std::size_t m : group.materials) {
            change(materials[m], more, scenario.radio.frequency, thickness.at(m));
        }
        return redrawn(scenario, name, scene.maps(), materials);
    }
    Perturbation out{.name = name, .scenario = scenario, .nothing = {}};
    bool has_number = change(out.scenario.propagation, more, thickness.at(first));
    for (RobotTable& robot : out.scenario.robots) {
        if (robot.propagation) has_number |= change(*robot.propagation, more, thickness.at(first));
    }
    if (!has_number) out.nothing = "the model has no parameter for the loss of a wall";
    return out;
}

void add_materials(const Scenario& scenario, std::vector<Perturbation>& out) {
    const auto thickness = thicknesses(*scenario.walls);
    for (const Group& group : material_groups(*scenario.walls, thickness)) {
        for (const double sign : {1.0, -1.0}) {
            out.push_back(with_material(scenario, group, sign * known_to, thickness));
        }
    }
}

}  // namespace

NetworkSettings Perturbation::settings() const {
    NetworkSettings settings = network_settings(scenario);
    if (moved.value > 0) settings.propagation = Displaced{settings.propagation, moved};
    return settings;
}

std::vector<Perturbation> perturbations(const Scenario& scenario) {
    refuse_doors(scenario.scene, "probe");
    std::vector<Perturbation> out;
    out.push_back({"1 cm", scenario, Meters{1e-2}, {}});
    out.push_back({"1 um", scenario, Meters{1e-6}, {}});
    if (!scenario.walls || scenario.walls->open_field() || !sees_walls(scenario)) return out;
    add_redrawings(scenario, out);
    add_materials(scenario, out);
    return out;
}

}  // namespace rovernet
