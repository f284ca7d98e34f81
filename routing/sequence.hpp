// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

// Sequence numbers of routing protocols, which wrap around.

namespace rovernet {

/// Whether sequence number a is newer than b: their difference as a signed 32-bit number is
/// positive (RFC 3561, 6.1).
constexpr bool is_newer(std::uint32_t a, std::uint32_t b) {
    return static_cast<std::int32_t>(a - b) > 0;
}
/// Newer one of two sequence numbers.
constexpr std::uint32_t newest(std::uint32_t a, std::uint32_t b) { return is_newer(a, b) ? a : b; }

}  // namespace rovernet
