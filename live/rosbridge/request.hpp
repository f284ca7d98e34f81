// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "live/carriers/request.hpp"
#include "live/rosbridge/service.hpp"
#include "live/rosbridge/topic.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

// Operations (requests) of the rosbridge protocol, version 2.

namespace rovernet {

/// Encoding in which one client gets the messages of a topic: text (JSON) or binary (CBOR).
enum class RosEncoding { json, cbor };

/// Delivery options of one client's subscription to a topic.
struct RosDelivery {
    Duration interval = {};        ///< least simulated time between two messages to the client
    std::size_t queue_length = 0;  ///< largest number of queued messages; the oldest are dropped
    RosEncoding encoding = RosEncoding::json;
};

struct RosSubscribe {
    std::string topic;               ///< topic name as the client wrote it
    std::optional<RosTopic> source;  ///< topic with the name `topic`; none: no topic has the name
    RosDelivery delivery;
};
/// Request to remove the subscription with the request's id, or all subscriptions to the topic if
/// there is no id.
struct RosUnsubscribe {
    std::string topic;
};
/// Request without effect: advertise or unadvertise, which this server does not need.
struct RosNothing {};
struct RosPublish {
    NodeId robot;
    RobotCommand command;
    std::string warning;  ///< text naming ignored members of the message; may be empty
};
struct RosCall {
    RosService service;
    RosArguments arguments;
};
/// Least severity of status messages that a client wants.
enum class RosLevel { info, warning, error, none };

using RosRequest =
    std::variant<RosSubscribe, RosUnsubscribe, RosNothing, RosPublish, RosCall, RosLevel>;

/// Name and id of a client's request (operation), for the answer, even if the rest is invalid.
struct RosOperation {
    std::string name;               ///< name of the operation, "publish"; empty if missing
    std::optional<std::string> id;  ///< id of the operation, given by the client; none if missing
    std::string target;             ///< topic, service or action name, as the client wrote it
};

/// Reader of rosbridge operations that reuses its memory. Unknown keys of an operation are ignored;
/// unknown keys of a message are an error.
///
/// Limits: 32 nesting levels, names of 256 bytes, 1,000 m/s and 1,000 rad/s, data of 65,535 bytes.
class RosRequestReader {
  public:
    RosRequestReader();
    ~RosRequestReader();

    /// Reads a request. @throws RequestError
    RosRequest read(std::string_view text, Session& session);
    /// Last operation that was read, valid or not.
    const RosOperation& operation() const { return operation_; }

  private:
    struct Parser;
    std::unique_ptr<Parser> parser_;
    RosOperation operation_;
};

}  // namespace rovernet
