// SPDX-License-Identifier: MIT
#include "live/viewer/view_history.hpp"

#include "experiment/recorded_scenario.hpp"
#include "experiment/version.hpp"
#include "models/medium/medium.hpp"
#include "traces/recorded/recorded_index.hpp"
#include "traces/recorded/recorded_trace.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace rovernet {

/// Sink that keeps the records in two files, each with its index.
class ViewHistory::Records {
  public:
    Records(const Scenario& scenario, const Network& network, std::string folder, std::size_t size)
        : network_(network),
          folder_(std::move(folder)),
          size_(size),
          scenario_(recorded_scenario(scenario, folder_)) {
        begin_file();
    }

    KindMask kinds() const {
        return kind_of<Sent>() | kind_of<AirSent>() | kind_of<Received>() | kind_of<Moved>() |
               kind_of<Switched>();
    }
    void on(const Record& record, const RecordContext& context) {
        if (last_.size >= size_) begin_file();
        take(record, context);
    }
    IndexedTrace of_message(std::uint64_t uid) {
        for (const File* file : {&before_, &last_})
            if (file->trace && file->index->has(uid)) return file->written();
        return {};
    }
    IndexedTrace of_present() { return last_.written(); }

  private:
    struct File {
        std::unique_ptr<RecordedTrace> trace;
        std::shared_ptr<RecordedIndex> index;
        std::size_t size = 0;
        IndexedTrace written() const { return {trace->flush(), index}; }
    };

    void take(const Record& record, const RecordContext& context) {
        constexpr std::size_t receptions_a_record = 12;
        const auto* received = std::get_if<Received>(&record);
        last_.size += receptions_a_record + (received ? received->receptions.size() : 0);
        last_.index->add(last_.trace->chunk(), record, context);
        last_.trace->on(record, context);
    }

    /// Begins a file with the legs and states of all robots, and deletes the last but one.
    void begin_file() {
        before_ = std::exchange(last_, {});
        last_.trace =
            std::make_unique<RecordedTrace>(fmt::format("{}/{}.mcap", folder_, number_++),
                                            RecordedTrace::Contents{.version = code_version(),
                                                                    .scenario = scenario_.text,
                                                                    .walls = scenario_.walls,
                                                                    .files = scenario_.files});
        last_.index = std::make_shared<RecordedIndex>();
        std::string name;  // of the robot that was asked for last
        last_.trace->begin(
            {.scenario = {},
             .robots = network_.size(),
             .name = [&](NodeId robot) -> std::string_view { return name = network_.name(robot); },
             .seed = network_.settings().seed,
             .replication = network_.settings().replication});
        const MessageTable no_messages;
        for (NodeId robot{0}; robot.index() < network_.size(); ++robot.value) {
            const Leg leg = network_.legs().leg(robot);
            take(Moved{network_.now(), robot, leg}, {network_.legs(), no_messages});
            if (!network_.medium().stations().is_on(robot))
                take(Switched{network_.now(), robot, false}, {network_.legs(), no_messages});
        }
    }

    const Network& network_;
    std::string folder_;
    std::size_t size_;
    RecordedScenario scenario_;
    int number_ = 0;
    File last_, before_;
};

ViewHistory::ViewHistory(const Scenario& scenario, std::shared_ptr<Network> network,
                         std::size_t size)
    : network_(std::move(network)),
      records_(std::make_shared<Records>(scenario, *network_, folder_.path(), size)),
      sink_(network_->add_sink(records_)) {}

ViewHistory::~ViewHistory() { network_->remove_sink(sink_); }

IndexedTrace ViewHistory::of_message(std::uint64_t uid) { return records_->of_message(uid); }
IndexedTrace ViewHistory::of_present() { return records_->of_present(); }

}  // namespace rovernet
