// SPDX-License-Identifier: MIT
#include "scene/storeys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

Storeys::Storeys(std::vector<double> floors, std::vector<Material> ceilings)
    : floors_(std::move(floors)), ceilings_(std::move(ceilings)) {
    if (ceilings_.empty()) ceilings_.assign(floors_.size() - 1, {.name = "ceiling"});
    if (ceilings_.size() + 1 == floors_.size()) return;
    throw std::invalid_argument(
        fmt::format("Storeys: there must be a ceiling for each storey except the highest, got {} "
                    "ceilings for {} storeys",
                    ceilings_.size(), floors_.size()));
}

double Storeys::bottom(std::size_t number) const {
    return number == 0 ? -infinite : floors_[number];
}

double Storeys::top(std::size_t number) const {
    return number + 1 == floors_.size() ? infinite : floors_[number + 1];
}

/// Number of the highest storey whose floor is not above z [m].
std::size_t Storeys::highest_below(double z) const {
    const auto above = std::upper_bound(floors_.begin() + 1, floors_.end(), z);
    return static_cast<std::size_t>(above - floors_.begin()) - 1;
}

std::span<const Material> Storeys::ceilings_between(double z0, double z1) const {
    const auto [first, last] = std::minmax({number_at(z0), number_at(z1)});
    return std::span(ceilings_).subspan(first, last - first);
}

}  // namespace rovernet
