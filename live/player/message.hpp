// SPDX-License-Identifier: MIT
#pragma once

#include "live/player/xdr.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

// Messages of the Player protocol over TCP, versions 2.0 to 3.1: 40 bytes of header, then the
// payload.

namespace rovernet {

/// Interface (kind) of a Player device. Messages of clients may contain values outside this list.
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

/// Address of a device at one port of the server, as used in messages.
struct PlayerAddress {
    PlayerInterface interface;
    std::uint32_t index;  ///< index among the devices of this interface at the port

    friend bool operator==(PlayerAddress, PlayerAddress) = default;
};

struct PlayerMessage {
    PlayerAddress device;
    PlayerType type;
    std::uint32_t subtype;  ///< subtype, whose meaning depends on interface and type
    double time = 0;        ///< simulated time [s]
    std::uint32_t sequence = 0;
    std::string payload = {};
};

/// Reads the server's host and port, which are ignored, and then the address of a device from a
/// payload. put_address() writes all of these. @throws MalformedMessage
PlayerAddress read_address(XdrReader& payload);
XdrWriter& put_address(XdrWriter& out, PlayerAddress device, std::uint16_t port);

/// Banner: first bytes that the server sends to a client. Clients read the banner in one call and
/// ignore its content.
std::string player_banner();

/// Bytes of a message: header and payload.
/// @param port  port of this server to which the client is connected; 0: the message belongs to no
/// device
std::string encode(const PlayerMessage& message, std::uint16_t port);

/// Encoded message SYNCH, which ends the data that answer a request of a client in PULL mode.
std::string player_round_end();
/// Encoded message to a client that does not read fast enough. @param lost  number of lost messages
std::string player_overflow(std::size_t lost);

/// Parser that splits the byte stream of a Player client into messages.
class PlayerStream {
  public:
    /// Longest payload of a message [bytes].
    static constexpr std::size_t longest = std::size_t{1} << 20U;

    void add(std::string_view bytes) { input_ += bytes; }
    /// Next message of the client; none if it is not complete yet.
    /// @throws MalformedMessage if the message is too long; later messages cannot be read then
    std::optional<PlayerMessage> next();

  private:
    std::string input_;
    std::size_t taken_ = 0;  // bytes of the input already parsed
};

}  // namespace rovernet
