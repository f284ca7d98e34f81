// SPDX-License-Identifier: MIT
#include "pictures/viewer/view_run.hpp"

#include "experiment/replay/loaded_run.hpp"
#include "experiment/replay/message_at_robot.hpp"
#include "experiment/summary.hpp"
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
            index->add(reader.chunk(), *record, context);
        }
        if (!reader.damage().empty()) index = nullptr;
    }
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
    explicit Viewed(const std::string& path)
        : path_(path),
          reader_(path),
          run_(reader_.run(), path),
          columns_(reader_, start_of_run + run_.scenario.scenario.duration) {
        follow_ = follow_list();
    }
    ViewedRun write(const ViewChoice& choice);

  private:
    Table head() const;
    Array follow_list() const;
    std::vector<std::string> left_out(const ViewChoice& choice) const;

    std::string path_;
    RecordedReader reader_;
    LoadedRun run_;
    Columns columns_;
    Array follow_;  // entry `follow` of the head
};

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
    head.set("damage", texts(reader_.damage()));
    return head;
}

/// Reasons why robots missed messages, for a short run.
Array Viewed::follow_list() const {
    constexpr std::size_t most = 100, most_frames = 5000;
    Array list;
    if (columns_.frames.frames() > most_frames) return list;
    for (const auto& missed : columns_.frames.missed(reader_.run().robots.size(), most)) {
        const MessageAtRobot there =
            message_at_robot(path_, run_, missed.uid, NodeId{missed.robot}, columns_.index.get());
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
    ViewFile file(choice.packs);
    Table head = this->head();
    head.set("map", view_map(run_.scenario, choice.map ? run_.settings : field,
                             columns_.motion.bounds(), file));
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

ViewedRun view_of_trace(const std::string& path, const ViewChoice& choice) {
    Viewed viewed(path);
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
