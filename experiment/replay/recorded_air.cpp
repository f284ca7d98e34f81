// SPDX-License-Identifier: MIT
#include "experiment/replay/recorded_air.hpp"

#include "sim/random.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace rovernet {
namespace {

// Light travels 3,000 km in this time, so that an older frame arrives nowhere.
constexpr Duration longest_delay{10'000'000};

MediumSettings medium_settings(const NetworkSettings& settings, const Scene& scene,
                               std::span<const SceneChange> changes) {
    return {.scene = &scene,
            .scene_changes = changes,
            .floor_height = settings.floor_height,
            .propagation_delay = settings.propagation_delay,
            .keep_losses = false,
            .shadowing = settings.shadowing,
            .fading = settings.fading,
            .seed = settings.seed,
            .replication = settings.replication};
}

std::unique_ptr<const Fades> fades_of(const NetworkSettings& settings) {
    if (settings.fading.model == FadingModel::none) return nullptr;
    return std::make_unique<Fades>(settings.fading, settings.seed, settings.replication);
}

/// Adds the robots in their order: those of the scenario's tables, and those of a movement file.
void add_stations(Medium& medium, const std::vector<std::string>& names, const Scenario& scenario,
                  const Propagation& common) {
    std::map<std::string, const RobotTable*> tables;
    std::map<const RobotTable*, Propagation> models;
    for (const RobotTable& table : scenario.robots) {
        for (int i = 0; i < table.count.value_or(1); ++i) tables.emplace(table.name_of(i), &table);
        if (table.propagation) models.emplace(&table, table.propagation->make());
    }
    for (const std::string& name : names) {
        const auto found = tables.find(name);
        const RobotTable* table = found == tables.end() ? nullptr : found->second;
        const bool has_own = table && table->propagation;
        medium.add(table ? table->radio : scenario.radio, name_key(name),
                   has_own ? models.at(table) : common);
    }
}

}  // namespace

RecordedAir::RecordedAir(const LoadedRun& run)
    : names_(run.names),
      scene_(run.settings.scene ? run.settings.scene : std::make_shared<Scene>()),
      scene_changes_(run.settings.scene_changes),
      medium_(medium_settings(run.settings, *scene_, scene_changes_)),
      access_(run.settings.access.make_access()),
      phy_(access_->phy()),
      fades_(fades_of(run.settings)),
      legs_(names_.size()) {
    add_stations(medium_, names_, run.scenario, run.settings.propagation);
}

void RecordedAir::take(const Record& record, const RecordContext& context) {
    if (const auto* moved = std::get_if<Moved>(&record)) {
        place(moved->node, moved->leg);
    } else if (const auto* switched = std::get_if<Switched>(&record)) {
        if (switched->node.index() < robots()) medium_.switch_radio(switched->node, switched->on);
    } else if (const auto* sent = std::get_if<AirSent>(&record)) {
        const bool is_data = !sent->air.control;
        add({.air = sent->air,
             .uid = is_data ? context.messages[sent->air.frame.message].uid : 0,
             .header = context.header ? *context.header : FrameHeader{},
             .bytes = sent->bytes,
             .rate = sent->rate,
             .begin = sent->time,
             .end = sent->time + sent->airtime,
             .record = records_},
            sent->time);
    }
    ++records_;
}

/// Adds a frame that starts now, and removes frames that are no longer needed.
void RecordedAir::add(const RecordedFrame& frame, Time now) {
    const NodeId from = frame.air.frame.sender, to = frame.air.frame.next_hop;
    if (from.index() >= robots() || (to != everyone && to.index() >= robots())) return;
    while (!frames_.empty() && frames_.front().end + longest_delay < now) frames_.pop_front();
    frames_.push_back(frame);
    RecordedFrame& added = frames_.back();
    if (frame.rate.value > 0) return;
    // A trace of format 3 or earlier.
    added.rate = rate_of(added.air);
    const Radio& radio = medium_.stations().radio(from);
    added.end = now + phy_.transmission(radio, added.rate, added.bytes).airtime();
}

void RecordedAir::place(NodeId node, const Leg& leg) {
    if (node.index() >= robots()) return;
    auto& legs = legs_[node.index()];
    legs.push_back({records_, leg});
    const std::uint64_t oldest = frames_.empty() ? records_ : frames_.front().record;
    while (legs.size() > 1 && legs[1].record < oldest) legs.pop_front();
}

/// Bit rate of a frame, as Mac has it.
BitRate RecordedAir::rate_of(const AirFrame& air) const {
    const BitRate sender = medium_.stations().radio(air.frame.sender).rate;
    if (access_->own_rates().empty()) return sender;
    const NodeId to = air.frame.next_hop;
    return access_->rate(air, sender, to == everyone ? sender : medium_.stations().radio(to).rate);
}

const RecordedFrame* RecordedAir::frame_of(const AirFrame& air, std::uint64_t uid,
                                           const Reception& reception) const {
    if (reception.node.index() >= robots()) return nullptr;
    const RecordedFrame* last = nullptr;
    for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame) {
        const bool is_like_it = frame->air.kind() == air.kind() && frame->uid == uid &&
                                frame->air.frame.sender == air.frame.sender &&
                                frame->air.frame.next_hop == air.frame.next_hop &&
                                frame->air.frame.hops == air.frame.hops;
        if (!is_like_it || frame->begin >= reception.time) continue;
        if (frame->end + delay(*frame, reception.node) == reception.time) return &*frame;
        if (!last) last = &*frame;
    }
    return last;  // where legs are missing, times are not quite right
}

/// Pose of a robot's antenna when the frame began, on the leg that held then.
Pose RecordedAir::pose(NodeId node, const RecordedFrame& frame) const {
    const auto& legs = legs_[node.index()];
    const auto held = std::find_if(legs.rbegin(), legs.rend(), [&](const Placed& placed) {
        return placed.record < frame.record;
    });
    const Leg leg = held == legs.rend() ? Leg{} : held->leg;
    Vec3 antenna = leg.position(frame.begin);
    antenna.z += medium_.stations().radio(node).antenna_height.value;
    return {antenna, Radians{leg.heading_at(frame.begin)}};
}

Duration RecordedAir::delay(const RecordedFrame& frame, NodeId to) const {
    const NodeId from = frame.air.frame.sender;
    if (from == to) return Duration{0};
    const Vec3 here = pose(from, frame).antenna, there = pose(to, frame).antenna;
    return medium_.arrivals().delay(std::sqrt(squared_distance(here, there)));
}

Arrival RecordedAir::arrival(const RecordedFrame& frame, NodeId to) const {
    const NodeId from = frame.air.frame.sender;
    if (from == to) return own_frame(to, frame.begin, frame.end);
    const Pose here = pose(from, frame), there = pose(to, frame);
    const LinkGain gain =
        LinkGain::of(medium_.stations().radio(from), medium_.stations().radio(to), [&] {
            return std::pair{here, there};
        });
    const Db lost = loss(frame, to, here.antenna, there.antenna);
    const Duration late = delay(frame, to);
    return {.begin = frame.begin + late,
            .end = frame.end + late,
            .level_dbm = received_power(medium_.stations().radio(from), lost, gain).value,
            .squared_distance = squared_distance(here.antenna, there.antenna),
            .from = from};
}

Db RecordedAir::loss(const RecordedFrame& frame, NodeId to, Vec3 here, Vec3 there) const {
    const NodeId from = frame.air.frame.sender;
    const MediumSettings& settings = medium_.settings();
    const std::uint64_t to_key = medium_.stations().key(to);
    // The key by which Medium draws for a frame.
    const std::uint64_t key =
        combine(medium_.stations().key(from),
                static_cast<std::uint64_t>((frame.begin - start_of_run).count()));
    const LinkBatch link{.frequency = medium_.stations().radio(from).frequency,
                         .from = here,
                         .from_key = medium_.stations().key(from),
                         .scene = &settings.scene_at(frame.begin),
                         .floor_height = settings.floor_height,
                         .seed = settings.seed,
                         .replication = settings.replication,
                         .at = frame.begin,
                         .frame = key};
    const double db = medium_.stations().model(from).loss_to(there, link, to_key);
    if (!fades_) return {db};
    const Db fade = fades_->gain(
        {.key = key, .receiver = to_key, .from = here, .to = there, .frequency = link.frequency});
    return {std::max(0.0, db - fade.value)};
}

std::vector<Wall> RecordedAir::walls(const RecordedFrame& frame, NodeId to) const {
    const Scene& scene = medium_.settings().scene_at(frame.begin);
    return scene.walls(pose(frame.air.frame.sender, frame).antenna, pose(to, frame).antenna);
}

}  // namespace rovernet
