// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/time.hpp"
#include "traces/ns2/ns2_file.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace rovernet {

/// Output format for an ns-2 trace.
enum class TraceForm { csv, ns2_old, ns2_new };

/// Result of converting an ns-2 trace: numbers of events that were written to the new file, and
/// numbers of events that were not.
struct Converted {
    Ns2Counts counts;
    std::uint64_t written = 0;                      ///< number of events written
    std::map<std::string, std::uint64_t> left_out;  ///< number of events not written, by reason
};

/// Converts the events of an ns-2 trace to another format. Comments and other lines that are not
/// events are left out.
///
/// From the old format to the new one, positions are taken from the `M` lines; packets that a robot
/// sends before its first `M` line are left out. `M`, `N` and `v` lines are the same in all
/// formats. Converting back gives the same bytes for every trace of rovernet without MAC lines.
/// Energies are only written in the new format, which has fewer fields for them.
/// @param out  output file, which gets its name when it is complete
/// @throws InputError as Ns2File; RunError if `out` cannot be written
Converted convert_ns2(Ns2Source in, const std::string& out, TraceForm,
                      Ns2Strictness = Ns2Strictness::tolerant);

/// Selection of events of an ns-2 trace: an event is kept unless a member of TraceCut excludes it.
struct TraceCut {
    std::optional<Time> from = {};     ///< earliest time of packets that are kept
    std::optional<Time> to = {};       ///< time from which on events are excluded
    std::optional<NodeId> robot = {};  ///< robot whose lines are kept; none: all robots
    /// Id of packets that are kept; none: any id. If an id is given, packets of routing agents and
    /// of the MAC are excluded, because their ids repeat.
    std::optional<std::uint64_t> message = {};
};

/// Writes the selected events of an ns-2 trace, unchanged. `M` lines (movements) before
/// TraceCut::from are kept, because they give the positions of the robots.
/// @throws InputError, RunError as convert_ns2()
Converted cut_ns2(Ns2Source in, const std::string& out, const TraceCut&,
                  Ns2Strictness = Ns2Strictness::tolerant);

}  // namespace rovernet
