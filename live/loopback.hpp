// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace rovernet {

/// Address of this machine that no other machine reaches.
struct Loopback {
    std::string host;  ///< "127.0.0.1" or "::1", say
    std::uint16_t port = 0;

    /// "127.0.0.1:7007", "[::1]:7007".
    std::string text() const;
};

/// Reads such an address: "127.0.0.1:7007", "localhost:0" or "[::1]:7007".
/// @throws std::invalid_argument for any other: who comes in there could be anybody
Loopback read_loopback(const std::string& text);

}  // namespace rovernet
