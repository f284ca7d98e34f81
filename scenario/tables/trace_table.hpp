// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"

#include <array>
#include <string_view>

// Traces as a scenario file asks for them:
//
//     [trace]
//     ns2 = "new"
//     mac = true

namespace rovernet {

/// Words of [trace] ns2: the wireless trace format of ns-2.35, its old or its new one.
enum class Ns2Choice {
    /// No trace.
    none,
    /// Format of the CMU extension, which ns-2 writes by default.
    old_format,
    /// Format that ns-2 writes after `use-newtrace`.
    new_format
};
template <>
struct EnumNames<Ns2Choice> {
    static constexpr std::array<std::string_view, 3> values = {"none", "old", "new"};
};
/// [trace]: the files that a run writes beside its results. trace_files() makes a sink of each.
struct TraceTable {
    /// Format of the ns-2 trace; none: no trace.
    Ns2Choice ns2 = Ns2Choice::none;
    /// Lines of the MAC layer are in the ns-2 trace, too.
    bool mac = false;
    /// All records go to a recorded trace (MCAP), too.
    bool record = false;
    /// Changes of links are in the recorded trace, too.
    bool links = false;

    static constexpr auto fields() {
        return describe(field("ns2", &TraceTable::ns2, "wireless trace format of ns-2.35"),
                        field("mac", &TraceTable::mac, "lines of the MAC layer in it, too"),
                        field("record", &TraceTable::record, "trace of all records, to replay"),
                        field("links", &TraceTable::links, "changes of links in that, too"));
    }
};

}  // namespace rovernet
