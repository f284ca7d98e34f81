// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "live/carriers/request.hpp"
#include "live/rosbridge/service.hpp"
#include "live/rosbridge/topic.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

// What ROS clients say: the operations of the rosbridge protocol, version 2.

namespace rovernet {

/// Encoding of the messages of a topic: JSON, JSON as the pixels of a picture, or CBOR.
enum class RosEncoding { json, png, cbor };

/// What one subscription of a client asks for.
struct RosDelivery {
    Duration interval = {};        ///< at least, of simulated time, between two messages
    std::size_t queue_length = 0;  ///< messages that wait for their time; the newest stay
    std::optional<std::size_t> fragment_size = {};  ///< [bytes] of text at most in one piece
    RosEncoding encoding = RosEncoding::json;
};

struct RosSubscribe {
    std::string topic;               ///< as the client wrote it
    std::optional<RosTopic> source;  ///< none: nothing is ever published there
    RosDelivery delivery;
};
/// For the subscription of this operation's id, or for all of that topic if it has none.
struct RosUnsubscribe {
    std::string topic;
};
/// An operation that changes nothing: who publishes does not have to say so before.
struct RosNothing {};
struct RosPublish {
    NodeId robot;
    RobotCommand command;
    std::string warning;  ///< what of the message counts for nothing; may be empty
};
struct RosCall {
    RosService service;
    RosArguments arguments;
};
/// Piece of a message that was too long for one.
struct RosFragment {
    std::string data;
    std::size_t number, total;
};
/// Level from which on a client wants to be told of events.
enum class RosLevel { info, warning, error, none };

using RosRequest = std::variant<RosSubscribe, RosUnsubscribe, RosNothing, RosPublish, RosCall,
                                RosFragment, RosLevel>;

/// Name and id of the last operation, for the answer to it, whatever is wrong with the rest.
struct RosOperation {
    std::string name;               ///< "publish"; empty if it had none
    std::optional<std::string> id;  ///< none if it had none
    std::string target;             ///< topic, service or action, as the client wrote it
};

/// Reader of operations, which keeps its memory. Keys of an operation that it does not know are
/// passed over; those of a message are not.
///
/// Limits: 32 levels of brackets, names of 256 bytes, 1,000 m/s and 1,000 rad/s, data of 65,535
/// bytes.
class RosRequestReader {
  public:
    RosRequestReader();
    ~RosRequestReader();

    /// @throws RequestError
    RosRequest read(std::string_view text, Session& session);
    /// The operation that was read last, or could not be.
    const RosOperation& operation() const { return operation_; }

  private:
    struct Parser;
    std::unique_ptr<Parser> parser_;
    RosOperation operation_;
};

}  // namespace rovernet
