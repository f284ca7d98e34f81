// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"

#include <algorithm>
#include <cstdint>

namespace rovernet {

/// How far a run was behind its clock: at each simulated time for which a front had asked, and
/// whenever it looked at its clients later than it meant to. Programs outside take that for a delay
/// of the radio.
struct Lateness {
    static constexpr Duration much{1'000'000};  ///< 1 ms

    Duration most{0};         ///< largest, of real time
    std::uint64_t times = 0;  ///< that fronts had asked for; and looks that came late
    std::uint64_t late = 0;   ///< of those: later than `much`

    void add(Duration behind) {
        most = std::max(most, behind);
        ++times;
        if (behind > much) ++late;
    }
    /// Adds a look at the clients. One that came in time is no time that anybody had asked for.
    void add_look(Duration behind) {
        if (behind > much) return add(behind);
        most = std::max(most, behind);
    }
    /// Share of the times that were later than `much` [-].
    double share() const {
        return times == 0 ? 0 : static_cast<double>(late) / static_cast<double>(times);
    }
};

}  // namespace rovernet
