// SPDX-License-Identifier: MIT
#pragma once

#include <arpa/inet.h>
#include <cerrno>
#include <cstring>
#include <netinet/in.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>
#include <utility>

namespace rovernet::test {

/// Client end of a connection, which sends and receives lines or bytes, and waits at most 20 s.
class LineClient {
  public:
    explicit LineClient(int port) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        open(reinterpret_cast<const sockaddr*>(&address), sizeof address);
    }
    explicit LineClient(const std::string& path) : socket_(socket(AF_UNIX, SOCK_STREAM, 0)) {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
        open(reinterpret_cast<const sockaddr*>(&address), sizeof address);
    }
    LineClient(LineClient&& other) noexcept
        : socket_(std::exchange(other.socket_, -1)), received_(std::move(other.received_)) {}
    ~LineClient() { close(); }

    void close() {
        if (socket_ >= 0) ::close(std::exchange(socket_, -1));
    }
    /// Resets the connection, as when a process is killed before it has read all bytes.
    void reset() {
        const linger at_once{1, 0};
        setsockopt(socket_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
        close();
    }
    /// Limits the bytes that the system takes while this client does not read.
    void limit_buffer(int bytes) const {
        setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes);
    }
    void end_sending() const { shutdown(socket_, SHUT_WR); }

    /// Sends bytes unchanged. @return whether all bytes were sent
    bool send_bytes(std::string_view bytes) const {
        while (!bytes.empty()) {
            const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
            if (sent <= 0) return false;
            bytes.remove_prefix(static_cast<std::size_t>(sent));
        }
        return true;
    }
    /// Next line received; empty if the connection has ended.
    std::string line() {
        for (;;) {
            const std::size_t end = received_.find('\n');
            if (end != std::string::npos) {
                std::string line = received_.substr(0, end);
                received_.erase(0, end + 1);
                return line;
            }
            char bytes[65536];
            const ssize_t got = recv(socket_, bytes, sizeof bytes, 0);
            if (got <= 0) return {};
            received_.append(bytes, static_cast<std::size_t>(got));
        }
    }
    /// Next `number` bytes received; fewer if the connection has ended.
    std::string bytes(std::size_t number) {
        char portion[65536];
        while (received_.size() < number) {
            const ssize_t got = recv(socket_, portion, sizeof portion, 0);
            if (got <= 0) break;
            received_.append(portion, static_cast<std::size_t>(got));
        }
        std::string found = received_.substr(0, number);
        received_.erase(0, number);
        return found;
    }
    std::string ask(const std::string& question) {
        send_bytes(question + "\n");
        return line();
    }

  private:
    void open(const sockaddr* address, socklen_t size) const {
        const timeval longest{20, 0};
        setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
        if (connect(socket_, address, size) != 0) throw std::runtime_error(std::strerror(errno));
    }

    int socket_;
    std::string received_;
};

}  // namespace rovernet::test
