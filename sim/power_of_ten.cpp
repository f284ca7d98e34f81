// SPDX-License-Identifier: MIT
#include "sim/power_of_ten.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <system_error>

namespace rovernet {

double times_power_of_ten(double number, int exponent) {
    if (exponent == 0 || !std::isfinite(number)) return number;
    std::array<char, 32> buffer{};
    const auto written = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number,
                                       std::chars_format::scientific);
    const std::string_view text(buffer.data(), written.ptr);
    const auto e = text.find('e');
    const std::size_t sign = text[e + 1] == '+' ? 1 : 0;  // from_chars takes no plus
    int own = 0;
    std::from_chars(text.data() + e + 1 + sign, text.data() + text.size(), own);
    const std::string moved = std::string(text.substr(0, e + 1)) + std::to_string(own + exponent);
    double out = 0;
    const auto read = std::from_chars(moved.data(), moved.data() + moved.size(), out);
    if (read.ec == std::errc{}) return out;
    return std::copysign(exponent > 0 ? HUGE_VAL : 0, number);
}

}  // namespace rovernet
