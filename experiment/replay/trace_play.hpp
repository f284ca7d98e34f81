// SPDX-License-Identifier: MIT
#pragma once

#include "traces/ns2/ns2_file.hpp"

#include <functional>
#include <string_view>

namespace rovernet {

/// What becomes of the lines of a trace that is played.
struct TracePlay {
    /// Called with each event when its time has come.
    std::function<void(std::string_view line)> show;
    /// Asked at least every 50 ms while it waits; false stops the play.
    std::function<bool()> goes_on;
};

/// Plays a trace: shows its events one after the other, paced by the clock. Time begins with the
/// first event.
/// @param speed  > 0: seconds of the trace in a second of real time
/// @return false if it was stopped
/// @throws InputError as Ns2File
bool play_trace(Ns2Source source, double speed, const TracePlay& play);

}  // namespace rovernet
