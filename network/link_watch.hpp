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

/// Change of a link: from `time` on `to` can hear `from`, or cannot any more.
struct LinkChange {
    Time time;
    NodeId from;
    NodeId to;
    /// State from then on.
    bool up;
    friend bool operator==(const LinkChange&, const LinkChange&) = default;
};

/// Watch over all links of a network: the state of every ordered pair of robots, and when it
/// changes next.
///
/// It must be told at once of every new leg, every switch and every new scene; it tells when to
/// call `advance`, which tells every change once, in the order of (time, from, to). A leg that ends
/// must be replaced at its end. Links count as down before `start`. A new leg costs a search for
/// each pair with that robot, see next_link_change; robots at rest cost nothing.
///
/// A pair takes 9 bytes and 16 more while a change is pending: 225 MB for 5000 robots, the most it
/// watches.
class LinkWatch {
  public:
    /// Number of robots beyond which it refuses.
    static constexpr std::size_t most_robots = 5000;

    /// What it looks at.
    struct Settings {
        /// Medium that decides on links; not null. All of these outlive the watch.
        const Medium* medium = nullptr;
        /// Legs of the same nodes; not null.
        const Legs* legs = nullptr;
        /// Scene of the medium now; not null.
        const Scene* scene = nullptr;
        /// Precision of the search.
        LinkSearch search = {};
    };
    /// Receiver of changes.
    using Tell = std::function<void(const LinkChange&)>;

    explicit LinkWatch(const Settings& settings) : settings_(settings) {}

    /// Looks at all pairs; those that are up change at `now`.
    /// @throws RunError if there are too many robots
    void start(Time now);
    /// Takes note that the robot's leg was replaced at `now`, or its radio switched on or off.
    void changed(NodeId node, Time now) { look_at(node, now); }
    /// Takes note that the scene of the medium is another one from `now` on: looks at all pairs.
    void scene_changed(const Scene& scene, Time now);
    /// Takes note of one more robot, the last, in medium and legs.
    /// @throws RunError if there are too many robots
    void added(NodeId node, Time now);

    /// Time at which `advance` has to be called next; nothing if nothing is pending. There may be
    /// no change to tell then, but a search to go on with.
    std::optional<Time> next() const;
    /// Tells the changes due at or before `now`. `tell` must not call back.
    void advance(Time now, const Tell& tell);

    /// State of a link, as told so far.
    bool is_up(NodeId from, NodeId to) const { return (state_[pair(from, to)] & up) != 0; }

  private:
    /// Time at which something is pending for a pair. An entry whose time is no longer that of the
    /// pair is stale, and passed over.
    struct Entry {
        Time time;
        NodeId from;
        NodeId to;
    };
    // Bits of a pair's state: the link is up; what is pending is no change, but a search to go on
    // with.
    static constexpr std::uint8_t up = 1;
    static constexpr std::uint8_t look_again = 2;

    // Index of an ordered pair. Pairs with the last robot come last, so that one more robot moves
    // none.
    static std::size_t pair(NodeId from, NodeId to) {
        const std::size_t i = from.index(), j = to.index();
        return i < j ? j * j + i : i * i + i + j;
    }
    // Order of the heap, the earliest on top.
    static bool later(const Entry& p, const Entry& q);

    // Makes room for the pairs of so many robots.
    void grow(std::size_t robots);
    // Looks anew at all pairs, at all of a robot, or at one of them.
    void look_at_all(Time now);
    void look_at(NodeId node, Time now);
    void look_at(NodeId from, NodeId to, Time now);
    // Searches for the next change of a pair, and expects it.
    void search(NodeId from, NodeId to, Time after);
    // Sets what is pending for a pair.
    void expect(NodeId from, NodeId to, Time time, bool change);
    // Whether something else is pending for the pair by now.
    bool stale(const Entry& entry) const { return next_[pair(entry.from, entry.to)] != entry.time; }
    // Removes stale entries from the top of the heap, and all if there are too many.
    void drop_stale();
    // Walls that the search for this sender's links needs.
    const WallPassages& walls_for(NodeId from);

    Settings settings_;
    std::size_t robots_ = 0;
    // Time of what is pending, by pair; never: nothing is.
    std::vector<Time> next_;
    // Bits of the state, by pair.
    std::vector<std::uint8_t> state_;
    // What is pending, the earliest first; entries of before a new look are stale.
    std::vector<Entry> heap_;
    // Pairs with something pending.
    std::size_t pending_ = 0;
    // Corners of walls, collected when a sender's loss goes by walls; and none, for others.
    std::optional<WallPassages> walls_;
    const WallPassages no_walls_ = {};
};

}  // namespace rovernet
