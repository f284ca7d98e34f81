// SPDX-License-Identifier: MIT
#include "live/rosbridge/front.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace rovernet {
namespace {

constexpr std::size_t most_subscriptions = 256;
constexpr std::size_t most_steps = 64;  // of a client, that are not over
constexpr int aborted = 6;              // action_msgs/GoalStatus

/// The first multiple of a period after a time.
Time multiple_after(Time time, Duration period) {
    return start_of_run + (time.time_since_epoch() / period + 1) * period;
}

void put_pair(RosWriter& out, std::string_view key, std::string_view value) {
    out.key(key);
    out.text(value);
}

/// Writes a message of a topic.
void write_publication(std::string& text, RosEncoding encoding, std::string_view name,
                       const std::function<void(RosWriter&)>& put_message) {
    text.clear();
    RosJsonWriter json(text);
    RosCborWriter cbor(text);
    RosWriter& out = encoding == RosEncoding::cbor ? static_cast<RosWriter&>(cbor) : json;
    out.open_object();
    put_pair(out, "op", "publish");
    put_pair(out, "topic", name);
    out.key("msg");
    put_message(out);
    out.close_object();
}

}  // namespace

struct RosbridgeFront::Client {
    Connection connection = 0;
    std::map<std::string, RosStream> streams = {};  // by topic, as the client wrote it
    RosLevel level = RosLevel::error;
    std::set<NodeId> warned = {};  // of robots, that some of their velocity counts for nothing
};

RosbridgeFront::RosbridgeFront(Carrier carrier) : carrier_(std::move(carrier)) {}
RosbridgeFront::~RosbridgeFront() = default;

void RosbridgeFront::begin(Session& session, const Scenario&) {
    session_ = &session;
    robots_.emplace(session);
    messages_.emplace(session, *robots_);
    api_.emplace(session);
}

void RosbridgeFront::opened(Connection client, ListenerId) { clients_[client].connection = client; }

void RosbridgeFront::closed(Connection gone) {
    clients_.erase(gone);
    robots_->left(gone);
    answer(clock_.left(gone));
    go_on();
}

std::size_t RosbridgeFront::received(Connection from, std::string_view message) {
    handle(clients_.at(from), message);
    go_on();
    return 1;
}

void RosbridgeFront::handle(Client& client, std::string_view message) {
    try {
        std::visit([&](const auto& request) { carry_out(client, request); },
                   reader_.read(message, *session_));
    } catch (const RequestError& fault) {
        const std::string at = fault.at().empty() ? "" : fault.at() + ": ";
        refuse(client, at + fault.what());
    }
}

/// Sends a client the error of its last operation.
void RosbridgeFront::refuse(Client& client, const std::string& why) {
    const RosOperation& operation = reader_.operation();
    const bool is_call = operation.name == "call_service";
    if (!is_call && operation.name != "send_action_goal") {
        return tell_status(client, RosLevel::error, why);
    }
    buffer_.clear();
    RosJsonWriter out(buffer_);
    out.open_object();
    put_pair(out, "op", is_call ? "service_response" : "action_result");
    if (operation.id) put_pair(out, "id", *operation.id);
    put_pair(out, is_call ? "service" : "action", operation.target);
    put_pair(out, "values", why);
    if (!is_call) {
        out.key("status");
        out.whole(aborted);
    }
    out.key("result");
    out.truth(false);
    out.close_object();
    carrier_.send(client.connection, buffer_);
}

void RosbridgeFront::tell_status(const Client& client, RosLevel level, std::string_view text) {
    if (level < client.level) return;
    buffer_.clear();
    RosJsonWriter out(buffer_);
    out.open_object();
    put_pair(out, "op", "status");
    put_pair(out, "level", level == RosLevel::error ? "error" : "warning");
    put_pair(out, "msg", text);
    if (reader_.operation().id) put_pair(out, "id", *reader_.operation().id);
    out.close_object();
    carrier_.send(client.connection, buffer_);
}

void RosbridgeFront::respond(Connection client, const RosOperation& call,
                             const std::function<void(RosWriter&)>& put_values) {
    buffer_.clear();
    RosJsonWriter out(buffer_);
    out.open_object();
    put_pair(out, "op", "service_response");
    if (call.id) put_pair(out, "id", *call.id);
    put_pair(out, "service", call.target);
    out.key("values");
    put_values(out);
    out.key("result");
    out.truth(true);
    out.close_object();
    carrier_.send(client, buffer_);
}

void RosbridgeFront::carry_out(Client& client, const RosSubscribe& request) {
    std::size_t subscriptions = 0;
    for (const auto& [name, each] : client.streams) subscriptions += each.subscriptions();
    if (subscriptions >= most_subscriptions) {
        throw RequestError("too_many", "topic",
                           fmt::format("expected {} subscriptions at most", most_subscriptions));
    }
    const auto& source = request.source;
    const bool is_of_radio = source && (source->kind() == RosTopicKind::received ||
                                        source->kind() == RosTopicKind::neighbors);
    if (is_of_radio) robots_->take(source->robot);
    RosStream& stream = client.streams[request.topic];
    stream.source = source;
    stream.add(reader_.operation().id.value_or(""), request.delivery);
    if (!source) return;
    if (messages_->period(*source) > Duration{0}) {
        stream.due = multiple_after(now(), messages_->period(*source));
    } else if (source->kind() != RosTopicKind::received) {
        write_publication(buffer_, stream.delivery().encoding, request.topic,
                          [&](RosWriter& out) { messages_->write(out, *source); });
        publish(client, stream, buffer_);
    }
}

void RosbridgeFront::carry_out(Client& client, const RosUnsubscribe& request) {
    const auto found = client.streams.find(request.topic);
    if (found == client.streams.end()) return;
    const auto& id = reader_.operation().id;
    if (id) found->second.remove(*id);
    if (!id || found->second.subscriptions() == 0) client.streams.erase(found);
}

void RosbridgeFront::carry_out(Client& client, const RosPublish& request) {
    robots_->carry_out(request.robot, request.command, client.connection);
    if (!request.warning.empty() && client.warned.insert(request.robot).second) {
        tell_status(client, RosLevel::warning, request.warning);
    }
}

void RosbridgeFront::carry_out(Client& client, RosLevel level) { client.level = level; }

void RosbridgeFront::carry_out(Client& client, const RosCall& call) {
    const auto& [text, robot, command, time] = call.arguments;
    const bool is_step = call.service.kind() == RosServiceKind::step;
    if (is_step && clock_.steps(client.connection) >= most_steps) {
        throw RequestError("too_many", "service",
                           fmt::format("{} steps of this client are not finished yet; expected {} "
                                       "unfinished steps at most",
                                       most_steps, most_steps));
    }
    std::optional<std::uint64_t> uid;
    if (command) uid = robots_->carry_out(*robot, *command, client.connection);
    switch (call.service.kind()) {
        case RosServiceKind::step:
            clock_.begin({client.connection, reader_.operation(),
                          now() + std::min(time, session_->end() - now())});
            return;
        case RosServiceKind::pause: answer(clock_.pause(client.connection, now())); break;
        case RosServiceKind::unpause: answer(clock_.unpause()); break;
        default: break;
    }
    respond(client.connection, reader_.operation(), [&](RosWriter& out) {
        if (call.service.type->name.starts_with("rosapi/")) return api_->write(out, call);
        out.open_object();
        if (call.service.kind() == RosServiceKind::radio_send) {
            out.key("accepted");
            out.truth(uid.has_value());
            out.key("uid");
            uid ? out.whole(static_cast<std::int64_t>(*uid)) : out.null();
        }
        out.close_object();
    });
}

/// Answers step calls that have ended, of clients that are still connected.
void RosbridgeFront::answer(const std::vector<RosClock::Step>& over) {
    for (const RosClock::Step& each : over) {
        if (!clients_.contains(each.client)) continue;
        respond(each.client, each.call, [&](RosWriter& out) {
            out.open_object();
            out.key("time");
            write_time(out, now());
            out.close_object();
        });
    }
}

/// Sends a message to a subscriber, or queues it.
void RosbridgeFront::publish(const Client& client, RosStream& stream, std::string_view message) {
    stream.take(message, now(), [&, encoding = stream.delivery().encoding](std::string_view text) {
        send(client, encoding, text);
    });
}

/// Message of a topic as it is now, which is written once for all who get the same.
const std::string& RosbridgeFront::written(const std::string& name, RosEncoding encoding,
                                           const RosTopic& topic) {
    const auto [place, is_new] = written_.try_emplace({name, encoding});
    if (is_new) {
        write_publication(place->second, encoding, name,
                          [&](RosWriter& out) { messages_->write(out, topic); });
    }
    return place->second;
}

/// Sends a message in its encoding: CBOR as bytes, JSON as text.
void RosbridgeFront::send(const Client& client, RosEncoding encoding, std::string_view message) {
    encoding == RosEncoding::cbor ? carrier_.send_binary(client.connection, message)
                                  : carrier_.send(client.connection, message);
}

void RosbridgeFront::tell() {
    const std::vector<HeardMessage> heard = robots_->heard();
    written_.clear();
    for (auto& [connection, client] : clients_) tell(client, heard);
    answer(clock_.end_steps(now()));
    go_on();
}

/// Sends a client the messages that are due now.
void RosbridgeFront::tell(Client& client, const std::vector<HeardMessage>& heard) {
    for (auto& [name, stream] : client.streams) {
        if (!stream.source) continue;
        const RosTopic& topic = *stream.source;
        const bool is_step_end = topic.kind() == RosTopicKind::clock && clock_.is_step_end(now());
        if (stream.due <= now() || is_step_end) {
            publish(client, stream, written(name, stream.delivery().encoding, topic));
            stream.due = multiple_after(now(), messages_->period(topic));
        }
        for (const HeardMessage& each : heard) {
            if (topic.kind() != RosTopicKind::received || each.at != topic.robot) continue;
            write_publication(buffer_, stream.delivery().encoding, name,
                              [&](RosWriter& out) { messages_->write(out, each); });
            publish(client, stream, buffer_);
        }
        stream.go_on(now(), [&, encoding = stream.delivery().encoding](std::string_view message) {
            send(client, encoding, message);
        });
    }
}

/// Updates next() after any change.
void RosbridgeFront::go_on() {
    next_ = robots_->any() ? multiple_after(now(), ros_tick) : never;
    next_ = std::min(next_, clock_.next());
    for (const auto& [connection, client] : clients_) {
        for (const auto& [name, stream] : client.streams) {
            next_ = std::min({next_, stream.due, stream.next()});
        }
    }
}

}  // namespace rovernet
