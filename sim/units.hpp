// SPDX-License-Identifier: MIT
#pragma once

#include <compare>

namespace rovernet {

/// A physical quantity that adds to its own kind only. `value` is in the unit that the name says.
template <class Unit>
struct Quantity {
    double value = 0;

    friend constexpr auto operator<=>(Quantity, Quantity) = default;
    friend constexpr Quantity operator+(Quantity a, Quantity b) { return {a.value + b.value}; }
    friend constexpr Quantity operator-(Quantity a, Quantity b) { return {a.value - b.value}; }
    friend constexpr Quantity operator-(Quantity a) { return {-a.value}; }
    friend constexpr Quantity operator*(double s, Quantity a) { return {s * a.value}; }
    friend constexpr double operator/(Quantity a, Quantity b) { return a.value / b.value; }
};

using Db = Quantity<struct DecibelUnit>;              ///< [dB], a ratio
using DbPerMeter = Quantity<struct AttenuationUnit>;  ///< [dB/m]
using MilliWatts = Quantity<struct MilliWattUnit>;    ///< [mW]
using Hertz = Quantity<struct HertzUnit>;             ///< [Hz]
using Meters = Quantity<struct MeterUnit>;            ///< [m]
using MetersPerSecond = Quantity<struct SpeedUnit>;   ///< [m/s]
using Radians = Quantity<struct RadianUnit>;          ///< [rad], counter-clockwise from the x axis
using RadiansPerSecond = Quantity<struct TurnRateUnit>;  ///< [rad/s]
using BitRate = Quantity<struct BitsPerSecondUnit>;      ///< [bit/s]

/// A power level [dBm]. Levels do not add: `Dbm + Dbm` does not compile, `Dbm - Dbm` is a ratio.
struct Dbm {
    double value = 0;

    friend constexpr auto operator<=>(Dbm, Dbm) = default;
    friend constexpr Dbm operator+(Dbm level, Db gain) { return {level.value + gain.value}; }
    friend constexpr Dbm operator-(Dbm level, Db loss) { return {level.value - loss.value}; }
    friend constexpr Db operator-(Dbm a, Dbm b) { return {a.value - b.value}; }
    friend constexpr Dbm operator-(Dbm level) { return {-level.value}; }
};

/// Power as a level: 10 log10(p / 1 mW). @throws std::invalid_argument unless p > 0
Dbm to_dbm(MilliWatts p);
/// A level as a power: 10^(level / 10) mW.
MilliWatts to_milliwatts(Dbm level);

inline constexpr double speed_of_light = 299'792'458;  ///< [m/s], exact by definition of the metre

inline namespace literals {
constexpr Dbm operator""_dBm(long double v) { return {static_cast<double>(v)}; }
constexpr Dbm operator""_dBm(unsigned long long v) { return {static_cast<double>(v)}; }
constexpr Db operator""_dB(long double v) { return {static_cast<double>(v)}; }
constexpr Db operator""_dB(unsigned long long v) { return {static_cast<double>(v)}; }
constexpr Meters operator""_m(long double v) { return {static_cast<double>(v)}; }
constexpr Meters operator""_m(unsigned long long v) { return {static_cast<double>(v)}; }
constexpr Hertz operator""_MHz(long double v) { return {static_cast<double>(v) * 1e6}; }
constexpr Hertz operator""_MHz(unsigned long long v) { return {static_cast<double>(v) * 1e6}; }
constexpr BitRate operator""_Mbps(long double v) { return {static_cast<double>(v) * 1e6}; }
constexpr BitRate operator""_Mbps(unsigned long long v) { return {static_cast<double>(v) * 1e6}; }
}  // namespace literals

}  // namespace rovernet
