// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"

#include <algorithm>
#include <cstdint>

namespace rovernet {

/// Delay of a paced run behind the clock: at each simulated time that a front (protocol server)
/// requested, and at each late poll of clients. External programs see this delay as an additional
/// delay of the radio.
struct Lateness {
    static constexpr Duration much{1'000'000};  ///< 1 ms: limit above which delays are `late`

    Duration most{0};         ///< largest delay of the run behind the clock, in real time
    std::uint64_t times = 0;  ///< number of delays: at times requested by fronts, at late polls
    std::uint64_t late = 0;   ///< number of delays above `much`

    void add(Duration behind) {
        most = std::max(most, behind);
        ++times;
        if (behind > much) ++late;
    }
    /// Adds the delay of a poll of clients. Polls in time are not counted, since no front requested
    /// them.
    void add_look(Duration behind) {
        if (behind > much) return add(behind);
        most = std::max(most, behind);
    }
    /// Share of measured delays above `much` [-].
    double share() const {
        return times == 0 ? 0 : static_cast<double>(late) / static_cast<double>(times);
    }
};

}  // namespace rovernet
