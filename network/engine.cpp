// SPDX-License-Identifier: MIT
#include "network/engine.hpp"

#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace rovernet {

namespace {

const Scene& open_field() {
    static const Scene scene;
    return scene;
}

std::optional<Db> interference_cut(const ReceptionRung& rung) {
    const auto* sinr = std::get_if<Sinr>(&rung);
    return sinr ? std::optional(sinr->interference_cut) : std::nullopt;
}

}  // namespace

Engine::Engine(NetworkSettings settings)
    : settings_(std::move(settings)),
      scene_(settings_.scene ? settings_.scene.get() : &open_field()),
      planners_(settings_.planners ? settings_.planners : std::make_shared<Planners>(*scene_)),
      medium_({.scene = scene_,
               .floor_height = settings_.floor_height,
               .propagation_delay = settings_.propagation_delay,
               .all_pairs = settings_.reference,
               .interference_cut = interference_cut(settings_.reception),
               .seed = settings_.seed,
               .replication = settings_.replication}),
      frames_meet_(!std::holds_alternative<Threshold>(settings_.reception)) {
    if (!positive.contains(settings_.floor_height.value)) {
        throw_out_of_range("network", "floor_height", positive.text, settings_.floor_height.value);
    }
    if (&planners_->scene() != scene_) {
        throw std::invalid_argument("network: planners must be those of its scene");
    }
    for (const Duration d : {settings_.links.tolerance, settings_.links.min_dwell}) {
        if (d < Duration{1}) throw_out_of_range("network", "links", ">= 1 ns", seconds(d));
    }
    if (const auto* sinr = std::get_if<Sinr>(&settings_.reception)) {
        sinr_receiver_ = SinrReceiver(*sinr);
    }
    if (const auto* aloha = std::get_if<Aloha>(&settings_.access)) aloha_.emplace(*aloha);
    if (const auto* csma = std::get_if<Csma>(&settings_.access)) {
        dcf_.emplace(*csma);
        if (std::holds_alternative<Sinr>(settings_.reception)) {
            for (const BitRate rate : csma->basic_rates) check_rate(rate);
        }
    }
    if (settings_.metrics) {
        metrics_ =
            std::make_shared<Metrics>(start_of_run + settings_.warmup, settings_.metric_parts);
        add_sink(Sink{metrics_});
    }
}

void Engine::add_sink(Sink sink) {
    const KindMask kinds = sink.kinds();
    wanted_ |= kinds;
    links_wanted_ = links_wanted_ || (kinds & kind_links) != 0;
    sinks_.push_back(std::move(sink));
}

void Engine::schedule(Time time, Action action) {
    if (time < now_) {
        throw std::invalid_argument(
            fmt::format("an action at {} s, but it is {} s already", seconds(time), seconds(now_)));
    }
    const std::size_t slot = actions_.take();
    actions_[slot] = std::move(action);
    queue_.schedule(time, Priority::user, {Occurrence::Kind::action, NodeId{0}, slot});
}

void Engine::act(std::size_t slot) {
    const Action action = actions_[slot];  // a copy: the call may add actions
    if (action.period > Duration{0}) {
        queue_.schedule(now_ + action.period, Priority::user,
                        {Occurrence::Kind::action, NodeId{0}, slot});
    } else {
        actions_[slot] = {};
        actions_.release(slot);
    }
    (*action.call)();
}

void Engine::serve(const Scheduler<Occurrence>::Event& event) {
    const auto& [kind, node_id, data] = event.payload;
    switch (kind) {
        case Occurrence::Kind::frame: return arrive(event);
        case Occurrence::Kind::router_timer: return router_->on_timer(*this, node_id, data);
        case Occurrence::Kind::leg_end:
            if (legs_.version(node_id) == data) next_leg(node_id);
            return;
        case Occurrence::Kind::handed_over: return react(node_id, data);
        case Occurrence::Kind::action: return act(data);
        case Occurrence::Kind::link_change: return change_links();
        case Occurrence::Kind::access_timer:
            return on_access_timer(node_id, static_cast<std::uint32_t>(data));
    }
}

/// The errors in its bits can be computed.
void Engine::check_rate(BitRate rate) const {
    if (modulation_of(rate)) return;
    throw std::invalid_argument(
        fmt::format("sinr knows the rates of 802.11b, a and g, not {} bit/s", rate.value));
}

/// Throws if too many events wait or were scheduled, or sees when that may be so next.
void Engine::count_events() {
    // The queue ends there; an event may add more than one.
    constexpr std::uint64_t most_pending = SchedulerLimits{}.pending / 16 * 15;
    if (queue_.size() > most_pending) {
        throw RunError(
            fmt::format("{} events wait at {:.9f} s, more than a run can hold; lower the load: "
                        "fewer messages, a "
                        "smaller ttl",
                        queue_.size(), seconds(now_)));
    }
    if (queue_.scheduled() > settings_.event_limit) {
        throw RunError(fmt::format(
            "event limit of {} reached at {:.9f} s; raise [scenario] event_limit, or lower the "
            "load: a shorter duration, fewer messages, a smaller ttl",
            settings_.event_limit, seconds(now_)));
    }
    check_at_ = std::min(settings_.event_limit, queue_.scheduled() + most_pending - queue_.size());
}

bool Engine::advance(Time end, std::uint64_t most_events) {
    running_ = true;
    end_of_run_ = end;
    begin_movements();
    if (links_wanted_ && !watch_) start_watch();
    for (;;) {
        const auto next = queue_.next_time();
        if (!next || *next > end) break;
        if (most_events-- == 0) return false;
        if (queue_.scheduled() > check_at_) [[unlikely]]
            count_events();
        const auto event = queue_.pop();
        now_ = event.key.time();
        ++served_;
        if (!queue_.empty()) medium_.prefetch(queue_.next().node);  // while this one is served
        serve(event);
    }
    now_ = std::max(now_, end);
    return true;
}

}  // namespace rovernet
