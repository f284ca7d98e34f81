// SPDX-License-Identifier: MIT
#pragma once

#include "models/medium/index_table.hpp"
#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"
#include "models/medium/wrapped_axis.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rovernet {

/// Index of nodes by their places: who is near a place, found in a grid of cells by their legs.
///
/// Entries lie in the order of their cells, row by row, each with a copy of its node's leg. A query
/// looks at one range of entries in each row, so that cells are narrow. Entries stay in the cells
/// where they were binned while queries look as much wider as the fastest of them can have moved
/// since. A query bins anew once that is a tenth of a cell and as many entries have been looked at
/// as there are. Nodes much faster than the others and those that jump are kept apart and looked at
/// by every query. The grid wraps around: its memory is bounded wherever the nodes are.
class NeighbourIndex {
  public:
    using Entry = IndexEntry;

    /// Place of no entry.
    static constexpr std::uint32_t nowhere = 0xffffffff;

    /// Adds the next node.
    void add(std::uint32_t label);
    /// Makes room for `nodes` nodes.
    void reserve(std::size_t nodes) { place_.reserve(nodes); }
    /// Takes note that the node's leg has been replaced.
    void moved(NodeId node, const Legs& legs);
    /// Sets the height of the cells [m]; best about the radius of most queries.
    void set_cell_size(double size) {
        stale_ = stale_ || size != wanted_cell_;
        wanted_cell_ = size;
    }

    /// Bins the nodes anew if it is time to; to be called before visit() and visit_if().
    void refresh(Time t, const Legs& legs) {
        if (is_stale(t)) bin(t, legs);
    }
    /// Position of the node [m]: as `legs` have it, and near in memory if its neighbours were
    /// looked at.
    Vec3 position_of(NodeId node, Time t, const Legs& legs) const {
        if (stale_) [[unlikely]]
            return legs.position(node, t);
        const std::uint32_t place = place_[node.index()];
        return place & is_apart ? apart_.position(place & ~is_apart, t, legs)
                                : binned_.position(place, t, legs);
    }
    void prefetch(NodeId node) const { __builtin_prefetch(place_.data() + node.index()); }
    /// Places of the entries() that are within `radius` [m] of `centre` at `t`, and some others;
    /// good until the next such call. `t` must not decrease from call to call.
    std::span<const std::uint32_t> near(Vec3 centre, double radius, Time t) {
        return look_around<false>(centre, radius + slack(t));
    }
    /// Number of nodes that are kept apart (too fast, or just jumped): every query looks at them.
    std::size_t apart() const { return apart_.entries.size(); }
    /// Calls visit(entry, position) for the nodes kept apart and the entries at `places`.
    template <class Visit>
    void visit(std::span<const std::uint32_t> places, Time t, const Legs& legs, Visit visit) const {
        visit_apart(t, legs, visit);
        const Entry* const entries = binned_.entries.data();
        if (binned_.motions.empty()) {
            for (const std::uint32_t i : places) visit(entries[i], entries[i].from);
        } else {
            for (const std::uint32_t i : places) visit(entries[i], binned_.position(i, t, legs));
        }
    }
    /// Calls visit(entry, position) for every node that is within `radius` [m] of `centre` at `t`,
    /// and for some others, in no order to rely on. `t` must not decrease from call to call.
    template <class Visit>
    void visit(Vec3 centre, double radius, Time t, const Legs& legs, Visit visit) {
        this->visit(near(centre, radius, t), t, legs, visit);
    }

    /// Calls visit(entry, position, place) as above, but of the entries() only for those for which
    /// passes(place, at_least) holds; the squared distance [m^2] between entry and centre, heights
    /// aside, is no less than that. The place of nodes kept apart is `nowhere`.
    template <class Passes, class Visit>
    void visit_if(Vec3 centre, double radius, Time t, const Legs& legs, Passes passes,
                  Visit visit) {
        const std::span<std::uint32_t> places = look_around<true>(centre, radius + slack(t));
        const float* const at_least = distances_at_least(places.size(), centre, radius, t);
        std::size_t passed = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            // Without a branch: it would be mispredicted for most that pass.
            const std::uint32_t place = places[passed] = places[i];
            passed += passes(place, at_least[i]);
        }
        visit_apart(t, legs, [&](const Entry& e, Vec3 p) { visit(e, p, nowhere); });
        for (const std::uint32_t i : places.first(passed)) {
            visit(binned_.entries[i], binned_.position(i, t, legs), i);
        }
    }
    /// Nodes in the order of their cells, but for those kept apart; good until the next bin.
    std::span<const Entry> entries() const { return binned_.entries; }
    /// Number of times that the nodes were binned.
    std::uint64_t bins() const { return bins_; }

  private:
    // Bit of a place in apart_.
    static constexpr std::uint32_t is_apart = 0x80000000;

    template <class Visit>
    void visit_apart(Time t, const Legs& legs, Visit&& visit) const {
        for (std::size_t i = 0; i < apart_.entries.size(); ++i) {
            visit(apart_.entries[i], apart_.position(i, t, legs));
        }
    }
    /// How far nodes may have gone since they were binned.
    struct Drift {
        Time since = start_of_run;
        /// Top speed of the entries [m/s]; in [m/ns], and a little more.
        double top_speed = 0;
        double top_speed_per_ns = 0;
        /// Sum of what legs did not continue exactly [m].
        double jumped = 0;

        /// Distance that a node may be from where it was binned [m].
        double at(Time t) const {
            return top_speed_per_ns * static_cast<double>((t - since).count()) + jumped;
        }
    };
    double slack(Time t) const { return drift_.at(t); }
    // Whether it is time to bin the nodes anew.
    bool is_stale(Time t) const {
        return stale_ || apart_.entries.size() > allowed_apart_ ||
               (looked_at_ > place_.size() && slack(t) > 0.1 * rows_.width());
    }
    /// Bound [m] on what is lost of a coordinate around `centre` in single precision.
    static double rounding(Vec3 centre, double reach) {
        return 1e-6 * (std::abs(centre.x) + std::abs(centre.y) + reach);
    }
    /// Entries that were binned within `reach` [m] of `centre`, and some others; how far off into
    /// distance2_, if that is wanted.
    template <bool distances_too>
    std::span<std::uint32_t> look_around(Vec3 centre, double reach);
    // Least squared distances [m^2] that the entries found may have now, wherever they went since
    // they were binned.
    float* distances_at_least(std::size_t count, Vec3 centre, double radius, Time t);
    // Makes room for what look_around() finds. @return for how much
    std::size_t make_room(std::size_t places);

    // Cell of a place.
    std::size_t cell_at(Vec3 p) const {
        return rows_.cell_at(p.y) * columns_.cells() + columns_.cell_at(p.x);
    }
    std::uint32_t label(NodeId node) const { return labels_.empty() ? 0 : labels_[node.index()]; }
    // Moves a node out of its cell, where an entry that is nowhere remains.
    void keep_apart(NodeId node, const Leg& leg);
    // Adds an entry to apart_. @return its place
    std::size_t add_apart(NodeId node);
    // Sorts all nodes into cells by counting.
    void bin(Time t, const Legs& legs);
    // All nodes, in the order of the cells that they were in, so that sorting them anew moves them
    // little.
    IndexTable take_all(const Legs& legs);
    // Lays a grid of at most two cells a node.
    void lay_grid(const IndexTable& all, Time t, const Legs& legs);

    // Labels by node; none as long as all are 0.
    std::vector<std::uint32_t> labels_;
    // Entries in the order of their cells.
    IndexTable binned_;
    // Places where they were binned [m].
    std::vector<float> x_, y_;
    // Memory that begins with what look_around() found.
    std::vector<std::uint32_t> near_;
    // Memory that begins with how far each was binned from the query [m^2].
    std::vector<float> distance2_;
    // First entry of each cell; one more than there are cells.
    std::vector<std::uint32_t> first_;
    // Place of each node in binned_, or in apart_.
    std::vector<std::uint32_t> place_;
    IndexTable apart_;
    WrappedAxis columns_, rows_;
    // Height of the cells that was asked for [m].
    double wanted_cell_ = 1;
    Drift drift_;
    // Entries and cells that were looked at since then.
    std::size_t looked_at_ = 0;
    // Nodes that may be kept apart until all are binned anew.
    std::size_t allowed_apart_ = 0;
    std::uint64_t bins_ = 0;
    bool stale_ = true;
};

}  // namespace rovernet
