// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace rovernet {

/// Address of this machine on which a server listens.
struct Address {
    std::string host;  ///< numeric IP address: "127.0.0.1", "::1", "0.0.0.0"
    std::uint16_t port = 0;

    /// Text of the address: "127.0.0.1:7007", "[::1]:7007".
    std::string text() const;
    /// Whether only this machine can reach the address.
    bool is_loopback() const;
};

/// Reads a loopback address, which only this machine can reach: "127.0.0.1:7007", "localhost:0",
/// "[::1]:7007".
/// @throws std::invalid_argument for an address that other machines can reach, or for other text
Address read_loopback(const std::string& text);

/// Reads the host of an address, loopback or not: "0.0.0.0", "192.168.1.5", "[::]".
/// @return host without brackets
/// @throws std::invalid_argument for a host name
std::string read_host(const std::string& text);

}  // namespace rovernet
