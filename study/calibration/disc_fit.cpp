// SPDX-License-Identifier: MIT
#include "study/calibration/disc_fit.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rovernet {

DiscFit fit_disc(std::vector<DiscLink> links) {
    if (links.empty()) throw std::invalid_argument("fit_disc: expected at least one link");
    for (const DiscLink& link : links) {
        if (!(link.distance > 0 && std::isfinite(link.distance))) {
            throw std::invalid_argument("fit_disc: distances must be > 0 m and finite");
        }
    }
    std::stable_sort(links.begin(), links.end(),
                     [](const DiscLink& a, const DiscLink& b) { return a.distance < b.distance; });
    std::size_t wrong = 0;  // with the nearest k called up
    for (const DiscLink& link : links) wrong += link.up;
    std::size_t fewest = wrong;
    std::vector<std::size_t> best{0};
    for (std::size_t k = 1; k <= links.size(); ++k) {
        if (links[k - 1].up) {
            --wrong;
        } else {
            ++wrong;
        }
        if (wrong < fewest) best.clear();
        fewest = std::min(fewest, wrong);
        if (wrong == fewest) best.push_back(k);
    }
    const std::size_t k = best[(best.size() - 1) / 2];
    const auto range = [&] {
        if (k == 0) return links.front().distance / 2;
        if (k == links.size()) return links.back().distance;
        return std::sqrt(links[k - 1].distance * links[k].distance);
    };
    return {{range()}, fewest};
}

}  // namespace rovernet
