// SPDX-License-Identifier: MIT
#include "mobility/speed_range.hpp"

#include "sim/fields.hpp"
#include "sim/math.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rovernet {

SpeedRange::SpeedRange(MetersPerSecond min, MetersPerSecond max, const Mover& mover,
                       std::string_view model)
    : low(std::min(min, mover.top_speed).value), high(std::min(max, mover.top_speed).value) {
    if (!non_negative.contains(min.value)) {
        throw_out_of_range(model, "min_speed", non_negative.text, min.value);
    }
    if (!positive.contains(max.value)) {
        throw_out_of_range(model, "max_speed", positive.text, max.value);
    }
    if (!(max >= min)) {
        throw_out_of_range(model, "max_speed", fmt::format(">= min_speed = {}", min.value),
                           max.value);
    }
}

double SpeedRange::at_a_moment(double u) const {
    return std::clamp(low * math::exp(u * math::log(high / low)), low, high);
}

double SpeedRange::mean_slowness() const {
    constexpr double close = 1e-4;  // to there the mean speed's inverse is right to 1e-9
    if (high - low <= close * low) return 2 / (low + high);
    return math::log(high / low) / (high - low);
}

}  // namespace rovernet
