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

/// Dimension of a quantity: what it measures, and so the units that it may carry. A new one needs
/// its units, an example and a largest value in quantity.cpp.
enum class Dimension {
    /// Level of a power: dBm; mW, W and uW are converted.
    power,
    /// Ratio: dB, dBi.
    gain,
    /// Hz, kHz, MHz, GHz.
    frequency,
    /// m, km, cm, mm.
    length,
    /// m/s, km/h.
    speed,
    /// s, ms, us, ns, min, h.
    time,
    /// b/s, kb/s, Mb/s, Gb/s; bit/s, kbit/s and Mbit/s are the same.
    bit_rate,
    /// B, kB, MB, GB of powers of 1000; KiB, MiB, GiB of 1024.
    size,
    /// deg, rad.
    angle,
    /// deg/s, rad/s.
    turn_rate,
    /// dB/m, dB/cm.
    attenuation
};

/// Number of a quantity such as "2450 MHz" in the dimension's base unit: dBm, dB, Hz, m, m/s, s,
/// bit/s, bytes, rad, rad/s, dB/m. A power in mW, uW or W becomes a level in dBm.
///
/// A bare number is an error in a file; from the command line it is in SI units (a power in watts).
/// Numbers so large that sums of them may overflow are errors, too.
///
/// @param value  text with number and unit, or a number
/// @param key    for the error
/// @throws InputError at the value saying what was found, which units are possible and what might
/// be meant
double read_quantity(const Value& value, std::string_view key, Dimension dimension);

/// Name of the base unit: "dBm", "m", "s" ...
std::string_view base_unit(Dimension dimension);

/// First dimension in which all these texts are quantities, if there is one. Pictures find out by
/// it whether the values of a key can stand on an axis.
std::optional<Dimension> shared_dimension(const std::vector<std::string>& texts);

/// Text of a quantity that reads back as the same number, in the first unit that makes it whole.
/// @param value  in the base unit
std::string quantity_text(double value, Dimension dimension);
/// Numbers of a list of bit rates in Mbit/s, without the unit: "1, 2, 5.5, 11".
std::string megabits_text(std::span<const BitRate> rates);

}  // namespace rovernet
