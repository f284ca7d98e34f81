// SPDX-License-Identifier: MIT
#pragma once

#include "live/player/xdr.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

// Messages of Player's protocol, as its clients of versions 2.0 to 3.1 speak it over TCP: 40 bytes
// of header, then the payload.

namespace rovernet {

/// Kind of a device. Messages may name others.
enum class PlayerInterface : std::uint32_t {
    player = 1,
    position2d = 4,
    sonar = 5,
    laser = 6,
    wifi = 23,
    simulation = 31,
    opaque = 51,
    ranger = 62,
};

enum class PlayerType : std::uint32_t { data = 1, command, request, ack, sync, nack };

/// Device at one port of the server, as messages name it.
struct PlayerAddress {
    PlayerInterface interface;
    std::uint32_t index;  ///< among the devices of that interface

    friend bool operator==(PlayerAddress, PlayerAddress) = default;
};

struct PlayerMessage {
    PlayerAddress device;
    PlayerType type;
    std::uint32_t subtype;  ///< meaning within the interface and type
    double time = 0;        ///< [s]
    std::uint32_t sequence = 0;
    std::string payload = {};
};

/// Reads and writes the address of a device in a payload, which has the server's in front of it.
/// @throws MalformedMessage
PlayerAddress read_address(XdrReader& payload);
XdrWriter& put_address(XdrWriter& out, PlayerAddress device, std::uint16_t port);

/// First bytes that a client is sent. It takes them with one call and does not look into them.
std::string player_banner();

/// Bytes of a message.
/// @param port  of this server at which the client is; 0: the message is of no device
std::string encode(const PlayerMessage& message, std::uint16_t port);

/// End of a round of data.
std::string player_round_end();
/// Word to a client that takes too little: so many messages to it are lost.
std::string player_overflow(std::size_t lost);

/// Messages in the bytes that a client sends.
class PlayerStream {
  public:
    /// Longest payload [bytes].
    static constexpr std::size_t longest = std::size_t{1} << 20U;

    void add(std::string_view bytes) { input_ += bytes; }
    /// The next message; nothing if it is not whole yet.
    /// @throws MalformedMessage if it is too long: nothing after it can be read
    std::optional<PlayerMessage> next();

  private:
    std::string input_;
    std::size_t taken_ = 0;  // of the input
};

}  // namespace rovernet
