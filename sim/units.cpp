// SPDX-License-Identifier: MIT
#include "sim/units.hpp"

#include "sim/math.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace rovernet {

Dbm to_dbm(MilliWatts p) {
    if (!(p.value > 0)) {
        throw std::invalid_argument(fmt::format("power must be > 0 mW, got {} mW", p.value));
    }
    return {10 * math::log10(p.value)};
}

}  // namespace rovernet
