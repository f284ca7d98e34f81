// SPDX-License-Identifier: MIT
#include "models/phy/chirp.hpp"

#include <chrono>

namespace rovernet {
namespace {

using namespace std::chrono_literals;
constexpr std::array<BitRate, 2> known{{{1000}, {8000}}};
constexpr Coding slow{0};

}  // namespace

Transmission Chirp::transmission(const Radio& radio, BitRate rate, std::uint32_t bytes) const {
    const Coding coding = this->coding(rate).value_or(slow);
    return {.rate = rate,
            .coding = coding,
            .bandwidth = radio.bandwidth,
            .preamble = coding == slow ? 80ms : 10ms,
            .payload = from_seconds(8.0 * bytes / rate.value),
            .bytes = bytes};
}
std::span<const BitRate> Chirp::rates() const { return known; }
std::optional<Coding> Chirp::coding(BitRate rate) const {
    for (std::uint8_t i = 0; i < known.size(); ++i) {
        if (known[i] == rate) return Coding{i};
    }
    return std::nullopt;
}
double Chirp::log_success(Coding, double sinr) const { return sinr > 0.1 ? 0 : -1; }
Db Chirp::certain_sinr(Coding) const { return Db{-10}; }
Dbm Chirp::sensitivity(const Radio& radio, Coding coding) const {
    return coding == slow ? radio.sensitivity - Db{10} : radio.sensitivity;
}
double Chirp::rejection(Coding wanted, Coding other) const {
    return wanted == other ? 1 : rejection_of_other;
}
PreambleDetection Chirp::preamble_detection(Coding coding) const {
    return {coding == slow ? 40ms : 5ms, Db{-10}};
}

}  // namespace rovernet
