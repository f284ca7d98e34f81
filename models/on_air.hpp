// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace rovernet {

/// A frame as it arrives at one node.
struct Arrival {
    static constexpr std::uint32_t no_reception = 0xffffffff;  ///< it is sensed, not decoded
    enum class Lock : std::uint8_t {
        open,    ///< not decided yet
        held,    ///< the receiver locked on to it
        missed,  ///< it did not
    };

    Time begin;
    Time end;
    double level_dbm;          ///< [dBm] received power; NaN until somebody asked for it
    double squared_distance;   ///< [m^2] from the sender
    NodeId from;               ///< its sender
    std::uint32_t flight = 0;  ///< known to the caller
    std::uint32_t reception = no_reception;  ///< its place among the flight's
    bool collided = false;                   ///< lost to another frame
    Lock lock = Lock::open;                  ///< of a receiver at the rung "sinr"

    bool overlaps(const Arrival& other) const { return begin < other.end && other.begin < end; }
};

/// What a node sends, as it drowns everything there.
constexpr Arrival own_frame(NodeId node, Time begin, Time end) {
    return {.begin = begin,
            .end = end,
            .level_dbm = std::numeric_limits<double>::infinity(),
            .squared_distance = 0,
            .from = node};
}

/// The frames that are on air at each node, its own included.
class OnAir {
  public:
    /// Forgets those added first at `node` that ended by `since`, so that lists at which nobody
    /// looks stay short.
    void add(NodeId node, const Arrival& arrival, Time since);

    /// Calls use(arrival) for each at `node` that ends after `since`, in the order of adding; if it
    /// returns false that one is forgotten. Those that ended before are forgotten, too.
    template <class Use>
    void each(NodeId node, Time since, Use use) {
        if (node.index() >= last_.size()) return;
        std::uint32_t& last = last_[node.index()];
        std::uint32_t before = last;
        for (bool more = last != none; more;) {
            const std::uint32_t here = entries_[before].next;
            more = here != last;
            Arrival& arrival = entries_[here].arrival;
            if (arrival.end > since && use(arrival)) {
                before = here;
            } else {
                forget_next(before, last);
            }
        }
    }

  private:
    static constexpr std::uint32_t none = 0xffffffff;
    struct Entry {
        Arrival arrival;
        std::uint32_t next;
    };
    /// Takes the entry that follows `before` out of the list that ends with `last`.
    void forget_next(std::uint32_t before, std::uint32_t& last);

    std::vector<std::uint32_t> last_;  // by node: the entry added last, which the first follows
    std::vector<Entry> entries_;
    std::uint32_t free_ = none;  // list of entries that are not in use
};

}  // namespace rovernet
