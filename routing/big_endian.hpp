// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

// Big-endian numbers in packets of routing protocols. The caller checks that each number lies
// within the packet.

namespace rovernet::big_endian {

/// Appends `value` to a packet as a big-endian number of `bytes` bytes.
inline void put(std::string& to, std::uint32_t value, std::size_t bytes = 4) {
    for (std::size_t i = bytes; i-- > 0;) to.push_back(static_cast<char>(value >> (8 * i)));
}
/// Big-endian number of `bytes` bytes in a packet, from byte `at` on (index from 0).
inline std::uint32_t get(std::string_view from, std::size_t at, std::size_t bytes = 4) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i)
        value = value << 8 | static_cast<std::uint8_t>(from[at + i]);
    return value;
}
/// Replaces four bytes of a packet, from byte `at` on (index from 0), by the big-endian `value`.
inline void set(std::string& in, std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) in[at + i] = static_cast<char>(value >> (24 - 8 * i));
}

}  // namespace rovernet::big_endian
