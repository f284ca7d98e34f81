// SPDX-License-Identifier: MIT
#include "models/on_air.hpp"

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
    if (node.index() >= last_change_.size()) last_change_.resize(node.index() + 1, none);
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

std::uint64_t OnAir::add(Emission frame) {
    frame.serial = first_ + frames_.size();
    longest_ = std::max(longest_, frame.end - frame.begin);
    frames_.push_back(frame);
    if (const double reach = std::sqrt(frame.squared_reach); reach > reach_ || cells_.empty()) {
        reach_ = std::max(reach_, reach);
        lay_grid();
    } else {
        file(frame);
    }
    return frame.serial;
}

void OnAir::file(const Emission& frame) {
    auto& cell =
        cells_[rows_.cell_at(frame.origin.y) * columns_.cells() + columns_.cell_at(frame.origin.x)];
    const auto kept = std::find_if(cell.begin(), cell.end(),
                                   [&](const Emission& e) { return e.serial >= first_; });
    cell.erase(cell.begin(), kept);
    cell.push_back(frame);
}

/// Cells as wide as frames disturb: a query looks at a few of them.
void OnAir::lay_grid() {
    constexpr double narrowest = 1, widest = 1e9;  // [m]
    columns_ = rows_ = WrappedAxis(std::clamp(reach_, narrowest, widest), side);
    cells_.assign(side * side, {});
    for (const Emission& frame : frames_) file(frame);
}

}  // namespace rovernet
