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

/// A line of a trace and its number, from 1.
struct NumberedLine {
    std::uint64_t line = 0;
    std::string text;
};

/// Where two traces part, and how many events of each kind they have.
struct TraceDifference {
    bool is_equal = true;
    /// What parts them: the field that differs first, such as "time", or that one of them ends.
    std::string field;
    /// Events around the first that differ: up to two that are equal, the one that differs
    /// (`place`-th of the list; behind the last: the file ends there), up to two that follow.
    std::vector<NumberedLine> a, b;
    std::size_t place = 0;
    /// Number of events in both, by kind: "s AGT", "D MAC COL", "M".
    std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> kinds;
    Ns2Counts counts_a, counts_b;
};

/// Compares two traces event by event, in any formats: what both lines tell is compared. Lines that
/// are no events, and blanks, do not matter; nor do the reason and the payload between formats.
/// @param tolerance  times differ if they are further apart
/// @throws InputError as Ns2File
TraceDifference diff_ns2(Ns2Source a, Ns2Source b, Duration tolerance,
                         Ns2Strictness = Ns2Strictness::tolerant);

}  // namespace rovernet
