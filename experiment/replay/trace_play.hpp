// SPDX-License-Identifier: MIT
#pragma once

#include "traces/ns2/ns2_file.hpp"

#include <functional>
#include <string_view>

namespace rovernet {

/// Callbacks of play_trace().
struct TracePlay {
    /// Callback with the line of each event of the trace, called at the time of the event.
    std::function<void(std::string_view line)> show;
    /// Callback, called at least every 50 ms while play_trace() waits; returning false stops the
    /// playback.
    std::function<bool()> goes_on;
};

/// Plays a trace from its first event on: shows the events of the trace one by one, paced by the
/// clock.
/// @param speed  ratio of trace time to real time [-], > 0
/// @return false if the callback `goes_on` stopped the playback
/// @throws InputError as Ns2File
bool play_trace(Ns2Source source, double speed, const TracePlay& play);

}  // namespace rovernet
