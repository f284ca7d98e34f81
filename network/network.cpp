// SPDX-License-Identifier: MIT
#include "network/network.hpp"

#include "models/medium/medium.hpp"
#include "network/engine.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

namespace rovernet {
Network::Network(NetworkSettings settings)
    : engine_(std::make_unique<Engine>(std::move(settings))) {}
Network::~Network() = default;

void Network::reserve(std::size_t robots) { engine_->reserve(robots); }
NodeId Network::add(Robot robot) { return engine_->add(std::move(robot)); }
void Network::route(Router router) { engine_->routing.set(std::move(router)); }
SinkId Network::add_sink(Sink sink) { return engine_->add_sink(std::move(sink)); }
void Network::remove_sink(SinkId sink) { engine_->world.records.remove(sink); }

std::optional<std::uint64_t> Network::send(NodeId from, NodeId to, std::string payload,
                                           SendOptions options) {
    return engine_->applications.send(engine_->known(from), to, std::move(payload), options);
}
void Network::saturate(NodeId node, NodeId to, std::uint32_t size, std::uint32_t flow,
                       std::string payload) {
    engine_->applications.saturate(node, to, std::move(payload),
                                   {.size = size, .flow = flow, .one_hop = true});
}

Subscription Network::on_receive(NodeId node, std::function<void(const Message&)> react) {
    return on_receive(node,
                      [react = std::move(react)](const Heard& heard) { react(heard.message); });
}

Subscription Network::on_receive(NodeId node, std::function<void(const Heard&)> react,
                                 HearOptions options) {
    const Callback<const Heard&> callback(std::move(react));
    engine_->applications.on_receive(engine_->known(node), callback, options);
    return callback.subscription();
}

Subscription Network::on_arrival(NodeId node, std::function<void()> react) {
    const Callback<> callback(std::move(react));
    engine_->motion.on_arrival(engine_->known(node), callback);
    return callback.subscription();
}

Subscription Network::on_link_lost(NodeId node, std::function<void(NodeId)> react) {
    const Callback<NodeId> callback(std::move(react));
    engine_->links.on_link_lost(engine_->known(node), callback);
    return callback.subscription();
}

void Network::move(NodeId node, Movement movement) {
    engine_->motion.move(node, std::move(movement));
}
void Network::place(NodeId node, Vec3 at, std::optional<Radians> heading) {
    engine_->motion.place(node, at, heading);
}
void Network::stop(NodeId node) { engine_->motion.place(node, position(node)); }
void Network::set_rate(NodeId node, BitRate rate) {
    engine_->channel.check(rate);
    engine_->world.medium.set_rate(engine_->known(node), rate);
    engine_->links.look_at(node);
}
void Network::switch_off(NodeId node) { engine_->switch_robot(node, false); }
void Network::take_away(NodeId node, Presence why) {
    engine_->away[engine_->known(node)] = why;
    engine_->switch_robot(node, false);
}
void Network::switch_on(NodeId node) {
    engine_->away.erase(node);
    engine_->switch_robot(node, true);
}

Subscription Network::at(Time time, std::function<void()> action) {
    const Callback<> callback(std::move(action));
    engine_->world.schedule(time, callback);
    return callback.subscription();
}

Subscription Network::every(Duration period, std::function<void()> action) {
    constexpr Range periods{
        .low = 0, .high = 1e9, .low_included = false, .text = "> 0 s, up to 1e9 s"};
    if (!periods.contains(seconds(period))) {
        throw_out_of_range("every", "period", periods.text, seconds(period));
    }
    const Callback<> callback(std::move(action));
    engine_->world.schedule(now() + period, callback, period);
    return callback.subscription();
}

void Network::run_until(Time end) {
    engine_->advance(end, std::numeric_limits<std::uint64_t>::max());
}
bool Network::advance(Time end, std::uint64_t most_events, Time limit) {
    return engine_->advance(end, most_events, limit);
}
void Network::finish() {
    engine_->applications.cut_off();
    engine_->routing.check_held();
    engine_->world.records.finish();
}
Time Network::now() const { return engine_->world.now; }
Time Network::next_event() const { return engine_->world.events.next_time().value_or(never); }
std::size_t Network::size() const { return engine_->world.size(); }
std::uint64_t Network::events() const { return engine_->served; }
std::uint64_t Network::transmissions() const { return engine_->world.transmissions; }
std::optional<Db> Network::interference_left_out() const {
    return engine_->channel.interference_left_out();
}
std::string Network::name(NodeId node) const {
    return std::string(engine_->names[engine_->known(node).value]);
}

std::optional<NodeId> Network::find(std::string_view name) const {
    const auto found = engine_->names.find(name);
    if (!found) return std::nullopt;
    return NodeId{*found};
}

Vec3 Network::position(NodeId node) const { return engine_->world.legs.position(node, now()); }
Radians Network::heading(NodeId node) const {
    return {wrapped(engine_->world.legs.leg(node).heading_at(now()))};
}
std::uint32_t Network::movements(NodeId node) const { return engine_->motion.movements(node); }

RobotState Network::robot(NodeId node) const {
    const Medium& medium = engine_->world.medium;
    Presence presence = Presence::on;
    if (!medium.stations().is_on(engine_->known(node))) {
        const auto away = engine_->away.find(node);
        presence = away == engine_->away.end() ? Presence::off : away->second;
    }
    return {.name = name(node),
            .at = position(node),
            .heading = heading(node),
            .radius = engine_->motion.body(node).radius,
            .presence = presence,
            .radio = medium.stations().radio(node),
            .propagation = medium.stations().model(node)};
}
std::vector<RouteState> Network::routes(NodeId node) const {
    const std::optional<Router>& router = engine_->routing.router();
    return router ? router->routes(engine_->known(node), now()) : std::vector<RouteState>{};
}
std::string Network::routing_notice() const {
    const std::optional<Router>& router = engine_->routing.router();
    return router ? router->notice() : std::string{};
}
const NetworkSettings& Network::settings() const { return engine_->world.settings; }

Db Network::path_loss(NodeId from, NodeId to) const {
    return medium().links().path_loss(from, to, now(), legs());
}
std::vector<Neighbour> Network::links(NodeId node, Time t) const {
    return neighbours(engine_->world.medium, engine_->world.legs, node, t);
}

void Network::find_hearers(NodeId node, std::vector<NodeId>& out) {
    const auto hearers = engine_->world.medium.hearers(node, now(), engine_->world.legs);
    for (const Medium::Found& found : hearers) out.push_back(found.node);
}

const Legs& Network::legs() const { return engine_->world.legs; }
const Medium& Network::medium() const { return engine_->world.medium; }
const Scene& Network::scene() const { return *engine_->world.scene; }
Planners& Network::planners() { return *engine_->world.planners; }

MetricValues Network::metrics() const {
    if (!engine_->metrics)
        throw std::invalid_argument(
            "this network computes no metrics; expected metrics = true in the settings of the "
            "network");
    return engine_->metrics->values();
}
Duration Network::airtime() const { return engine_->mac.airtime_so_far(); }

NodeId robot_named(const Network& network, const std::string& name) {
    if (const auto node = network.find(name)) return *node;
    constexpr std::size_t most_listed = 20, most_compared = 1000;
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < network.size() && i < most_compared; ++i) {
        names.push_back(network.name(NodeId{i}));
    }
    const std::string near = did_you_mean(name, names);
    names.resize(std::min(names.size(), most_listed));
    throw std::invalid_argument(fmt::format(
        "there is no robot \"{}\"; expected one of {}{}{}{}", name, fmt::join(names, ", "),
        network.size() > most_listed ? " ..." : "", near.empty() ? "" : "; ", near));
}

}  // namespace rovernet
