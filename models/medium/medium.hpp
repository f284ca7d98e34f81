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
#include "models/variation/fading.hpp"
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

/// Medium between radios: who hears a transmission, and when. The transmitter's propagation model
/// rules. Everything about a frame is fixed at its start: who is on, where everybody is, at what
/// level, and the scene between them.
///
/// Its parts answer for themselves: stations() who is there, links() what one link loses,
/// arrivals() how a frame arrives at one node. Times must not decrease from one search to the next.
class Medium {
  public:
    using Settings = MediumSettings;

    /// Makes an empty medium; stations are added to it.
    /// @throws std::invalid_argument if its shadowing or fading has a parameter out of its range
    explicit Medium(const Settings& settings);
    /// Copies are forbidden: the parts refer to each other.
    Medium(const Medium&) = delete;
    Medium& operator=(const Medium&) = delete;

    /// Settings as they were given.
    const Settings& settings() const { return settings_; }
    /// Its stations: radios, models, and who is on.
    const Stations& stations() const { return stations_; }
    /// Losses, levels and margins of single links.
    const LinkLosses& links() const { return links_; }
    /// Frames as they arrive at single nodes.
    const Arrivals& arrivals() const { return arrivals_; }
    Arrivals& arrivals() { return arrivals_; }

    /// Adds the next node, as Stations::add(); the model must work in the scene, too.
    void add(const Radio& radio, std::uint64_t key, const Propagation& propagation);
    /// Makes room for `nodes` nodes.
    void reserve(std::size_t nodes) {
        stations_.reserve(nodes);
        index_.reserve(nodes);
    }
    /// Prefetches the state of `node`, the sender of the next event; node 0 if that event has none.
    void prefetch(NodeId node) const {
        stations_.prefetch(node);
        index_.prefetch(node);
    }
    /// Prefetches what position() takes.
    void prefetch_position(NodeId node) const { index_.prefetch(node); }
    /// Takes note that the node's leg has been replaced.
    void moved(NodeId node, const Legs& legs) {
        ++changes_;
        index_.moved(node, legs);
        pairs_.moved(node);
        stations_.moved(node, legs);
    }
    /// Switches a node's radio; a node that is off neither sends nor receives.
    void switch_radio(NodeId node, bool on) {
        ++changes_;
        stations_.switch_radio(node, on);
    }
    /// Number of changes so far: of legs, and of nodes added or switched.
    std::uint64_t changes() const { return changes_; }
    /// Position of a node [m]: as `legs` have it, and near in memory if its neighbours sent lately.
    Vec3 position(NodeId node, Time t, const Legs& legs) const {
        return index_.position_of(node, t, legs);
    }

    /// Node that was found by a search.
    struct Found {
        NodeId node;
        /// Squared distance between the antennas [m^2].
        double squared_distance;
    };

    /// Receivers of a frame.
    struct Receivers {
        /// Ends of the frame at the first and the last of them, if there are any.
        Time first, last;
        /// Receptions in no order.
        Sieve<Reception> sieved;
        std::span<Reception> all() const { return sieved.kept(); }
    };
    /// Finds the nodes that hear `from` when it sends at `start`.
    /// @param end  of the frame at the transmitter
    void find_receivers(NodeId from, Time start, Time end, const Legs& legs, Receivers& out);
    /// Finds the same, and the nodes that only sense the frame: these are returned in no order,
    /// good until the next call.
    std::span<const Found> find_sensors(NodeId from, Time start, Time end, const Legs& legs,
                                        Receivers& out);
    /// Position of the sender's antenna in the last search for receivers [m].
    Vec3 origin() const { return origin_; }
    /// Distance of its farthest receiver [m].
    double heard_within();

    /// Nodes that hear `from` at `t`; good until the next call.
    std::span<const Found> hearers(NodeId from, Time t, const Legs& legs) {
        find(from, Strength::decodable, t, legs, 0);
        return found_.kept();
    }
    /// Whether `to` is one of those that hear `from` at `t`: looks at that one link.
    bool hears(NodeId from, NodeId to, Time t, const Legs& legs);

  private:
    using Entry = NeighbourIndex::Entry;
    using Kind = Stations::Kind;

    Medium(const Settings& settings, const std::shared_ptr<const Fades>& fades);
    // Chooses cells as wide as the reach of the median station: most queries then look at nine of
    // them.
    void choose_cells();
    // Searches for the nodes that a signal of `from` is strong enough for, in the way that the
    // Decision of its kind says: in found_ those who can decode it, in sensors_ the others.
    void find(NodeId from, Strength strength, Time t, const Legs& legs, std::uint64_t frame);
    // Searches by the distance alone.
    void find_in_range(NodeId from, Strength strength, Time t, const Legs& legs);
    // Searches as find_in_range() among stations of one kind, for those who can decode.
    void find_alike(NodeId from, Time t, const Legs& legs);
    // Searches by the distance and the draw of each pair.
    void find_in_table(NodeId from, Strength strength, Time t, const Legs& legs);
    // Searches by asking the model for the losses of those within reach.
    void find_in_reach(NodeId from, Strength strength, Time t, const Legs& legs,
                       std::uint64_t frame);
    // Computes when a frame that ends at `end` ends at those who were found.
    void tell_arrivals(Time end, Receivers& out) const;
    // Makes the index ready for queries about `from` at `t`.
    void look_from(NodeId from, Time t, const Legs& legs);
    // Fills shares_.
    void share_draws();
    // Visitor of the index: calls use(entry, antenna, squared distance and, if the index tells it,
    // place) for nodes within reach that are on and may link.
    template <class Use>
    auto within(NodeId from, double reach2, Use use) const;
    // Visits the nodes within reach.
    template <class Use>
    void visit(NodeId from, double reach2, Time t, const Legs& legs, Use use);

    Settings settings_;
    // Draws of links, where tables decide.
    PairDraws draws_;
    Stations stations_;
    LinkLosses links_;
    Arrivals arrivals_;
    // Changes so far.
    std::uint64_t changes_ = 0;
    // Nodes by their places, and losses of pairs at rest.
    NeighbourIndex index_;
    PairCache pairs_;
    // Scene that the losses of pairs are in.
    const Scene* pairs_of_ = nullptr;
    // Shares of draws_, by place in the index, if tables decide; number of the index's bin that
    // they belong to.
    std::vector<std::uint64_t> shares_;
    std::uint64_t shares_of_bin_ = 0;
    // Whether the index knows how wide its cells are.
    bool cells_chosen_ = false;

    // Search that found_ is of: from, strength, time and changes_; then what is under work.
    std::optional<std::tuple<NodeId, Strength, Time, std::uint64_t>> last_;
    Vec3 origin_;
    // Results of the last search.
    Sieve<Found> found_, sensors_;
    Candidates candidates_;
};

}  // namespace rovernet
