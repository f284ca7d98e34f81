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

/// Forms that an ns-2 trace can be written in.
enum class TraceForm { csv, ns2_old, ns2_new };

/// Counts of the lines of a file that was written anew.
struct Converted {
    Ns2Counts counts;
    std::uint64_t written = 0;                      ///< events that were written
    std::map<std::string, std::uint64_t> left_out;  ///< events that were not written, by reason
};

/// Writes the events of a trace in another form; comments and other lines that are no events are
/// left out.
///
/// From the old format to the new one, places are those of the `M` lines; a packet of a robot that
/// has none before it is left out. `M`, `N` and `v` lines are the same in all formats. The way back
/// gives the same bytes for every trace of ours without MAC lines. Energies are written in
/// the new format only, which has fewer fields for them.
/// @param out  file that gets its name when it is whole
/// @throws InputError as Ns2File; RunError if it cannot be written
Converted convert_ns2(Ns2Source in, const std::string& out, TraceForm,
                      Ns2Strictness = Ns2Strictness::tolerant);

/// Piece of a trace: every line that none of these members rules out.
struct TraceCut {
    std::optional<Time> from = {};     ///< no packet before it
    std::optional<Time> to = {};       ///< nothing at this time or later
    std::optional<NodeId> robot = {};  ///< lines of this robot only
    /// Packets of this id only; none of routing agents and of the MAC's own, whose ids repeat.
    std::optional<std::uint64_t> message = {};
};

/// Writes the events of a trace that belong to a piece of it, as they stand. `M` lines before its
/// begin stay, as nobody would know where the robots are.
/// @throws InputError, RunError as convert_ns2()
Converted cut_ns2(Ns2Source in, const std::string& out, const TraceCut&,
                  Ns2Strictness = Ns2Strictness::tolerant);

}  // namespace rovernet
