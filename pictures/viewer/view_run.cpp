// SPDX-License-Identifier: MIT
#include "pictures/viewer/view_run.hpp"

#include "experiment/build.hpp"
#include "experiment/recorded_scenario.hpp"
#include "experiment/replay/message_at_robot.hpp"
#include "experiment/summary.hpp"
#include "models/propagation/list.hpp"
#include "pictures/viewer/motion_columns.hpp"
#include "pictures/viewer/view_file.hpp"
#include "pictures/viewer/view_map.hpp"
#include "pictures/viewer/view_series.hpp"
#include "traces/metrics.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <map>
#include <utility>

namespace rovernet {
namespace {

/// Content of a recorded trace, by its columns.
struct Columns {
    Columns(RecordedReader& reader, Time end) : series(end) {
        while (const Record* record = reader.next()) {
            const RecordContext context = reader.context();
            const KindMask kind = KindMask{1} << record->index();
            if (motion.kinds() & kind) motion.on(*record, context);
            if (frames.kinds() & kind) frames.on(*record, context);
            if (metrics.kinds() & kind) metrics.on(*record, context);
            if (series.kinds() & kind) series.on(*record, context);
        }
    }
    MotionColumns motion;
    FrameColumns frames;
    Metrics metrics;
    ViewSeries series;
};

Array robot_list(const RecordedRun& run, const Scenario& scenario) {
    std::map<std::string, const RobotTable*> tables;
    for (const RobotTable& table : scenario.robots) {
        for (int i = 0; i < table.count.value_or(1); ++i) tables.emplace(table.name_of(i), &table);
    }
    const Propagation common = scenario.propagation.make();
    Array list;
    for (const std::string& name : run.robots) {
        const auto found = tables.find(name);
        const bool is_listed = found != tables.end();  // else it is of a movement file
        const Radio& radio = is_listed ? found->second->radio : scenario.radio;
        Table robot;
        robot.set("name", name);
        robot.set("radius", (is_listed ? found->second->radius : Robot{}.radius).value);
        const bool has_own = is_listed && found->second->propagation;
        robot.set("model", has_own ? found->second->propagation->make().name() : common.name());
        robot.set("power_dbm", radio.power.value);
        robot.set("sensitivity_dbm", radio.sensitivity.value);
        robot.set("antenna_z", radio.antenna_height.value);
        list.emplace_back(std::move(robot));
    }
    return list;
}

/// Fates in the words of the page, in the order of the enumeration.
constexpr std::array words_of_fate{"received, to be forwarded",
                                   "received, TTL used up",
                                   "received again",
                                   "robot was off",
                                   "bit errors",
                                   "collision",
                                   "robot was sending",
                                   "received"};
static_assert(words_of_fate.size() == static_cast<std::size_t>(last_fate) + 1);

Array outcome_list() {
    Array list;
    for (const char* words : words_of_fate) {
        list.emplace_back(words);
        list.emplace_back(fmt::format("{}, delivered", words));
    }
    return list;
}

Array texts(const std::vector<std::string>& list) { return {list.begin(), list.end()}; }

Array model_list() {
    Array list;
    for_each_model([&]<class Model>() { list.emplace_back(Model::name); });
    return list;
}

Array flow_list(const Scenario& scenario) {
    Array list{""};
    for (const TrafficTable& table : scenario.traffic) list.emplace_back(table.name);
    return list;
}

/// Recorded run, ready to be written as view files.
class Viewed {
  public:
    explicit Viewed(const std::string& path)
        : path_(path),
          reader_(path),
          replayed_(reader_.run(), path),
          scenario_(replayed_.with({})),
          settings_(network_settings(scenario_)),
          columns_(reader_, start_of_run + scenario_.scenario.duration) {
        check_robots(reader_.run(), scenario_, path);
    }
    ViewedRun write(const ViewChoice& choice);

  private:
    Table head() const;
    Array follow_list() const;
    std::vector<std::string> left_out(const ViewChoice& choice) const;

    std::string path_;
    RecordedReader reader_;
    ReplayedScenario replayed_;
    Scenario scenario_;
    NetworkSettings settings_;
    Columns columns_;
};

/// Entries of the head that describe the run, without those of columns.
Table Viewed::head() const {
    Table head;
    head.set("rvw", 1);
    head.set("version", reader_.run().version);
    head.set("name", scenario_.scenario.name);
    head.set("seed", reader_.run().seed);
    head.set("replication", reader_.run().replication);
    head.set("duration_ns", std::int64_t{scenario_.scenario.duration.count()});
    head.set("robots", robot_list(reader_.run(), scenario_));
    head.set("colors", view_colors());
    head.set("models", model_list());
    head.set("outcomes", outcome_list());
    head.set("flows", flow_list(scenario_));
    Table metrics;
    append_metrics(metrics, columns_.metrics.values());
    head.set("metrics", std::move(metrics));
    head.set("follow", follow_list());
    head.set("damage", texts(reader_.damage()));
    return head;
}

/// Reasons why robots missed messages, for a short run: each is found by reading the trace again.
Array Viewed::follow_list() const {
    constexpr std::size_t most = 100, most_frames = 5000;
    Array list;
    if (columns_.frames.frames() > most_frames) return list;
    for (const auto& missed : columns_.frames.missed(reader_.run().robots.size(), most)) {
        const MessageAtRobot there = message_at_robot(path_, missed.uid, NodeId{missed.robot});
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
    std::vector<std::string> all;
    if (const std::size_t n = columns_.frames.left_out(); n > 0)
        all.push_back(fmt::format("{} of {} frames are left out.", n, columns_.frames.frames()));
    if (!choice.map) all.emplace_back("The map is left out.");
    if (choice.frames.payload_bytes == 0)
        all.emplace_back("The contents of messages are left out.");
    return all;
}

ViewedRun Viewed::write(const ViewChoice& choice) {
    const std::size_t robots = reader_.run().robots.size();
    const Time end = start_of_run + scenario_.scenario.duration;
    const NetworkSettings field{};
    ViewFile file;
    Table head = this->head();
    head.set("map",
             view_map(scenario_, choice.map ? settings_ : field, columns_.motion.bounds(), file));
    columns_.motion.write(file, robots);
    columns_.series.write(file, head);
    columns_.frames.write(file, head, robots, end, choice.frames);
    ViewedRun view{.name = scenario_.scenario.name,
                   .bytes = {},
                   .robots = robots,
                   .messages = columns_.frames.messages(),
                   .frames = columns_.frames.frames() - columns_.frames.left_out(),
                   .left_out = left_out(choice),
                   .damage = reader_.damage()};
    head.set("thinned", texts(view.left_out));
    view.bytes = file.bytes(std::move(head));
    return view;
}

}  // namespace

ViewedRun view_of_trace(const std::string& path, const ViewChoice& choice) {
    Viewed viewed(path);
    ViewChoice tried = choice;
    ViewedRun view = viewed.write(tried);
    while (view.bytes.size() > choice.most_bytes && view.frames > 0) {
        // Nearly all bytes are those of frames; the margin makes most files fit at once.
        const double share =
            0.95 * static_cast<double>(choice.most_bytes) / static_cast<double>(view.bytes.size());
        tried.frames.most_frames =
            static_cast<std::size_t>(share * static_cast<double>(view.frames));
        view = viewed.write(tried);
    }
    return view;
}

}  // namespace rovernet
