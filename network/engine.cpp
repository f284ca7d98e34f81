// SPDX-License-Identifier: MIT
#include "network/engine.hpp"

#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rovernet {

// Each part is constructed after the parts that it notifies.
Engine::Engine(NetworkSettings settings)
    : world(std::move(settings)),
      applications(world, routing, mac),
      routing(world, mac, applications),
      mac(world, channel, routing),
      channel(world, mac),
      links(world),
      motion(world, channel, links) {
    for (const BitRate rate : mac.own_rates()) channel.check(rate);
    if (!world.settings.metrics) return;
    metrics = std::make_shared<Metrics>(start_of_run + world.settings.warmup,
                                        world.settings.metric_parts);
    add_sink(Sink{metrics});
}

void Engine::reserve(std::size_t robots) {
    world.legs.reserve(robots);
    world.medium.reserve(robots);
    names.reserve(robots);
}

NodeId Engine::add(Robot robot) {
    if (robot.name.empty()) robot.name = fmt::format("r{}", world.size());
    if (names.find(robot.name)) {
        throw std::invalid_argument(fmt::format(
            "two robots are named \"{}\"; give each robot a different name", robot.name));
    }
    Motion::check(robot);
    channel.check(robot.radio.rate);
    world.medium.add(robot.radio, name_key(robot.name),
                     robot.propagation.value_or(world.settings.propagation));
    mac.add();
    names.add(robot.name);
    std::string role = std::move(robot.role);
    const NodeId id = motion.add(std::move(robot));
    routing.set_role(id, std::move(role));
    links.added(id);
    if (world.running) {
        motion.begin_all();
        routing.on_start(id);
    }
    return id;
}

SinkId Engine::add_sink(Sink sink) {
    if (sink.kinds() & kind_links) links.want();
    if (sink.kinds() & kind_levels) world.levels_wanted = true;
    if (world.running) sink.begin(run_info());
    return world.records.add(std::move(sink));
}

RunInfo Engine::run_info() const {
    return {.scenario = world.settings.scenario,
            .robots = world.size(),
            .name = [this](NodeId node) { return names[known(node).value]; },
            .seed = world.settings.seed,
            .replication = world.settings.replication};
}

void Engine::switch_robot(NodeId id, bool on) {
    if (world.medium.stations().is_on(id) == on) return;
    channel.before_change(id, !on);
    world.medium.switch_radio(id, on);
    if (!on) mac.switch_off(id);
    world.emit(Switched{world.now, id, on});
    links.look_at(id);
    if (!world.running) return;
    on ? motion.resume(id) : motion.pause(id);
    routing.on_switched(id, on);
    if (on) applications.refill(id);
}

void Engine::change_scene() {
    world.change_scene();
    links.scene_changed();
    motion.scene_changed();
}

void Engine::serve(const Event& event) {
    const auto& [kind, node, data] = event.payload;
    switch (kind) {
        case Occurrence::Kind::frame: return channel.arrive(event);
        case Occurrence::Kind::router_timer: return routing.on_timer(node, data);
        case Occurrence::Kind::send: return routing.on_send(static_cast<SendHandle>(data));
        case Occurrence::Kind::leg_end: return motion.on_leg_end(node, data);
        case Occurrence::Kind::handed_over: return applications.react(node, data);
        case Occurrence::Kind::action: return world.act(data);
        case Occurrence::Kind::link_change: return links.change_links();
        case Occurrence::Kind::access_timer:
            return mac.on_timer(node, static_cast<std::uint32_t>(data));
        case Occurrence::Kind::unheard: return mac.on_unheard(data);
        case Occurrence::Kind::scene_change: return change_scene();
        case Occurrence::Kind::arp:
            return routing.on_arp(node, NodeId{static_cast<std::uint32_t>(data)});
    }
}

/// Throws at the event limits; otherwise computes the number of events until the next check.
void Engine::count_events() {
    const auto& events = world.events;
    // Margin below the size of the queue, because one event may add several.
    constexpr std::uint64_t most_pending = SchedulerLimits{}.pending / 16 * 15;
    if (events.size() > most_pending) {
        throw RunError(
            fmt::format("{} scheduled events wait at {:.9f} s of simulated time, which is more "
                        "than a run can hold; lower the load: fewer messages, a smaller ttl",
                        events.size(), seconds(world.now)));
    }
    const std::uint64_t limit = world.settings.event_limit;
    if (events.scheduled() > limit) {
        const auto advice =
            applications.has_sent()
                ? "lower the load: a shorter duration, fewer messages, a smaller ttl"
                : "simulate less: choose a shorter duration or an earlier time";
        throw RunError(fmt::format(
            "the event limit of {} is reached at {:.9f} s; raise [scenario] event_limit, or {}",
            limit, seconds(world.now), advice));
    }
    if (events.scheduled() > look_at_) {
        look_at_ = events.scheduled() + Liveness::most_events;
        legs_.look(world.now);
        others_.look(world.now);
    }
    check_at_ = std::min({limit, look_at_, events.scheduled() + most_pending - events.size()});
    if (!legs_.is_counting(world.now) && !others_.is_counting(world.now)) return;
    check_at_ = 0;
    count_next();
}

void Engine::count_next() {
    using Kind = Occurrence::Kind;
    const auto& [kind, node, unused] = world.events.next();
    const bool is_of_robot =
        kind != Kind::action && kind != Kind::link_change && kind != Kind::scene_change;
    Liveness& watch = kind == Kind::leg_end ? legs_ : others_;
    if (!is_of_robot || !watch.is_counting(world.now) || !watch.is_stuck(node)) return;
    const Vec3 at = world.legs.position(node, world.now);
    throw StalledRun(fmt::format(
        "robot \"{}\" at ({:.6f}, {:.6f}) m: {} events at {:.9f} s of the run, and the simulated "
        "time hardly advances; {} causes events without end",
        names[node.value], at.x, at.y, Liveness::most_events, seconds(world.now),
        kind == Kind::leg_end ? "its movement"
                              : "the protocol of this robot, or its reaction to a message,"));
}

bool Engine::advance(Time end, std::uint64_t most_events, Time limit) {
    auto& events = world.events;
    world.end_of_run = std::max(end, limit);
    if (!std::exchange(world.running, true)) {
        world.records.begin(run_info());
        routing.start();
    }
    motion.begin_all();
    links.begin();
    for (;;) {
        const auto next = events.next_time();
        if (!next || *next > end) break;
        if (most_events-- == 0) return false;
        if (events.scheduled() > check_at_) [[unlikely]]
            count_events();
        const Event event = events.pop();
        world.now = event.key.time();
        ++served;
        if (!events.empty()) world.medium.prefetch(events.next().node);  // meanwhile
        serve(event);
        end = std::max(end, world.now);
    }
    world.now = std::max(world.now, end);
    return true;
}

}  // namespace rovernet
