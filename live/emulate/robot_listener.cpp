// SPDX-License-Identifier: MIT
#include "live/emulate/robot_listener.hpp"

#include "sim/error.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <pwd.h>
#include <set>
#include <string_view>
#include <sys/random.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <utility>

namespace rovernet {
namespace {

constexpr std::string_view socket_prefix = "rovernet/";
constexpr int socket_type = SOCK_SEQPACKET | SOCK_CLOEXEC;  // whole messages

/// Abstract Unix address.
class ListenerAddress {
  public:
    explicit ListenerAddress(const RobotListener& listener) {
        const std::string name =
            fmt::format("{}{}{}/{}", socket_prefix, listener.run, listener.mark, listener.robot);
        if (name.size() >= sizeof address_.sun_path) {
            throw RunError(fmt::format("robot {}: this name is too long; expected a shorter name",
                                       listener.robot));
        }
        address_.sun_family = AF_UNIX;
        std::memcpy(address_.sun_path + 1, name.data(), name.size());
        size_ = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    }
    const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&address_); }
    socklen_t size() const { return size_; }

  private:
    sockaddr_un address_{};
    socklen_t size_;
};

/// Parses the name of a listener, "PID/ROBOT" or "PID.NUMBER/ROBOT".
std::optional<RobotListener> read_listener(std::string_view text) {
    RobotListener listener{};
    const std::size_t slash = text.find('/');
    if (slash == text.npos) return std::nullopt;
    const char* const end = text.data() + slash;
    const auto [rest, error] = std::from_chars(text.data(), end, listener.run);
    if (error != std::errc{} || (rest != end && *rest != '.')) return std::nullopt;
    listener.mark.assign(rest, end);
    listener.robot = text.substr(slash + 1);
    return listener;
}

}  // namespace

int RobotListener::listen() const {
    const ListenerAddress address(*this);
    const int socket = ::socket(AF_UNIX, socket_type, 0);
    constexpr int waiting = 64;
    if (socket >= 0 && bind(socket, address.get(), address.size()) == 0 &&
        ::listen(socket, waiting) == 0) {
        return socket;
    }
    const int error = errno;
    if (socket >= 0) close(socket);
    errno = error;
    return -1;
}

std::optional<int> RobotListener::connect_to() const {
    const ListenerAddress address(*this);
    const int socket = ::socket(AF_UNIX, socket_type | SOCK_NONBLOCK, 0);
    if (socket >= 0 && connect(socket, address.get(), address.size()) == 0) return socket;
    const int error = errno;
    if (socket >= 0) close(socket);
    if (error == EAGAIN) return -1;
    return std::nullopt;
}

int open_listener(pid_t run, const std::string& robot) {
    RobotListener listener{run, "", robot};
    constexpr int most_tries = 100;
    for (int i = 0; i < most_tries; ++i) {
        const int socket = listener.listen();
        if (socket >= 0) return socket;
        if (errno != EADDRINUSE) break;
        std::uint32_t number = 0;  // one that nobody can take beforehand
        (void)!getrandom(&number, sizeof number, 0);
        listener.mark = fmt::format(".{}", number);
    }
    throw RunError(fmt::format("cannot listen for programs that enter the network of robot {}: {}",
                               robot, std::strerror(errno)));
}

std::vector<RobotListener> all_listeners() {
    std::set<RobotListener> listeners;
    std::ifstream sockets("/proc/net/unix");
    const std::string mark = fmt::format(" @{}", socket_prefix);
    for (std::string line; std::getline(sockets, line);) {
        const std::size_t place = line.find(mark);
        if (place == line.npos) continue;
        auto listener = read_listener(std::string_view(line).substr(place + mark.size()));
        if (listener)
            listeners.insert(std::move(*listener));  // accepted connections have the same name
    }
    return {listeners.begin(), listeners.end()};
}

std::optional<uid_t> user_behind(int socket) {
    ucred peer{};
    socklen_t size = sizeof peer;
    if (getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return std::nullopt;
    if (peer.uid == static_cast<uid_t>(-1)) return std::nullopt;
    return peer.uid;
}

std::string user_name(uid_t user) {
    passwd entry{};
    passwd* found = nullptr;
    std::array<char, 4096> room{};
    getpwuid_r(user, &entry, room.data(), room.size(), &found);
    return found ? fmt::format("{} ({})", found->pw_name, user) : fmt::format("{}", user);
}

}  // namespace rovernet
