// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <vector>

namespace rovernet {

/// Watch over the growth of simulated time: it finds a robot whose events follow one another
/// without end while the clock all but stands, so that the run would never be over.
///
/// The clock is looked at once in `most_events` events. Only if it has grown less than `growth`
/// since, the events of each robot are counted, until it has.
class Liveness {
  public:
    /// Events of one robot within `growth` that are too many.
    static constexpr std::uint64_t most_events = 100'000;

    /// @param growth  time that so many events of one robot take at least [ns]
    explicit Liveness(Duration growth) : growth_(growth) {}

    /// Looks at the clock, after `most_events` more events of all robots.
    void look(Time now) {
        if (now - last_look_ < growth_) begin_ = now, is_counting_ = true;
        last_look_ = now;
    }
    /// Whether the events of robots have to be counted.
    bool is_counting(Time now) {
        if (is_counting_ && now - begin_ >= growth_) {
            is_counting_ = false;
            counts_ = {};
        }
        return is_counting_;
    }
    /// Counts an event of a robot, while is_counting(). @return whether it has had too many
    bool is_stuck(NodeId node) {
        if (counts_.size() <= node.index()) counts_.resize(node.index() + 1);
        return ++counts_[node.index()] >= most_events;
    }

  private:
    Duration growth_;
    Time last_look_ = before_run;
    Time begin_ = start_of_run;
    bool is_counting_ = false;
    // Events by node since begin_; empty while nothing is counted.
    std::vector<std::uint32_t> counts_;

    static constexpr Time before_run = start_of_run - Duration{1'000'000'000};
};

}  // namespace rovernet
