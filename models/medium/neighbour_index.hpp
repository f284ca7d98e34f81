// SPDX-License-Identifier: MIT
#pragma once

#include "models/medium/index_table.hpp"
#include "models/medium/wrapped_axis.hpp"
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

/// Spatial index of moving nodes: finds the nodes near a given position, by a grid of cells.
///
/// A node's entry has a copy of its leg (piece of movement). Entries are sorted by cell, row by
/// row. A query reads one range of entries in each row, so cells are narrow. The order is not
/// updated while nodes move: a query adds to its radius the distance that the fastest node can have
/// moved since the last sorting. All nodes are sorted again once this distance is a tenth of a cell
/// and as many entries have been read as there are nodes. Nodes much faster than the others, and
/// nodes that jump, are stored separately and checked by every query. The grid wraps around (cell
/// index modulo grid size), so its memory is bounded for any positions.
class NeighbourIndex {
  public:
    using Entry = IndexEntry;

    /// Index that stands for "no entry" where an index into entries() is expected.
    static constexpr std::uint32_t nowhere = 0xffffffff;

    /// Adds the next node, with a number (label) that queries return.
    void add(std::uint32_t label);
    /// Reserves memory for `nodes` nodes.
    void reserve(std::size_t nodes) { place_.reserve(nodes); }
    /// Updates the index after the node's leg was replaced.
    void moved(NodeId node, const Legs& legs);
    /// Sets the height of the grid's cells [m]; best near the radius of most queries.
    void set_cell_size(double size) {
        stale_ = stale_ || size != wanted_cell_;
        wanted_cell_ = size;
    }

    /// Sorts the nodes into cells again if necessary; must precede visit() and visit_if().
    void refresh(Time t, const Legs& legs) {
        if (is_stale(t)) bin(t, legs);
    }
    /// Position of the node [m] by its leg in `legs`. The position is computed from a copy of the
    /// leg, which is in the processor's cache if the node's neighbours were visited recently.
    Vec3 position_of(NodeId node, Time t, const Legs& legs) const {
        if (stale_) [[unlikely]]
            return legs.position(node, t);
        const std::uint32_t place = place_[node.index()];
        return place & is_apart ? apart_.position(place & ~is_apart, t, legs)
                                : binned_.position(place, t, legs);
    }
    void prefetch(NodeId node) const { __builtin_prefetch(place_.data() + node.index()); }
    /// Indices into entries() of all nodes within `radius` [m] of `centre` at `t`, and of some
    /// nodes farther away. Valid until the next call. `t` must not decrease from call to call.
    std::span<const std::uint32_t> near(Vec3 centre, double radius, Time t) {
        return look_around<false>(centre, radius + slack(t));
    }
    /// Number of nodes outside the grid (too fast, or just jumped), which every query checks.
    std::size_t apart() const { return apart_.entries.size(); }
    /// Calls visit(entry, position) for the nodes stored separately, and for the entries at the
    /// indices `places`.
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
    /// Calls visit(entry, position) for every node within `radius` [m] of `centre` at `t` and for
    /// some nodes farther away, in any order. `t` must not decrease from call to call.
    template <class Visit>
    void visit(Vec3 centre, double radius, Time t, const Legs& legs, Visit visit) {
        this->visit(near(centre, radius, t), t, legs, visit);
    }

    /// Calls visit(entry, position, place) like visit(), but for entries in cells only if
    /// passes(place, at_least). place: index into entries(), `nowhere` for nodes stored separately.
    /// at_least: lower bound of the squared horizontal distance [m^2] of entry and centre.
    template <class Passes, class Visit>
    void visit_if(Vec3 centre, double radius, Time t, const Legs& legs, Passes passes,
                  Visit visit) {
        const std::span<std::uint32_t> places = look_around<true>(centre, radius + slack(t));
        const float* const at_least = distances_at_least(places.size(), centre, radius, t);
        std::size_t passed = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            // Without a branch, which would often be mispredicted.
            const std::uint32_t place = places[passed] = places[i];
            passed += passes(place, at_least[i]);
        }
        visit_apart(t, legs, [&](const Entry& e, Vec3 p) { visit(e, p, nowhere); });
        for (const std::uint32_t i : places.first(passed)) {
            visit(binned_.entries[i], binned_.position(i, t, legs), i);
        }
    }
    /// Entries of the nodes in grid cells, sorted by cell; without the nodes that are stored
    /// separately (see apart()). The span is valid until refresh() sorts the nodes again.
    std::span<const Entry> entries() const { return binned_.entries; }
    /// Number of times that the nodes were sorted into cells.
    std::uint64_t bins() const { return bins_; }

  private:
    // Bit of an element of place_: set if the element is an index into apart_.
    static constexpr std::uint32_t is_apart = 0x80000000;

    template <class Visit>
    void visit_apart(Time t, const Legs& legs, Visit&& visit) const {
        for (std::size_t i = 0; i < apart_.entries.size(); ++i) {
            visit(apart_.entries[i], apart_.position(i, t, legs));
        }
    }
    /// Largest distance that nodes may have moved since they were sorted into cells.
    struct Drift {
        Time since = start_of_run;
        /// Top speed of the nodes [m/s]; and in [m/ns], rounded up.
        double top_speed = 0;
        double top_speed_per_ns = 0;
        /// Sum of position jumps between consecutive legs [m].
        double jumped = 0;

        /// Largest distance [m] that a node may have moved at `t` since it was sorted into a cell.
        double at(Time t) const {
            return top_speed_per_ns * static_cast<double>((t - since).count()) + jumped;
        }
    };
    double slack(Time t) const { return drift_.at(t); }
    // Whether the nodes have to be sorted into cells again.
    bool is_stale(Time t) const {
        return stale_ || apart_.entries.size() > allowed_apart_ ||
               (looked_at_ > place_.size() && slack(t) > 0.1 * rows_.width());
    }
    /// Bound on the rounding error [m] of a coordinate around `centre` in single precision.
    static double rounding(Vec3 centre, double reach) {
        return 1e-6 * (std::abs(centre.x) + std::abs(centre.y) + reach);
    }
    /// Finds the entries of all cells within `reach` [m] of `centre`, and some entries of other
    /// cells. If distances_too, writes the squared distances of the found entries into distance2_.
    template <bool distances_too>
    std::span<std::uint32_t> look_around(Vec3 centre, double reach);
    // Lower bounds of the squared distances [m^2] between `centre` and the entries that
    // look_around() found, for any motion since the last binning.
    float* distances_at_least(std::size_t count, Vec3 centre, double radius, Time t);
    // Resizes near_ and distance2_, the results of look_around(), to 2 `places`. @return new size
    std::size_t make_room(std::size_t places);

    // Index of the cell that contains the position p [m].
    std::size_t cell_at(Vec3 p) const {
        return rows_.cell_at(p.y) * columns_.cells() + columns_.cell_at(p.x);
    }
    std::uint32_t label(NodeId node) const { return labels_.empty() ? 0 : labels_[node.index()]; }
    // Removes a node from its cell, which keeps an unused entry, and stores it separately.
    void keep_apart(NodeId node, const Leg& leg);
    // Adds an entry to apart_. @return its index
    std::size_t add_apart(NodeId node);
    // Sorts all nodes into cells by counting.
    void bin(Time t, const Legs& legs);
    // Removes all entries and returns them sorted by old cell, so that new sorting moves few.
    IndexTable take_all(const Legs& legs);
    // Makes a grid of at most two cells per node.
    void lay_grid(const IndexTable& all, Time t, const Legs& legs);

    // Labels by node; empty while all are 0.
    std::vector<std::uint32_t> labels_;
    // Entries in the order of their cells.
    IndexTable binned_;
    // Positions [m] of the entries of binned_ at the last binning.
    std::vector<float> x_, y_;
    // Memory for the results of look_around().
    std::vector<std::uint32_t> near_;
    // Memory for the squared distances between query and binned positions [m^2].
    std::vector<float> distance2_;
    // Index of the first entry of each cell; one value more than there are cells.
    std::vector<std::uint32_t> first_;
    // Index of each node in binned_, or in apart_ (marked by is_apart).
    std::vector<std::uint32_t> place_;
    IndexTable apart_;
    WrappedAxis columns_, rows_;
    // Requested height of the cells [m].
    double wanted_cell_ = 1;
    Drift drift_;
    // Number of entries and cells visited since the last binning.
    std::size_t looked_at_ = 0;
    // Number of nodes that may be stored separately before all nodes are binned again.
    std::size_t allowed_apart_ = 0;
    std::uint64_t bins_ = 0;
    bool stale_ = true;
};

}  // namespace rovernet
