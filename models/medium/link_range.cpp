// SPDX-License-Identifier: MIT
#include "models/medium/link_range.hpp"

#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rovernet {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Largest finite x >= 0 with holds(x), which is true up to some x and false beyond; negative if
/// there is none. Non-negative floating-point numbers are ordered like their bits.
template <class Predicate>
double last_that(Predicate holds) {
    if (!holds(0.0)) return -1;
    std::uint64_t yes = 0, no = std::bit_cast<std::uint64_t>(infinity);
    while (no - yes > 1) {
        const std::uint64_t middle = yes + (no - yes) / 2;
        (holds(std::bit_cast<double>(middle)) ? yes : no) = middle;
    }
    return std::bit_cast<double>(yes);
}

}  // namespace

double loss_at(const Propagation& model, Hertz frequency, double distance, Meters height) {
    assert(model.shape() == LossShape::by_distance || model.shape() == LossShape::by_heights);
    const double z = height.value;
    return model.loss_to({distance, 0, z}, {.frequency = frequency, .from = {0, 0, z}});
}

double largest_squared_distance(const Propagation& model, Hertz frequency, Db budget,
                                Meters height) {
    return last_that([&](double squared) {
        return loss_at(model, frequency, std::sqrt(squared), height) <= budget.value;
    });
}

}  // namespace rovernet
