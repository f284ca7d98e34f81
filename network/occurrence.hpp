// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/scheduler.hpp"

#include <cstdint>

namespace rovernet {

/// What an event is about; `data` means what `kind` says.
struct Occurrence {
    enum class Kind : std::uint32_t {
        frame,         ///< a frame of `node` arrives; data: its slot in Channel
        router_timer,  ///< data: the router's tag
        send,          ///< a frame of `node` that waited for its time; data: its SendHandle
        leg_end,       ///< data: the leg's version
        handed_over,   ///< `node` reacts to a message; data: see Applications::react
        action,        ///< data: its slot in Actions
        link_change,
        access_timer  ///< data: the access protocol's tag
    };
    Kind kind;
    NodeId node;
    std::uint64_t data;
};

using Event = Scheduler<Occurrence>::Event;

}  // namespace rovernet
