// SPDX-License-Identifier: MIT
#pragma once

#include "sim/event_heap.hpp"
#include "sim/ids.hpp"
#include "sim/node_filter.hpp"
#include "sim/record.hpp"
#include "sim/time.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rovernet {

/// Receptions that are served before events that come earlier but do not concern them, and the
/// timers that they set: those are queued when the reception's turn comes, so that timers of one
/// time are served in the order in which they would have been set.
class Overtaking {
  public:
    struct Timer {
        EventKey cause;  ///< the turn of the reception that set it
        Time at;
        NodeId node;
        std::uint64_t tag;
    };

    static constexpr std::size_t most = 64;  ///< receptions at a time: they are searched one by one

    /// From now until end() it is about `receptions`, which the event with this key serves.
    void begin(EventKey event, std::span<const Reception> receptions) {
        event_ = event;
        receptions_ = receptions;
        for (const Reception& r : receptions_) nodes_.add(r.node);
    }
    void end() {
        for (const Reception& r : receptions_) nodes_.remove(r.node);
        receptions_ = {};
    }
    bool active() const { return !receptions_.empty(); }
    /// One of them is the node's, or it looks so.
    bool concerns(NodeId node) const { return nodes_.may_have(node); }

    /// A timer that the reception at `node` sets; it should be one of those that are served.
    void set_timer(NodeId node, Time at, std::uint64_t tag) {
        const auto heard = std::find_if(receptions_.begin(), receptions_.end(),
                                        [&](const Reception& r) { return r.node == node; });
        const EventKey cause = heard == receptions_.end() ? event_ : event_.at(heard->time);
        const Timer timer{cause, at, node, tag};
        const auto later =
            std::upper_bound(timers_.begin(), timers_.end(), timer,
                             [](const Timer& a, const Timer& b) { return a.cause < b.cause; });
        timers_.insert(later, timer);
    }
    bool has_timers() const { return !timers_.empty(); }
    /// The next turn at which timers are queued; if there is none, after every event.
    EventKey next_turn() const { return timers_.empty() ? EventKey{} : timers_.front().cause; }
    /// Hands over, in order, the timers whose turn comes before that of `event`.
    template <class Use>
    void take_timers(EventKey event, Use use) {
        std::size_t taken = 0;
        for (; taken < timers_.size() && timers_[taken].cause < event; ++taken) use(timers_[taken]);
        timers_.erase(timers_.begin(), timers_.begin() + static_cast<std::ptrdiff_t>(taken));
    }

  private:
    EventKey event_;
    std::span<const Reception> receptions_;
    NodeFilter nodes_;           // theirs
    std::vector<Timer> timers_;  // in the order of their causes; few
};

}  // namespace rovernet
