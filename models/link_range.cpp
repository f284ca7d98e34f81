// SPDX-License-Identifier: MIT
#include "models/link_range.hpp"

#include <bit>
#include <cassert>
#include <cstdint>
#include <limits>

namespace rovernet {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The largest finite x >= 0 for which holds(x), which is true up to some x and false beyond;
/// negative if there is none. Non-negative numbers are in the order of their bits.
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

double largest_squared_distance(const Propagation& model, Hertz frequency, Db budget) {
    assert(model.shape() == LossShape::by_distance);
    const auto within = [&](double d) {
        const Vec3 to{d, 0, 0};
        const std::uint64_t key = 0;
        double loss = 0;
        LinkBatch link{.frequency = frequency, .from = {}, .to = {&to, 1}, .to_keys = {&key, 1}};
        model.loss(link, Db{infinity}, {&loss, 1});
        return loss <= budget.value;
    };
    return last_that([&](double squared) { return within(std::sqrt(squared)); });
}

}  // namespace rovernet
