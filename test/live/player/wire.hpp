// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

// Encoding of Player's messages for tests, independent of the tested code.

namespace rovernet::test {

inline std::string be(std::uint64_t number, int bytes) {
    std::string out;
    for (int i = bytes - 1; i >= 0; --i) out += static_cast<char>(number >> (8 * i));
    return out;
}
inline std::string be32(std::uint64_t number) { return be(number, 4); }
inline std::string be64(double number) { return be(std::bit_cast<std::uint64_t>(number), 8); }
inline std::string doubles(std::initializer_list<double> numbers) {
    std::string out;
    for (const double number : numbers) out += be64(number);
    return out;
}
/// Array of bytes as encoded by Player: its counts, the bytes, and padding.
inline std::string counted(const std::string& bytes) {
    const std::string count = be32(bytes.size());
    return count + count + bytes + std::string((4 - bytes.size() % 4) % 4, '\0');
}

inline std::uint64_t number_at(std::string_view bytes, std::size_t at, std::size_t size) {
    std::uint64_t number = 0;
    for (const char c : bytes.substr(at, size))
        number = number << 8U | static_cast<unsigned char>(c);
    return number;
}
inline double double_at(std::string_view bytes, std::size_t at) {
    return std::bit_cast<double>(number_at(bytes, at, 8));
}
inline float float_at(std::string_view bytes, std::size_t at) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(number_at(bytes, at, 4)));
}

inline std::string from_hex(std::string_view text) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
        bytes += static_cast<char>(std::stoi(std::string(text.substr(i, 2)), nullptr, 16));
    }
    return bytes;
}
inline std::string to_hex(std::string_view bytes) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (const char c : bytes) {
        text += digits[static_cast<unsigned char>(c) >> 4U];
        text += digits[static_cast<unsigned char>(c) & 15U];
    }
    return text;
}

enum WireType : std::uint32_t { data = 1, cmd, req, ack, sync_message, nack };

/// Message of Player's protocol: header and payload.
struct Wire {
    std::uint32_t host = 0, robot = 0, interface = 0, index = 0, type = 0, subtype = 0;
    double time = 0;
    std::uint32_t sequence = 0;
    std::string payload = {};

    std::string bytes() const {
        std::string out;
        for (const std::uint32_t field : {host, robot, interface, index, type, subtype}) {
            out += be32(field);
        }
        return out + be64(time) + be32(sequence) + be32(payload.size()) + payload;
    }
    /// Text of an answer for comparisons, without time and sequence number.
    std::string gist() const {
        std::ostringstream out;
        out << std::hex << host << ' ' << std::dec << robot << ' ' << interface << ':' << index
            << ' ' << type << '.' << subtype << ' ' << to_hex(payload);
        return out.str();
    }
};

/// Removes all complete messages from the front of `bytes`, and returns them.
inline std::vector<Wire> take_messages(std::string& bytes) {
    std::vector<Wire> found;
    while (bytes.size() >= 40) {
        const std::size_t size = number_at(bytes, 36, 4);
        if (bytes.size() < 40 + size) break;
        const auto field = [&](std::size_t i) {
            return static_cast<std::uint32_t>(number_at(bytes, 4 * i, 4));
        };
        found.push_back({field(0), field(1), field(2), field(3), field(4), field(5),
                         double_at(bytes, 24), field(8), bytes.substr(40, size)});
        bytes.erase(0, 40 + size);
    }
    return found;
}

inline std::string request(std::uint32_t interface, std::uint32_t index, std::uint32_t subtype,
                           std::string payload = {}) {
    return Wire{0, 0, interface, index, req, subtype, 0, 7, std::move(payload)}.bytes();
}
inline std::string order(std::uint32_t interface, std::uint32_t index, std::string payload) {
    return Wire{0, 0, interface, index, cmd, 1, 0, 0, std::move(payload)}.bytes();
}
inline std::string mode(std::uint32_t pull_or_push) { return request(1, 0, 5, be32(pull_or_push)); }
/// Request that opens a device (access 1) or closes it (2).
inline std::string device(std::uint32_t interface, std::uint32_t index, std::uint32_t access = 1) {
    return request(1, 0, 3,
                   be32(0) + be32(0) + be32(interface) + be32(index) + be32(access) + counted(""));
}
inline std::string ask() { return request(1, 0, 4); }
inline std::string drive(double speed, double turn_rate) {
    return order(4, 0, doubles({speed, 0, turn_rate}) + be32(1));
}

constexpr std::uint32_t pull = 2, push = 1;

}  // namespace rovernet::test
