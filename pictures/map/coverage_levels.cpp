// SPDX-License-Identifier: MIT
#include "pictures/map/coverage_levels.hpp"

#include "experiment/reports/range_of_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

namespace rovernet {

std::vector<ContourLevel> contour_levels(const Transmitter& transmitter) {
    const Radio& radio = transmitter.receiver;
    std::vector<ContourLevel> levels{{radio.sensitivity, "sensitivity"}};
    if (radio.labels.range_db && !range_of(transmitter.model))
        levels.push_back({*radio.labels.range_db, "range_db"});
    return levels;
}

std::pair<double, double> color_range(const CoverageMap& map,
                                      const std::vector<ContourLevel>& levels) {
    constexpr double below = 20, least = 20, step = 5;  // [dB]
    constexpr double rest = 0.0005;
    double weakest = levels.front().level.value;
    for (const ContourLevel& each : levels) weakest = std::min(weakest, each.level.value);
    std::vector<double> dbm = map.dbm;
    const auto skipped = static_cast<std::ptrdiff_t>(rest * static_cast<double>(dbm.size()));
    std::nth_element(dbm.begin(), dbm.begin() + skipped, dbm.end(), std::greater<>());
    const double strongest = dbm[static_cast<std::size_t>(skipped)];
    const double low = step * std::floor((weakest - below) / step);
    return {low, std::max(step * std::ceil(strongest / step), low + least)};
}

}  // namespace rovernet
