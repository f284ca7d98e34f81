// SPDX-License-Identifier: MIT
#include "network/world.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace rovernet {
namespace {

const Scene& open_field() {
    static const Scene scene;
    return scene;
}

}  // namespace

World::World(NetworkSettings given)
    : settings(std::move(given)),
      scene(settings.scene ? settings.scene.get() : &open_field()),
      planners(settings.planners ? settings.planners : std::make_shared<Planners>(*scene)),
      medium({.scene = scene,
              .scene_changes = settings.scene_changes,
              .floor_height = settings.floor_height,
              .propagation_delay = settings.propagation_delay,
              .all_pairs = settings.reference,
              .interference_cut = settings.reception.interference_cut(),
              .phy = settings.access.phy(),
              .shadowing = settings.shadowing,
              .fading = settings.fading,
              .seed = settings.seed,
              .replication = settings.replication}),
      phy(medium.settings().phy) {
    if (settings.floor_height != no_storeys && !positive.contains(settings.floor_height.value)) {
        throw_out_of_range("network", "floor_height", positive.text, settings.floor_height.value);
    }
    if (&planners->scene() != scene) {
        throw std::invalid_argument(
            "network: the planners must belong to the scene of the network");
    }
    for (const Duration d : {settings.links.tolerance, settings.links.min_dwell}) {
        if (d < Duration{1}) throw_out_of_range("network", "links", ">= 1 ns", seconds(d));
    }
    // Scheduled first, so that a scene change precedes all other events of its time.
    for (Time last{start_of_run - Duration{1}};
         const SceneChange& change : settings.scene_changes) {
        if (change.time <= std::exchange(last, change.time) || !change.scene) {
            throw std::invalid_argument(
                "network: scene_changes must be scenes in ascending order of time");
        }
        if (change.time == start_of_run) {
            change_scene();
        } else {
            events.schedule(change.time, Priority::frame_end,
                            {Occurrence::Kind::scene_change, NodeId{0}, 0});
        }
    }
}

void World::change_scene() {
    const SceneChange& change = *last_change(settings.scene_changes, now);
    scene = change.scene.get();
    doors = change.doors.get();
}

void World::schedule(Time time, Callback<> call, Duration period) {
    if (time < now) {
        throw std::invalid_argument(
            fmt::format("an action was scheduled for {} s, but the simulated time is already {} s; "
                        "expected the present time or a later time",
                        seconds(time), seconds(now)));
    }
    const std::size_t slot = actions_.take();
    actions_[slot] = {std::move(call), period};
    events.schedule(time, Priority::user, {Occurrence::Kind::action, NodeId{0}, slot});
}

void World::hold_header(std::uint32_t header) {
    if (header >= header_holders_.size()) header_holders_.resize(header + std::size_t{1});
    ++header_holders_[header];
}

void World::release_header(std::uint32_t header) {
    if (--header_holders_[header] == 0) on_header_forgotten(header);
}

void World::act(std::size_t slot) {
    const Action action = actions_[slot];  // a copy: the call may add actions
    if (action.period > Duration{0} && !action.call.has_ended()) {
        events.schedule(now + action.period, Priority::user,
                        {Occurrence::Kind::action, NodeId{0}, slot});
    } else {
        actions_[slot] = {};
        actions_.release(slot);
    }
    action.call();
}

}  // namespace rovernet
