// SPDX-License-Identifier: MIT
#include "network/network.hpp"

#include "network/engine.hpp"

#include <limits>
#include <stdexcept>

namespace rovernet {
namespace {

Callback<> callback(std::function<void()> call) {
    return std::make_shared<std::function<void()>>(std::move(call));
}

}  // namespace

Network::Network(NetworkSettings settings)
    : engine_(std::make_unique<Engine>(std::move(settings))) {}
Network::~Network() = default;

void Network::reserve(std::size_t robots) { engine_->reserve(robots); }
NodeId Network::add(Robot robot) { return engine_->add(std::move(robot)); }
void Network::route(Router router) { engine_->route(std::move(router)); }
void Network::add_sink(Sink sink) { engine_->add_sink(std::move(sink)); }

void Network::broadcast(NodeId node, std::string payload, std::optional<std::uint32_t> size,
                        std::uint32_t flow) {
    const auto bytes = size.value_or(static_cast<std::uint32_t>(payload.size()));
    engine_->send(node, std::move(payload), {bytes, flow});
}

void Network::unicast(NodeId node, NodeId to, std::string payload,
                      std::optional<std::uint32_t> size, std::uint32_t flow) {
    const auto bytes = size.value_or(static_cast<std::uint32_t>(payload.size()));
    engine_->send_to(node, to, std::move(payload), {bytes, flow});
}
void Network::saturate(NodeId node, NodeId to, std::uint32_t size, std::uint32_t flow) {
    engine_->saturate(node, to, {size, flow});
}

void Network::on_receive(NodeId node, std::function<void(const Message&)> react) {
    on_receive(node, [react = std::move(react)](const Message& m, const Heard&) { react(m); });
}

void Network::on_receive(NodeId node, std::function<void(const Message&, const Heard&)> react) {
    engine_->node(node).on_receive.push_back(
        std::make_shared<std::function<void(const Message&, const Heard&)>>(std::move(react)));
    engine_->has_reactions_ = true;
}

void Network::on_arrival(NodeId node, std::function<void()> react) {
    engine_->on_arrival_[engine_->known(node)].push_back(callback(std::move(react)));
}

void Network::on_link_lost(NodeId node, std::function<void(NodeId)> react) {
    engine_->watch_links();
    engine_->on_link_lost_[engine_->known(node)].push_back(
        std::make_shared<std::function<void(NodeId)>>(std::move(react)));
}

void Network::move(NodeId node, Movement movement) { engine_->move(node, std::move(movement)); }
void Network::place(NodeId node, Vec3 at) { engine_->place(node, at); }
void Network::stop(NodeId node) { engine_->place(node, position(node)); }
void Network::switch_off(NodeId node) { engine_->switch_robot(node, false); }
void Network::take_away(NodeId node, Presence why) {
    engine_->away_[engine_->known(node)] = why;
    engine_->switch_robot(node, false);
}
void Network::switch_on(NodeId node) {
    engine_->away_.erase(node);
    engine_->switch_robot(node, true);
}

void Network::at(Time time, std::function<void()> action) {
    engine_->schedule(time, {callback(std::move(action))});
}

void Network::every(Duration period, std::function<void()> action) {
    constexpr Range periods{
        .low = 0, .high = 1e9, .low_included = false, .text = "> 0 s, up to 1e9 s"};
    if (!periods.contains(seconds(period))) {
        throw_out_of_range("every", "period", periods.text, seconds(period));
    }
    engine_->schedule(now() + period, {callback(std::move(action)), period});
}

void Network::run_until(Time end) {
    engine_->advance(end, std::numeric_limits<std::uint64_t>::max());
}
bool Network::advance(Time end, std::uint64_t most_events) {
    return engine_->advance(end, most_events);
}
void Network::finish() { engine_->cut_off(); }
Time Network::now() const { return engine_->now(); }
std::size_t Network::size() const { return engine_->size(); }
std::uint64_t Network::events() const { return engine_->served_; }
std::optional<Db> Network::interference_left_out() const {
    return engine_->interference_left_out();
}
std::string Network::name(NodeId node) const {
    return std::string(engine_->names_[engine_->known(node).value]);
}

std::optional<NodeId> Network::find(std::string_view name) const {
    const auto found = engine_->names_.find(name);
    if (!found) return std::nullopt;
    return NodeId{*found};
}

Vec3 Network::position(NodeId node) const { return engine_->legs_.position(node, now()); }
Radians Network::heading(NodeId node) const {
    return {wrapped(engine_->legs_.leg(node).heading_at(now()))};
}

Presence Network::presence(NodeId node) const {
    if (engine_->medium_.is_on(engine_->known(node))) return Presence::on;
    const auto away = engine_->away_.find(node);
    return away == engine_->away_.end() ? Presence::off : away->second;
}
Meters Network::radius(NodeId node) const { return engine_->body(node).radius; }
const NetworkSettings& Network::settings() const { return engine_->settings_; }

std::vector<Neighbour> Network::links(NodeId node, Time t) const {
    return neighbours(engine_->medium_, engine_->legs_, node, t);
}

void Network::find_hearers(NodeId node, std::vector<NodeId>& out) {
    const auto hearers = engine_->medium_.hearers(node, now(), engine_->legs_);
    for (const Medium::Found& found : hearers) out.push_back(found.node);
}

const Legs& Network::legs() const { return engine_->legs_; }
const Medium& Network::medium() const { return engine_->medium_; }
const Scene& Network::scene() const { return *engine_->scene_; }
Planners& Network::planners() { return *engine_->planners_; }

MetricValues Network::metrics() const {
    if (!engine_->metrics_) throw std::invalid_argument("this network was made without metrics");
    return engine_->metrics_->values();
}

}  // namespace rovernet
