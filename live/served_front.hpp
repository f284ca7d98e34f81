// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/front.hpp"
#include "live/paced_run.hpp"

#include <chrono>
#include <memory>
#include <set>

namespace rovernet {

/// Front (protocol server) of a paced run, with its listeners and what the run keeps of it.
struct ServedFront {
    const FrontListeners& listeners;
    std::unique_ptr<Front> front = nullptr;
    FrontListeners::Ports ports = {};
    std::set<Front::Connection> clients = {};
    Time due = never;      ///< its next(), before the session went on
    Time held_at = never;  ///< its limit(), at which the run waits
    std::chrono::steady_clock::time_point held_since = {};
};

}  // namespace rovernet
