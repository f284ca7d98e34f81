// SPDX-License-Identifier: MIT
#pragma once

#include "models/links/link_changes.hpp"
#include "models/links/wall_passages.hpp"
#include "scene/scene.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace rovernet {

class Medium;

/// Change of a link: from `time` on, node `to` can hear node `from` (up) or cannot (down).
struct LinkChange {
    Time time;
    NodeId from;
    NodeId to;
    /// True if the link is up after the change.
    bool up;
    friend bool operator==(const LinkChange&, const LinkChange&) = default;
};

/// Prediction of link changes in a network: state of every ordered pair of robots, and time of its
/// next change.
///
/// Every new leg, every switched radio and every new scene must be reported immediately. A leg must
/// be replaced at its end. next() returns the time at which advance() must be called; advance()
/// reports every change once, in the order of (time, from, to). Links count as down before start().
///
/// A new leg costs a search for each pair with its robot, see next_link_change; robots at rest cost
/// nothing. For a propagation model of unknown shape (LossShape), a search covers a time span as
/// long as the time since start(), and at least 16 samples: a leg may last far beyond the end of
/// the run.
///
/// Memory: 9 bytes for each pair, and 16 more while a change is pending; 225 MB for 5000 robots,
/// the largest number of robots.
class LinkWatch {
  public:
    /// Largest number of robots; with more robots RunError is thrown.
    static constexpr std::size_t most_robots = 5000;

    /// Inputs of the prediction.
    struct Settings {
        /// Medium that determines links; not null. All objects in Settings must outlive the
        /// LinkWatch.
        const Medium* medium = nullptr;
        /// Current leg (straight movement or rest) of each node of the medium; not null.
        const Legs* legs = nullptr;
        /// Current scene of the medium; not null.
        const Scene* scene = nullptr;
        /// Precision of the search for link changes.
        LinkSearch search = {};
    };
    /// Callback that is called with each change of a link.
    using Tell = std::function<void(const LinkChange&)>;

    explicit LinkWatch(const Settings& settings) : settings_(settings) {}

    /// Starts the prediction: searches all pairs of robots. A link that is up is reported as a
    /// change at `now`.
    /// @throws RunError if there are too many robots
    void start(Time now);
    /// Reports that the robot's leg was replaced at `now`, or its radio switched on or off.
    void changed(NodeId node, Time now) { look_at(node, now); }
    /// Reports that the medium has a new scene from `now` on; searches all pairs.
    void scene_changed(const Scene& scene, Time now);
    /// Reports a new robot, the last one in medium and legs.
    /// @throws RunError if there are too many robots
    void added(NodeId node, Time now);

    /// Time at which `advance` must be called next; empty if nothing is pending. At this time
    /// either a change is due, or only the continuation of a search.
    std::optional<Time> next() const;
    /// Calls `tell` for each link change due at or before `now`. `tell` must not call the
    /// LinkWatch.
    void advance(Time now, const Tell& tell);

    /// State of a link (true: up), as reported so far.
    bool is_up(NodeId from, NodeId to) const { return (state_[pair(from, to)] & up) != 0; }

  private:
    /// Entry of the heap: time of the next change of a pair's link, or of the next search for it.
    /// An entry is stale, and skipped, if its time differs from that in next_.
    struct Entry {
        Time time;
        NodeId from;
        NodeId to;
    };
    // Bits of a pair's state. `up`: the link is up. `look_again`: the pending time is not a change,
    // but the time to continue the search.
    static constexpr std::uint8_t up = 1;
    static constexpr std::uint8_t look_again = 2;

    // Index of an ordered pair of robots. Pairs with the last robot come last, so that adding a
    // robot moves no entry.
    static std::size_t pair(NodeId from, NodeId to) {
        const std::size_t i = from.index(), j = to.index();
        return i < j ? j * j + i : i * i + i + j;
    }
    // Order of the heap: whether `p` is later than `q`, so that the earliest entry is on top.
    static bool later(const Entry& p, const Entry& q);

    // Allocates memory for the pairs of this many robots.
    void grow(std::size_t robots);
    // Search again for the next change of all pairs, of all pairs of a robot, or of one pair.
    void look_at_all(Time now);
    void look_at(NodeId node, Time now);
    void look_at(NodeId from, NodeId to, Time now);
    // Searches the first link change of a pair later than `after`, and queues the change.
    void search(NodeId from, NodeId to, Time after);
    // Sets the pending time of a pair: a link change, or the continuation of a search (not
    // `change`).
    void expect(NodeId from, NodeId to, Time time, bool change);
    // Whether an entry is stale: the pair's pending time has changed since the entry was made.
    bool stale(const Entry& entry) const { return next_[pair(entry.from, entry.to)] != entry.time; }
    // Removes stale entries from the top of the heap. If the heap has too many stale entries,
    // removes all stale entries.
    void drop_stale();
    // Walls for the search of links from `from`; an empty set if the sender's path loss does not
    // depend on walls.
    const WallPassages& walls_for(NodeId from);

    Settings settings_;
    // Time at which the prediction started, passed to start().
    Time begin_ = {};
    std::size_t robots_ = 0;
    // Pending time of each pair (a change, or the continuation of a search); `never` for none.
    std::vector<Time> next_;
    // State of each pair: bits `up` and `look_again`.
    std::vector<std::uint8_t> state_;
    // Heap of pending times, earliest first; entries replaced by a later search are stale.
    std::vector<Entry> heap_;
    // Number of pairs with a pending time.
    std::size_t pending_ = 0;
    // Walls for senders whose path loss depends on walls, built at the first such sender.
    // no_walls_: the empty set for all other senders.
    std::optional<WallPassages> walls_;
    const WallPassages no_walls_ = {};
};

}  // namespace rovernet
