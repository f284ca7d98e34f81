// SPDX-License-Identifier: MIT
#include "traces/ns2/decimal.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace rovernet {
namespace {

constexpr std::uint64_t second_in_ns = 1'000'000'000;

/// Writes exactly `digits` digits, with leading zeros.
char* write_padded(char* out, std::uint64_t value, int digits) {
    for (int i = digits; i-- > 0; value /= 10) out[i] = static_cast<char>('0' + value % 10);
    return out + digits;
}

/// Writes the sign of the time, and returns |time| [ns].
std::uint64_t magnitude(char*& out, Time time) {
    const auto ns = time.time_since_epoch().count();
    if (ns >= 0) return static_cast<std::uint64_t>(ns);
    *out++ = '-';
    return 0 - static_cast<std::uint64_t>(ns);
}

/// round(100 a), for 0 <= a < 2^52 / 100: the exact product, ties to even.
std::uint64_t hundredths(double a) {
    const double product = a * 100;
    const auto whole = static_cast<std::uint64_t>(product);
    // The distance to the tie is exact and a multiple of ulp(product), so the product's rounding
    // error only matters if the distance is zero.
    double beyond_tie = (product - static_cast<double>(whole)) - 0.5;
    if (beyond_tie == 0) beyond_tie = std::fma(a, 100.0, -product);
    const bool up = beyond_tie > 0 || (beyond_tie == 0 && whole % 2 == 1);
    return whole + (up ? 1 : 0);
}

}  // namespace

char* write_integer(char* out, std::uint64_t value) {
    constexpr int digits = 20;  // of 2^64
    return std::to_chars(out, out + digits, value).ptr;
}

char* write_hex(char* out, std::uint32_t value) {
    constexpr int digits = 8;
    return std::to_chars(out, out + digits, value, 16).ptr;
}

char* write_fixed2(char* out, double value) {
    constexpr double fast_below = 4e13;  // 2^52 / 100, about
    const double a = std::abs(value);
    if (!(a < fast_below)) return out + std::snprintf(out, longest_decimal, "%.2f", value);
    if (std::signbit(value)) *out++ = '-';
    const std::uint64_t n = hundredths(a);
    out = write_integer(out, n / 100);
    *out++ = '.';
    return write_padded(out, n % 100, 2);
}

char* write_seconds(char* out, Time time) {
    const std::uint64_t ns = magnitude(out, time);
    out = write_integer(out, ns / second_in_ns);
    *out++ = '.';
    return write_padded(out, ns % second_in_ns, 9);
}

char* write_seconds5(char* out, Time time) {
    constexpr std::uint64_t unit = 10'000;  // [ns]
    const std::uint64_t ns = magnitude(out, time);
    const std::uint64_t rest = ns % unit;
    std::uint64_t n = ns / unit;
    if (rest > unit / 2 || (rest == unit / 2 && n % 2 == 1)) ++n;
    out = write_integer(out, n / 100'000);
    *out++ = '.';
    return write_padded(out, n % 100'000, 5);
}

char* write_seconds_short(char* out, Time time) {
    out = write_seconds(out, time);
    while (out[-1] == '0') --out;
    return out[-1] == '.' ? out - 1 : out;
}

}  // namespace rovernet
