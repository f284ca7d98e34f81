// SPDX-License-Identifier: MIT
#include "models/access/csma.hpp"

#include <algorithm>

namespace rovernet {

WifiTiming Csma::timing() const {
    WifiTiming out = timing_of(standard);
    if (eifs == EifsRule::ns2) out = ns2_timing(out);
    out.slot = slot.value_or(out.slot);
    out.sifs = sifs.value_or(out.sifs);
    out.difs = difs.value_or(out.sifs + 2 * out.slot);
    out.cca_time = cca_time.value_or(out.cca_time);
    out.turnaround = turnaround.value_or(out.turnaround);
    out.rx_start_delay = rx_start_delay.value_or(out.rx_start_delay);
    out.cw_min = cw_min.value_or(out.cw_min);
    out.cw_max = std::max(cw_max.value_or(out.cw_max), out.cw_min);
    return out;
}

}  // namespace rovernet
