// SPDX-License-Identifier: MIT
#pragma once

#include "models/arrival.hpp"
#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"
#include "sim/wrapped_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <span>
#include <vector>

namespace rovernet {

/// The frames that are on air, and those that were so lately that they may still matter.
///
/// Kept once each, where they were sent: who receives a frame asks what else was on air around it,
/// so that a frame that meets no other costs hardly anything. Since a frame's levels are fixed when
/// it begins, what nodes were before their legs or radios changed is kept as long as the frames.
class OnAir {
  public:
    /// A node goes along `leg` from now on.
    void goes(const Leg& leg, Meters antenna_height);
    /// What `node` has been until now, and since its last change; kept if there are frames.
    void changes(NodeId node, const Leg& leg, bool on);

    /// Adds a frame; `begin` must not decrease. @return its serial
    std::uint64_t add(Emission frame);
    /// Forgets the first frames, as long as they ended by `t`, and calls use(frame) for each.
    template <class Use>
    void forget(Time t, Use use) {
        while (!frames_.empty() && frames_.front().end <= t) {
            use(frames_.front());
            take_off();
        }
        while (!changes_.empty() && changes_.front().serial <= first_) {
            changes_.pop_front();
            ++first_change_;
        }
    }
    const Emission& operator[](std::uint64_t serial) const { return frames_[serial - first_]; }

    /// All, in the order of their serials.
    const std::deque<Emission>& frames() const { return frames_; }
    /// Of the others that end after `since` and begin before `until`, those that may disturb a
    /// receiver of `frame` by `now`, and some more; good until the next call. Receivers that
    /// changed lately may meet further ones.
    std::span<const Emission* const> near(const Emission& frame, Time since, Time until, Time now);

    /// A node before it changed.
    struct Before {
        Leg leg;
        bool on;
        std::uint64_t serial;    // of the next frame
        std::uint64_t previous;  // change of the same node
    };
    /// The node's leg or radio has changed since a frame began that is kept.
    bool has_changed(NodeId node) const {
        return !changes_.empty() && last_change(node) >= first_change_;
    }
    /// What the node was when the frame began; null if it has not changed since.
    const Before* before(NodeId node, const Emission& frame) const;

    /// [ns] of the longest frame
    Duration longest() const { return longest_; }
    /// [m] no frame disturbs anybody farther away, nor is anybody farther away
    double reach() const {
        constexpr double anywhere = 4e15;
        return std::min({reach_, distance(low_, high_), anywhere});
    }

  private:
    static constexpr std::size_t side = 64;  // [cells] of the grid
    static constexpr std::uint64_t none = ~std::uint64_t{0};
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    /// The frames that were sent there, as a chain of serials.
    struct Cell {
        std::uint64_t oldest = none, newest = none;
    };

    std::uint64_t last_change(NodeId node) const {
        return node.index() < last_change_.size() ? last_change_[node.index()] : 0;
    }
    void lay_grid();
    void file(std::uint64_t serial);
    void take_off();
    /// Cells of one row as bits.
    static std::uint64_t bits(WrappedAxis::Cells cells) {
        const auto first = [](std::size_t n) {
            return n < side ? (std::uint64_t{1} << n) - 1 : none;
        };
        return (first(cells.end) & ~first(cells.begin)) | first(cells.wrapped_end);
    }

    std::deque<Emission> frames_;     // in the order of their serials
    std::deque<std::uint64_t> next_;  // of each, the serial of the next in its cell
    std::uint64_t first_ = 0;         // serial of the first
    WrappedAxis columns_, rows_;
    std::vector<Cell> cells_;                 // row by row
    std::array<std::uint64_t, side> used_{};  // by row, a bit for each cell that is not empty
    std::vector<const Emission*> near_;       // begins with the result of near()

    std::deque<Before> changes_;              // numbered in their order, from 1 on
    std::uint64_t first_change_ = 1;          // number of the first that is kept
    std::vector<std::uint64_t> last_change_;  // number, by node

    Duration longest_{0};
    double reach_ = 0;    // [m] of the frames so far
    double fastest_ = 0;  // [m/s]
    // All antennas are between them [m].
    Vec3 low_ = {infinity, infinity, infinity}, high_ = {-infinity, -infinity, -infinity};
};

}  // namespace rovernet
