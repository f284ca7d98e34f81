// SPDX-License-Identifier: MIT
#include "models/radio.hpp"

namespace rovernet {

Duration airtime(const Radio& radio, std::uint32_t bytes) {
    return radio.preamble + from_seconds(8.0 * bytes / radio.rate.value);
}

}  // namespace rovernet
