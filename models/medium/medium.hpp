// SPDX-License-Identifier: MIT
#pragma once

#include "models/medium/arrivals.hpp"
#include "models/medium/candidates.hpp"
#include "models/medium/link_losses.hpp"
#include "models/medium/medium_settings.hpp"
#include "models/medium/neighbour_index.hpp"
#include "models/medium/pair_cache.hpp"
#include "models/medium/stations.hpp"
#include "models/propagation/propagation.hpp"
#include "models/radio.hpp"
#include "models/variation/fades.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/record.hpp"
#include "sim/sieve.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

namespace rovernet {

/// Radio medium: determines the receivers of a transmission, and the times of reception. The
/// transmitter's propagation model applies. A frame's receivers are fixed at its start: by the
/// nodes that are on then, their positions and levels, and the scene.
///
/// Parts of a Medium are public: stations() has the radios, links() the losses of single links,
/// arrivals() the frames at single nodes. Times must not decrease from search to search.
class Medium {
  public:
    using Settings = MediumSettings;

    /// Creates an empty medium; stations are added later.
    /// @throws std::invalid_argument if a shadowing or fading parameter is out of its range
    explicit Medium(const Settings& settings);
    /// Not copyable, because the parts refer to each other.
    Medium(const Medium&) = delete;
    Medium& operator=(const Medium&) = delete;

    /// Settings of the medium, as passed to the constructor.
    const Settings& settings() const { return settings_; }
    /// Stations: radios, propagation models, and which nodes are on.
    const Stations& stations() const { return stations_; }
    /// Losses, levels and margins of single links.
    const LinkLosses& links() const { return links_; }
    /// Arrivals: times and levels of frames at single nodes.
    const Arrivals& arrivals() const { return arrivals_; }
    Arrivals& arrivals() { return arrivals_; }

    /// Adds the next node, as Stations::add(); the propagation model must also work in the medium's
    /// scene.
    void add(const Radio& radio, std::uint64_t key, const Propagation& propagation);
    /// Reserves memory for `nodes` nodes.
    void reserve(std::size_t nodes) {
        stations_.reserve(nodes);
        index_.reserve(nodes);
    }
    /// Prefetches the state of `node` into the processor's cache: the sender of the next event, or
    /// node 0 if the event has no sender.
    void prefetch(NodeId node) const {
        stations_.prefetch(node);
        index_.prefetch(node);
    }
    /// Prefetches the data that position() reads into the processor's cache.
    void prefetch_position(NodeId node) const { index_.prefetch(node); }
    /// Updates the medium after the node's leg was replaced.
    void moved(NodeId node, const Legs& legs) {
        ++changes_;
        index_.moved(node, legs);
        pairs_.moved(node);
        stations_.moved(node, legs);
    }
    /// Sets the bit rate of a node's radio, and with it the coding.
    void set_rate(NodeId node, BitRate rate) {
        ++changes_;
        stations_.set_rate(node, rate);
    }
    /// Switches a node's radio; a node that is off neither sends nor receives.
    void switch_radio(NodeId node, bool on) {
        ++changes_;
        stations_.switch_radio(node, on);
    }
    /// Number of changes so far: replaced legs, set bit rates, switched radios and added nodes.
    std::uint64_t changes() const { return changes_; }
    /// Position of a node [m] by its leg. The position is computed from a copy of the leg, which is
    /// in the processor's cache if the node's neighbours transmitted recently.
    Vec3 position(NodeId node, Time t, const Legs& legs) const {
        return index_.position_of(node, t, legs);
    }

    /// Node found in a search for the nodes that hear a transmitter.
    struct Found {
        NodeId node;
        /// Squared distance to the transmitter's antenna [m^2].
        double squared_distance;
    };

    /// Receivers of a frame: result of find_receivers().
    struct Receivers {
        /// Times at which the frame ends at the first and at the last receiver, if there are any.
        Time first, last;
        /// Position of the sender's antenna [m].
        Vec3 origin;
        /// Distance of the farthest receiver [m]; 0 if there are none.
        double heard_within = 0;
        /// Receptions of the frame, one for each receiver, unsorted.
        Sieve<Reception> sieved;
        std::span<Reception> all() const { return sieved.kept(); }
    };
    /// Finds the nodes that can decode a frame of `from` that starts at `start`.
    /// @param coding  modulation and coding of the frame, on which sensitivities may depend
    /// @param end     end of the frame at the transmitter
    void find_receivers(NodeId from, Coding coding, Time start, Time end, const Legs& legs,
                        Receivers& out);
    /// Finds `to` alone, if it can decode the frame.
    void find_receiver(NodeId from, NodeId to, Coding, Time start, Time end, const Legs&,
                       Receivers& out);
    /// Finds the receivers like find_receivers(). @return nodes that sense the frame but cannot
    /// decode it, in any order; valid until the next call
    std::span<const Found> find_sensors(NodeId from, Coding coding, Time start, Time end,
                                        const Legs& legs, Receivers& out);

    /// Nodes that hear `from` at `t`; valid until the next call.
    std::span<const Found> hearers(NodeId from, Time t, const Legs& legs) {
        find(from, stations_.kind(from), Strength::decodable, t, legs, 0);
        return found_.kept();
    }
    /// Whether `to` hears `from` at `t`; checks only this link.
    bool hears(NodeId from, NodeId to, Time t, const Legs& legs);

  private:
    using Entry = NeighbourIndex::Entry;
    using Kind = Stations::Kind;

    Medium(const Settings& settings, const std::shared_ptr<const Fades>& fades);
    // Sets the cell size of the index to the reach of the median station, so that most queries
    // visit nine cells.
    void choose_cells();
    // Finds the nodes at which a signal of `from` has at least `strength`, by the method (Decision)
    // that is fastest for the kind `mine`. Nodes that can decode the signal go into found_, the
    // others into sensors_. `mine` is the kind of `from` for the coding of its frame.
    void find(NodeId from, Kind mine, Strength strength, Time t, const Legs& legs,
              std::uint64_t frame);
    // Method of find() for losses that depend only on the distance: compares distances with ranges.
    void find_in_range(NodeId from, Kind mine, Strength strength, Time t, const Legs& legs);
    // Faster find_in_range() for stations of one kind: finds only the nodes that can decode.
    void find_alike(NodeId from, Kind mine, Time t, const Legs& legs);
    // Method of find() under shadowing: tables of distance and shadowing draw decide each link.
    void find_in_table(NodeId from, Kind mine, Strength strength, Time t, const Legs& legs);
    // Method of find() for any propagation model: computes the losses to all nodes within reach.
    void find_in_reach(NodeId from, Kind mine, Strength strength, Time t, const Legs& legs,
                       std::uint64_t frame);
    // Node `to`, if it can decode a signal of `from` from `here`.
    std::optional<Found> link(NodeId from, Kind mine, Vec3 here, NodeId to, Time, const Legs&,
                              std::uint64_t frame);
    Vec3 antenna(NodeId node, Kind kind, Time t, const Legs& legs) const;
    // Puts the nodes of found_ into `out`, for a frame that ends at `end` at its sender.
    void put_arrivals(Time end, Receivers& out) const;
    void look_from(NodeId from, Time t, const Legs& legs);  // prepares index and origin_
    void share_draws();                                     // computes shares_ for all nodes
    // Visitor for the index: calls use(entry, antenna, squared distance, place) for nodes within
    // reach that are on and may have a link. `place` is omitted if the index returns no place.
    template <class Use>
    auto within(NodeId from, Kind mine, double reach2, Use use) const;
    // Visits the nodes within reach: calls use() as described at within().
    template <class Use>
    void visit(NodeId from, Kind mine, double reach2, Time t, const Legs& legs, Use use);

    Settings settings_;
    // Shadowing draws of pairs of nodes, for Decision::by_table.
    PairDraws draws_;
    Stations stations_;
    LinkLosses links_;
    Arrivals arrivals_;
    // Number of changes so far, see changes().
    std::uint64_t changes_ = 0;
    // Index of nodes by position, and path losses of pairs at rest.
    NeighbourIndex index_;
    PairCache pairs_;
    const Scene* pairs_of_ = nullptr;  // scene of the losses in pairs_
    // Contributions of nodes to draws_, by place in the index; and bins() of the index then.
    std::vector<std::uint64_t> shares_;
    std::uint64_t shares_of_bin_ = 0;
    // Whether the cell size of the index was set.
    bool cells_chosen_ = false;
    // Parameters of the last search (from, kind, strength, time, changes_), and position of its
    // antenna.
    std::optional<std::tuple<NodeId, Kind, Strength, Time, std::uint64_t>> last_;
    Vec3 origin_;
    // Results of the last search: nodes that can decode, and nodes that only sense.
    Sieve<Found> found_, sensors_;
    Candidates candidates_;
};

}  // namespace rovernet
