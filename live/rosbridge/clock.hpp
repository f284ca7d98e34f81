// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/front.hpp"
#include "live/rosbridge/request.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <optional>
#include <set>
#include <vector>

namespace rovernet {

/// Control of simulated time by ROS clients: pause, unpause, and steps. The class does not advance
/// time itself: its caller must not run beyond limit(), and passes the current time. Step calls are
/// stored here until the step has ended; the caller answers them.
///
/// A client that pauses or steps blocks time. Time continues when any client unpauses, or when the
/// last blocking client has left. Pause and unpause end all steps early.
class RosClock {
  public:
    using Connection = Front::Connection;

    /// Request of a ROS client for a step of simulated time, answered when the step has ended.
    struct Step {
        Connection client;
        RosOperation call;
        Time until;  ///< simulated time at which the step ends, >= its start
    };

    /// Number of unfinished steps of a client.
    std::size_t steps(Connection client) const;
    /// Starts a step: simulated time advances until the latest end of all steps, then stops.
    void begin(Step step);
    /// Pauses simulated time now, on behalf of a client.
    /// @return calls of steps that end early because of the pause, the oldest first
    std::vector<Step> pause(Connection client, Time now);
    /// Lets simulated time continue, even if several clients block it.
    /// @return calls of steps that end early because time continues, the oldest first
    std::vector<Step> unpause();
    /// Handles a client that has left. The client's calls are dropped. Its steps continue, since
    /// other clients may wait for the steps' end. Time continues if no other client blocks it.
    /// @return calls of steps that end early if time continues, the oldest first; otherwise empty
    std::vector<Step> left(Connection client);
    /// Ends the steps whose end is reached at time `now`.
    /// @return calls of the ended steps, the oldest first
    std::vector<Step> end_steps(Time now);

    /// Whether a step ends at time `now`, and end_steps() has not ended it yet.
    bool is_step_end(Time now) const;
    /// Simulated time at which the next step ends; `never` if no step is unfinished.
    Time next() const;
    /// Simulated time at which the run must stop; `never` if no client blocks time.
    Time limit() const { return limit_; }

  private:
    std::vector<Step> steps_;        // unfinished steps
    std::optional<Time> of_nobody_;  // last end of the steps of clients that have left
    std::set<Connection> holders_;   // clients that block time by a pause or a step
    Time limit_ = never;
};

}  // namespace rovernet
