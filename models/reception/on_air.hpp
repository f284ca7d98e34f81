// SPDX-License-Identifier: MIT
#pragma once

#include "models/arrival.hpp"
#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"
#include "models/medium/wrapped_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <span>
#include <vector>

// Frames on air, found by where they were sent. Interference asks near() once for each frame whose
// receptions are judged.

namespace rovernet {

/// Frames that are on air, and those that were so lately that they may still matter.
///
/// Each is kept once, where it was sent: who receives a frame asks what else was on air around it,
/// so that a frame that meets no other costs hardly anything. As a frame's levels are fixed when it
/// begins, what nodes were before their legs or radios changed is kept as long as the frames.
///
/// The frames lie in a grid of 64 x 64 cells that wraps around, each as wide as frames interfere.
/// Interference owns one.
class OnAir {
  public:
    /// Takes note of a leg that some node goes along: it bounds speeds, and where antennas are.
    /// @param antenna_height  height above the robot's z [m]
    void goes(const Leg& leg, Meters antenna_height);
    /// Keeps what `node` has been until now, and since its last change, if there are frames.
    /// @param leg  leg until now
    /// @param on   whether its radio was on until now
    void changes(NodeId node, const Leg& leg, bool on);

    /// Adds a frame; its `begin` must not be before that of the frame before.
    /// @return its serial: one more than that of the frame before
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
    /// Frame of that serial, which must be kept.
    const Emission& operator[](std::uint64_t serial) const { return frames_[serial - first_]; }

    /// Frames that are kept, in the order of their serials.
    const std::deque<Emission>& frames() const { return frames_; }
    /// Frames that end after `since` and begin before `until`, and may interfere with a receiver of
    /// `frame` by `now`; some more may be among them, `frame` itself is not. Receivers that changed
    /// lately may meet further ones, see has_changed().
    /// @return in no order to rely on; good until the next call
    std::span<const Emission* const> near(const Emission& frame, Time since, Time until, Time now);

    /// State of a node before it changed. Changes of a node are a chain, the last one first.
    struct Before {
        /// Leg and state of the radio until then.
        Leg leg;
        bool on;
        /// Serial of the first frame after the change.
        std::uint64_t serial;
        /// Number of the change of the same node before this one.
        std::uint64_t previous;
    };
    /// Whether the node's leg or radio has changed since a frame began that is kept: near() does
    /// not hold for it then.
    bool has_changed(NodeId node) const {
        return !changes_.empty() && last_change(node) >= first_change_;
    }
    /// State of the node when the frame began; null if it has not changed since.
    const Before* before(NodeId node, const Emission& frame) const;

    /// Time on air of the longest frame so far [ns].
    Duration longest() const { return longest_; }
    /// Distance [m] beyond which no frame interferes with anybody, or beyond which nobody is. It
    /// bounds propagation delays.
    double reach() const {
        constexpr double anywhere = 4e15;
        return std::min({reach_, distance(low_, high_), anywhere});
    }

  private:
    // Cells of the grid along each axis.
    static constexpr std::size_t side = 64;
    static constexpr std::uint64_t none = ~std::uint64_t{0};
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    // Frames that were sent in a cell, as a chain of serials.
    struct Cell {
        std::uint64_t oldest = none, newest = none;
    };

    // Number of the node's last change; 0 if there is none.
    std::uint64_t last_change(NodeId node) const {
        return node.index() < last_change_.size() ? last_change_[node.index()] : 0;
    }
    // Lays the grid anew, as wide as frames interfere now.
    void lay_grid();
    // Puts a frame at the end of its cell's chain.
    void file(std::uint64_t serial);
    // Removes the first frame.
    void take_off();
    // Cells of one row as bits.
    static std::uint64_t bits(WrappedAxis::Cells cells) {
        const auto first = [](std::size_t n) {
            return n < side ? (std::uint64_t{1} << n) - 1 : none;
        };
        return (first(cells.end) & ~first(cells.begin)) | first(cells.wrapped_end);
    }

    // Frames in the order of their serials.
    std::deque<Emission> frames_;
    // Serial of the next frame in the same cell, for each frame.
    std::deque<std::uint64_t> next_;
    // Serial of the first frame.
    std::uint64_t first_ = 0;
    // Axes of the grid.
    WrappedAxis columns_, rows_;
    // Cells of the grid, row by row.
    std::vector<Cell> cells_;
    // A bit for each cell of a row that is not empty.
    std::array<std::uint64_t, side> used_{};
    // Memory whose begin is the result of near().
    std::vector<const Emission*> near_;

    // Changes, numbered in their order from 1 on.
    std::deque<Before> changes_;
    // Number of the first change that is kept.
    std::uint64_t first_change_ = 1;
    // Number of each node's last change.
    std::vector<std::uint64_t> last_change_;

    // Longest time on air so far [ns].
    Duration longest_{0};
    // Distance of interference of the frames so far [m].
    double reach_ = 0;
    // Speed of the fastest node so far [m/s].
    double fastest_ = 0;
    // Box around all antennas so far [m].
    Vec3 low_ = {infinity, infinity, infinity}, high_ = {-infinity, -infinity, -infinity};
};

}  // namespace rovernet
