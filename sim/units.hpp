// SPDX-License-Identifier: MIT
#pragma once

#include <compare>

// Quantities that the compiler tells apart: a gain is no level, a distance no frequency. Each holds
// one double, `value`, in the unit that its name says, and costs nothing beside it.
//
//     const Dbm received = 16_dBm + 3_dB - 92_dB;   // a level and ratios: -73 dBm
//     const Db margin = received - Dbm{-75};        // two levels: 2 dB
//     const double share = Meters{30} / Meters{60};  // two lengths: 0.5

namespace rovernet {

/// Physical quantity that adds to its own kind only. A multiple is a quantity; the ratio of two is
/// a number.
/// @tparam Unit  a type that only names the unit
template <class Unit>
struct Quantity {
    double value = 0;

    /// Comparisons, sums and differences within a kind; multiples; the ratio of two.
    friend constexpr auto operator<=>(Quantity, Quantity) = default;
    friend constexpr Quantity operator+(Quantity a, Quantity b) { return {a.value + b.value}; }
    friend constexpr Quantity operator-(Quantity a, Quantity b) { return {a.value - b.value}; }
    friend constexpr Quantity operator-(Quantity a) { return {-a.value}; }
    friend constexpr Quantity operator*(double s, Quantity a) { return {s * a.value}; }
    friend constexpr double operator/(Quantity a, Quantity b) { return a.value / b.value; }
};

/// Ratio of two powers [dB]: a gain, or a loss if it is subtracted.
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

/// Level of a power [dBm]: 10 log10 of it in mW. Levels do not add, and `Dbm + Dbm` does not
/// compile: the sum of two powers is that of their MilliWatts. `Dbm - Dbm` is a ratio [dB].
struct Dbm {
    double value = 0;

    /// Comparisons of levels; a gain or a loss added to one; the ratio of two; the negative level.
    friend constexpr auto operator<=>(Dbm, Dbm) = default;
    friend constexpr Dbm operator+(Dbm level, Db gain) { return {level.value + gain.value}; }
    friend constexpr Dbm operator-(Dbm level, Db loss) { return {level.value - loss.value}; }
    friend constexpr Db operator-(Dbm a, Dbm b) { return {a.value - b.value}; }
    friend constexpr Dbm operator-(Dbm level) { return {-level.value}; }
};

/// Level of a power: 10 log10(p / 1 mW); 1 mW is 0 dBm, 45 mW are 16.53 dBm.
/// @throws std::invalid_argument unless p > 0
Dbm to_dbm(MilliWatts p);
/// Power of a level: 10^(level / 10) mW.
MilliWatts to_milliwatts(Dbm level);

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
/// Frequency, given in MHz, kept in Hz.
constexpr Hertz operator""_MHz(long double v) { return {static_cast<double>(v) * 1e6}; }
constexpr Hertz operator""_MHz(unsigned long long v) { return {static_cast<double>(v) * 1e6}; }
/// Bit rate, given in Mbit/s, kept in bit/s.
constexpr BitRate operator""_Mbps(long double v) { return {static_cast<double>(v) * 1e6}; }
constexpr BitRate operator""_Mbps(unsigned long long v) { return {static_cast<double>(v) * 1e6}; }
}  // namespace literals

}  // namespace rovernet
