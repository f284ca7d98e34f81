// SPDX-License-Identifier: MIT
#pragma once

#include "traces/ns2/ns2_file.hpp"

#include <functional>
#include <string_view>

namespace rovernet {

/// Callbacks of play_trace().
struct TracePlay {
    /// Called with each event of the trace, when its time has come.
    std::function<void(std::string_view line)> show;
    /// Called at least every 50 ms during waits; returning false stops the play.
    std::function<bool()> goes_on;
};

/// Plays a trace: shows its events in turn, paced by the clock, from the first event on.
/// @param speed  > 0: seconds of the trace in a second of real time
/// @return false if it was stopped
/// @throws InputError as Ns2File
bool play_trace(Ns2Source source, double speed, const TracePlay& play);

}  // namespace rovernet
