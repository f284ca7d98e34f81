// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/scheduler.hpp"

#include <cstdint>

// Events of a running network. Whatever happens later is an Occurrence in the Scheduler of the
// World; Engine::serve hands it to the part that it is for.

namespace rovernet {

/// Payload of an event: 16 bytes. `data` means what `kind` says. A part that is added to the
/// network needs a kind here and a case in Engine::serve.
struct Occurrence {
    enum class Kind : std::uint32_t {
        /// A frame of `node` ends at some of its receivers; data: its slot in Channel.
        frame,
        /// A timer of the routing protocol at `node`; data: the protocol's tag.
        router_timer,
        /// A frame of `node` that waited for its time is sent; data: its SendHandle.
        send,
        /// The leg of `node` ends; data: the leg's version, as another leg may have taken its
        /// place.
        leg_end,
        /// An application at `node` reacts to a message; data: see Applications::react.
        handed_over,
        /// An action of the user's; data: its slot in World. `node` means nothing.
        action,
        /// A link changes, or has to be looked at; see LinkMonitor. `node` means nothing.
        link_change,
        /// A timer of the access model at `node`; data: the model's tag.
        access_timer,
        /// A door closes or opens: the scene is another one from now on. `node` means nothing.
        scene_change
    };
    Kind kind;
    /// Node that it concerns, if it concerns one.
    NodeId node;
    std::uint64_t data;
};

/// Event as the Scheduler gives it: its key and its payload.
using Event = Scheduler<Occurrence>::Event;

}  // namespace rovernet
