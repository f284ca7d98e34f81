// SPDX-License-Identifier: MIT
#include "experiment/client_radios.hpp"

#include "sim/link_layer.hpp"
#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace rovernet {

/// Sink that stores data which network callbacks do not include: uids of messages, and last hop and
/// level of received frames.
class ClientRadios::Ears {
  public:
    struct Frame {
        std::uint64_t uid;  // of the message
        Time time;
        NodeId sender;
        std::optional<Dbm> level;
    };

    KindMask kinds() const { return kind_of<Sent>() | kind_of<Received>() | kind_levels; }
    void on(const Record& record, const RecordContext& context) {
        if (const auto* sent = std::get_if<Sent>(&record)) {
            last_sent = context.messages[sent->message].uid;
        }
        const auto* got = std::get_if<Received>(&record);
        if (!got) return;
        for (std::size_t i = 0; i < got->receptions.size(); ++i) {
            const Reception& at = got->receptions[i];
            const auto listening = frames_.find(at.node);
            if (!at.delivered || listening == frames_.end()) continue;
            auto& frames = listening->second;
            // Frames of a robot that was switched off before delivery remain here.
            std::erase_if(frames, [&](const Frame& f) { return f.time + reacts_in < at.time; });
            frames.push_back({context.messages[got->frame.message].uid, at.time, got->frame.sender,
                              got->levels.empty() ? std::nullopt : std::optional(got->levels[i])});
        }
    }

    void listen(NodeId robot) { frames_[robot]; }
    void stop_listening(NodeId robot) { frames_.erase(robot); }
    /// Removes and returns the frame that brought a message to a robot.
    std::optional<Frame> take(NodeId robot, std::uint64_t uid) {
        auto& frames = frames_[robot];
        const auto found = std::find_if(frames.begin(), frames.end(),
                                        [&](const Frame& frame) { return frame.uid == uid; });
        if (found == frames.end()) return std::nullopt;
        const Frame frame = *found;
        frames.erase(found);
        return frame;
    }
    /// Stores the port of a message; uids ascend.
    void put_port(std::uint64_t uid, std::uint16_t port) { ports_.emplace_back(uid, port); }
    std::uint16_t port(std::uint64_t uid) const {
        const auto found = std::lower_bound(ports_.begin(), ports_.end(), std::pair{uid, no_port});
        return found != ports_.end() && found->first == uid ? found->second : no_port;
    }

    std::optional<std::uint64_t> last_sent;

  private:
    static constexpr Duration reacts_in = 2 * least_reaction;
    static constexpr std::uint16_t no_port = 0;

    std::map<NodeId, std::vector<Frame>> frames_;
    std::vector<std::pair<std::uint64_t, std::uint16_t>> ports_;  // in order
};

ClientRadios::~ClientRadios() {
    for (auto& [robot, listeners] : listeners_) listeners.subscription.end();
}

void ClientRadios::join(ClientId client, const std::vector<NodeId>& robots) {
    if (!ears_) {
        ears_ = std::make_shared<Ears>();
        network_.add_sink(ears_);
    }
    inboxes_[client] = {};
    for (const NodeId robot : robots) listen(client, robot);
}

void ClientRadios::leave(ClientId client, const std::vector<NodeId>& robots) {
    for (const NodeId robot : robots) stop_listening(client, robot);
    inboxes_.erase(client);
}

void ClientRadios::listen(ClientId client, NodeId robot) {
    Listeners& listeners = listeners_[robot];
    listeners.clients.push_back(client);
    if (listeners.clients.size() > 1) return;
    ears_->listen(robot);
    listeners.subscription = network_.on_receive(
        robot,
        [this, robot](const Message& message, const Heard& how) { hear(robot, message, how); });
}

void ClientRadios::stop_listening(ClientId client, NodeId robot) {
    Listeners& listeners = listeners_.at(robot);
    std::erase(listeners.clients, client);
    if (!listeners.clients.empty()) return;
    listeners.subscription.end();
    listeners_.erase(robot);
    ears_->stop_listening(robot);
}

void ClientRadios::hear(NodeId robot, const Message& message, const Heard& how) {
    const auto frame = ears_->take(robot, message.uid);
    for (const ClientId each : listeners_.at(robot).clients) {
        Inbox& inbox = inboxes_.at(each);
        if (!inbox.hears) continue;
        HeardMessage& heard = inbox.heard.emplace_back(HeardMessage{
            network_.now(), robot, message.origin, how.hops, message.payload, message.origin});
        if (frame) {
            heard.last_hop = frame->sender;
            heard.level = frame->level;
        }
        heard.port = ears_->port(message.uid);
        heard.is_for_everyone = message.to == everyone;
    }
}

bool ClientRadios::has(ClientId client, NodeId robot) const {
    const auto found = listeners_.find(robot);
    if (found == listeners_.end()) return false;
    const std::vector<ClientId>& clients = found->second.clients;
    return std::find(clients.begin(), clients.end(), client) != clients.end();
}

std::optional<std::uint64_t> ClientRadios::send(NodeId robot, const SendCommand& command) {
    ears_->last_sent.reset();
    if (command.to || command.one_hop) {
        network_.unicast(robot, command.to.value_or(everyone), command.payload, command.size);
    } else {
        network_.broadcast(robot, command.payload, command.size);
    }
    if (command.port != 0 && ears_->last_sent) ears_->put_port(*ears_->last_sent, command.port);
    return ears_->last_sent;
}

std::vector<HeardMessage> ClientRadios::heard(ClientId client) {
    auto heard = std::exchange(inboxes_.at(client).heard, {});
    std::stable_sort(heard.begin(), heard.end(), [](const auto& a, const auto& b) {
        return a.time != b.time ? a.time < b.time : a.at < b.at;
    });
    return heard;
}

void ClientRadios::set_hearing(ClientId client, bool hears) {
    Inbox& inbox = inboxes_.at(client);
    inbox.hears = hears;
    if (!hears) inbox.heard.clear();
}

}  // namespace rovernet
