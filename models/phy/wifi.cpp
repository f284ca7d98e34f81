// SPDX-License-Identifier: MIT
#include "models/phy/wifi.hpp"

#include "models/phy/error_rate.hpp"

#include <cmath>

namespace rovernet {

std::span<const BitRate> rates_of(WifiStandard standard) {
    const auto all = modulated_rates();
    constexpr auto dsss = static_cast<std::size_t>(Modulation::ofdm_6);  // those before
    switch (standard) {
        case WifiStandard::a: return all.subspan(dsss);
        case WifiStandard::b: return all.first(dsss);
        case WifiStandard::g: break;
    }
    return all;
}

Duration wifi_airtime(WifiStandard standard, Duration preamble, BitRate rate, std::uint32_t bytes) {
    using namespace std::chrono_literals;
    const double bits = 8.0 * bytes;
    if (standard == WifiStandard::b) {
        const auto us = static_cast<std::int64_t>(std::ceil(1e6 * bits / rate.value - 1e-9));
        return preamble + std::chrono::microseconds{us};
    }
    constexpr double service_and_tail = 16 + 6;  // [bits]
    const double bits_per_symbol = rate.value * 4e-6;
    const auto symbols =
        static_cast<std::int64_t>(std::ceil((service_and_tail + bits) / bits_per_symbol - 1e-9));
    const Duration extension = standard == WifiStandard::g ? Duration{6us} : Duration{0};
    return preamble + symbols * 4us + extension;
}

Transmission Wifi::transmission(const Radio& radio, BitRate rate, std::uint32_t bytes) const {
    constexpr Duration none{0};
    return {.rate = rate,
            .coding = coding(rate).value_or(Coding{}),
            .bandwidth = radio.bandwidth,
            .preamble = radio.preamble,
            .payload = framing ? wifi_airtime(*framing, none, rate, bytes)
                               : from_seconds(8.0 * bytes / rate.value),
            .bytes = bytes};
}

std::span<const BitRate> Wifi::rates() const { return modulated_rates(); }

std::optional<Coding> Wifi::coding(BitRate rate) const {
    const auto modulation = modulation_of(rate);
    if (!modulation) return std::nullopt;
    return static_cast<Coding>(*modulation);
}

double Wifi::log_success(Coding coding, double sinr) const {
    return rovernet::log_success(static_cast<Modulation>(coding), sinr);
}

Db Wifi::certain_sinr(Coding coding) const {
    return rovernet::certain_sinr(static_cast<Modulation>(coding));
}

}  // namespace rovernet
