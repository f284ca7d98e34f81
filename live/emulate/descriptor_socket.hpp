// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace rovernet {

/// Message between processes of this machine that carries a descriptor; or a text, if there is
/// none to carry.
struct DescriptorMessage {
    int descriptor = -1;  ///< whoever receives it owns it
    std::string text = {};
};

/// Sends a message over a Unix socket. @return whether it was taken
bool send_descriptor(int socket, const DescriptorMessage& message);
/// Receives one; nothing if the other end has gone.
std::optional<DescriptorMessage> receive_descriptor(int socket);

}  // namespace rovernet
