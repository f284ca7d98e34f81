// SPDX-License-Identifier: MIT
#include "pictures/viewer/view_run.hpp"

#include "experiment/replay/loaded_run.hpp"
#include "experiment/replay/message_at_robot.hpp"
#include "experiment/reports/network_at.hpp"
#include "experiment/summary.hpp"
#include "mobility/files/movement_file.hpp"
#include "network/network.hpp"
#include "pictures/viewer/motion_columns.hpp"
#include "pictures/viewer/view_file.hpp"
#include "pictures/viewer/view_head.hpp"
#include "pictures/viewer/view_map.hpp"
#include "pictures/viewer/view_series.hpp"
#include "traces/metrics.hpp"
#include "traces/recorded/recorded_index.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace rovernet {
namespace {

/// Robots that a scenario's movement file moves, which may be absent before and after it.
class FilePresence {
  public:
    explicit FilePresence(const LoadedRun& run) {
        const Scenario& scenario = run.scenario;
        if (!scenario.movement.file) return;
        for (std::uint32_t i = 0; i < run.names.size(); ++i) nodes_.emplace(run.names[i], i);
        const auto path =
            std::filesystem::path(scenario.file).parent_path() / *scenario.movement.file;
        MovementFile file(path.string(), scenario.movement.syntax);
        robots_ = file.robots();
        while (const auto command = file.next()) {
            if (command->kind != MovementCommand::Kind::vanish) continue;
            if (const auto node = node_of(robots_[command->robot]))
                gone_.emplace(node->value, command->time);
        }
    }
    /// Whether the file ends the presence of a robot at a time.
    bool leaves(NodeId robot, Time time) const { return gone_.contains({robot.value, time}); }
    /// Tells the columns which robots appear later than at the start.
    void begin(MotionColumns& motion) const {
        for (const FileRobot& robot : robots_) {
            const auto node = node_of(robot);
            if (node && robot.appears > start_of_run) motion.begin(*node, Presence::not_departed);
        }
    }

  private:
    std::optional<NodeId> node_of(const FileRobot& robot) const {
        const auto found = nodes_.find(robot.name);
        return found == nodes_.end() ? std::nullopt : std::optional(NodeId{found->second});
    }

    std::map<std::string, std::uint32_t> nodes_;  // robots of the run, by name
    std::vector<FileRobot> robots_;
    std::set<std::pair<std::uint32_t, Time>> gone_;
};

/// Content of a recorded trace, by its columns.
struct Columns {
    Columns(const Columns&) = delete;  // motion refers to presence
    Columns(RecordedReader& reader, const LoadedRun& run)
        : presence(run),
          motion(true, [this](NodeId robot, Time time) { return presence.leaves(robot, time); }),
          series(start_of_run + run.scenario.scenario.duration) {
        presence.begin(motion);
        while (const Record* record = reader.next()) {
            const RecordContext context = reader.context();
            const KindMask kind = KindMask{1} << record->index();
            if (motion.kinds() & kind) motion.on(*record, context);
            if (frames.kinds() & kind) frames.on(*record, context);
            if (metrics.kinds() & kind) metrics.on(*record, context);
            if (series.kinds() & kind) series.on(*record, context);
            index->add(reader.chunk(), *record, context);
        }
        if (!reader.damage().empty()) index = nullptr;
        stand_at_start(run);
    }
    /// Lets robots stand at their start if the trace has lost all of their movements.
    void stand_at_start(const LoadedRun& run) {
        const std::vector<NodeId> lost = motion.without_leg(run.names.size());
        if (lost.empty()) return;
        const auto network = network_at(run.scenario, start_of_run);
        for (const NodeId robot : lost) {
            const Leg leg = robot.index() < network->size() ? network->legs().leg(robot) : Leg{};
            motion.on(Moved{start_of_run,
                            robot,
                            {.from = leg.from, .to = leg.from, .heading = leg.heading}},
                      {network->legs(), MessageTable()});
        }
    }
    FilePresence presence;
    MotionColumns motion;
    FrameColumns frames;
    Metrics metrics;
    ViewSeries series;
    std::shared_ptr<RecordedIndex> index = std::make_shared<RecordedIndex>();
};

Array texts(const std::vector<std::string>& list) { return {list.begin(), list.end()}; }

/// Recorded run, ready to be written as view files.
class Viewed {
  public:
    Viewed(const std::string& path, bool has_map)
        : path_(path),
          reader_(path),
          run_(reader_.run(), path),
          columns_(reader_, viewable(run_, path)) {
        follow_ = follow_list(has_map);
    }
    ViewedRun write(const ViewChoice& choice);

  private:
    /// @throws InputError if the run is too long
    static const LoadedRun& viewable(const LoadedRun& run, const std::string& path) {
        check_viewable(run.scenario, path);
        return run;
    }
    std::vector<std::string> damage() const;
    Table head() const;
    Array follow_list(bool has_map) const;
    std::vector<std::string> left_out(const ViewChoice& choice) const;

    std::string path_;
    RecordedReader reader_;
    LoadedRun run_;
    Columns columns_;
    Array follow_;  // entry `follow` of the head
};

/// Sentences about broken and missing parts of the trace, and up to which time it reaches.
std::vector<std::string> Viewed::damage() const {
    std::vector<std::string> all;
    for (const std::string& what : reader_.damage()) {
        all.push_back(fmt::format("The trace is damaged: {}.", what));
        if (what != "the end is missing") continue;
        all.push_back(fmt::format(
            "The trace reaches up to {:.6f} s of {:.6g} s: what happened after this time is not "
            "known, and all robots are shown at their last known places.",
            seconds(reader_.now()), seconds(run_.scenario.scenario.duration)));
    }
    return all;
}

/// Entries of the head that describe the run, without those of columns.
Table Viewed::head() const {
    const RecordedRun& run = reader_.run();
    Table head = view_head(run_.scenario, run.robots, run.version);
    // Flows of an ns-2 trace are in no table of its scenario.
    Array& flows = *head.find("flows")->array();
    while (flows.size() <= columns_.frames.last_flow())
        flows.emplace_back(fmt::format("flow {}", flows.size()));
    head.set("seed", run.seed);
    head.set("replication", run.replication);
    Table metrics;
    append_metrics(metrics, columns_.metrics.values());
    head.set("metrics", std::move(metrics));
    head.set("follow", follow_);
    head.set("damage", texts(damage()));
    return head;
}

/// Reasons why robots missed messages, for a short run.
Array Viewed::follow_list(bool has_map) const {
    constexpr std::size_t most = 100, most_frames = 5000;
    Array list;
    if (columns_.frames.frames() > most_frames) return list;
    for (const auto& missed : columns_.frames.missed(reader_.run().robots.size(), most)) {
        MessageAtRobot there =
            message_at_robot(path_, run_, missed.uid, NodeId{missed.robot}, columns_.index.get());
        there.tells_walls = has_map;
        Table entry;
        entry.set("message", missed.message);
        entry.set("robot", missed.robot);
        entry.set("outcome", there.frames.empty() ? "not sent" : outcome_text(there.frames.back()));
        entry.set("text", sentence(there));
        list.emplace_back(std::move(entry));
    }
    return list;
}

std::vector<std::string> Viewed::left_out(const ViewChoice& choice) const {
    std::vector<std::string> all = choice.missing;
    if (const std::size_t n = columns_.frames.left_out(); n > 0)
        all.push_back(fmt::format("{} of {} frames are left out.", n, columns_.frames.frames()));
    if (!choice.map) all.emplace_back("The map is left out.");
    if (choice.frames.payload_bytes == 0)
        all.emplace_back("The contents of messages are left out.");
    return all;
}

ViewedRun Viewed::write(const ViewChoice& choice) {
    const std::size_t robots = reader_.run().robots.size();
    const Time end = start_of_run + run_.scenario.scenario.duration;
    const NetworkSettings field{};
    Scenario scenario = run_.scenario;
    if (!choice.map) scenario.scene.doors.clear();
    ViewFile file(choice.packs);
    Table head = this->head();
    head.set("map", view_map(scenario, choice.map ? run_.settings : field, columns_.motion.bounds(),
                             file));
    columns_.motion.write(file, robots);
    columns_.series.write(file, head);
    columns_.frames.write(file, head, robots, end, choice.frames);
    const std::vector<MessageName>& names = columns_.frames.message_names();
    if (choice.comparison) write_comparison(*choice.comparison, names, robots, file, head);
    ViewedRun view{.name = run_.scenario.scenario.name,
                   .bytes = {},
                   .robots = robots,
                   .messages = columns_.frames.messages(),
                   .frames = columns_.frames.frames() - columns_.frames.left_out(),
                   .left_out = left_out(choice),
                   .damage = reader_.damage(),
                   .message_names = names,
                   .index = columns_.index};
    head.set("thinned", texts(view.left_out));
    view.bytes = file.bytes(std::move(head));
    return view;
}

}  // namespace

void check_viewable(const Scenario& scenario, const std::string& path) {
    constexpr Duration longest{(std::int64_t{1} << 53U) - 1};  // exact in a number of JavaScript
    const Duration duration = scenario.scenario.duration;
    if (duration <= longest) return;
    throw InputError(
        Location{path},
        fmt::format("the run lasts {:.6g} s; expected at most {:.6g} s (104 days) for a page, "
                    "because a browser does not count nanoseconds exactly beyond this time; choose "
                    "a shorter duration, or use `rovernet draw` and `rovernet where`",
                    seconds(duration), seconds(longest)));
}

ViewedRun view_of_trace(const std::string& path, const ViewChoice& choice) {
    Viewed viewed(path, choice.map);
    ViewedRun view = viewed.write(choice);
    if (view.bytes.size() <= choice.most_bytes) return view;
    ViewChoice tried = choice;
    tried.frames.most_frames = 0;
    ViewedRun bare = viewed.write(tried);
    if (bare.bytes.size() >= choice.most_bytes) return bare;
    const double room = static_cast<double>(choice.most_bytes - bare.bytes.size());
    while (view.bytes.size() > choice.most_bytes && view.frames > 0) {
        // The bytes of the frames; the margin makes most files fit at once.
        const double taken = static_cast<double>(view.bytes.size() - bare.bytes.size());
        const double share = std::min(0.95 * room / taken, 0.99);
        tried.frames.most_frames =
            static_cast<std::size_t>(share * static_cast<double>(view.frames));
        view = viewed.write(tried);
    }
    return view;
}

}  // namespace rovernet
