// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <utility>

namespace rovernet {

/// Clock of a run that follows real time. The clock shows simulated time; its speed is the ratio of
/// simulated time to real time [-], and may change during the run. Without a speed, the clock does
/// not limit the run.
class RunClock {
  public:
    using Real = std::chrono::steady_clock;

    /// @param real   reads real time
    /// @param speed  ratio of simulated time to real time [-]
    RunClock(const std::function<Real::time_point()>& real, std::optional<double> speed)
        : real_(real), speed_(speed) {}

    /// Whether the clock limits the run.
    bool paces() const { return speed_.has_value(); }
    /// Present time, at most `end`; `never` without a speed.
    Time now(Time end) const {
        if (!speed_) return never;
        const std::chrono::duration<double> wall = real_() - started_;
        return start_of_run + from_seconds(std::min(wall.count() * *speed_, seconds(end)));
    }
    /// Sets the clock to the time `t`.
    void set(Time t) {
        started_ = real_();
        if (speed_) started_ -= std::chrono::duration_cast<Real::duration>(real_time(t));
    }
    /// Sets the clock to the time `t`, and changes its speed from then on.
    void set_speed(std::optional<double> speed, Time t) {
        speed_ = speed;
        set(t);
    }
    /// Real time that has passed since the clock showed `t`; negative if the clock has not reached
    /// `t` yet. To be called only if the clock has a speed.
    Duration since(Time t) const { return real_() - started_ - real_time(t); }
    /// Real time that a simulated duration takes. To be called only if the clock has a speed.
    Duration real_time(Duration simulated) const {
        return from_seconds(seconds(simulated) / *speed_);
    }
    /// Simulated time that passes in a real duration, at most until `end`. To be called only if the
    /// clock has a speed.
    Duration simulated(Duration real, Time end) const {
        return from_seconds(std::min(seconds(real) * *speed_, seconds(end)));
    }

  private:
    Duration real_time(Time t) const { return real_time(t - start_of_run); }

    std::function<Real::time_point()> real_;
    std::optional<double> speed_;
    Real::time_point started_;
};

}  // namespace rovernet
