// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/front.hpp"
#include "live/paced_run.hpp"

#include <chrono>
#include <memory>
#include <set>

namespace rovernet {

/// Front (protocol server) of a paced run, with its listeners and its state in the run.
struct ServedFront {
    const FrontListeners& listeners;
    std::unique_ptr<Front> front = nullptr;
    FrontListeners::Ports ports = {};
    std::set<Front::Connection> clients = {};
    Time due = never;      ///< value of Front::next() before the session continued
    Time held_at = never;  ///< value of Front::limit() at which the run waits
    std::chrono::steady_clock::time_point held_since = {};

    /// Tells the front how long the run has waited at its limit, if the run waits there.
    void tell_held(Time now, std::chrono::steady_clock::time_point time) {
        const Time limit = front->limit();
        if (limit > now || limit != held_at) held_since = time;
        held_at = limit;
        if (limit <= now) front->held(time - held_since);
    }
};

}  // namespace rovernet
