// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace rovernet {

/// What a program or a browser says when it asks for a WebSocket (RFC 6455, 4.1).
struct WebRequest {
    std::string_view target;                      ///< "/?token=0123..."
    std::string_view host;                        ///< "127.0.0.1:9090"
    std::optional<std::string_view> origin = {};  ///< whose page it is; a program says none
};

/// Rule of who may open a WebSocket at an address of this machine. At one that other machines
/// reach, it is who knows the token, which was told to the person who started the server. At one
/// that they do not reach, it is any program, and some pages:
///
/// A browser opens one for any page that it shows, also for one of another machine, and tells whose
/// page it is. So a page has to be this server's own, or to know the token. A page from a file has
/// the origin "null", as have others that hide theirs. The name in `Host` has to be this machine's:
/// another machine's name that leads here would make its pages the server's own.
class Admission {
  public:
    Admission(Address address, std::string token);

    /// Reason why a request is refused; empty if it may come in.
    std::string refusal(const WebRequest& request) const;

  private:
    Address address_;
    std::string token_;
};

/// 128 bits that nobody can guess, as 32 hexadecimal digits.
/// @throws RunError if the system gives none
std::string random_token();

}  // namespace rovernet
