// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace rovernet {

// Conversion of numbers to text, rounded like printf, but several times faster. Each function
// writes to `out` without a terminating zero, and returns the end of the text.

/// Largest number of bytes that any function of this file writes (%.2f of the largest double).
inline constexpr std::size_t longest_decimal = 320;

char* write_integer(char* out, std::uint64_t value);
/// Writes hexadecimal digits in lower case, without 0x.
char* write_hex(char* out, std::uint32_t value);

/// Writes a number with two decimals ("%.2f"). The exact binary value is rounded, ties to the even
/// digit.
char* write_fixed2(char* out, double value);

/// Writes a time [s] with 9 decimals, exactly.
char* write_seconds(char* out, Time time);
/// Writes a time [s] with 5 decimals. The exact value is rounded, ties to the even digit.
char* write_seconds5(char* out, Time time);
/// Writes a time [s] with as many decimals as the exact value needs: "10", "0.25".
char* write_seconds_short(char* out, Time time);

inline char* write_text(char* out, std::string_view text) {
    return out + text.copy(out, text.size());
}

}  // namespace rovernet
