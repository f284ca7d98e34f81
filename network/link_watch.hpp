// SPDX-License-Identifier: MIT
#pragma once

#include "models/links/link_changes.hpp"
#include "models/links/wall_passages.hpp"
#include "models/medium/medium.hpp"
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

/// From `time` on `to` can hear `from`, or cannot any more.
struct LinkChange {
    Time time;
    NodeId from;
    NodeId to;
    bool up;
    friend bool operator==(const LinkChange&, const LinkChange&) = default;
};

/// All links of a network: the state of every ordered pair of robots and when it changes next.
///
/// Tell it at once of every new leg and every switch; it tells when to call `advance`, and there
/// every change once, in the order of (time, from, to). A leg that ends must be replaced at its
/// end. Links count as down before `start`. A pair takes 9 bytes and 16 more while a change is
/// pending: 225 MB for 5000 robots, the most it watches. A new leg costs a search for each pair
/// with that robot, see next_link_change; robots at rest cost nothing.
class LinkWatch {
  public:
    static constexpr std::size_t most_robots = 5000;

    struct Settings {
        const Medium* medium = nullptr;  ///< not null; outlives the watch, as do the others
        const Legs* legs = nullptr;      ///< not null; the same nodes as the medium
        const Scene* scene = nullptr;    ///< not null; the medium's
        LinkSearch search = {};
    };
    using Tell = std::function<void(const LinkChange&)>;

    explicit LinkWatch(const Settings& settings) : settings_(settings) {}

    /// Looks at all pairs; those that are up change at `now`.
    /// @throws RunError if there are too many robots
    void start(Time now);
    /// The robot's leg was replaced at `now`, or its radio was switched on or off.
    void changed(NodeId node, Time now) { look_at(node, now); }
    /// The medium and the legs have one more robot, the last.
    /// @throws RunError if there are too many robots
    void added(NodeId node, Time now);

    /// When `advance` has to be called next; then it may have to look only, and no change to tell.
    std::optional<Time> next() const;
    /// Tells the changes due at or before `now`. `tell` must not call back.
    void advance(Time now, const Tell& tell);

    /// As told so far.
    bool is_up(NodeId from, NodeId to) const { return (state_[pair(from, to)] & up) != 0; }

  private:
    struct Entry {
        Time time;
        NodeId from;
        NodeId to;
    };
    // Bits of a pair's state.
    static constexpr std::uint8_t up = 1;
    static constexpr std::uint8_t look_again = 2;  // what is pending is no change

    // Pairs with the last robot come last, so that a robot more moves none.
    static std::size_t pair(NodeId from, NodeId to) {
        const std::size_t i = from.index(), j = to.index();
        return i < j ? j * j + i : i * i + i + j;
    }
    static bool later(const Entry& p, const Entry& q);

    void grow(std::size_t robots);
    void look_at(NodeId node, Time now);
    void look_at(NodeId from, NodeId to, Time now);
    void search(NodeId from, NodeId to, Time after);
    void expect(NodeId from, NodeId to, Time time, bool change);
    bool stale(const Entry& entry) const { return next_[pair(entry.from, entry.to)] != entry.time; }
    void drop_stale();
    const WallPassages& walls_for(NodeId from);

    Settings settings_;
    std::size_t robots_ = 0;
    std::vector<Time> next_;           // of each pair; never: nothing pending
    std::vector<std::uint8_t> state_;  // of each pair
    std::vector<Entry> heap_;          // the earliest first; entries of before a new look are stale
    std::size_t pending_ = 0;          // pairs with something pending
    std::optional<WallPassages> walls_;
    const WallPassages no_walls_ = {};
};

}  // namespace rovernet
