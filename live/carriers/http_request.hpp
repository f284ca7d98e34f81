// SPDX-License-Identifier: MIT
#pragma once

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

// Validation of requests to a web server: pages and handshakes of WebSockets.

namespace rovernet {

using HttpRequest = boost::beast::http::request<boost::beast::http::empty_body>;

inline bool is_base64(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' ||
           c == '/';
}

/// Text of a field or target of a request.
inline std::string_view text_of(boost::string_view view) { return {view.data(), view.size()}; }

/// Error of a request, independent of the client; empty if valid.
inline std::string fault_of(const HttpRequest& request) {
    namespace http = boost::beast::http;
    const auto& fields = request.base();
    // RFC 9112, 3.2: exactly one Host. RFC 6455, 11.3: neither field of the handshake twice; 10.2
    // trusts the one Origin.
    const std::size_t hosts = fields.count(http::field::host);
    if (hosts > 1 || (hosts == 0 && request.version() >= 11)) return "expected one header Host";
    for (const http::field each : {http::field::origin, http::field::sec_websocket_key,
                                   http::field::sec_websocket_version}) {
        if (fields.count(each) <= 1) continue;
        return fmt::format("expected one header {}", text_of(http::to_string(each)));
    }
    if (!boost::beast::websocket::is_upgrade(request)) return {};
    // RFC 6455, 4.1: the base64 of 16 bytes.
    constexpr std::string_view ending = "==";
    constexpr std::size_t letters = 22;  // 16 bytes in 6 bits each
    const auto field = fields[http::field::sec_websocket_key];
    const std::string_view key(field.data(), field.size());
    const bool is_key = key.size() == letters + ending.size() && key.ends_with(ending) &&
                        std::all_of(key.begin(), key.begin() + letters, is_base64);
    return is_key ? "" : "Sec-WebSocket-Key: expected 16 bytes in base64";
}

}  // namespace rovernet
