// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

// Big-endian numbers in packets of routing protocols. The caller checks that they lie within.

namespace rovernet::big_endian {

/// Appends a number of `bytes` bytes.
inline void put(std::string& to, std::uint32_t value, std::size_t bytes = 4) {
    for (std::size_t i = bytes; i-- > 0;) to.push_back(static_cast<char>(value >> (8 * i)));
}
/// Number of `bytes` bytes from place `at` on.
inline std::uint32_t get(std::string_view from, std::size_t at, std::size_t bytes = 4) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i)
        value = value << 8 | static_cast<std::uint8_t>(from[at + i]);
    return value;
}
/// Replaces the four bytes from place `at` on.
inline void set(std::string& in, std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) in[at + i] = static_cast<char>(value >> (24 - 8 * i));
}

}  // namespace rovernet::big_endian
