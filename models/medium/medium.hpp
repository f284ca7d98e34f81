// SPDX-License-Identifier: MIT
#pragma once

#include "models/arrival.hpp"
#include "models/link_gain.hpp"
#include "models/medium/candidates.hpp"
#include "models/medium/medium_settings.hpp"
#include "models/medium/neighbour_index.hpp"
#include "models/medium/pair_cache.hpp"
#include "models/medium/radio_kinds.hpp"
#include "models/medium/recent_losses.hpp"
#include "models/propagation/propagation.hpp"
#include "models/radio.hpp"
#include "models/variation/fading.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/record.hpp"
#include "sim/sieve.hpp"

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace rovernet {

/// Medium between radios: who hears a transmission, when and at what level. The transmitter's
/// propagation model rules. Everything about a frame is fixed at its start: who is on, where
/// everybody is, at what level. A link is up if and only if its path loss is within link_budget.
///
/// Times must not decrease from one search to the next. The channel of a network searches; links,
/// pictures and the judges of receptions ask for levels.
class Medium {
  public:
    using Settings = MediumSettings;

    /// Makes an empty medium; stations are added to it.
    /// @throws std::invalid_argument if its shadowing or fading has a parameter out of its range
    explicit Medium(const Settings& settings);
    /// Settings as they were given.
    const Settings& settings() const { return settings_; }

    /// Adds the next node.
    /// @param key          of the robot, for random draws
    /// @param propagation  model of what it transmits
    /// @throws std::invalid_argument if a radio parameter is out of its range, or the model cannot
    /// work at the radio's frequency
    void add(const Radio& radio, std::uint64_t key, const Propagation& propagation);
    /// Makes room for `nodes` nodes.
    void reserve(std::size_t nodes) {
        keys_.reserve(nodes);
        index_.reserve(nodes);
    }
    /// Prefetches the state of `node`, the sender of the next event; node 0 if that event has none.
    void prefetch(NodeId node) const {
        __builtin_prefetch(keys_.data() + node.index());
        index_.prefetch(node);
    }
    /// Prefetches what position() takes.
    void prefetch_position(NodeId node) const { index_.prefetch(node); }
    /// Takes note that the node's leg has been replaced.
    void moved(NodeId node, const Legs& legs) {
        ++changes_;
        index_.moved(node, legs);
        pairs_.moved(node);
        if (node.index() < measured_) measure(node.index(), node.index() + 1, legs);
    }
    /// Switches a node's radio; a node that is off neither sends nor receives.
    void switch_radio(NodeId node, bool on);
    /// Whether no node is off.
    bool all_are_on() const { return off_ == 0; }
    /// Number of nodes that are on.
    std::size_t on() const { return keys_.size() - off_; }
    /// Whether all are of one kind, with antennas that have no direction: links go both ways then.
    bool all_are_alike() const { return kinds_.size() == 1 && !is_directional(); }
    /// Whether some antenna is directional: then headings count.
    bool is_directional() const { return kinds_.is_directional(); }
    /// Number of changes so far: of legs, and of nodes added or switched.
    std::uint64_t changes() const { return changes_; }
    /// Whether a node's radio is on.
    bool is_on(NodeId node) const { return all_are_on() || stations_[node.index()].on; }
    /// Key of the robot, as add() was given it.
    std::uint64_t key(NodeId node) const { return keys_[node.index()]; }
    /// Radio of a node, with its labels and addresses.
    const Radio& radio(NodeId node) const {
        return radios_.size() == 1 ? radios_.front() : radios_[stations_[node.index()].radio];
    }
    /// Whether the gates of both let them have a link: one of them is open, or they share a
    /// network.
    bool may_link(NodeId a, NodeId b) const { return kinds_.may_link(kind(a), kind(b)); }
    /// Noise floor of a node's receiver [dBm].
    Dbm noise(NodeId node) const { return kinds_.noise(kind(node)); }
    /// Ratio by which `frames` that the cut left out may raise a receiver's noise; there is a cut.
    Db left_out(std::size_t frames) const;

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
    /// Position of the sender's antenna in the last find_receivers() [m].
    Vec3 origin() const { return origin_; }
    /// Distance of its farthest receiver [m].
    double heard_within();
    /// Delay [ns] of a frame over a distance [m].
    Duration delay(double distance) const;

    /// Squared distance [m^2] beyond which `node` interferes with nobody; may be infinite.
    double squared_reach(NodeId node) {
        return kinds_.squared_reach(kind(node), Strength::interfering);
    }
    /// Position of a node [m]: as `legs` have it, and near in memory if its neighbours sent lately.
    Vec3 position(NodeId node, Time t, const Legs& legs) const {
        return index_.position_of(node, t, legs);
    }
    /// Frame as it arrives at `to`, which is `at` [m] when it begins; nothing if it is too weak to
    /// interfere, or if the two may have no link. The level is left open where the distance and the
    /// pair decide it.
    std::optional<Arrival> arrival(const Emission& frame, NodeId to, Vec3 at) {
        at.z += kinds_.height(kind(to));
        const double d2 = squared_distance(frame.origin, at);
        return d2 > frame.squared_reach ? std::nullopt : arrival_from(frame, d2, to, at);
    }
    /// Frame as it arrives at `to` where some antenna is directional.
    /// @param headings  of both ends when the frame begins
    std::optional<Arrival> arrival(const Emission& frame, NodeId to, Vec3 at,
                                   const Headings& headings) {
        at.z += kinds_.height(kind(to));
        const double d2 = squared_distance(frame.origin, at);
        if (d2 > frame.squared_reach || !may_link(frame.from, to)) return std::nullopt;
        return arrival_by_loss(frame, d2, to, at, headings);
    }
    /// Received power [dBm] at `to` of a frame whose level was left open.
    Dbm level(const Arrival& arrival, NodeId to) const;
    /// Whether the level of `frame` at `to` exceeds that of `other` by `by` or more. Levels that
    /// are open remain so if that is plain without them.
    bool is_stronger(Arrival& frame, Arrival& other, Db by, NodeId to);

    /// Nodes that hear `from` at `t`; good until the next call.
    std::span<const Found> hearers(NodeId from, Time t, const Legs& legs) {
        find(from, Strength::decodable, t, legs, 0);
        return found_.kept();
    }

    /// Whether `to` is one of those that hear `from` at `t`: looks at that one link.
    bool hears(NodeId from, NodeId to, Time t, const Legs& legs);
    /// Number of nodes other than `from` that a chain of links joins to it at `t`: searched anew,
    /// see Reachability.
    std::uint32_t reachable(NodeId from, Time t, const Legs& legs);

    /// Path loss [dB] from `from` to `to` at `t`, with nothing given up: shadowing is in it, fading
    /// is not.
    Db path_loss(NodeId from, NodeId to, Time t, const Legs& legs) const;
    /// Gain of the antennas and cables between two nodes at `t`.
    LinkGain gain(NodeId from, NodeId to, Time t, const Legs& legs) const {
        return LinkGain::of(radio(from), radio(to), [&] {
            return std::pair{pose(from, t, legs), pose(to, t, legs)};
        });
    }
    /// Received power [dBm] at `to` of what `from` sends at `t`: the local mean.
    Dbm level(NodeId from, NodeId to, Time t, const Legs& legs) const;
    /// Path loss [dB] that the link could still bear at `t`; negative: it is too weak.
    Db margin(NodeId from, NodeId to, Time t, const Legs& legs) const;

    /// Shape of the link's margin while both ends go on along their legs as at `t`.
    LossShape shape(NodeId from, NodeId to, Time t, const Legs& legs) const;
    /// Whether the margin may change while they do: one of them moves, or turns and an antenna is
    /// directional.
    bool may_change(NodeId from, NodeId to, Time t, const Legs& legs) const;

    /// Whether `to` can hear `from` at `t`: both are on, may link, and the budget allows it. A
    /// switched-off or gated link is down whatever its level.
    bool link_up(NodeId from, NodeId to, Time t, const Legs& legs) const;
    /// Model that rules what `node` transmits.
    const Propagation& model(NodeId node) const { return kinds_.model(kind(node)); }

    /// Position of a node's antenna at `t` [m].
    Vec3 antenna(NodeId node, Time t, const Legs& legs) const;
    /// Pose of a node's antenna at `t`.
    Pose pose(NodeId node, Time t, const Legs& legs) const;

  private:
    using Entry = NeighbourIndex::Entry;
    /// Node: its radio, its kind, and whether it is on.
    struct Station {
        /// Index into radios_.
        std::uint32_t radio;
        std::uint32_t kind : 31;
        std::uint32_t on : 1;
    };
    using Kind = RadioKinds::Kind;

    // Kind of a node; where all are alike, without a look at the station.
    Kind kind(NodeId node) const {
        return kinds_.size() == 1 ? Kind{0} : Kind{stations_[node.index()].kind};
    }
    // Lists the stations that are not listed yet: they are as the first one, and on.
    void list_stations();
    // Chooses cells as wide as the reach of the median station: most queries then look at nine of
    // them.
    void choose_cells();
    // Takes note of how high the antennas of nodes `begin` to `end` get on their legs, if heights
    // matter.
    void measure(std::size_t begin, std::size_t end, const Legs& legs);
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
    // Frame as it arrives, as arrival(), within its reach.
    std::optional<Arrival> arrival_from(const Emission& frame, double d2, NodeId to, Vec3 there);
    // Frame as it arrives between two that may have a link, by Decision::by_loss.
    std::optional<Arrival> arrival_by_loss(const Emission& frame, double d2, NodeId to, Vec3 there,
                                           const Headings& headings) const;
    // Frame that arrives over a squared distance, with this level.
    Arrival arrival_of(const Emission& frame, double d2, double level_dbm) const;
    // Model with the shadowing of the settings over it; the same for copies of one handle.
    Propagation shadowed(const Propagation& model);
    // Links of a transmitter, as a model is asked for them.
    LinkBatch batch(NodeId from, Vec3 origin, Time t, std::uint64_t frame) const;
    // Path loss [dB] from `from` here to `to` there, as a frame sees it.
    double loss(NodeId from, NodeId to, Vec3 here, Vec3 there, Time t, std::uint64_t frame,
                Db give_up) const;
    // Path loss [dB] by the model, the local mean; above `give_up` it says no more than that.
    double computed_loss(NodeId from, NodeId to, Vec3 here, Vec3 there, Time t, std::uint64_t frame,
                         Db give_up) const;
    // Loss [dB] that a frame sees where the link's is `loss_db`; that one if frames do not fade.
    double faded(double loss_db, NodeId from, NodeId to, Vec3 here, Vec3 there,
                 std::uint64_t frame) const;
    // Whether losses are kept for who judges the frames.
    bool keeps_recent_losses() const {
        return settings_.interference_cut && settings_.keep_losses && !settings_.all_pairs;
    }
    // Key of the frame that a node sends at `t`, see LinkBatch: there is but one.
    std::uint64_t frame_key(NodeId from, Time t) const {
        return combine(key(from), static_cast<std::uint64_t>((t - start_of_run).count()));
    }

    Settings settings_;
    // Keys of robots, by node.
    std::vector<std::uint64_t> keys_;
    // Stations by node; none as long as all are alike and on.
    std::vector<Station> stations_;
    // Radios that differ.
    std::vector<Radio> radios_;
    // Nodes that are off.
    std::size_t off_ = 0;
    // Changes so far.
    std::uint64_t changes_ = 0;
    // Draws of links, where tables decide.
    PairDraws draws_;
    // Fades of frames; null: they do not fade.
    std::shared_ptr<const Fades> fades_;
    RadioKinds kinds_;
    // Models as they were given, and with shadowing, if there is some.
    std::vector<std::pair<Propagation, Propagation>> shadowed_;
    // Nodes by their places, and losses of pairs at rest.
    NeighbourIndex index_;
    // Shares of draws_, by place in the index, if tables decide; number of the index's bin that
    // they belong to.
    std::vector<std::uint64_t> shares_;
    std::uint64_t shares_of_bin_ = 0;
    PairCache pairs_;
    // Losses of the last searches, if frames are judged that interfere.
    RecentLosses recent_;
    // Whether the index knows how wide its cells are.
    bool cells_chosen_ = false;
    // Nodes whose heights the kinds know, if heights matter.
    std::size_t measured_ = 0;

    // Search that found_ is of: from, strength, time and changes_; then what is under work.
    std::optional<std::tuple<NodeId, Strength, Time, std::uint64_t>> last_;
    Vec3 origin_;
    // Results of the last search.
    Sieve<Found> found_, sensors_;
    Candidates candidates_;
};

}  // namespace rovernet
