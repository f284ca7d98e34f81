// SPDX-License-Identifier: MIT
#pragma once

#include "sim/events/scheduler.hpp"
#include "sim/ids.hpp"

#include <cstdint>

// Events of a running network. Every future action is an Occurrence in the Scheduler of the World;
// Engine::serve passes it to the part of the network that handles it.

namespace rovernet {

/// Payload of an event: 16 bytes. The meaning of `data` depends on `kind`. A new part of the
/// network needs a kind here and a case in Engine::serve.
struct Occurrence {
    enum class Kind : std::uint32_t {
        /// End of a frame of `node` at some of its receivers; data: slot of the frame in Channel.
        frame,
        /// Timer of the routing protocol at `node`; data: the protocol's tag.
        router_timer,
        /// Transmission of a frame of `node` that waited for its send time; data: its SendHandle.
        send,
        /// End of the leg of `node`; data: the leg's version, because the leg may have been
        /// replaced.
        leg_end,
        /// Reaction of an application at `node` to a message; data: slot of the delivery, see
        /// Applications::react.
        handed_over,
        /// Action of the user; data: slot of the action in World. `node` is not used.
        action,
        /// Change of a link, or continued search for a change; see LinkMonitor. `node` is not used.
        link_change,
        /// Timer of the access model at `node`; data: the model's tag.
        access_timer,
        /// End of a unicast of `node` whose sender hears no result: its next hop is out of range,
        /// or the sender is off; data: slot of the frame in Mac.
        unheard,
        /// Change of the scene: a door closes or opens. `node` is not used.
        scene_change,
        /// Event of address resolution at `node`; data: id of the neighbour, see Arp.
        arp
    };
    Kind kind;
    /// Node of the event; not used by kinds that concern no node.
    NodeId node;
    std::uint64_t data;
};

/// Event from the Scheduler: its key and its payload.
using Event = Scheduler<Occurrence>::Event;

}  // namespace rovernet
