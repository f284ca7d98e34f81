// SPDX-License-Identifier: MIT
#include "experiment/session.hpp"

#include "experiment/build.hpp"
#include "mobility/waypoints.hpp"
#include "models/medium/medium.hpp"
#include "scenario/located.hpp"
#include "sim/link_layer.hpp"
#include "sim/sink.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <utility>

namespace rovernet {
namespace {

/// Place where no robot is, for an arc that nobody is on.
constexpr Vec3 not_driven{1e300, 0, 0};

}  // namespace

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
      end_(start_of_run + scenario.scenario.duration) {
    populate(*network_, scenario);
    for (const RobotTable& table : scenario.robots) {
        for (int i = 0; table.scan && i < table.count.value_or(1); ++i) {
            range_finders_[*network_->find(table.name_of(i))] = *table.scan;
        }
    }
}

Session::~Session() {
    for (auto& [id, client] : clients_) {
        for (Subscription& each : client.subscriptions) each.end();
    }
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
    advance(network_->now(), every_event);  // a command comes after all events of its time
    if (!ears_) {
        ears_ = std::make_shared<Ears>();
        network_->add_sink(ears_);
    }
    const ClientId id = next_client_++;
    Client& client = clients_[id];
    client.name = std::move(name);
    client.robots = robots;
    for (const NodeId robot : robots) {
        drivers_[robot] = id;
        ears_->listen(robot);
        client.subscriptions.push_back(network_->on_receive(
            robot, [this, id, robot](const Message& message, const Heard& how) {
                hear(id, robot, message, how);
            }));
    }
    return id;
}

void Session::hear(ClientId client, NodeId robot, const Message& message, const Heard& how) {
    const auto frame = ears_->take(robot, message.uid);
    if (!clients_.at(client).hears) return;
    HeardMessage heard{network_->now(), robot,           message.origin,
                       how.hops,        message.payload, message.origin};
    if (frame) {
        heard.last_hop = frame->sender;
        heard.level = frame->level;
    }
    heard.port = ears_->port(message.uid);
    heard.is_for_everyone = message.to == everyone;
    clients_.at(client).heard.push_back(std::move(heard));
}

void Session::detach(ClientId client) {
    for (Subscription& each : client_of(client).subscriptions) each.end();
    for (const NodeId robot : client_of(client).robots) {
        carry_out(client, robot, StopCommand{});
        ears_->stop_listening(robot);
        drivers_.erase(robot);
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

std::optional<std::uint64_t> Session::carry_out(ClientId client, NodeId robot,
                                                const RobotCommand& command, std::uint64_t number) {
    check_robot(client, robot);
    advance(network_->now(), every_event);  // what the last command caused at this time comes first
    if (tell_) tell_({network_->now(), robot, client_of(client).name, number, command});
    ears_->last_sent.reset();
    std::visit([&](const auto& each) { act(robot, each); }, command);
    return ears_->last_sent;
}

void Session::act(NodeId robot, const DriveCommand& command) {
    Driven driven{.speed = command.speed, .turn_rate = command.turn_rate};
    if (command.timeout) driven.until = network_->now() + *command.timeout;
    Driving& driving = driving_[robot];
    if (!driving.arc) driving.arc = std::make_shared<DrivenArc>(DrivenArc{.at = not_driven});
    driving.until = driven.until.value_or(never);
    driving.speed = command.speed.value;
    driven.arc = driving.arc;
    network_->move(robot, driven);
}

void Session::act(NodeId robot, const GoalCommand& command) {
    driving_.erase(robot);
    network_->move(robot, ToGoal{command.to, command.speed});
}

void Session::act(NodeId robot, const StopCommand&) {
    driving_.erase(robot);
    network_->stop(robot);
}

void Session::act(NodeId robot, const PlaceCommand& command) {
    driving_.erase(robot);
    network_->place(robot, command.at, command.heading);
}

void Session::act(NodeId robot, const SendCommand& command) {
    if (command.to) {
        network_->unicast(robot, *command.to, command.payload, command.size);
    } else {
        network_->broadcast(robot, command.payload, command.size);
    }
    if (command.port != 0 && ears_->last_sent) ears_->put_port(*ears_->last_sent, command.port);
}

void Session::move(ClientId client, NodeId robot, Movement movement) {
    check_robot(client, robot);
    driving_.erase(robot);
    network_->move(robot, std::move(movement));
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

const Session::Driving* Session::driving(NodeId robot) const {
    const auto found = driving_.find(robot);
    const bool drives = found != driving_.end() && network_->now() < found->second.until;
    return drives ? &found->second : nullptr;
}

bool Session::is_stalled(NodeId robot) const {
    const Driving* driven = driving(robot);
    return driven && driven->speed != 0 && network_->legs().leg(robot).velocity == Vec3{};
}

Twist Session::twist(NodeId robot) const {
    const Leg leg = network_->legs().leg(robot);
    if (network_->now() >= leg.end) return {};
    const double speed = std::sqrt(squared_distance(leg.velocity, {}));
    const Driving* driven = driving(robot);
    if (!driven) return {speed, leg.turning};
    // A chord is a little shorter than its arc.
    if (driven->arc->speed != 0) return {driven->arc->speed, leg.turning};
    return {driven->speed < 0 ? -speed : speed, leg.turning};
}

const RangeFinder* Session::range_finder(NodeId robot) const {
    const auto found = range_finders_.find(robot);
    return found == range_finders_.end() ? nullptr : &found->second;
}

std::vector<double> Session::scan(NodeId robot) const {
    const RangeFinder& finder = range_finders_.at(robot);
    std::vector<RoundBody> others;
    const auto storey_of = [&](Vec3 at) { return network_->scene().storey_number(at.z); };
    const std::size_t storey = storey_of(network_->position(robot));
    for (NodeId other{0}; other.index() < network_->size(); ++other.value) {
        const RobotState state = network_->robot(other);
        const bool is_there = state.presence == Presence::on || state.presence == Presence::off;
        if (other != robot && is_there && storey_of(state.at) == storey)
            others.push_back({state.at, state.radius});
    }
    std::vector<double> ranges(static_cast<std::size_t>(finder.beams));
    finder.measure(network_->scene(), network_->position(robot), network_->heading(robot), others,
                   ranges);
    return ranges;
}

}  // namespace rovernet
