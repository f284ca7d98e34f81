// SPDX-License-Identifier: MIT
#pragma once

#include "live/rosbridge/request.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Ways of the rosbridge protocol to carry a message in others: as a picture, and in pieces.

namespace rovernet {

/// A message as the pixels of a picture, in base64 in a message of the operation "png". The text is
/// padded with newlines to a rectangle.
std::string in_picture(std::string_view message);

/// Sends a message in pieces, in messages of the operation "fragment".
/// @param size  of a piece at most [bytes]; characters are not cut
/// @param id    that no other message of this client has
void send_in_pieces(std::string_view message, std::size_t size, const std::string& id,
                    const std::function<void(std::string_view)>& send);

/// Pieces that a client has sent, until a message is whole.
///
/// Limits: 1 MiB of all that is not whole, 16 messages of which something is missing. After 10 s of
/// simulated time what came of a message is dropped.
class RosPieces {
  public:
    /// Adds a piece. @return the message, if it is whole. @throws RequestError
    std::optional<std::string> add(const std::string& id, RosFragment piece, Time now);

  private:
    struct Message {
        Time since;
        std::map<std::size_t, std::string> pieces;
    };
    std::size_t bytes() const;

    std::map<std::string, Message> messages_;
};

}  // namespace rovernet
