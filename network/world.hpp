// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/planners.hpp"
#include "models/medium/medium.hpp"
#include "network/callback.hpp"
#include "network/network.hpp"
#include "network/occurrence.hpp"
#include "network/recorder.hpp"
#include "scene/scene.hpp"
#include "sim/events/scheduler.hpp"
#include "sim/legs.hpp"
#include "sim/message.hpp"
#include "sim/random.hpp"
#include "sim/slots.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace rovernet {

/// State that all parts of a running network share: time, events, legs and radios of robots,
/// messages and records. State that only one part changes is a member of that part.
///
/// A part stores only references to the World and to the parts that it calls: two networks in one
/// process share nothing.
struct World {
    /// Creates an empty world.
    /// @throws std::invalid_argument if a setting is out of its range
    explicit World(NetworkSettings given);
    /// Not copyable, because the parts of the network refer to the World.
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    /// Passes a record to all sinks that want its kind.
    template <class R>
    void emit(const R& record) {
        records.emit(record, {legs, messages, router});
    }
    /// Number of robots.
    std::size_t size() const { return legs.size(); }
    /// Stores a message created now, with one reference, the caller's; sets its uid and time of
    /// creation.
    MessageId new_message(Message message) {
        message.uid = next_uid++;
        message.created = now;
        return messages.add(std::move(message));
    }
    /// Key of a robot, XXH64 of its name. Draws and orderings depend on the key, not on the id.
    std::uint64_t key(NodeId node) const { return medium.stations().key(node); }
    /// Uniform draw in (0, 1) of this run: a function of its key, independent of the order of
    /// draws.
    /// @param a, b   subjects of the draw, see Purpose
    /// @param index  index among several draws with the same fields
    double draw(Purpose purpose, std::uint64_t a, std::uint64_t b, std::uint64_t index) const {
        return uniform({settings.seed, settings.replication, purpose, a, b, index});
    }
    /// Removes a reference to a message; the routing protocol is notified after the last removal.
    void release(MessageId id) {
        if (messages.release(id) && on_forgotten) on_forgotten(id);
    }
    /// Adds (hold) or removes a reference to the message and a reference to the header of a frame.
    void hold(const Frame& frame) {
        messages.hold(frame.message);
        if (frame.header != 0) [[unlikely]]
            hold_header(frame.header);
    }
    void release(const Frame& frame) {
        if (frame.header != 0) [[unlikely]]
            release_header(frame.header);
        release(frame.message);
    }

    /// Calls `call` at `time`, and then every `period` [ns] unless `period` is 0. Actions of the
    /// same time are called in the order of scheduling, after all other events of that time.
    /// @throws std::invalid_argument if `time` is before now
    void schedule(Time time, Callback<> call, Duration period = {});
    /// Serves the event of a user's action: calls the action in `slot`, and queues the event again
    /// if the action has a period.
    void act(std::size_t slot);

    /// Changes `scene` and `doors` to the scene of settings.scene_changes that is due now.
    void change_scene();

    /// Settings of the network, as given.
    NetworkSettings settings;
    /// Current scene: at first settings.scene or an open field, later a scene of
    /// settings.scene_changes; never null.
    const Scene* scene;
    /// Closed doors of the current scene; null if no door is closed.
    const ClosedDoors* doors = nullptr;
    /// Path planners for settings.scene, in which all doors are open; shared with other runs if
    /// settings.planners is set.
    std::shared_ptr<Planners> planners;
    /// Time of the current event, and time up to which the current run_until() or advance() serves.
    Time now = start_of_run, end_of_run = start_of_run;
    /// Whether the run has begun.
    bool running = false;
    /// Future events of the run.
    Scheduler<Occurrence> events;
    /// Current leg (straight movement or rest) of each robot.
    Legs legs;
    /// Radios and propagation, which determine links and receivers.
    Medium medium;
    /// Physical layer of the access model's frames.
    const Phy phy;
    /// Messages in use: a frame on air, a queue or the routing protocol refers to each message.
    MessageTable messages;
    /// Sinks, which get the records of emit().
    Recorder records;
    /// Routing protocol, for sinks; null until Routing sets it.
    const Router* router = nullptr;
    /// Called after the last reference to a message was removed; set by Routing.
    std::function<void(MessageId)> on_forgotten = {};
    /// Called after the last reference to a header of a frame was removed; set by Routing.
    std::function<void(std::uint32_t)> on_header_forgotten = {};
    /// Uid of the next message: number of messages made so far.
    std::uint64_t next_uid = 0;
    /// Number of frames transmitted so far.
    std::uint64_t transmissions = 0;
    /// True if a sink or the routing protocol requests the received powers at all nodes.
    bool levels_wanted = false;
    /// Flag of each node, by id; true: an application of the node requests received powers. Empty
    /// if no application requests received powers.
    std::vector<bool> level_wanted_at = {};
    /// Whether received powers of frames are requested: wants_levels() at any node,
    /// wants_level_at() at `node`.
    bool wants_levels() const { return levels_wanted || !level_wanted_at.empty(); }
    bool wants_level_at(NodeId node) const {
        return levels_wanted ||
               (node.index() < level_wanted_at.size() && level_wanted_at[node.index()]);
    }
    /// Received powers of receptions [dBm], as a record contains them: `levels` if the powers are
    /// requested at all nodes (levels_wanted); otherwise empty.
    std::span<const Dbm> for_sinks(std::span<const Dbm> levels) const {
        return levels_wanted ? levels : std::span<const Dbm>{};
    }
    /// Requests the received powers of frames at `node` from now on.
    void want_level_at(NodeId node) {
        if (node.index() >= level_wanted_at.size()) level_wanted_at.resize(node.index() + 1);
        level_wanted_at[node.index()] = true;
    }

  private:
    void hold_header(std::uint32_t header);
    void release_header(std::uint32_t header);

    // Scheduled action of the user, and its period [ns]; 0: once.
    struct Action {
        Callback<> call = {};
        Duration period{0};
    };
    // Scheduled actions; the event of an action stores the action's slot.
    Slots<Action> actions_;
    // Number of references to each header of frames, by Frame::header.
    std::vector<std::uint32_t> header_holders_;
};

}  // namespace rovernet
