// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "sim/units.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Numbers with units, as a scenario file writes them: "2450 MHz". All quantities are kept in the
// base unit of their dimension. The table of units is in quantity.cpp.

namespace rovernet {

/// Physical dimension of a quantity, which determines its valid units. A new dimension needs its
/// units, an example and a largest value in quantity.cpp.
enum class Dimension {
    /// Level of a power: dBm; mW, W and uW are converted.
    power,
    /// Power ratio, such as a gain or a loss: dB, dBi.
    gain,
    /// Frequency: Hz, kHz, MHz, GHz.
    frequency,
    /// Length: m, km, cm, mm.
    length,
    /// Speed: m/s, km/h.
    speed,
    /// Time: s, ms, us, ns, min, h.
    time,
    /// Bit rate: b/s, kb/s, Mb/s, Gb/s; also written bit/s, kbit/s, Mbit/s.
    bit_rate,
    /// Size: B, kB, MB, GB (powers of 1000); KiB, MiB, GiB (powers of 1024).
    size,
    /// Angle: deg, rad.
    angle,
    /// Turn rate: deg/s, rad/s.
    turn_rate,
    /// Attenuation: dB/m, dB/cm.
    attenuation
};

/// Dimension of a C++ quantity type, given as an argument of that type.
constexpr Dimension dimension_of(Dbm) { return Dimension::power; }
constexpr Dimension dimension_of(Db) { return Dimension::gain; }
constexpr Dimension dimension_of(Hertz) { return Dimension::frequency; }
constexpr Dimension dimension_of(Meters) { return Dimension::length; }
constexpr Dimension dimension_of(MetersPerSecond) { return Dimension::speed; }
constexpr Dimension dimension_of(BitRate) { return Dimension::bit_rate; }
constexpr Dimension dimension_of(Radians) { return Dimension::angle; }
constexpr Dimension dimension_of(RadiansPerSecond) { return Dimension::turn_rate; }
constexpr Dimension dimension_of(DbPerMeter) { return Dimension::attenuation; }

/// Concept of a C++ quantity type: dimension_of() is defined for values of the type.
template <class T>
concept IsQuantity = requires(T v) {
    dimension_of(v);
};

/// Number of a quantity such as "2450 MHz" in the dimension's base unit: dBm, dB, Hz, m, m/s, s,
/// bit/s, bytes, rad, rad/s, dB/m. A power in mW, uW or W becomes a level in dBm.
///
/// A bare number is an error in a file; from the command line it is in SI units (a power in watts).
/// A number so large that sums may overflow is an error, too.
///
/// @param value  text with number and unit, or a number
/// @param key    name of the value's key, for the error message
/// @throws InputError at the value; the message names the text found, the possible units and a
/// suggestion
double read_quantity(const Value& value, std::string_view key, Dimension dimension);

/// Regular expression of the texts that read_quantity() accepts for a dimension. A power in W, mW
/// or uW must be more than zero, because it is converted to dBm. A size in bytes must be a whole
/// number.
/// @param any_sign  false: no text with a minus sign
std::string quantity_pattern(Dimension dimension, bool any_sign);

/// Name of a dimension's base unit: "dBm", "m", "s" ...
std::string_view base_unit(Dimension dimension);

/// First dimension in which all texts are valid quantities; empty if no dimension fits. Pictures
/// use the dimension to decide whether the values of a key can be drawn on an axis.
std::optional<Dimension> shared_dimension(const std::vector<std::string>& texts);

/// Text of a quantity: "5 m", "25 cm". read_quantity() reads the same number from the text. The
/// unit is the first one, in the dimension's list of units in quantity.cpp, in which the number is
/// whole and reads back exactly. If no unit fits, the base unit is used.
/// @param value  number in the base unit
std::string quantity_text(double value, Dimension dimension);
/// List of bit rates as numbers in Mbit/s, without the unit: "1, 2, 5.5, 11".
std::string megabits_text(std::span<const BitRate> rates);

}  // namespace rovernet
