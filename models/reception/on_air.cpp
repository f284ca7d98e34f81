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
    bound_reach();
}

void OnAir::bound_reach() {
    constexpr double anywhere = 4e15;
    bounded_reach_ = std::min({reach_, distance(low_, high_), anywhere});
}

void OnAir::changes(NodeId node, const Leg& leg, bool on) {
    if (frames_.empty() && past_.empty()) return;
    if (node.index() >= last_change_.size()) last_change_.resize(node.index() + 1, 0);
    changes_.push_back({leg, on, next_serial(), last_change_[node.index()]});
    last_change_[node.index()] = first_change_ + changes_.size() - 1;
}

const OnAir::Before* OnAir::before(NodeId node, const Emission& frame) const {
    const Before* oldest = nullptr;
    for (std::uint64_t n = last_change(node); n >= first_change_;) {
        const Before& each = change(n);
        if (each.serial <= frame.serial) break;
        oldest = &each;
        n = each.previous;
    }
    return oldest;
}

std::span<const Emission* const> OnAir::near(const Emission& frame, Time since, Time until,
                                             Time now) {
    const auto frame_of = [this](std::uint64_t serial) -> const Emission& {
        return frames_[serial - first_];
    };
    const auto cells_of = [this](std::size_t row) { return used_[row]; };
    if (near_.size() <= frames_.size()) near_.resize(2 * frames_.size() + 1);
    return search(frame, since, until, now - frames_.front().begin, frame_of, cells_of,
                  {first_, frames_.size(), near_});
}

std::span<const Emission* const> OnAir::past(const Emission& frame, Time since, Time until,
                                             Time now) {
    const auto frame_of = [this](std::uint64_t serial) -> const Emission& {
        return serial < first_ ? past_[serial - first_past_] : frames_[serial - first_];
    };
    const auto all = [](std::size_t) { return ~std::uint64_t{0}; };
    const std::size_t stored = past_.size() + frames_.size();
    if (found_past_.size() <= stored) found_past_.resize(2 * stored + 1);
    return search(frame, since, until, now - frame_of(first_past_).begin, frame_of, all,
                  {first_past_, stored, found_past_});
}

template <class FrameOf, class CellsOf>
std::span<const Emission* const> OnAir::search(const Emission& frame, Time since, Time until,
                                               Duration span, FrameOf frame_of, CellsOf cells_of,
                                               const Searched& all) {
    constexpr double rounding = 1e-9;
    const double moved = fastest_ * seconds(span);
    const double reach = (1 + rounding) * (frame.heard_within + this->reach() + moved);
    const std::uint64_t columns = bits(columns_.near(frame.origin.x, reach));
    // From the last element to the first, so that an earlier frame comes before a later one of the
    // same cell: it is more often the reason why a frame is lost.
    const Emission** const end = all.found.data() + all.found.size();
    const Emission** next = end - 1;
    rows_.near(frame.origin.y, reach).each([&](std::size_t bottom, std::size_t top) {
        for (std::size_t row = bottom; row < top; ++row) {
            for (std::uint64_t left = cells_of(row) & columns; left != 0; left &= left - 1) {
                const auto column = static_cast<std::size_t>(std::countr_zero(left));
                std::uint64_t serial = cells_[row * side + column];
                for (; serial - all.first < all.count; serial = previous_[serial - first_past_]) {
                    const Emission& other = frame_of(serial);
                    const double d2 = squared_distance(frame.origin, other.origin);
                    // Conditions without a branch, which would often be mispredicted.
                    const std::size_t lasts = other.end > since, begun = other.begin < until;
                    const std::size_t reaches = d2 <= reach * reach,
                                      another = serial != frame.serial;
                    *next = &other;
                    next -= lasts & begun & reaches & another;
                }
            }
        }
    });
    return {next + 1, end};
}

std::uint64_t OnAir::add(Emission frame) {
    frame.serial = next_serial();
    due_ = std::min(due_, frame.end);
    longest_ = std::max(longest_, frame.end - frame.begin);
    frames_.push_back(frame);
    previous_.push_back(none);
    if (const double reach = std::sqrt(frame.squared_reach); reach > reach_ || cells_.empty()) {
        reach_ = std::max(reach_, reach);
        bound_reach();
        lay_grid();
    } else {
        file(frame);
    }
    return frame.serial;
}

/// Builds the grid with cells as wide as the interference range: a query visits a few of them.
void OnAir::lay_grid() {
    constexpr double narrowest = 1, widest = 1e9;  // [m]
    columns_ = rows_ = WrappedAxis(std::clamp(reach_, narrowest, widest), side);
    cells_.assign(side * side, none);
    used_ = {};
    for (const Emission& frame : past_) file(frame);
    for (const Emission& frame : frames_) file(frame);
}

/// Appends a frame to its cell's chain.
void OnAir::file(const Emission& frame) {
    const std::uint64_t serial = frame.serial;
    const auto [row, column] = cell_of(frame);
    std::uint64_t& last = cells_[row * side + column];
    previous_[serial - first_past_] = last;
    last = serial;
    if (serial >= first_) used_[row] |= std::uint64_t{1} << column;
}

void OnAir::take_off() {
    const Emission& frame = frames_.front();
    const auto [row, column] = cell_of(frame);
    const bool last = cells_[row * side + column] == frame.serial;
    if (last) used_[row] &= ~(std::uint64_t{1} << column);
    past_.push_back(frame);
    frames_.pop_front();
}

void OnAir::drop_past(Time t) {
    for (; !past_.empty() && past_.front().end <= t; ++first_past_) {
        past_.pop_front();
        previous_.pop_front();
    }
    for (; !changes_.empty() && changes_.front().serial <= first_past_; ++first_change_) {
        changes_.pop_front();
    }
    recent_change_ = std::max(recent_change_, first_change_);
    const std::uint64_t end = first_change_ + changes_.size();
    while (recent_change_ < end && change(recent_change_).serial <= first_) ++recent_change_;
}

}  // namespace rovernet
