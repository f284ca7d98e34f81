// SPDX-License-Identifier: MIT
#include "models/reception/on_air.hpp"

#include <bit>

namespace rovernet {

void OnAir::goes(const Leg& leg, Meters antenna_height) {
    const double speed = std::sqrt(dot(leg.velocity, leg.velocity));
    fastest_ = std::max(fastest_, speed);
    const auto take = [&](Vec3 p) {
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
        p.z += antenna_height.value;
        high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
    };
    take(leg.from);
    take(leg.to);
    const bool unbounded = leg.end == never && speed > 0;
    if (unbounded) high_.x = infinity;
}

void OnAir::changes(NodeId node, const Leg& leg, bool on) {
    if (frames_.empty()) return;
    if (node.index() >= last_change_.size()) last_change_.resize(node.index() + 1, 0);
    const std::uint64_t next = first_ + frames_.size();
    changes_.push_back({leg, on, next, last_change_[node.index()]});
    last_change_[node.index()] = first_change_ + changes_.size() - 1;
}

const OnAir::Before* OnAir::before(NodeId node, const Emission& frame) const {
    const Before* oldest = nullptr;
    for (std::uint64_t n = last_change(node); n >= first_change_;) {
        const Before& change = changes_[n - first_change_];
        if (change.serial <= frame.serial) break;
        oldest = &change;
        n = change.previous;
    }
    return oldest;
}

std::span<const Emission* const> OnAir::near(const Emission& frame, Time since, Time until,
                                             Time now) {
    constexpr double rounding = 1e-9;
    const double moved = fastest_ * seconds(now - frames_.front().begin);
    const double reach = (1 + rounding) * (frame.heard_within + this->reach() + moved);
    const std::uint64_t columns = bits(columns_.near(frame.origin.x, reach));
    if (near_.size() < frames_.size()) near_.resize(2 * frames_.size());
    std::size_t count = 0;
    rows_.near(frame.origin.y, reach).each([&](std::size_t bottom, std::size_t top) {
        for (std::size_t row = bottom; row < top; ++row) {
            for (std::uint64_t left = used_[row] & columns; left != 0; left &= left - 1) {
                const auto column = static_cast<std::size_t>(std::countr_zero(left));
                std::uint64_t serial = cells_[row * side + column].oldest;
                for (; serial != none; serial = next_[serial - first_]) {
                    const Emission& other = (*this)[serial];
                    const double d2 = squared_distance(frame.origin, other.origin);
                    // Conditions without a branch, which would often be mispredicted.
                    const std::size_t lasts = other.end > since, begun = other.begin < until;
                    const std::size_t reaches = d2 <= reach * reach,
                                      another = serial != frame.serial;
                    near_[count] = &other;
                    count += lasts & begun & reaches & another;
                }
            }
        }
    });
    return {near_.data(), count};
}

std::uint64_t OnAir::add(Emission frame) {
    frame.serial = first_ + frames_.size();
    longest_ = std::max(longest_, frame.end - frame.begin);
    frames_.push_back(frame);
    next_.push_back(none);
    if (const double reach = std::sqrt(frame.squared_reach); reach > reach_ || cells_.empty()) {
        reach_ = std::max(reach_, reach);
        lay_grid();
    } else {
        file(frame.serial);
    }
    return frame.serial;
}

/// Builds the grid with cells as wide as the interference range: a query visits a few of them.
void OnAir::lay_grid() {
    constexpr double narrowest = 1, widest = 1e9;  // [m]
    columns_ = rows_ = WrappedAxis(std::clamp(reach_, narrowest, widest), side);
    cells_.assign(side * side, {});
    used_ = {};
    for (const Emission& frame : frames_) file(frame.serial);
}

/// Appends a frame to its cell's chain.
void OnAir::file(std::uint64_t serial) {
    const Vec3 origin = (*this)[serial].origin;
    const std::size_t row = rows_.cell_at(origin.y), column = columns_.cell_at(origin.x);
    Cell& cell = cells_[row * side + column];
    if (cell.oldest == none) {
        cell.oldest = serial;
        used_[row] |= std::uint64_t{1} << column;
    } else {
        next_[cell.newest - first_] = serial;
    }
    cell.newest = serial;
    next_[serial - first_] = none;
}

/// Removes the oldest frame.
void OnAir::take_off() {
    const Vec3 origin = frames_.front().origin;
    const std::size_t row = rows_.cell_at(origin.y), column = columns_.cell_at(origin.x);
    Cell& cell = cells_[row * side + column];
    cell.oldest = next_.front();
    if (cell.oldest == none) used_[row] &= ~(std::uint64_t{1} << column);
    frames_.pop_front();
    next_.pop_front();
    ++first_;
}

}  // namespace rovernet
