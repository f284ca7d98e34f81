// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace rovernet {

/// Fields of an HTTP request that opens a WebSocket (RFC 6455, 4.1).
struct WebRequest {
    std::string_view target;  ///< request target: "/?token=0123..."
    std::string_view host;    ///< header Host: "127.0.0.1:9090"
    /// Header Origin: site of the web page; none if the client is no browser.
    std::optional<std::string_view> origin = {};
};

/// Access rule for WebSockets at an address of this machine. If other machines can reach the
/// address, clients need the token, which is printed when the server starts. At a loopback address,
/// any program may connect, but a web page only if it comes from this server or has the token.
///
/// Reason: a browser opens WebSockets for pages of any site, and sends the page's origin. A page
/// from a file has the origin "null", like pages that hide their origin. The name in `Host` must
/// belong to this machine. Otherwise a foreign name that resolves to this machine would make
/// foreign pages look like pages of this server (DNS rebinding).
class Admission {
  public:
    Admission(Address address, std::string token);

    /// Reason to reject a request that opens a WebSocket; empty if it is accepted.
    std::string refusal(const WebRequest& request) const;
    /// Whether only programs of this machine reach the address.
    bool is_loopback() const { return address_.is_loopback(); }

  private:
    Address address_;
    std::string token_;
};

/// Random token of 128 bits, unpredictable, as 32 hexadecimal digits.
/// @throws RunError if the system provides no random numbers
std::string random_token();

}  // namespace rovernet
