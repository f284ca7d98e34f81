// SPDX-License-Identifier: MIT
#include "study/advise/medium_cost.hpp"

#include "experiment/build.hpp"
#include "models/medium/medium.hpp"
#include "sim/sink.hpp"

#include <algorithm>
#include <ctime>

namespace rovernet {
namespace {

constexpr std::uint64_t most_recorded_frames = 200'000;
constexpr std::size_t most_events = 2'000'000;

double thread_cpu_s() {
    std::timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Writes a run's legs, switches and frames into a record.
class MediumRecorder {
  public:
    explicit MediumRecorder(MediumRecord& record) : record_(&record) {}

    KindMask kinds() const {
        return kind_of<Moved>() | kind_of<Arrived>() | kind_of<NoWay>() | kind_of<Switched>() |
               kind_of<AirSent>() | kind_of<Transmitted>() | kind_of<Received>();
    }
    void on(const Record& record, const RecordContext& context) {
        if (record_->frames == most_recorded_frames) return;
        if (const auto* moved = std::get_if<Moved>(&record)) {
            add(moved->time, moved->node, moved->leg);
        } else if (const auto* arrived = std::get_if<Arrived>(&record)) {
            add(arrived->time, arrived->node, context.legs.leg(arrived->node));
        } else if (const auto* blocked = std::get_if<NoWay>(&record)) {
            add(blocked->time, blocked->node, context.legs.leg(blocked->node));
        } else if (const auto* switched = std::get_if<Switched>(&record)) {
            add(switched->time, switched->node, switched->on);
        } else if (const auto* sent = std::get_if<AirSent>(&record)) {
            add(sent->time, sent->air.frame.sender, MediumRecord::OnAir{});
            ++record_->frames;
        } else if (std::holds_alternative<Transmitted>(record)) {
            ++record_->transmissions;
        } else if (const auto* received = std::get_if<Received>(&record)) {
            record_->receivers += received->receptions.size();
        }
    }

  private:
    template <class What>
    void add(Time time, NodeId node, What what) {
        record_->events.push_back({time, node, what});
    }
    MediumRecord* record_;
};

/// Number of frames of a (possibly long) recording that every model can process within a turn.
std::uint64_t frames_within(const MediumRecord& record, const std::vector<MediumReplay>& replays,
                            double turn_s) {
    std::uint64_t frames = record.frames;
    for (const MediumReplay& replay : replays) {
        frames = std::min(frames, replay.answer(record, frames, turn_s).frames);
    }
    return frames;
}

/// Receivers per frame that a model finds.
double receivers_per_frame(const MediumRecord& record, const MediumReplay& replay,
                           std::uint64_t frames) {
    constexpr double no_limit = 1e9;  // [s]
    const auto all = replay.answer(record, frames, no_limit);
    return static_cast<double>(all.receivers) / static_cast<double>(all.frames);
}

/// CPU time per frame [s], over passes that fill a turn. Fewer passes are made if constructing the
/// medium takes longer than replaying.
double cost_in_turn(const MediumRecord& record, const MediumReplay& replay, std::uint64_t frames,
                    double turn_s) {
    const double begin = thread_cpu_s();
    MediumReplay::Answers sum;
    do {
        const auto pass = replay.answer(record, frames, 10 * turn_s);
        sum.frames += pass.frames;
        sum.cpu_s += pass.cpu_s;
    } while (sum.cpu_s < turn_s && thread_cpu_s() - begin < 2 * turn_s);
    return sum.cpu_s / static_cast<double>(sum.frames);
}

}  // namespace

MediumRecord record_medium(const Scenario& scenario, const std::function<bool()>& stopped) {
    constexpr std::uint64_t events_a_slice = 20'000;
    NetworkSettings settings = network_settings(scenario);
    settings.metrics = false;
    Network network(std::move(settings));
    populate(network, scenario);
    MediumRecord record;
    network.add_sink(MediumRecorder(record));
    const Time end = start_of_run + scenario.scenario.duration;
    while (!network.advance(end, events_a_slice)) {
        if (record.frames == most_recorded_frames || record.events.size() > most_events ||
            stopped())
            break;
    }
    return record;
}

MediumReplay::MediumReplay(const Scenario& scenario)
    : settings_(network_settings(scenario)), network_(std::make_unique<Network>(settings_)) {
    populate(*network_, scenario);
}

MediumReplay::Answers MediumReplay::answer(const MediumRecord& record, std::uint64_t most_frames,
                                           double most_s) const {
    const Stations& robots = network_->medium().stations();
    Legs legs = network_->legs();
    Medium medium(network_->medium().settings());
    medium.reserve(network_->size());
    for (std::uint32_t i = 0; i < network_->size(); ++i) {
        const NodeId node{i};
        medium.add(robots.radio(node), robots.key(node), robots.model(node));
        if (!robots.is_on(node)) medium.switch_radio(node, false);
    }
    const bool sensed = settings_.access.listens();
    constexpr std::uint64_t frames_a_look = 64;  // at the clock
    Medium::Receivers found;
    Answers answers;
    const double begin = thread_cpu_s();
    for (const auto& [time, node, what] : record.events) {
        if (answers.frames == most_frames) break;
        if (const auto* leg = std::get_if<Leg>(&what)) {
            legs.replace(node, *leg);
            medium.moved(node, legs);
        } else if (const auto* on = std::get_if<bool>(&what)) {
            medium.switch_radio(node, *on);
        } else {
            if (sensed) {
                medium.find_sensors(node, Coding{}, time, time, legs, found);
            } else {
                medium.find_receivers(node, Coding{}, time, time, legs, found);
            }
            answers.receivers += found.all().size();
            if (++answers.frames % frames_a_look == 0 && thread_cpu_s() - begin > most_s) break;
        }
    }
    answers.cpu_s = thread_cpu_s() - begin;
    return answers;
}

MediumCosts measure_medium(const MediumRecord& record, const std::vector<Scenario>& scenarios,
                           const CostTurns& turns, const std::function<bool()>& stopped) {
    MediumCosts costs;
    costs.turns = turns.turns;
    costs.turn_s = std::clamp(turns.total_s / (turns.turns * static_cast<double>(scenarios.size())),
                              0.05, 0.2);
    if (record.frames == 0 || record.transmissions == 0) return costs;
    costs.frames_per_transmission =
        static_cast<double>(record.frames) / static_cast<double>(record.transmissions);
    std::vector<MediumReplay> replays;
    for (const Scenario& scenario : scenarios) replays.emplace_back(scenario);
    costs.frames = frames_within(record, replays, costs.turn_s);
    std::vector<std::vector<double>> seen(replays.size());
    for (int turn = 0; turn < turns.turns; ++turn) {
        for (std::size_t i = 0; i < replays.size(); ++i) {
            if (stopped()) return costs;
            seen[i].push_back(cost_in_turn(record, replays[i], costs.frames, costs.turn_s));
        }
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
        auto& each = seen[i];
        std::sort(each.begin(), each.end());
        costs.models.push_back({each[each.size() / 2], each.front(), each.back(),
                                receivers_per_frame(record, replays[i], costs.frames)});
    }
    return costs;
}

}  // namespace rovernet
