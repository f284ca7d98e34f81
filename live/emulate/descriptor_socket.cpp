// SPDX-License-Identifier: MIT
#include "live/emulate/descriptor_socket.hpp"

#include <cstring>
#include <sys/socket.h>
#include <sys/uio.h>

namespace rovernet {
namespace {

constexpr std::size_t longest_text = 8192;  // [bytes] a path is in it

/// Room for one descriptor beside a message.
union Room {
    cmsghdr header;
    char bytes[CMSG_SPACE(sizeof(int))];
};

}  // namespace

bool send_descriptor(int socket, const DescriptorMessage& message) {
    std::string text = message.text.substr(0, longest_text);
    if (text.empty()) text = ".";  // a descriptor cannot go alone
    iovec bytes{text.data(), text.size()};
    msghdr out{};
    out.msg_iov = &bytes;
    out.msg_iovlen = 1;
    Room room{};
    if (message.descriptor >= 0) {
        out.msg_control = room.bytes;
        out.msg_controllen = sizeof room.bytes;
        room.header.cmsg_level = SOL_SOCKET;
        room.header.cmsg_type = SCM_RIGHTS;
        room.header.cmsg_len = CMSG_LEN(sizeof(int));
        std::memcpy(CMSG_DATA(&room.header), &message.descriptor, sizeof(int));
    }
    return sendmsg(socket, &out, MSG_NOSIGNAL) >= 0;
}

std::optional<DescriptorMessage> receive_descriptor(int socket) {
    char text[longest_text];
    iovec bytes{text, sizeof text};
    Room room{};
    msghdr in{};
    in.msg_iov = &bytes;
    in.msg_iovlen = 1;
    in.msg_control = room.bytes;
    in.msg_controllen = sizeof room.bytes;
    const ssize_t got = recvmsg(socket, &in, MSG_CMSG_CLOEXEC);
    if (got <= 0) return std::nullopt;
    DescriptorMessage message{.text = std::string(text, static_cast<std::size_t>(got))};
    const cmsghdr* const carried = CMSG_FIRSTHDR(&in);
    if (carried && carried->cmsg_type == SCM_RIGHTS) {
        std::memcpy(&message.descriptor, CMSG_DATA(carried), sizeof(int));
    }
    return message;
}

}  // namespace rovernet
