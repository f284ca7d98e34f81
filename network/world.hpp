// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/planners.hpp"
#include "models/medium/medium.hpp"
#include "network/callback.hpp"
#include "network/network.hpp"
#include "network/occurrence.hpp"
#include "network/recorder.hpp"
#include "scene/scene.hpp"
#include "sim/legs.hpp"
#include "sim/message.hpp"
#include "sim/random.hpp"
#include "sim/scheduler.hpp"
#include "sim/slots.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

namespace rovernet {

/// World of a running network: what all its parts share. Time, events, robots' legs and radios,
/// messages and records are here; what only one part writes is in that part.
///
/// Parts keep a reference to it and to those that they call, and nothing else: two networks in one
/// process share nothing.
struct World {
    /// Makes an empty world.
    /// @throws std::invalid_argument if a setting is out of its range
    explicit World(NetworkSettings given);
    /// Copies are forbidden: the parts refer to it.
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    /// Gives a record to all sinks that want its kind.
    template <class R>
    void emit(const R& record) {
        records.emit(record, {legs, messages});
    }
    /// Number of robots.
    std::size_t size() const { return legs.size(); }
    /// Stores a message that is made now, held once by the caller. Its uid and time of creation are
    /// given here.
    MessageId new_message(Message message) {
        message.uid = next_uid++;
        message.created = now;
        return messages.add(std::move(message));
    }
    /// Key of a robot, XXH64 of its name: draws and orders depend on it, not on the robot's number.
    std::uint64_t key(NodeId node) const { return medium.stations().key(node); }
    /// Uniform draw in (0, 1) of this run. The order of draws decides nothing: each is a function
    /// of its key.
    /// @param a, b   what it is about, see Purpose
    /// @param index  number among several such draws
    double draw(Purpose purpose, std::uint64_t a, std::uint64_t b, std::uint64_t index) const {
        return uniform({settings.seed, settings.replication, purpose, a, b, index});
    }
    /// Counts one frame or waiting copy fewer of a message; the routing protocol is told when none
    /// is left.
    void release(MessageId id) {
        if (messages.release(id) && on_forgotten) on_forgotten(id);
    }

    /// Calls `call` at `time`, and every `period` [ns] from then on unless that is 0. Actions of
    /// one time are called in the order in which they were scheduled, after all else that is due
    /// then.
    /// @throws std::invalid_argument if that is before now
    void schedule(Time time, Callback<> call, Duration period = {});
    /// Serves the event of an action: calls what waits in that slot, and queues it again if it has
    /// a period.
    void act(std::size_t slot);

    /// Goes on to the next scene of the settings, whose time has come.
    void change_scene();

    /// Settings as they were given.
    NetworkSettings settings;
    /// Scene now: that of the settings, or an open field, and later those that follow it; never
    /// null.
    const Scene* scene;
    /// Closed doors of the scene now; null: none.
    const ClosedDoors* doors = nullptr;
    /// Ways around the walls of the settings' scene, whose doors are open; shared with other runs
    /// if the settings say so.
    std::shared_ptr<Planners> planners;
    /// Time of the event that is served, and end of the current run_until().
    Time now = start_of_run, end_of_run = start_of_run;
    /// The run has begun.
    bool running = false;
    /// Events to come.
    Scheduler<Occurrence> events;
    /// Motion of all robots.
    Legs legs;
    /// Radios, and who hears whom.
    Medium medium;
    const Phy phy;  // that the access protocol's frames go by
    /// Messages that somebody still refers to.
    MessageTable messages;
    /// Sinks, which get what emit() is given.
    Recorder records;
    /// Called when nothing refers to a message any more; Routing sets it.
    std::function<void(MessageId)> on_forgotten = {};
    /// Messages made so far: the uid of the next.
    std::uint64_t next_uid = 0;
    /// Frames put on air so far.
    std::uint64_t transmissions = 0;
    /// Somebody asks for received powers: a sink, or the routing protocol.
    bool levels_wanted = false;

  private:
    // Action of the user's that is due, and its period [ns]; 0: once.
    struct Action {
        Callback<> call = {};
        Duration period{0};
    };
    // Actions by the slot that their event carries.
    Slots<Action> actions_;
};

}  // namespace rovernet
