// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"

#include <array>
#include <string_view>

// Traces in a scenario file:
//
//     [trace]
//     ns2 = "new"
//     mac = true

namespace rovernet {

/// Values of [trace] ns2: the old or the new wireless trace format of ns-2.35.
enum class Ns2Choice {
    /// No trace.
    none,
    /// Old format, by the CMU extension; ns-2 writes this format by default.
    old_format,
    /// New format, which ns-2 writes after the command `use-newtrace`.
    new_format
};
template <>
struct EnumNames<Ns2Choice> {
    static constexpr std::array<std::string_view, 3> values = {"none", "old", "new"};
};
/// [trace]: trace files that a run writes into the folder of its results. trace_files() makes a
/// sink for each file.
struct TraceTable {
    /// Format of the ns-2 trace; none: no trace.
    Ns2Choice ns2 = Ns2Choice::none;
    /// True if the ns-2 trace includes lines of the MAC layer.
    bool mac = false;
    /// True if all records are written to a recorded trace (MCAP).
    bool record = false;
    /// True if the recorded trace includes the times at which links come up and go down.
    bool links = false;

    static constexpr auto fields() {
        return describe(
            field("ns2", &TraceTable::ns2,
                  "write a trace in the wireless format of ns-2.35, old or new"),
            field("mac", &TraceTable::mac,
                  "true: the ns-2 trace also has the lines of the MAC layer"),
            field("record", &TraceTable::record,
                  "true: write a recorded trace with all events of the run, for replay"),
            field("links", &TraceTable::links,
                  "true: the recorded trace also has the changes of links"));
    }
};

}  // namespace rovernet
