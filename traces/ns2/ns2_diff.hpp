// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"
#include "traces/ns2/ns2_file.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {

/// Line of an ns-2 trace with its line number, from 1.
struct NumberedLine {
    std::uint64_t line = 0;
    std::string text;
};

/// First difference of two ns-2 traces, and number of events by kind in each trace.
struct TraceDifference {
    bool is_equal = true;
    /// Name of the first field that differs, such as "time"; or a text about the end of one trace.
    std::string field;
    /// Events around the first difference: up to two equal events, the different event (index
    /// `place`; beyond the list if the file ends there), and up to two that follow.
    std::vector<NumberedLine> a, b;
    std::size_t place = 0;
    /// Number of events in trace a and in trace b, by kind: "s AGT", "D MAC COL", "M".
    std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> kinds;
    Ns2Counts counts_a, counts_b;
};

/// Part of two traces that is read: the whole traces, or the traces up to the first difference. In
/// the second case `kinds` and the counts end at the difference, and `a` and `b` contain no later
/// events.
enum class DiffExtent { whole, first_difference };

/// Compares two ns-2 traces event by event, in any formats, by the fields that both lines have.
/// Lines that are not events, and blanks, are ignored. Reason and payload are ignored between
/// different formats.
/// @param tolerance  largest time difference of equal events
/// @throws InputError as Ns2File
TraceDifference diff_ns2(Ns2Source a, Ns2Source b, Duration tolerance,
                         Ns2Strictness = Ns2Strictness::tolerant, DiffExtent = DiffExtent::whole);

}  // namespace rovernet
