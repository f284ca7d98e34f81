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
#include <utility>
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
/// A frame is recent until forget() passes its end; near() finds recent frames. Earlier frames may
/// be kept for longer, see forget(); past() finds these, too.
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
    /// Makes the oldest frames past, in the order of their serial numbers, until the first frame
    /// that ends after `t`. Calls use(frame) for each. Past frames are removed when they ended
    /// `kept` before `t`.
    template <class Use>
    void forget(Time t, Use use, Duration kept = {}) {
        if (t < due_) return;
        for (; !frames_.empty() && frames_.front().end <= t; ++first_) {
            use(frames_.front());
            take_off();
        }
        drop_past(t - kept);
        due_ = frames_.empty() ? never : frames_.front().end;
        if (!past_.empty()) due_ = std::min(due_, past_.front().end + kept);
    }
    /// Recent frame with serial number `serial`.
    const Emission& operator[](std::uint64_t serial) const { return frames_[serial - first_]; }

    /// Recent frames, in the order of their serial numbers.
    const std::deque<Emission>& frames() const { return frames_; }
    /// Past frames, in the order of their serial numbers; the recent frames follow.
    const std::deque<Emission>& past_frames() const { return past_; }
    /// Recent frames that end after `since` and begin before `until`, and may interfere at a
    /// receiver of `frame` by `now`. The result may contain further frames, but not `frame` itself.
    /// Frames may be missing for receivers with recent changes, see has_changed().
    /// @return frames in any order; valid until the next call
    std::span<const Emission* const> near(const Emission& frame, Time since, Time until, Time now);
    /// Frames as by near(), past frames included. Frames may be missing for receivers with any
    /// stored change, see has_stored_change().
    /// @return frames in any order; valid until the next call
    std::span<const Emission* const> past(const Emission& frame, Time since, Time until, Time now);

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
    /// Whether the node's leg or radio has changed since the start of the oldest recent frame. If
    /// true, the result of near() may lack frames for this node.
    bool has_changed(NodeId node) const {
        return !changes_.empty() && last_change(node) >= recent_change_;
    }
    /// Whether the node's leg or radio has changed since the start of the oldest stored frame. If
    /// true, the result of past() may lack frames for this node.
    bool has_stored_change(NodeId node) const {
        return !changes_.empty() && last_change(node) >= first_change_;
    }
    /// State of a node when `frame` began; null if its leg and radio have not changed since.
    const Before* before(NodeId node, const Emission& frame) const;

    /// Longest time on air of a frame so far [ns].
    Duration longest() const { return longest_; }
    /// Upper bound [m] of the distance from a sender to the nodes at which its frames interfere:
    /// the interference range, or the diagonal of the box of all antennas. Bounds the delays.
    double reach() const { return bounded_reach_; }

  private:
    // Number of cells of the grid in each direction.
    static constexpr std::size_t side = 64;
    static constexpr std::uint64_t none = ~std::uint64_t{0};
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    // Number of the node's last change, see Before::previous; 0 if the node has not changed.
    std::uint64_t last_change(NodeId node) const {
        return node.index() < last_change_.size() ? last_change_[node.index()] : 0;
    }
    // Change with number `n`, which must be stored.
    const Before& change(std::uint64_t n) const { return changes_[n - first_change_]; }
    std::uint64_t next_serial() const { return first_ + frames_.size(); }
    // Grid cell of a frame: row and column.
    std::pair<std::size_t, std::size_t> cell_of(const Emission& frame) const {
        return {rows_.cell_at(frame.origin.y), columns_.cell_at(frame.origin.x)};
    }
    // Sets bounded_reach_.
    void bound_reach();
    // Builds the grid again for the current interference range.
    void lay_grid();
    // Appends a stored frame to the chain of its grid cell.
    void file(const Emission& frame);
    // Makes the oldest recent frame past.
    void take_off();
    // Removes past frames that ended by `t`, and changes before all stored frames.
    void drop_past(Time t);
    // Frames that a query searches, by serial number, and memory for its result: more elements than
    // there are frames.
    struct Searched {
        std::uint64_t first, count;
        std::span<const Emission*> found;
    };
    // Query of near() and past().
    // @param span      time from the beginning of the oldest frame to the time `now` of the query
    // @param frame_of  frame_of(serial): the frame with this serial number
    // @param cells_of  cells_of(row): bit mask of the cells to search
    template <class FrameOf, class CellsOf>
    std::span<const Emission* const> search(const Emission& frame, Time since, Time until,
                                            Duration span, FrameOf frame_of, CellsOf cells_of,
                                            const Searched& all);
    // Bit mask of the given cells of one row.
    static std::uint64_t bits(WrappedAxis::Cells cells) {
        const auto first = [](std::size_t n) {
            return n < side ? (std::uint64_t{1} << n) - 1 : none;
        };
        return (first(cells.end) & ~first(cells.begin)) | first(cells.wrapped_end);
    }

    // Recent and past frames, in the order of their serial numbers.
    std::deque<Emission> frames_, past_;
    // Serial number of the previous frame in the same grid cell, for each frame of past_ and then
    // of frames_; less than first_past_, or `none`, if no such frame is stored.
    std::deque<std::uint64_t> previous_;
    // Serial numbers of the first recent frame, and of the first stored frame.
    std::uint64_t first_ = 0, first_past_ = 0;
    // Time from which forget() has to do something.
    Time due_ = never;
    // Axes of the grid.
    WrappedAxis columns_, rows_;
    // Serial number of the last frame in each cell of the grid, as in previous_; row by row.
    std::vector<std::uint64_t> cells_;
    // Bit mask of the cells of each row that have recent frames.
    std::array<std::uint64_t, side> used_{};
    // Memory for the results of near() and past().
    std::vector<const Emission*> near_, found_past_;

    // States of nodes before changes, numbered in order from 1 on.
    std::deque<Before> changes_;
    // Numbers of the first stored change, and of the first one since the oldest recent frame began.
    std::uint64_t first_change_ = 1, recent_change_ = 1;
    // Number of the last change of each node, see Before::previous.
    std::vector<std::uint64_t> last_change_;

    // Longest time on air so far [ns].
    Duration longest_{0};
    // Largest interference range so far [m], and the result of reach().
    double reach_ = 0, bounded_reach_ = 0;
    // Speed of the fastest node so far [m/s].
    double fastest_ = 0;
    // Bounding box of all antennas so far [m].
    Vec3 low_ = {infinity, infinity, infinity}, high_ = {-infinity, -infinity, -infinity};
};

}  // namespace rovernet
