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
        return set_to_ + simulated(real_() - set_at_, end);
    }
    /// Sets the clock to the time `t`.
    void set(Time t) {
        set_at_ = real_();
        set_to_ = t;
    }
    /// Sets the clock to the time `t`, and changes its speed from then on.
    void set_speed(std::optional<double> speed, Time t) {
        speed_ = speed;
        set(t);
    }
    /// Real time that has passed since the clock showed `t`; negative if the clock has not reached
    /// `t` yet. To be called only if the clock has a speed.
    Duration since(Time t) const { return real_() - set_at_ - real_time(t - set_to_); }
    /// Real time that a simulated duration takes, at most 31 years. To be called only if the clock
    /// has a speed.
    Duration real_time(Duration simulated) const {
        constexpr double longest = 1e9;  // [s]
        return from_seconds(std::clamp(seconds(simulated) / *speed_, -longest, longest));
    }
    /// Simulated time that passes in a real duration, at most from the time of set() until `end`.
    /// To be called only if the clock has a speed.
    Duration simulated(Duration real, Time end) const {
        return from_seconds(std::min(seconds(real) * *speed_, seconds(end - set_to_)));
    }

  private:
    std::function<Real::time_point()> real_;
    std::optional<double> speed_;
    Real::time_point set_at_;     // real time of the last set()
    Time set_to_ = start_of_run;  // time that the clock showed then
};

}  // namespace rovernet
