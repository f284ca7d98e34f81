// SPDX-License-Identifier: MIT
#pragma once

#include "test/live/line_client.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace rovernet::test {

/// WebSocket client, written from RFC 6455 and independent of the server's library.
class WebClient {
  public:
    /// Requests a WebSocket with the key of the RFC's example (1.3).
    /// @param lines   additional lines of the request, each with its "\r\n"
    /// @param host    value of the header `Host`; empty: the address
    explicit WebClient(int port, const std::string& lines = {}, const std::string& target = "/",
                       std::string host = {})
        : socket_(port) {
        if (host.empty()) host = "127.0.0.1:" + std::to_string(port);
        socket_.send_bytes("GET " + target + " HTTP/1.1\r\nHost: " + host +
                           "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                           "Sec-WebSocket-Version: 13\r\n"
                           "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
                           lines + "\r\n");
        for (std::string line = socket_.line(); line.size() > 1; line = socket_.line()) {
            answer_ += line + "\n";
        }
    }

    /// Header lines of the server's answer to the request.
    const std::string& answer() const { return answer_; }
    bool is_in() const { return answer_.starts_with("HTTP/1.1 101 "); }
    LineClient& socket() { return socket_; }

    struct Frame {
        int kind = -1;  ///< opcode (5.2); -1: the connection has ended
        bool is_last = true;
        std::string bytes = {};
        /// Reason of a close frame (7.4); 0 if the frame has no reason.
        int reason() const {
            if (kind != 8 || bytes.size() < 2) return 0;
            return static_cast<unsigned char>(bytes[0]) << 8 | static_cast<unsigned char>(bytes[1]);
        }
    };
    static constexpr int more = 0, text = 1, binary = 2, closing = 8, ping = 9, pong = 10;

    bool send(std::string_view bytes, int kind = text, bool is_last = true) const {
        std::string frame(1, static_cast<char>((is_last ? 0x80 : 0) | kind));
        if (bytes.size() < 126) {
            frame += static_cast<char>(0x80 | bytes.size());
        } else {
            const int places = bytes.size() < 65'536 ? 2 : 8;
            frame += static_cast<char>(0x80 | (places == 2 ? 126 : 127));
            for (int i = places - 1; i >= 0; --i) frame += static_cast<char>(bytes.size() >> 8 * i);
        }
        constexpr std::string_view mask = "\x37\xfa\x21\x3d";
        frame += mask;
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            frame += static_cast<char>(bytes[i] ^ mask[i % 4]);
        }
        return socket_.send_bytes(frame);
    }
    Frame frame() {
        const std::string head = socket_.bytes(2);
        if (head.size() < 2) return {};
        Frame found{head[0] & 0x0f, (head[0] & 0x80) != 0, {}};
        // frames of a server are not masked
        std::uint64_t size = static_cast<unsigned char>(head[1]);
        if (size >= 126) {
            const std::string number = socket_.bytes(size == 126 ? 2 : 8);
            size = 0;
            for (const char c : number) size = size << 8 | static_cast<unsigned char>(c);
        }
        found.bytes = socket_.bytes(size);
        return found;
    }
    /// Next message, without control frames.
    std::string message() {
        std::string whole;
        for (;;) {
            const Frame part = frame();
            if (part.kind == ping) send(part.bytes, pong);
            if (part.kind < 0 || part.kind == closing) return {};
            if (part.kind > binary) continue;
            whole += part.bytes;
            if (part.is_last) return whole;
        }
    }
    std::string ask(const std::string& question) {
        send(question);
        return message();
    }
    /// Waits for the server's close frame, answers it and returns its reason; earlier frames are
    /// discarded. 0: the connection ended without a close frame.
    int reason() {
        for (;;) {
            const Frame next = frame();
            if (next.kind < 0) return 0;
            if (next.kind != closing) continue;
            send(next.bytes, closing);
            socket_.close();
            return next.reason();
        }
    }

  private:
    LineClient socket_;
    std::string answer_;
};

}  // namespace rovernet::test
