// SPDX-License-Identifier: MIT
#include "sim/events/scheduler.hpp"

#include "sim/error.hpp"

#include <string>

namespace rovernet {

void throw_too_many_events(const char* state, std::uint64_t limit) {
    throw RunError("more than " + std::to_string(limit) + " events are " + state +
                   "; the run requests too many events at once, or schedules events without end");
}

}  // namespace rovernet
