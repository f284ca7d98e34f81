// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <utility>

namespace rovernet {

/// Header fields of each answer of a web server that opens no WebSocket: browsers keep no copy of
/// the page, show the page in no frame of another page, and give the data of the run to no other
/// page.
inline constexpr std::array<std::pair<const char*, const char*>, 6> page_fields{{
    {"Connection", "close"},
    {"Cache-Control", "no-store"},
    {"X-Content-Type-Options", "nosniff"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"X-Frame-Options", "DENY"},
}};

/// Sets page_fields in a response of HTTP.
/// @param policy  value of the field Content-Security-Policy; empty: the response has no such field
template <class Response>
void set_page_fields(Response& response, const std::string& policy) {
    for (const auto& [name, value] : page_fields) response.set(name, value);
    if (!policy.empty()) response.set("Content-Security-Policy", policy);
}

}  // namespace rovernet
