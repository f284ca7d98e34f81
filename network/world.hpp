// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/planners.hpp"
#include "models/medium/medium.hpp"
#include "network/callback.hpp"
#include "network/network.hpp"
#include "network/occurrence.hpp"
#include "network/recorder.hpp"
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

/// What all parts of a running network share: time, events, robots' legs and radios, messages and
/// records.
struct World {
    /// @throws std::invalid_argument if a setting is out of its range
    explicit World(NetworkSettings given);
    World(const World&) = delete;  // the parts refer to it
    World& operator=(const World&) = delete;

    template <class R>
    void emit(const R& record) {
        records.emit(record, {legs, messages});
    }
    std::size_t size() const { return legs.size(); }
    /// Stores a message that is made now, held once by the caller; its uid is given here.
    MessageId new_message(Message message) {
        message.uid = next_uid++;
        message.created = now;
        return messages.add(std::move(message));
    }
    std::uint64_t key(NodeId node) const { return medium.key(node); }
    /// A uniform draw in (0, 1) of this run.
    double draw(Purpose purpose, std::uint64_t a, std::uint64_t b, std::uint64_t index) const {
        return uniform({settings.seed, settings.replication, purpose, a, b, index});
    }
    /// One frame or waiting copy fewer refers to the message; tells when nothing does any more.
    void release(MessageId id) {
        if (messages.release(id) && on_forgotten) on_forgotten(id);
    }

    /// Calls `call` at `time`, and every `period` from then on unless that is 0.
    /// @throws std::invalid_argument if that is before now
    void schedule(Time time, Callback<> call, Duration period = {});
    /// Calls what waits in that slot of `actions`.
    void act(std::size_t slot);

    NetworkSettings settings;
    const Scene* scene;
    std::shared_ptr<Planners> planners;
    Time now = start_of_run, end_of_run = start_of_run;  // of the current run_until
    bool running = false;                                // the run has begun
    Scheduler<Occurrence> events;
    Legs legs;
    Medium medium;
    const Phy phy;  // that the access protocol's frames go by
    MessageTable messages;
    Recorder records;
    std::function<void(MessageId)> on_forgotten = {};
    std::uint64_t next_uid = 0;       // of messages
    std::uint64_t transmissions = 0;  // so far
    bool levels_wanted = false;       // somebody asks for received powers

  private:
    struct Action {
        Callback<> call = {};
        Duration period{0};
    };
    Slots<Action> actions_;
};

}  // namespace rovernet
