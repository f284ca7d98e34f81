// SPDX-License-Identifier: MIT
#pragma once

#include "models/arrival.hpp"
#include "models/medium/wrapped_axis.hpp"
#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <span>
#include <vector>

// Spatial index of frames on air. Interference calls near() once for each frame whose receptions
// are judged.

namespace rovernet {

/// Frames on air, and recent frames that may still affect receptions.
///
/// Each frame is stored once, at its place of transmission. A query for a received frame returns
/// the frames nearby, so a frame without other frames nearby takes almost no time. Levels of a
/// frame are fixed when it begins, so the states of nodes before their legs or radios changed are
/// kept as long as the frames.
///
/// Frames are stored in a grid of 64 x 64 cells that wraps around; a cell is as wide as the
/// interference range.
class OnAir {
  public:
    /// Extends the bounds on speeds and antenna positions by a new leg of a node.
    /// @param antenna_height  height above the robot's z [m]
    void goes(const Leg& leg, Meters antenna_height);
    /// Stores the state of `node` between its last change and now, if any frame is stored.
    /// @param leg  leg of the node until now
    /// @param on   whether the node's radio was on until now
    void changes(NodeId node, const Leg& leg, bool on);

    /// Adds a frame, which must not begin before the previously added frame.
    /// @return serial number of the frame, one more than that of the previous frame
    std::uint64_t add(Emission frame);
    /// Removes the oldest frames in the order of their serial numbers, until the first frame that
    /// ends after `t`. Calls use(frame) for each removed frame.
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
    /// Frame with serial number `serial`, which must be stored.
    const Emission& operator[](std::uint64_t serial) const { return frames_[serial - first_]; }

    /// Stored frames, in the order of their serial numbers.
    const std::deque<Emission>& frames() const { return frames_; }
    /// Frames that end after `since` and begin before `until`, and may interfere at a receiver of
    /// `frame` by `now`. The result may contain further frames, but not `frame` itself. Frames may
    /// be missing for receivers with recent changes, see has_changed().
    /// @return frames in any order; valid until the next call
    std::span<const Emission* const> near(const Emission& frame, Time since, Time until, Time now);

    /// State of a node before its leg or radio changed. A node's changes form a chain, last first.
    struct Before {
        /// Leg and radio state until the change.
        Leg leg;
        bool on;
        /// Serial number of the first frame that began after the change.
        std::uint64_t serial;
        /// Number of the previous change of the same node; 0 if there is no previous change. The
        /// changes of all nodes are numbered together, from 1.
        std::uint64_t previous;
    };
    /// Whether the node's leg or radio has changed since the start of the oldest stored frame. If
    /// true, the result of near() may lack frames for this node.
    bool has_changed(NodeId node) const {
        return !changes_.empty() && last_change(node) >= first_change_;
    }
    /// State of a node when `frame` began; null if its leg and radio have not changed since.
    const Before* before(NodeId node, const Emission& frame) const;

    /// Longest time on air of a frame so far [ns].
    Duration longest() const { return longest_; }
    /// Upper bound [m] of the distance from a sender to the nodes at which its frames interfere:
    /// the interference range, or the diagonal of the box of all antennas. Bounds the delays.
    double reach() const {
        constexpr double anywhere = 4e15;
        return std::min({reach_, distance(low_, high_), anywhere});
    }

  private:
    // Number of cells of the grid in each direction.
    static constexpr std::size_t side = 64;
    static constexpr std::uint64_t none = ~std::uint64_t{0};
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    // Chain of the frames transmitted in a grid cell: serial numbers of its first and last frame.
    struct Cell {
        std::uint64_t oldest = none, newest = none;
    };

    // Number of the node's last change, see Before::previous; 0 if the node has not changed.
    std::uint64_t last_change(NodeId node) const {
        return node.index() < last_change_.size() ? last_change_[node.index()] : 0;
    }
    // Builds the grid again for the current interference range.
    void lay_grid();
    // Appends a stored frame to the chain of its grid cell.
    void file(std::uint64_t serial);
    // Removes the oldest stored frame.
    void take_off();
    // Bit mask of the given cells of one row.
    static std::uint64_t bits(WrappedAxis::Cells cells) {
        const auto first = [](std::size_t n) {
            return n < side ? (std::uint64_t{1} << n) - 1 : none;
        };
        return (first(cells.end) & ~first(cells.begin)) | first(cells.wrapped_end);
    }

    // Frames in the order of their serial numbers.
    std::deque<Emission> frames_;
    // Serial number of the next frame in the same grid cell, for each frame of frames_.
    std::deque<std::uint64_t> next_;
    // Serial number of the first stored frame.
    std::uint64_t first_ = 0;
    // Axes of the grid.
    WrappedAxis columns_, rows_;
    // Cells of the grid, row by row.
    std::vector<Cell> cells_;
    // Bit mask of the non-empty cells of each row.
    std::array<std::uint64_t, side> used_{};
    // Memory for the result of near().
    std::vector<const Emission*> near_;

    // States of nodes before changes, numbered in order from 1 on.
    std::deque<Before> changes_;
    // Number of the first stored change.
    std::uint64_t first_change_ = 1;
    // Number of the last change of each node, see Before::previous.
    std::vector<std::uint64_t> last_change_;

    // Longest time on air so far [ns].
    Duration longest_{0};
    // Largest interference range so far [m].
    double reach_ = 0;
    // Speed of the fastest node so far [m/s].
    double fastest_ = 0;
    // Bounding box of all antennas so far [m].
    Vec3 low_ = {infinity, infinity, infinity}, high_ = {-infinity, -infinity, -infinity};
};

}  // namespace rovernet
