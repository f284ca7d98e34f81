// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"

#include <algorithm>
#include <cstdint>

namespace rovernet {

/// Delays of a paced run behind the clock, measured at each simulated time that a front (protocol
/// server) requested, and at each late poll of clients. External programs see this delay
/// as an additional delay of the radio.
struct Lateness {
    static constexpr Duration much{1'000'000};  ///< 1 ms: limit above which a delay counts as late

    Duration most{0};         ///< largest delay of the run behind the clock, in real time
    std::uint64_t times = 0;  ///< number of delays: one per requested time, one per late poll
    std::uint64_t late = 0;   ///< number of delays above `much`

    void add(Duration behind) {
        most = std::max(most, behind);
        ++times;
        if (behind > much) ++late;
    }
    /// Adds the delay of a poll of clients. A delay of at most `much` is not counted in `times`,
    /// since no front (protocol server) requested the poll.
    void add_look(Duration behind) {
        if (behind > much) return add(behind);
        most = std::max(most, behind);
    }
    /// Share of the measured delays that exceed `much` (1 ms) [-].
    double share() const {
        return times == 0 ? 0 : static_cast<double>(late) / static_cast<double>(times);
    }
};

}  // namespace rovernet
