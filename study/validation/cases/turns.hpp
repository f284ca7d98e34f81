// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <iterator>
#include <span>
#include <vector>

// Cost comparison of methods for the same task, measured in turns so that a slowdown of the machine
// affects all methods equally.

namespace rovernet {

/// Cost of one operation [ns]: median, lowest and highest of the measurement turns.
struct TurnCost {
    double median = 0, low = 0, high = 0;
};

/// Method whose CPU time is measured: `pass` performs all operations once.
struct TimedMethod {
    std::function<double()> pass;  ///< returns any number that depends on every operation, so that
                                   ///< none is optimised away
    double operations = 1;         ///< number of operations in a pass, > 0
};

/// Method that sums value(x) over all elements x of `all`, which must outlive the method.
template <class All, class Value>
TimedMethod timed_sum(const All& all, Value value) {
    return {[&all, value] {
                double sum = 0;
                for (const auto& each : all) sum += static_cast<double>(value(each));
                return sum;
            },
            static_cast<double>(std::size(all))};
}

/// Length of a cost measurement.
struct Turns {
    int turns = 5;
    double least_s = 0.02;  ///< least CPU time of each method in a turn [s]
};

/// Measures the CPU time of methods in this thread. Each turn measures all methods one after the
/// other, each for enough passes to fill its time.
/// @return cost of each method, in their order
std::vector<TurnCost> costs_in_turns(std::span<const TimedMethod> methods, const Turns& turns);

}  // namespace rovernet
