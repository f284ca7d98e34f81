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

/// Clock of a run as ROS clients control it: they pause simulated time, let it go on, or let it go
/// on by steps. It does not run by itself: who serves the run keeps to limit(), and tells the time.
/// Calls of steps wait here; whoever gets them back answers them.
///
/// A client that pauses time or steps holds it. Time goes on when any client unpauses it, or when
/// the last client that held it has left. A pause and its end overtake all steps: these are over.
class RosClock {
  public:
    using Connection = Front::Connection;

    /// Call of a step, which is answered when the step is over.
    struct Step {
        Connection client;
        RosOperation call;
        Time until;  ///< end of the step, not before the time at which it begins
    };

    /// Number of a client's steps that are not over.
    std::size_t steps(Connection client) const;
    /// Begins a step: time goes on until its end, or until that of a longer one, and stands still.
    void begin(Step step);
    /// Stops time now, for a client.
    /// @return calls of steps that it overtakes, the oldest first
    std::vector<Step> pause(Connection client, Time now);
    /// Lets time go on, whoever holds it.
    /// @return calls of steps that it overtakes, the oldest first
    std::vector<Step> unpause();
    /// A client has left. Its steps are not over, as other clients may wait for the end of the last
    /// one; its calls are forgotten.
    /// @return as unpause(), if that lets time go on; none otherwise
    std::vector<Step> left(Connection client);
    /// Ends the steps that do not go on beyond now.
    /// @return their calls, the oldest first
    std::vector<Step> end_steps(Time now);

    /// Whether a step goes on until now, and end_steps() has not ended it yet.
    bool is_step_end(Time now) const;
    /// Time at which the next step ends; `never` if there is none.
    Time next() const;
    /// Time at which the run has to stop; `never` if nobody holds it.
    Time limit() const { return limit_; }

  private:
    std::vector<Step> steps_;        // those that are not over
    std::optional<Time> of_nobody_;  // end of the last step whose client has left
    std::set<Connection> holders_;   // clients that have paused time, or stepped
    Time limit_ = never;
};

}  // namespace rovernet
