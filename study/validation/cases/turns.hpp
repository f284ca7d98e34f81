// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <vector>

// Cost of methods that do the same, measured so that a machine which slows down meanwhile slows all
// of them down.

namespace rovernet {

/// Cost of one operation [ns]: median, lowest and highest of the turns.
struct TurnCost {
    double median = 0, low = 0, high = 0;
};

/// Method to be measured: all its operations once, one after the other.
struct TimedMethod {
    std::function<double()> pass;  ///< any number that depends on every operation
    double operations = 1;         ///< [-] in a pass, > 0
};

/// Length of a measurement.
struct Turns {
    int turns = 5;
    double least_s = 0.02;  ///< [s] of CPU time that each method gets in a turn, at least
};

/// Measures the CPU time of this thread: in each turn all methods one after the other, each for as
/// many passes as fill its time.
/// @return one for each method, in their order
std::vector<TurnCost> costs_in_turns(std::span<const TimedMethod> methods, const Turns& turns);

}  // namespace rovernet
