// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstdint>

// Physical quantities as separate types: the compiler rejects a gain used as a level, or a distance
// as a frequency. Each has one double, `value`, in the unit of its name, at no extra cost.
//
//     const Dbm received = 16_dBm + 3_dB - 92_dB;   // a level and ratios: -73 dBm
//     const Db margin = received - Dbm{-75};        // two levels: 2 dB
//     const double share = Meters{30} / Meters{60};  // two lengths: 0.5

namespace rovernet {

/// Physical quantity. Only quantities of the same kind can be added; a number times a quantity is a
/// quantity; the ratio of two quantities of one kind is a number.
/// @tparam Unit  type that only names the unit
template <class Unit>
struct Quantity {
    double value = 0;

    /// Comparison, sum, difference and ratio of quantities of one kind; product with a number.
    friend constexpr auto operator<=>(Quantity, Quantity) = default;
    friend constexpr Quantity operator+(Quantity a, Quantity b) { return {a.value + b.value}; }
    friend constexpr Quantity operator-(Quantity a, Quantity b) { return {a.value - b.value}; }
    friend constexpr Quantity operator-(Quantity a) { return {-a.value}; }
    friend constexpr Quantity operator*(double s, Quantity a) { return {s * a.value}; }
    friend constexpr double operator/(Quantity a, Quantity b) { return a.value / b.value; }
};

/// Ratio of two powers [dB]: a gain, or a loss if subtracted.
using Db = Quantity<struct DecibelUnit>;
/// Attenuation [dB/m].
using DbPerMeter = Quantity<struct AttenuationUnit>;
/// Power [mW]; powers of several signals add.
using MilliWatts = Quantity<struct MilliWattUnit>;
/// Frequency or bandwidth [Hz].
using Hertz = Quantity<struct HertzUnit>;
/// Length [m].
using Meters = Quantity<struct MeterUnit>;
/// Speed [m/s].
using MetersPerSecond = Quantity<struct SpeedUnit>;
/// Angle or heading [rad], counter-clockwise from the x axis.
using Radians = Quantity<struct RadianUnit>;
/// Turn rate [rad/s], counter-clockwise.
using RadiansPerSecond = Quantity<struct TurnRateUnit>;
/// Rate of data on air [bit/s].
using BitRate = Quantity<struct BitsPerSecondUnit>;

/// Power level [dBm]: 10 log10 of the power in mW. `Dbm + Dbm` does not compile: to add two powers,
/// add their MilliWatts. `Dbm - Dbm` is a ratio [dB].
struct Dbm {
    double value = 0;

    /// Comparison of levels; level plus gain; level minus loss; ratio of two levels; negative
    /// level.
    friend constexpr auto operator<=>(Dbm, Dbm) = default;
    friend constexpr Dbm operator+(Dbm level, Db gain) { return {level.value + gain.value}; }
    friend constexpr Dbm operator-(Dbm level, Db loss) { return {level.value - loss.value}; }
    friend constexpr Db operator-(Dbm a, Dbm b) { return {a.value - b.value}; }
    friend constexpr Dbm operator-(Dbm level) { return {-level.value}; }
};

/// Level of a power: 10 log10(p / 1 mW); 1 mW is 0 dBm, 45 mW are 16.53 dBm.
/// @throws std::invalid_argument unless p > 0
Dbm to_dbm(MilliWatts p);

/// Speed of light in vacuum [m/s], exact by definition of the metre.
inline constexpr double speed_of_light = 299'792'458;

/// Literals for parameters in code: 15_dBm, 3.5_dB, 250_m, 2450_MHz, 11_Mbps.
inline namespace literals {
/// Level [dBm], with or without a decimal point.
constexpr Dbm operator""_dBm(long double v) { return {static_cast<double>(v)}; }
constexpr Dbm operator""_dBm(unsigned long long v) { return {static_cast<double>(v)}; }
/// Ratio [dB].
constexpr Db operator""_dB(long double v) { return {static_cast<double>(v)}; }
constexpr Db operator""_dB(unsigned long long v) { return {static_cast<double>(v)}; }
/// Length [m].
constexpr Meters operator""_m(long double v) { return {static_cast<double>(v)}; }
constexpr Meters operator""_m(unsigned long long v) { return {static_cast<double>(v)}; }
/// Frequency, written in MHz, stored in Hz.
constexpr Hertz operator""_MHz(long double v) { return {static_cast<double>(v) * 1e6}; }
constexpr Hertz operator""_MHz(unsigned long long v) { return {static_cast<double>(v) * 1e6}; }
/// Bit rate, written in Mbit/s, stored in bit/s.
constexpr BitRate operator""_Mbps(long double v) { return {static_cast<double>(v) * 1e6}; }
constexpr BitRate operator""_Mbps(unsigned long long v) { return {static_cast<double>(v) * 1e6}; }
}  // namespace literals

/// Size of a message or a header [bytes], at most 1 MB in a file.
struct Bytes {
    std::uint32_t value = 0;

    constexpr Bytes() = default;
    constexpr Bytes(std::uint32_t bytes) : value(bytes) {}
    friend bool operator==(Bytes, Bytes) = default;
};

}  // namespace rovernet
