// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/value.hpp"
#include "sim/units.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// What a quantity measures, and so the units it may carry.
enum class Dimension {
    power,
    gain,
    frequency,
    length,
    speed,
    time,
    bit_rate,
    size,
    angle,
    turn_rate,
    attenuation
};

/// A number with its unit, such as "2450 MHz", in the dimension's base unit: dBm, dB, Hz, m, m/s,
/// s, bit/s, bytes, rad, rad/s, dB/m. A bare number is an error in a file; from the command line it
/// is in SI units (a power in watts).
/// @throws InputError saying what was found, which units are possible and what might be meant
double read_quantity(const Value& value, std::string_view key, Dimension dimension);

/// The base unit's name.
std::string_view base_unit(Dimension dimension);

/// The dimension in which all these texts are quantities, if there is one.
std::optional<Dimension> shared_dimension(const std::vector<std::string>& texts);

/// The quantity [base unit] as a text that reads back as the same number.
std::string quantity_text(double value, Dimension dimension);

}  // namespace rovernet
