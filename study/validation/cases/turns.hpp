// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <iterator>
#include <span>
#include <vector>

// Cost comparison of methods for the same task, measured in turns so that a slowdown of the machine
// affects all methods equally.

namespace rovernet {

/// CPU time of one operation [ns]: median, lowest and highest value over the measurement turns.
struct TurnCost {
    double median = 0, low = 0, high = 0;
};

/// Method whose CPU time is measured by costs_in_turns().
struct TimedMethod {
    /// Function that performs all operations once (a pass). Its result depends on every operation,
    /// so that the compiler removes no operation.
    std::function<double()> pass;
    double operations = 1;  ///< number of operations in a pass, > 0
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

/// Number and length of the turns of a cost measurement by costs_in_turns().
struct Turns {
    int turns = 5;
    /// Minimum CPU time [s] of each method in a turn. Passes of the method are repeated until their
    /// CPU time reaches this value.
    double least_s = 0.02;
};

/// Measures the CPU time of methods in this thread. Each turn measures all methods one after the
/// other. Passes of a method are repeated until they take Turns::least_s.
/// @return cost of each method, in the order of `methods`
std::vector<TurnCost> costs_in_turns(std::span<const TimedMethod> methods, const Turns& turns);

}  // namespace rovernet
