// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace rovernet {

/// Message between processes of this machine that contains a file descriptor, or only a text.
struct DescriptorMessage {
    int descriptor = -1;  ///< file descriptor, owned by the receiver; -1: none
    std::string text = {};
};

/// Sends a message over a Unix socket. @return whether the message was sent
bool send_descriptor(int socket, const DescriptorMessage& message);
/// Receives a message from a Unix socket; none if the peer has closed the socket.
std::optional<DescriptorMessage> receive_descriptor(int socket);

}  // namespace rovernet
