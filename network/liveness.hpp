// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <vector>

namespace rovernet {

/// Stall detection: finds a robot whose events follow one another without end while simulated time
/// hardly grows, so that the run would never end.
///
/// Simulated time is checked once in `most_events` events. If it has grown by less than `growth`
/// since the last check, the events of each robot are counted until simulated time has grown by
/// `growth`.
class Liveness {
  public:
    /// Largest number of events of one robot within the simulated time `growth`.
    static constexpr std::uint64_t most_events = 100'000;

    /// @param growth  shortest simulated time [ns] that most_events events of one robot may take
    explicit Liveness(Duration growth) : growth_(growth) {}

    /// Checks the growth of simulated time since the last call, and starts to count events if it is
    /// below `growth`. Called after every `most_events` events of all robots.
    void look(Time now) {
        if (now - last_look_ < growth_) begin_ = now, is_counting_ = true;
        last_look_ = now;
    }
    /// Whether the caller must now count the events of robots by is_stuck(). Counting begins in
    /// look(). It ends in this function, once simulated time has grown by `growth` since then.
    bool is_counting(Time now) {
        if (is_counting_ && now - begin_ >= growth_) {
            is_counting_ = false;
            counts_ = {};
        }
        return is_counting_;
    }
    /// Counts an event of a robot; to be called only while is_counting().
    /// @return whether the robot has had `most_events` events since counting began
    bool is_stuck(NodeId node) {
        if (counts_.size() <= node.index()) counts_.resize(node.index() + 1);
        return ++counts_[node.index()] >= most_events;
    }

  private:
    Duration growth_;
    Time last_look_ = before_run;
    Time begin_ = start_of_run;
    bool is_counting_ = false;
    // Number of events of each node since begin_; empty while no events are counted.
    std::vector<std::uint32_t> counts_;

    static constexpr Time before_run = start_of_run - Duration{1'000'000'000};
};

}  // namespace rovernet
