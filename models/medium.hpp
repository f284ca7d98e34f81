// SPDX-License-Identifier: MIT
#pragma once

#include "models/candidates.hpp"
#include "models/membership.hpp"
#include "models/neighbour_index.hpp"
#include "models/pair_cache.hpp"
#include "models/propagation.hpp"
#include "models/radio.hpp"
#include "models/shadowed_range.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/record.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {

/// The air: who hears a transmission. The transmitter's propagation model rules. Everything about a
/// frame is fixed at its start: who is on, where everybody is, at what level. A link is up iff its
/// path loss is within link_budget.
class Medium {
  public:
    struct Settings {
        const Scene* scene = nullptr;   ///< not null; outlives the medium
        Meters floor_height{3};         ///< [m] of one storey
        bool propagation_delay = true;  ///< a frame arrives distance / c after it is sent
        bool keep_losses = true;        ///< of pairs at rest, instead of computing them again
        bool all_pairs = false;         ///< for tests: without the grid, nor losses kept
        /// [dB] frames disturb others down to so much below the sensitivity (but not to more than
        /// 10 dB below the noise floor); none: only those that are sensed do.
        std::optional<Db> interference_cut = std::nullopt;
        std::uint64_t seed = 0;
        std::uint32_t replication = 0;
    };

    explicit Medium(const Settings& settings) : settings_(settings) {}

    /// Adds the next node. `key`: the robot's, for random draws.
    /// @throws std::invalid_argument if a radio parameter is out of its range, or the model cannot
    ///         work at the radio's frequency
    void add(const Radio& radio, std::uint64_t key, const Propagation& propagation);
    /// Room for `nodes` nodes.
    void reserve(std::size_t nodes) {
        stations_.reserve(nodes);
        index_.reserve(nodes);
    }
    /// The node's leg has been replaced.
    void moved(NodeId node, const Legs& legs) {
        index_.moved(node, legs);
        pairs_.moved(node);
    }

    void switch_radio(NodeId node, bool on);
    bool is_on(NodeId node) const { return off_ == 0 || stations_[node.index()].on; }
    const Radio& radio(NodeId node) const { return radios_[stations_[node.index()].radio]; }
    /// The gates of both let them have a link: one of them is open, or they share a network.
    bool may_link(NodeId a, NodeId b) const {
        return !gated_ || Membership::match(kind(a).membership, kind(b).membership);
    }
    Dbm noise(NodeId node) const { return kind(node).noise; }
    /// What `frames` that the cut left out may add to a receiver's noise; there is a cut.
    Db left_out(std::size_t frames) const;

    /// Appends to `out` the nodes that hear `from` when it sends at `start`, in the order in which
    /// the frame ends at them, then of NodeId. `start` must not decrease from call to call.
    /// @param end  of the frame at the transmitter
    void receivers(NodeId from, Time start, Time end, const Legs& legs,
                   std::vector<Reception>& out);

    /// One that senses a transmission.
    struct Hearer {
        NodeId node;
        Duration delay;           ///< [ns] that the frame is under way
        double squared_distance;  ///< [m^2] between the antennas
        double loss_db;           ///< [dB]; NaN if the link goes by distance: see level()
        bool senses;              ///< else it is disturbed at most
    };
    struct Hearers {
        /// Those whose link is up, in the order in which the frame ends at them, then of NodeId.
        std::span<const Hearer> receivers;
        std::span<const Hearer> others;  ///< who only sense it, in no order
    };
    /// Those that sense `from` at `t`, which must not decrease; good until the next call.
    Hearers sensed(NodeId from, Time t, const Legs& legs);
    /// Received power [dBm] at `to` over a link of `from` that goes by distance.
    Dbm level(NodeId from, NodeId to, double squared_distance) const;
    /// Received power [dBm] at `to` after `loss` [dB].
    Dbm level_after(NodeId from, NodeId to, double loss_db) const {
        return received_power(kind(from).radio, kind(to).radio, Db{loss_db});
    }

    struct Found {
        NodeId node;
        double squared_distance;  ///< [m^2] between the antennas
    };
    /// Those that hear `from` at `t`, which must not decrease; good until the next call.
    std::span<const Found> hearers(NodeId from, Time t, const Legs& legs) {
        find_hearers(from, t, legs);
        return found_;
    }

    /// Nodes other than `from` that a chain of links joins to it at `t`, which must not decrease.
    std::uint32_t reachable(NodeId from, Time t, const Legs& legs);

    /// Path loss [dB] from `from` to `to` at `t`, with nothing given up.
    Db path_loss(NodeId from, NodeId to, Time t, const Legs& legs) const;

    /// `to` can hear `from` at `t`: both are on, may link, and the budget allows it. A switched-off
    /// or gated link is down whatever its level.
    bool link_up(NodeId from, NodeId to, Time t, const Legs& legs) const;
    /// The model that rules what `node` transmits.
    const Propagation& model(NodeId node) const { return models_[kind(node).model]; }

    /// A node's antenna at `t` [m].
    Vec3 antenna(NodeId node, Time t, const Legs& legs) const;

  private:
    using Entry = NeighbourIndex::Entry;
    struct Station {
        std::uint64_t key;
        std::uint32_t radio;  // index into radios_
        std::uint32_t kind;   // index into kinds_
        bool on = true;
    };
    /// Nobody of a kind that is farther hears, senses or is disturbed. NaN: to be computed.
    struct Ranges {
        double heard2 = nan, sensed2 = nan, audible2 = nan;  // [m^2]
        static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    };
    /// Stations that are alike in all that decides a link.
    struct Kind {
        Radio radio;  // without labels and addresses
        Membership membership;
        std::uint32_t model;  // index into models_
        Dbm noise;
        std::uint32_t stations = 1;  // of this kind
        // [m^2] nobody farther hears it, or senses it; < 0: to be computed
        double reach2 = -1, sensed_reach2 = -1;
        std::vector<Ranges> ranges = {};                          // to each kind, by distance
        std::vector<std::optional<ShadowedRange>> shadowed = {};  // the same with shadowing
    };

    const Kind& kind(NodeId node) const { return kinds_[stations_[node.index()].kind]; }
    std::uint32_t kind_of(const Radio& radio, std::uint32_t model);
    Membership membership(const Radio& radio);
    void choose_cells();

    void find_in_reach(NodeId from, Time t, const Legs& legs);
    void find_in_shadowed_range(NodeId from, const ShadowedLoss& loss, Time t, const Legs& legs);
    void find_in_range(NodeId from, Time t, const Legs& legs);
    void find_sensed_in_range(NodeId from, Time t, const Legs& legs);
    void find_sensed_in_reach(NodeId from, Time t, const Legs& legs);
    Duration delay(double distance) const;
    Dbm weakest_audible(const Radio& to) const;
    Db audible_budget(const Radio& from, const Radio& to) const;
    void find_hearers(NodeId from, Time t, const Legs& legs);
    void late_receivers(Time end, std::vector<Reception>& out) const;
    template <class Use>
    void visit(NodeId from, double reach2, Time t, const Legs& legs, Use use);
    template <class Budget>
    void find_losses(NodeId from, double reach2, Time t, const Legs& legs, Budget budget);
    double squared_reach(const Kind& from, Db best_receiver) const;
    double squared_reach(Kind& from);
    double squared_sensed_reach(Kind& from);
    Ranges compute_ranges(const Kind& from, const Radio& to) const;
    LinkBatch batch(NodeId from, Vec3 origin) const;
    double loss(NodeId from, NodeId to, Vec3 here, Vec3 there) const;

    Settings settings_;
    std::vector<Station> stations_;
    std::vector<Radio> radios_;  // those that differ
    std::vector<Kind> kinds_;
    std::vector<double> heights_;  // [m] antennas' of the kinds
    std::size_t off_ = 0;          // stations that are switched off
    std::vector<std::string> essids_ = {"any"};
    std::vector<std::pair<int, Hertz>> channels_;
    bool gated_ = false;  // some two radios do not match
    std::vector<Propagation> models_;
    Db best_receiver_{-1e300};  // gain - cable loss - sensitivity of the most sensitive station
    Db best_sensor_{-1e300};    // the same for what is sensed
    NeighbourIndex index_;
    PairCache pairs_;
    bool cells_chosen_ = false;

    // What is under work, kept for its memory.
    Vec3 origin_;
    std::vector<Found> found_;
    std::vector<std::uint64_t> order_;
    Candidates candidates_;
    std::vector<Hearer> receivers_, sensors_;
};

}  // namespace rovernet
