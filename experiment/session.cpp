// SPDX-License-Identifier: MIT
#include "experiment/session.hpp"

#include "experiment/build.hpp"
#include "models/medium/medium.hpp"
#include "scenario/located.hpp"
#include "sim/link_layer.hpp"
#include "sim/sink.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <type_traits>
#include <utility>

namespace rovernet {

/// Sink that notes what the callbacks of a network do not tell: the numbers of messages, and whose
/// frame brought a message at what level.
class Session::Ears {
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
            // A robot that was switched off before it could react leaves its frames here.
            std::erase_if(frames, [&](const Frame& f) { return f.time + reacts_in < at.time; });
            frames.push_back({context.messages[got->frame.message].uid, at.time, got->frame.sender,
                              got->levels.empty() ? std::nullopt : std::optional(got->levels[i])});
        }
    }

    void listen(NodeId robot) { frames_[robot]; }
    void stop_listening(NodeId robot) { frames_.erase(robot); }
    /// The frame that brought a message to a robot, which is forgotten then.
    std::optional<Frame> take(NodeId robot, std::uint64_t uid) {
        auto& frames = frames_[robot];
        const auto found = std::find_if(frames.begin(), frames.end(),
                                        [&](const Frame& frame) { return frame.uid == uid; });
        if (found == frames.end()) return std::nullopt;
        const Frame frame = *found;
        frames.erase(found);
        return frame;
    }
    /// Notes the port of a message, later than those before.
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

Session::Session(const Scenario& scenario) : Session(scenario, network_settings(scenario)) {}

Session::Session(const Scenario& scenario, NetworkSettings settings)
    : file_(scenario.file),
      network_(std::make_shared<Network>(std::move(settings))),
      end_(start_of_run + scenario.scenario.duration),
      driven_(*network_) {
    populate(*network_, scenario);
    for (const RobotTable& table : scenario.robots) {
        if (table.scan.empty()) continue;
        const auto scanners = std::make_shared<const std::vector<Scanner>>(table.scan);
        for (int i = 0; i < table.count.value_or(1); ++i) {
            range_finders_[*network_->find(table.name_of(i))] = scanners;
        }
    }
}

Session::~Session() {
    for (auto& [robot, listeners] : listeners_) listeners.subscription.end();
}

bool Session::advance(Time until, std::uint64_t most_events) {
    // A fault that a model finds only when its turn comes is the scenario's, too.
    return located(Location{file_},
                   [&] { return network_->advance(std::min(until, end_), most_events); });
}

bool Session::run(std::optional<double> speed, const std::function<bool(double)>& progress) {
    using WallClock = std::chrono::steady_clock;
    constexpr std::uint64_t events_a_slice = 256;  // each may reach thousands of robots
    constexpr double longest_wait_s = 0.05;
    const auto started = WallClock::now();
    const Time begun = network_->now();
    for (;;) {
        Time until = end_;
        if (speed) {
            const std::chrono::duration<double> wall = WallClock::now() - started;
            until = std::min(end_, begun + from_seconds(wall.count() * *speed));
        }
        const bool arrived = advance(until, events_a_slice);
        const bool done = arrived && until == end_;
        const double share = seconds(network_->now()) / seconds(end_);
        if (progress && !progress(share)) return false;
        if (done) return true;
        if (speed && network_->now() >= until) {
            std::this_thread::sleep_for(std::chrono::duration<double>(longest_wait_s));
        }
    }
}

ClientId Session::attach(const std::vector<NodeId>& robots, std::string name) {
    for (const NodeId robot : robots) {
        const std::string robot_name = network_->name(robot);
        if (drivers_.contains(robot)) {
            throw std::invalid_argument(
                fmt::format("robot {} is driven by another client already", robot_name));
        }
        if (std::count(robots.begin(), robots.end(), robot) > 1) {
            throw std::invalid_argument(fmt::format("robot {} is listed twice", robot_name));
        }
    }
    const ClientId client = attach_radios(robots, std::move(name));
    for (const NodeId robot : robots) drivers_[robot] = client;
    return client;
}

ClientId Session::attach_radios(const std::vector<NodeId>& robots, std::string name) {
    advance(network_->now(), every_event);  // a command comes after all events of its time
    if (!ears_) {
        ears_ = std::make_shared<Ears>();
        network_->add_sink(ears_);
    }
    const ClientId client = next_client_++;
    clients_[client] = {.name = std::move(name), .robots = robots};
    for (const NodeId robot : robots) listen(client, robot);
    return client;
}

void Session::listen(ClientId client, NodeId robot) {
    Listeners& listeners = listeners_[robot];
    listeners.clients.push_back(client);
    if (listeners.clients.size() > 1) return;
    ears_->listen(robot);
    listeners.subscription = network_->on_receive(
        robot,
        [this, robot](const Message& message, const Heard& how) { hear(robot, message, how); });
}

void Session::stop_listening(ClientId client, NodeId robot) {
    Listeners& listeners = listeners_.at(robot);
    std::erase(listeners.clients, client);
    if (!listeners.clients.empty()) return;
    listeners.subscription.end();
    listeners_.erase(robot);
    ears_->stop_listening(robot);
}

void Session::hear(NodeId robot, const Message& message, const Heard& how) {
    const auto frame = ears_->take(robot, message.uid);
    for (const ClientId each : listeners_.at(robot).clients) {
        Client& client = clients_.at(each);
        if (!client.hears) continue;
        HeardMessage& heard = client.heard.emplace_back(HeardMessage{
            network_->now(), robot, message.origin, how.hops, message.payload, message.origin});
        if (frame) {
            heard.last_hop = frame->sender;
            heard.level = frame->level;
        }
        heard.port = ears_->port(message.uid);
        heard.is_for_everyone = message.to == everyone;
    }
}

void Session::detach(ClientId client) {
    for (const NodeId robot : client_of(client).robots) {
        if (driver(robot) == client) {
            carry_out(client, robot, StopCommand{});
            drivers_.erase(robot);
        }
        stop_listening(client, robot);
    }
    clients_.erase(client);
}

std::optional<ClientId> Session::driver(NodeId robot) const {
    const auto found = drivers_.find(robot);
    return found == drivers_.end() ? std::nullopt : std::optional(found->second);
}

Session::Client& Session::client_of(ClientId client) {
    const auto found = clients_.find(client);
    if (found == clients_.end()) throw std::invalid_argument("there is no such client");
    return found->second;
}

void Session::check_robot(ClientId client, NodeId robot) {
    client_of(client);
    if (driver(robot) == client) return;
    throw std::invalid_argument(
        fmt::format("robot {} is not the client's: attach it first", network_->name(robot)));
}

void Session::check_radio(ClientId client, NodeId robot) {
    const auto found = listeners_.find(robot);
    const bool is_its =
        found != listeners_.end() &&
        std::count(found->second.clients.begin(), found->second.clients.end(), client);
    if (!is_its) check_robot(client, robot);
}

std::optional<std::uint64_t> Session::carry_out(ClientId client, NodeId robot,
                                                const RobotCommand& command, std::uint64_t number) {
    if (std::holds_alternative<SendCommand>(command)) {
        check_radio(client, robot);
    } else {
        check_robot(client, robot);
    }
    advance(network_->now(), every_event);  // what the last command caused at this time comes first
    if (tell_) tell_({network_->now(), robot, client_of(client).name, number, command});
    ears_->last_sent.reset();
    const auto act = [&](const auto& each) {
        if constexpr (std::is_same_v<decltype(each), const SendCommand&>) {
            send_message(robot, each);
        } else {
            driven_.carry_out(robot, each);
        }
    };
    std::visit(act, command);
    return ears_->last_sent;
}

void Session::send_message(NodeId robot, const SendCommand& command) {
    if (command.to) {
        network_->unicast(robot, *command.to, command.payload, command.size);
    } else {
        network_->broadcast(robot, command.payload, command.size);
    }
    if (command.port != 0 && ears_->last_sent) ears_->put_port(*ears_->last_sent, command.port);
}

void Session::move(ClientId client, NodeId robot, Movement movement) {
    check_robot(client, robot);
    driven_.move(robot, std::move(movement));
}

std::vector<HeardMessage> Session::heard(ClientId client) {
    auto heard = std::exchange(client_of(client).heard, {});
    std::stable_sort(heard.begin(), heard.end(), [](const auto& a, const auto& b) {
        return a.time != b.time ? a.time < b.time : a.at < b.at;
    });
    return heard;
}

void Session::set_hearing(ClientId client, bool hears) {
    client_of(client).hears = hears;
    if (!hears) client_of(client).heard.clear();
}

std::span<const Scanner> Session::range_finders(NodeId robot) const {
    const auto found = range_finders_.find(robot);
    return found == range_finders_.end() ? std::span<const Scanner>{} : *found->second;
}

std::vector<double> Session::scan(NodeId robot, std::size_t number) const {
    const Scanner& scanner = range_finders_.at(robot)->at(number);
    std::vector<RoundBody> others;
    const auto storey_of = [&](Vec3 at) { return network_->scene().storeys().number_at(at.z); };
    const std::size_t storey = storey_of(network_->position(robot));
    for (NodeId other{0}; other.index() < network_->size(); ++other.value) {
        const RobotState state = network_->robot(other);
        const bool is_there = state.presence == Presence::on || state.presence == Presence::off;
        if (other != robot && is_there && storey_of(state.at) == storey)
            others.push_back({state.at, state.radius});
    }
    std::vector<double> ranges(scanner.size());
    scanner.measure(network_->scene(), {network_->position(robot), network_->heading(robot)},
                    others, ranges);
    return ranges;
}

}  // namespace rovernet
