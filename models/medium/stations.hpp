// SPDX-License-Identifier: MIT
#pragma once

#include "models/link_gain.hpp"
#include "models/medium/medium_settings.hpp"
#include "models/medium/radio_kinds.hpp"
#include "models/propagation/propagation.hpp"
#include "models/radio.hpp"
#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace rovernet {

/// Stations of a medium, by node: radio, propagation model for its transmissions, and on/off state.
/// Positions are in Legs.
class Stations {
    // Node with its radio, its kind, and its on/off state.
    struct Station {
        // Index into radios_.
        std::uint32_t radio;
        std::uint32_t kind : 31;
        std::uint32_t on : 1;
    };

  public:
    using Kind = RadioKinds::Kind;

    /// Creates an empty list. `most_fade`: largest gain by fading [dB]; empty: frames do not fade.
    /// @throws std::invalid_argument if a shadowing parameter of the settings is out of its range
    Stations(const MediumSettings& settings, std::optional<Db> most_fade);

    /// Adds the next node. @return its kind
    /// @param key          key of the robot, for random draws
    /// @param propagation  propagation model for the node's transmissions; shadowing of the
    ///                     settings is added
    /// @throws std::invalid_argument if a radio parameter is out of its range, or the model cannot
    /// work at the radio's frequency
    Kind add(const Radio& radio, std::uint64_t key, const Propagation& propagation);
    /// Reserves memory for `nodes` nodes.
    void reserve(std::size_t nodes) { keys_.reserve(nodes); }
    /// Number of nodes.
    std::size_t size() const { return keys_.size(); }
    /// Prefetches the state of `node` into the processor's cache.
    void prefetch(NodeId node) const { __builtin_prefetch(keys_.data() + node.index()); }

    /// Sets the bit rate of a node's radio, and with it the coding.
    void set_rate(NodeId node, BitRate rate);
    /// Switches a node's radio; a node that is off neither sends nor receives.
    void switch_radio(NodeId node, bool on);
    /// Whether a node's radio is on.
    bool is_on(NodeId node) const { return all_are_on() || stations_[node.index()].on; }
    /// Whether all nodes are on.
    bool all_are_on() const { return off_ == 0; }
    /// Number of nodes that are on.
    std::size_t on() const { return keys_.size() - off_; }

    /// Whether all stations are of one kind, with isotropic antennas: all links are then
    /// bidirectional.
    bool all_are_alike() const { return kinds_.size() == 1 && !is_directional(); }
    /// Whether any antenna is directional, so that headings affect links.
    bool is_directional() const { return kinds_.is_directional(); }
    /// Kind of a node (see RadioKinds); without memory access if all nodes are of one kind.
    Kind kind(NodeId node) const {
        return kinds_.size() == 1 ? Kind{0} : Kind{stations_[node.index()].kind};
    }
    /// Kind of a node while it sends this coding; kind(node) if sensitivities ignore the coding.
    Kind kind(NodeId node, Coding coding) {
        return kinds_.depend_on_coding() ? kind_of_coding(node, coding) : kind(node);
    }
    /// Kinds of stations, with their shared data; some of it is computed on first use.
    const RadioKinds& kinds() const { return kinds_; }
    RadioKinds& kinds() { return kinds_; }

    /// Key of the robot, as passed to add().
    std::uint64_t key(NodeId node) const { return keys_[node.index()]; }
    /// Radio of a node, with its labels and addresses.
    const Radio& radio(NodeId node) const {
        return radios_.size() == 1 ? radios_.front() : radios_[stations_[node.index()].radio];
    }
    /// Propagation model for transmissions of `node`.
    const Propagation& model(NodeId node) const { return kinds_.model(kind(node)); }
    /// Noise floor of a node's receiver [dBm].
    Dbm noise(NodeId node) const { return kinds_.noise(kind(node)); }
    /// Whether the gates of both nodes allow a link: they share a network, or one node has no gate.
    bool may_link(NodeId a, NodeId b) const { return kinds_.may_link(kind(a), kind(b)); }

    /// Height of a node's antenna above the robot's z [m].
    double height(NodeId node) const { return kinds_.height(kind(node)); }
    /// Position of a node's antenna at `t` [m].
    Vec3 antenna(NodeId node, Time t, const Legs& legs) const;
    /// Pose of a node's antenna at `t`.
    Pose pose(NodeId node, Time t, const Legs& legs) const;
    /// Gains [dB] of the antennas and cables of the link from `from` to `to` at `t`.
    LinkGain gain(NodeId from, NodeId to, Time t, const Legs& legs) const {
        return LinkGain::of(radio(from), radio(to), [&] {
            return std::pair{pose(from, t, legs), pose(to, t, legs)};
        });
    }
    /// Updates the antenna heights for a new leg of `node`, if heights matter and
    /// measure() has included the node before.
    void moved(NodeId node, const Legs& legs) {
        if (node.index() < measured_) measure(node.index(), node.index() + 1, legs);
    }
    /// Updates the antenna heights for all nodes added since the last call. Must be called
    /// before the reach or the decision of a kind is queried.
    void measure(const Legs& legs) {
        if (kinds_.heights_matter() && measured_ < keys_.size()) [[unlikely]]
            measure(measured_, keys_.size(), legs);
    }

    /// Copy of the pointer to the on/off states of all nodes. A loop that writes to memory need not
    /// load this pointer again for each node.
    class Switches {
      public:
        explicit Switches(const Stations& stations)
            : some_off_(stations.all_are_on() ? nullptr : stations.stations_.data()) {}
        bool is_on(NodeId node) const { return !some_off_ || some_off_[node.index()].on; }

      private:
        const Station* some_off_;
    };

  private:
    Kind kind_of_coding(NodeId node, Coding coding);
    // Fills stations_, up to the last node; new entries have the first radio and kind, and are on.
    void list_stations();
    // Adds the shadowing of the settings to a model. All copies of one Propagation share the
    // result.
    Propagation shadowed(const Propagation& model);
    // Reports the antenna heights on the legs of nodes `begin` to `end` to kinds_.
    void measure(std::size_t begin, std::size_t end, const Legs& legs);

    // Shadowing that is added to all models; below, seed and replication of its draws.
    Shadowing shadowing_;
    std::uint64_t seed_;
    std::uint32_t replication_;
    // Keys of robots, by node.
    std::vector<std::uint64_t> keys_;
    // Stations by node; empty while all nodes have equal radios and models, and are on.
    std::vector<Station> stations_;
    // Distinct radios.
    std::vector<Radio> radios_;
    // Number of nodes that are off.
    std::size_t off_ = 0;
    RadioKinds kinds_;
    // Propagation models as passed to add(), each with its copy that has added shadowing.
    std::vector<std::pair<Propagation, Propagation>> shadowed_;
    // Number of nodes whose antenna heights are known to kinds_.
    std::size_t measured_ = 0;
};

}  // namespace rovernet
