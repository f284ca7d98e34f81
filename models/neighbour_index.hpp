// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rovernet {

/// Who is near a place: nodes in a grid of cells, found by their legs.
///
/// Entries lie in the order of their cells, row by row, each with a copy of its node's leg. A query
/// looks at one range of entries in each row, so that cells are narrow. Entries stay in the
/// cells where they were binned while queries look as much wider as the fastest of them can have
/// moved since. A query bins anew once that is a tenth of a cell and as many entries have been
/// looked at as there are. Nodes much faster than the others and those that jump are kept apart and
/// looked at by every query. The grid wraps around: its memory is bounded wherever the nodes are.
class NeighbourIndex {
  public:
    /// A node and its leg: what a query looks at.
    struct Entry {
        Vec3 from;
        Vec3 velocity;
        Time start;
        Time end;
        NodeId node;
        std::uint32_t label;  ///< what add() was given
    };

    /// Adds the next node.
    void add(std::uint32_t label) {
        labels_.push_back(label);
        stale_ = true;
    }
    /// Room for `nodes` nodes.
    void reserve(std::size_t nodes) { labels_.reserve(nodes); }
    /// The node's leg has been replaced.
    void moved(NodeId node, const Legs& legs);
    /// Height of the cells [m] from now on; best about the radius of most queries.
    void set_cell_size(double size) {
        stale_ = stale_ || size != wanted_cell_;
        wanted_cell_ = size;
    }

    /// Calls visit(entry, position) for every node that is within `radius` [m] of `centre` at `t`,
    /// and for some others, in no order to rely on. `t` must not decrease from call to call.
    template <class Visit>
    void visit(Vec3 centre, double radius, Time t, const Legs& legs, Visit visit) {
        if (is_stale(t)) bin(t, legs);
        for (const Entry& e : apart_) visit(e, position(e, t, legs));
        for (const std::uint32_t i : near(centre, radius + slack(t))) {
            visit(entries_[i], position(entries_[i], t, legs));
        }
    }

  private:
    static constexpr std::uint32_t is_apart = 0x80000000;  // bit of a place in apart_
    static constexpr double far = 1e15;  // [cells] beyond it positions share the last cell

    /// `count` cells of one axis, from `first` on, before they wrap around.
    struct Cells {
        std::int64_t first;
        std::int64_t count;
    };

    static Vec3 position(const Entry& e, Time t, const Legs& legs) {
        if (t >= e.end) [[unlikely]]
            return legs.leg(e.node).to;
        return e.from + seconds(t - e.start) * e.velocity;
    }
    /// How far a node may be from where it was binned [m].
    double slack(Time t) const { return top_speed_ * seconds(t - binned_) + jumped_; }
    bool is_stale(Time t) const {
        return stale_ || apart_.size() > allowed_apart_ ||
               (slack(t) > 0.1 * height_ && looked_at_ > labels_.size());
    }
    static std::int64_t cell_of(double x, double size) {
        return static_cast<std::int64_t>(std::floor(std::clamp(x / size, -far, far)));
    }
    static Cells cells(double centre, double reach, double size, std::size_t wrap) {
        const double rounding = 1e-9 * (std::abs(centre) + reach);
        const std::int64_t first = cell_of(centre - reach - rounding, size);
        const std::int64_t last = cell_of(centre + reach + rounding, size);
        return {first, std::min(last - first + 1, static_cast<std::int64_t>(wrap))};
    }
    static std::size_t wrapped_cell(std::int64_t cell, std::size_t wrap) {
        const auto n = static_cast<std::int64_t>(wrap);
        return static_cast<std::size_t>((cell % n + n) % n);
    }
    /// Calls use(begin, end) for the cells once they have wrapped around: one range, or two.
    template <class Use>
    static void for_each_wrapped(Cells cells, std::size_t wrap, Use use) {
        const std::size_t begin = wrapped_cell(cells.first, wrap);
        const std::size_t end = begin + static_cast<std::size_t>(cells.count);
        use(begin, std::min(end, wrap));
        if (end > wrap) use(0, end - wrap);
    }

    /// The entries that were binned within `reach` [m] of `centre`, and some others.
    std::span<const std::uint32_t> near(Vec3 centre, double reach);
    void look_through(std::uint32_t begin, std::uint32_t end, float x, float y, float reach2);

    static Entry entry(NodeId node, std::uint32_t label, const Leg& leg) {
        return {leg.from, leg.velocity, leg.start, leg.end, node, label};
    }
    std::size_t cell_at(Vec3 p) const {
        return wrapped_cell(cell_of(p.y, height_), rows_) * columns_ +
               wrapped_cell(cell_of(p.x, width_), columns_);
    }
    void keep_apart(const Entry& e);
    void bin(Time t, const Legs& legs);
    void lay_grid(Time t, const Legs& legs);
    double choose_top_speed(const Legs& legs) const;

    std::vector<std::uint32_t> labels_;  // by node
    std::vector<Entry> entries_;         // in the order of their cells
    std::vector<float> x_, y_;           // [m] where they were binned
    std::vector<std::uint32_t> near_;    // begins with the result of near()
    std::size_t found_ = 0;              // by near() so far
    std::vector<std::uint32_t> first_;   // entry of a cell; one more than there are cells
    std::vector<std::uint32_t> place_;   // of a node in entries_, or in apart_
    std::vector<Entry> apart_;
    std::size_t columns_ = 1, rows_ = 1;
    double wanted_cell_ = 1;         // [m]
    double width_ = 1, height_ = 1;  // [m] of the cells
    double top_speed_ = 0;           // [m/s] of the entries
    double jumped_ = 0;              // [m] sum of what legs did not continue exactly
    Time binned_ = start_of_run;
    std::size_t looked_at_ = 0;  // entries and cells since then
    std::size_t allowed_apart_ = 0;
    bool stale_ = true;
};

}  // namespace rovernet
