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
/// The clock is checked once in `most_events` events. If simulated time has grown by less than
/// `growth` since the last check, the events of each robot are counted until it has.
class Liveness {
  public:
    /// Largest number of events of one robot within the simulated time `growth`.
    static constexpr std::uint64_t most_events = 100'000;

    /// @param growth  shortest simulated time [ns] that most_events events of one robot may take
    explicit Liveness(Duration growth) : growth_(growth) {}

    /// Checks how far simulated time has grown; called after every `most_events` events of all
    /// robots.
    void look(Time now) {
        if (now - last_look_ < growth_) begin_ = now, is_counting_ = true;
        last_look_ = now;
    }
    /// Whether the events of robots have to be counted now.
    bool is_counting(Time now) {
        if (is_counting_ && now - begin_ >= growth_) {
            is_counting_ = false;
            counts_ = {};
        }
        return is_counting_;
    }
    /// Counts an event of a robot, while is_counting(). @return whether the robot has had too many
    bool is_stuck(NodeId node) {
        if (counts_.size() <= node.index()) counts_.resize(node.index() + 1);
        return ++counts_[node.index()] >= most_events;
    }

  private:
    Duration growth_;
    Time last_look_ = before_run;
    Time begin_ = start_of_run;
    bool is_counting_ = false;
    // Number of events by node since begin_; empty while nothing is counted.
    std::vector<std::uint32_t> counts_;

    static constexpr Time before_run = start_of_run - Duration{1'000'000'000};
};

}  // namespace rovernet
