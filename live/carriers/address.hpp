// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace rovernet {

/// Address of this machine that a server listens on.
struct Address {
    std::string host;  ///< a number: "127.0.0.1", "::1", "0.0.0.0"
    std::uint16_t port = 0;

    /// "127.0.0.1:7007", "[::1]:7007".
    std::string text() const;
    /// No other machine reaches it.
    bool is_loopback() const;
};

/// Reads an address that no other machine reaches: "127.0.0.1:7007", "localhost:0", "[::1]:7007".
/// @throws std::invalid_argument for any other: who comes in there could be anybody
Address read_loopback(const std::string& text);

/// Reads the host of an address, whoever may reach it: "0.0.0.0", "192.168.1.5", "[::]".
/// @return it without brackets
/// @throws std::invalid_argument for a name
std::string read_host(const std::string& text);

}  // namespace rovernet
