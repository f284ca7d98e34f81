// SPDX-License-Identifier: MIT
#include "models/radio.hpp"

#include "sim/math.hpp"

namespace rovernet {

Dbm noise_floor(Hertz bandwidth, Db noise_figure) {
    constexpr double thermal = -173.97518719422808;  // 10 log10(k 290 K / 1 mW), per hertz
    return Dbm{thermal + 10 * math::log10(bandwidth.value)} + noise_figure;
}

Dbm noise_floor(const Radio& radio) { return noise_floor(radio.bandwidth, radio.noise_figure); }

}  // namespace rovernet
