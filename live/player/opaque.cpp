// SPDX-License-Identifier: MIT
#include "live/player/opaque.hpp"

#include <algorithm>

namespace rovernet {
namespace {

constexpr std::uint32_t opaque_bytes = 1;  // the only command

/// Lowers the TTL in the first byte of a payload by the hops that the message crossed.
void lower_ttl(std::string& payload, int hops) {
    if (payload.empty()) return;
    const int ttl = static_cast<unsigned char>(payload.front());
    payload.front() = static_cast<char>(std::max(ttl - hops, 0));
}

}  // namespace

void PlayerRelay::command(std::uint32_t subtype, XdrReader payload) {
    if (subtype != opaque_bytes) return;
    std::string message = XdrWriter().bytes(payload.bytes()).take();
    if (said_.size() == most || bytes_ + message.size() > most_bytes) return;
    bytes_ += message.size();
    said_.push_back(std::move(message));
}

std::vector<std::string> PlayerRelay::data() {
    bytes_ = 0;
    return std::exchange(said_, {});
}

std::vector<std::string> PlayerRadio::data() {
    std::vector<std::string> payloads;
    for (HeardMessage& heard : robot_.heard()) {
        if (has_ttl_) lower_ttl(heard.payload, heard.hops);
        payloads.push_back(XdrWriter().bytes(heard.payload).take());
    }
    return payloads;
}

void PlayerRadio::command(std::uint32_t subtype, XdrReader payload) {
    if (subtype != opaque_bytes) return;
    const std::string_view bytes = payload.bytes();
    if (bytes.size() > longest_message)
        throw MalformedMessage("the message is too long to be sent by radio");
    robot_.carry_out(SendCommand{.payload = std::string(bytes)});
}

}  // namespace rovernet
