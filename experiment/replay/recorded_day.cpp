// SPDX-License-Identifier: MIT
#include "experiment/replay/recorded_day.hpp"

#include "experiment/build.hpp"
#include "experiment/replay/to_destination.hpp"
#include "experiment/run.hpp"
#include "experiment/version.hpp"
#include "experiment/warmup.hpp"
#include "mobility/recorded_legs.hpp"
#include "models/medium/medium.hpp"
#include "models/propagation/disc.hpp"
#include "scenario/equal_starts.hpp"
#include "sim/geometry.hpp"
#include "traces/metrics.hpp"
#include "traces/recorded/recorded_trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace rovernet {
namespace {

std::shared_ptr<Metrics> metrics_of(const Scenario& scenario, const NetworkSettings& settings) {
    const Time begin = start_of_run + warmup_of(scenario, settings);
    return std::make_shared<Metrics>(begin, settings.metric_parts);
}

std::uint64_t sum_of(const std::vector<std::uint64_t>& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

/// Deliveries that are in `some` and not in `others`; both are sorted.
std::vector<Delivery> missing(const std::vector<Delivery>& some,
                              const std::vector<Delivery>& others) {
    std::vector<Delivery> only;
    std::set_difference(some.begin(), some.end(), others.begin(), others.end(),
                        std::back_inserter(only));
    return only;
}

std::vector<std::uint64_t> counts_by_robot(const std::vector<Delivery>& list, std::size_t robots) {
    std::vector<std::uint64_t> counts(robots);
    for (const Delivery& each : list) ++counts[each.at.index()];
    return counts;
}

}  // namespace

std::uint64_t DeliveryChange::all_gained() const { return sum_of(gained); }
std::uint64_t DeliveryChange::all_lost() const { return sum_of(lost); }

DeliveryDifference difference_of(std::vector<Delivery> before, std::vector<Delivery> after) {
    std::sort(before.begin(), before.end());
    std::sort(after.begin(), after.end());
    DeliveryDifference difference{missing(after, before), missing(before, after), 0};
    difference.same = before.size() - difference.lost.size();
    return difference;
}

DeliveryChange change_of(const PlayedDay& before, const PlayedDay& after, std::size_t robots) {
    const DeliveryDifference difference = difference_of(before.deliveries, after.deliveries);
    return {counts_by_robot(difference.gained, robots), counts_by_robot(difference.lost, robots)};
}

RecordedDay::RecordedDay(const std::string& path) {
    RecordedReader trace(path);
    run_ = trace.run();
    scenario_ = std::make_unique<ReplayedScenario>(run_, path);
    const Scenario scenario = scenario_->with({});
    check_robots(run_, scenario, path);
    const auto metrics = metrics_of(scenario, network_settings(scenario));
    const auto deliveries = std::make_shared<Deliveries>();
    Sink sinks[] = {Sink(DayLogSink{log_}), Sink(metrics), Sink(deliveries)};
    while (const Record* record = trace.next()) {
        for (Sink& sink : sinks) sink.on(*record, trace.context());
    }
    log_.recorded = {metrics->values(), std::move(deliveries->all)};
    log_.notices = trace.damage();
    log_.legs.resize(run_.robots.size());
}

RecordedDay::RecordedDay(RecordedRun run, const std::string& path, DayLog log)
    : run_(std::move(run)),
      scenario_(std::make_unique<ReplayedScenario>(run_, path)),
      log_(std::move(log)) {
    log_.legs.resize(run_.robots.size());
}

PlayedDay RecordedDay::record(const std::string& path, const std::vector<std::string>& set,
                              const std::function<bool(double)>& progress) const {
    RecordedScenario scenario =
        recorded_scenario(scenario_->with(set), std::filesystem::path(path).parent_path().string());
    const auto trace = std::make_shared<RecordedTrace>(
        path, RecordedTrace::Contents{.version = code_version(),
                                      .scenario = std::move(scenario.text),
                                      .walls = std::move(scenario.walls),
                                      .files = std::move(scenario.files)});
    PlayedDay played = play(set, progress, {Sink(trace)});
    trace->close();
    return played;
}

PlayedDay RecordedDay::play(const std::vector<std::string>& set,
                            const std::function<bool(double)>& progress,
                            const std::vector<Sink>& sinks) const {
    const Scenario scenario = scenario_->with(set);
    NetworkSettings settings = network_settings(scenario);
    const auto metrics = metrics_of(scenario_->with({}), settings);
    const auto deliveries = std::make_shared<Deliveries>();
    settings.metrics = false;
    Network network(settings);
    network.route(to_destinations(scenario.routing.make()));
    add_robots(network, scenario);
    network.add_sink(metrics);
    network.add_sink(deliveries);
    for (const Sink& sink : sinks) network.add_sink(sink);
    schedule(network);
    const Time end = start_of_run + scenario.scenario.duration;
    constexpr std::uint64_t events_a_slice = 100'000;
    while (!network.advance(end, events_a_slice)) {
        if (progress &&
            !progress(seconds(network.now() - start_of_run) / seconds(end - start_of_run))) {
            throw Interrupted();
        }
    }
    network.finish();
    return {metrics->values(), std::move(deliveries->all)};
}

std::string RecordedDay::starts_together(const std::vector<std::string>& set) const {
    const Scenario scenario = scenario_->with(set);
    const bool repeats = scenario.access.as<Csma>();
    // A unicast of csma is repeated after a backoff.
    const auto counts = [&](const Message& message) {
        return !repeats || message.to == everyone || message.is_routed;
    };
    const auto meets = [&](const DayLog::Said& a, const DayLog::Said& b, Duration apart) {
        return a.message.origin != b.message.origin && b.time - a.time < apart;
    };
    std::vector<bool> together(log_.said.size());
    for (std::size_t i = 0; i < log_.said.size(); ++i) {
        const DayLog::Said& said = log_.said[i];
        const Duration apart = collision_free_gap(scenario, said.message.size);
        if (apart == Duration{0}) return "";
        for (std::size_t k = i + 1; k < log_.said.size() && log_.said[k].time - said.time < apart;
             ++k) {
            if (!meets(said, log_.said[k], apart)) continue;
            together[i] = together[i] || counts(said.message);
            together[k] = together[k] || counts(log_.said[k].message);
        }
    }
    const auto met = static_cast<std::size_t>(std::count(together.begin(), together.end(), true));
    if (met == 0 || met * 10 < log_.said.size()) return "";
    return fmt::format(
        "{} of {} messages are sent at nearly the same time as a message of a different robot (the "
        "frames overlap in time). access.model={} does not separate these frames, so the frames "
        "collide. With access.model=csma and access.immediate_access=false, robots draw a backoff "
        "before each frame, as in ns-2",
        met, log_.said.size(), scenario.access.name());
}

std::string RecordedDay::hears_farther(const std::vector<std::string>& set) const {
    const auto place = [&](NodeId node, Time t) {
        const std::vector<Leg>& legs = log_.legs[node.index()];
        const auto later = std::upper_bound(legs.begin(), legs.end(), t,
                                            [](Time at, const Leg& leg) { return at < leg.start; });
        return later == legs.begin() ? legs.front().from : std::prev(later)->position(t);
    };
    const DayLog::Heard* farthest = nullptr;
    double metres = 0;
    for (const DayLog::Heard& heard : log_.heard) {
        // A damaged trace may have lost the legs of a robot.
        if (log_.legs[heard.from.index()].empty() || log_.legs[heard.to.index()].empty()) continue;
        const double d = distance(place(heard.from, heard.time), place(heard.to, heard.time));
        if (d <= metres) continue;
        metres = d;
        farthest = &heard;
    }
    if (!farthest) return "";
    const Scenario scenario = scenario_->with(set);
    Network network(network_settings(scenario));
    add_robots(network, scenario);
    network.run_until(farthest->time);
    const Disc* disc = network.medium().stations().model(farthest->from).as<Disc>();
    const double missing = -network.medium()
                                .links()
                                .margin(farthest->from, farthest->to, network.now(), network.legs())
                                .value;
    constexpr double rounding = 0.5;  // [dB] of places in the trace
    if (missing <= rounding) return "";
    const std::string found = fmt::format(
        "{} received a frame of {} over {:.0f} m at {:.6f} s", run_.robots[farthest->to.index()],
        run_.robots[farthest->from.index()], metres, seconds(farthest->time - start_of_run));
    if (disc)
        return fmt::format(
            "{}, but the radio of this row reaches only {:g} m; give this radio a larger "
            "range: --as \"propagation.model=disc;propagation.range={:.0f} m\"",
            found, disc->range.value, std::ceil(metres));
    const double power = scenario.radio.power.value + std::ceil(missing * 10) / 10;
    return fmt::format(
        "{}, but with the radio of this row, the received power is {:.1f} dB below the "
        "sensitivity; give this radio enough power: --as \"radio.power={:.1f} dBm\"",
        found, missing, power);
}

/// Adds the robots in their order: those of the scenario's tables, and those of a movement file.
void RecordedDay::add_robots(Network& network, const Scenario& scenario) const {
    std::map<std::string, const RobotTable*> tables;
    std::map<const RobotTable*, Propagation> models;
    const auto roles = scenario.routing.make().traits().roles;
    for (const RobotTable& table : scenario.robots) {
        for (int i = 0; i < table.count.value_or(1); ++i) tables.emplace(table.name_of(i), &table);
        if (table.propagation) models.emplace(&table, table.propagation->make());
    }
    for (std::size_t i = 0; i < run_.robots.size(); ++i) {
        Robot robot{.name = run_.robots[i], .at = {}, .radio = scenario.radio};
        if (!log_.legs[i].empty()) {
            robot.at = log_.legs[i].front().from;
            robot.heading = {log_.legs[i].front().heading};
            robot.move = RecordedLegs(log_.legs[i]);
        }
        if (const auto found = tables.find(run_.robots[i]); found != tables.end()) {
            const RobotTable& table = *found->second;
            robot.radius = table.radius;
            robot.radio = table.radio;
            if (log_.legs[i].empty() && table.at) robot.at = *table.at;
            robot.role = role_under(roles, table.role);
            if (table.propagation) robot.propagation = models.at(&table);
        }
        network.add(std::move(robot));
    }
}

/// Schedules what robots said and when they were switched, each in the order in which it was.
void RecordedDay::schedule(Network& network) const {
    for (const DayLog::Turned& turned : log_.turned) {
        network.at(turned.time, [this, &network, turned] {
            if (!turned.on) return network.switch_off(turned.node);
            network.switch_on(turned.node);
            // A robot would continue its last leg when switched on; the trace has its real leg.
            network.move(turned.node, RecordedLegs(log_.legs[turned.node.index()]));
        });
    }
    for (const DayLog::Said& said : log_.said) {
        network.at(said.time, [&network, &message = said.message] {
            network.send(message.origin, message.to, message.payload,
                         {.size = message.size,
                          .flow = message.flow,
                          .port = message.port,
                          .one_hop = !message.is_routed});
        });
    }
}

}  // namespace rovernet
