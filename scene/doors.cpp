// SPDX-License-Identifier: MIT
#include "scene/doors.hpp"

#include "scene/closed_doors.hpp"
#include "scene/map_frame.hpp"
#include "scene/occupancy.hpp"
#include "scene/scene.hpp"
#include "scene/wall_index.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

/// Last of the times at or before `t`; -1 ns if there is none.
Duration last_of(const std::vector<Duration>& times, Duration t) {
    Duration last{-1};
    for (const Duration each : times) {
        if (each <= t) last = std::max(last, each);
    }
    return last;
}

/// Map of one cell, the closed door. For an axis-parallel door yaw is 0, so that its corners are
/// exact.
OccupancyGrid map_of(const Door& door, const Storeys& storeys) {
    Vec3 along = door.to - door.from, begin = door.from;
    if (along.x < 0 || (along.x == 0 && along.y < 0)) {
        begin = door.to;
        along = -1 * along;
    }
    const double length = distance(Vec3{}, {along.x, along.y, 0}), half = door.thickness.value / 2;
    OccupancyGrid map{.columns = 1, .rows = 1, .cells = {Cell::occupied}};
    map.origin.z = storeys.floor(storeys.number_at(door.from.z));
    if (along.x == 0) {
        map.cell_width = door.thickness.value;
        map.cell_height = length;
        map.origin.x = begin.x - half;
        map.origin.y = begin.y;
        return map;
    }
    map.cell_width = length;
    map.cell_height = door.thickness.value;
    map.origin.x = begin.x + half * along.y / length;
    map.origin.y = begin.y - half * along.x / length;
    if (along.y != 0) map.yaw = math::atan2(along.y, along.x);
    return map;
}

/// Index of the material in `all`; the material is appended if it is missing.
std::uint8_t number_of(const Material& material, std::vector<Material>& all) {
    const auto found = std::find(all.begin(), all.end(), material);
    const auto number = static_cast<std::size_t>(found - all.begin());
    if (number > 255)
        throw std::invalid_argument("Scene: found more than 256 materials; expected at most 256");
    if (found == all.end()) all.push_back(material);
    return static_cast<std::uint8_t>(number);
}

}  // namespace

bool Door::is_closed(Time t) const {
    const Duration now = t - start_of_run;
    return last_of(closes, now) > last_of(opens, now);
}

std::array<Vec3, 4> Door::corners() const {
    const MapFrame frame(map_of(*this, Storeys()));
    return {frame.to_world({0, 0}), frame.to_world({1, 0}), frame.to_world({1, 1}),
            frame.to_world({0, 1})};
}

ClosedDoors::ClosedDoors(const Scene& scene, std::span<const Door> doors) {
    const Storeys& storeys = scene.storeys();
    for (const Door& door : doors) {
        const std::size_t storey = storeys.number_at(door.from.z);
        const auto index =
            std::make_shared<const WallIndex>(1, 1, std::vector<CellRectangle>{{0, 0, 1, 1}});
        doors_.push_back({Obstacles(MapFrame(map_of(door, storeys)), index), storeys.bottom(storey),
                          storeys.top(storey)});
    }
}

bool ClosedDoors::passable(Vec3 a, Vec3 b, Meters radius) const {
    return std::all_of(doors_.begin(), doors_.end(), [&](const Closed& closed) {
        const auto [low, high] = std::minmax(a.z, b.z);
        const bool elsewhere = high < closed.bottom || low >= closed.top;
        return elsewhere || closed.door.passable(a, b, radius);
    });
}

std::optional<Vec3> ClosedDoors::stop(Vec3 a, Vec3 b, Meters radius) const {
    if (passable(a, b, radius)) return std::nullopt;
    constexpr int halvings = 40;
    constexpr double before = 1e-6;  // [m]
    const Vec3 way = b - a;
    double good = 0, bad = 1;
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (good + bad);
        (passable(a, a + middle * way, radius) ? good : bad) = middle;
    }
    // A shorter path counts as none, so that a robot that has stopped here stays.
    const double least = before / distance(a, b);
    return good > 2 * least ? a + (good - least) * way : a;
}

Scene with_closed(const Scene& open, std::span<const Door> closed) {
    std::vector<OccupancyGrid> maps = open.maps();
    std::vector<Material> materials = open.materials();
    for (const Door& door : closed) {
        maps.push_back(map_of(door, open.storeys()));
        maps.back().material = number_of(door.material, materials);
    }
    const auto ceilings = open.storeys().ceilings();
    return Scene(std::move(maps), std::move(materials), {ceilings.begin(), ceilings.end()});
}

std::vector<SceneChange> scene_changes(const std::shared_ptr<const Scene>& open,
                                       std::span<const Door> doors) {
    std::set<Duration> times;
    for (const Door& door : doors) {
        times.insert(door.closes.begin(), door.closes.end());
        times.insert(door.opens.begin(), door.opens.end());
    }
    std::vector<bool> before(doors.size(), false);
    std::map<std::vector<bool>, SceneChange> known{{before, {start_of_run, open, nullptr}}};
    std::vector<SceneChange> changes;
    for (const Duration time : times) {
        std::vector<bool> state;
        std::vector<Door> closed;
        for (const Door& door : doors) {
            state.push_back(door.is_closed(start_of_run + time));
            if (state.back()) closed.push_back(door);
        }
        if (std::exchange(before, state) == state) continue;
        const auto [found, is_new] = known.try_emplace(state);
        SceneChange& change = found->second;
        if (is_new) {
            change.scene = std::make_shared<const Scene>(with_closed(*open, closed));
            change.doors = std::make_shared<const ClosedDoors>(*open, closed);
        }
        change.time = start_of_run + time;
        changes.push_back(change);
    }
    return changes;
}

}  // namespace rovernet
