// SPDX-License-Identifier: MIT
#include "experiment/reports/link_history.hpp"

#include "experiment/build.hpp"
#include "experiment/reports/network_at.hpp"
#include "experiment/reports/time_text.hpp"
#include "experiment/run.hpp"
#include "files/csv_field.hpp"
#include "network/network.hpp"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <string_view>
#include <utility>

namespace rovernet {
namespace {

/// Visits the changes of links in the records of a run.
struct History {
    const Network* network;
    std::optional<NodeId> hearing;
    std::function<void(const LinkHistoryRow&)> visit;

    KindMask kinds() const { return kind_links; }
    void on(const Record& record, const RecordContext&) {
        if (const auto* up = std::get_if<LinkUp>(&record)) add(*up, true);
        if (const auto* down = std::get_if<LinkDown>(&record)) add(*down, false);
    }

  private:
    template <class Change>
    void add(const Change& change, bool is_up) {
        if (hearing && change.to != *hearing) return;
        visit({change.time, network->name(change.from), network->name(change.to), is_up,
               network->position(change.from), network->position(change.to)});
    }
};

/// Coordinates of both robots, with the names of their columns.
std::array<std::pair<std::string_view, double>, 6> coordinates(const LinkHistoryRow& row) {
    return {{{"from_x_m", row.from_at.x},
             {"from_y_m", row.from_at.y},
             {"from_z_m", row.from_at.z},
             {"to_x_m", row.to_at.x},
             {"to_y_m", row.to_at.y},
             {"to_z_m", row.to_at.z}}};
}

std::string_view event_of(const LinkHistoryRow& row) { return row.is_up ? "up" : "down"; }

}  // namespace

void for_each_link_change(const Scenario& scenario, const std::optional<std::string>& robot,
                          const std::function<void(const LinkHistoryRow&)>& visit,
                          const TellTime& tell) {
    const Scenario played = without_idle_traffic(scenario);
    Network network(network_settings(played));
    populate(network, played);
    const auto hearing = robot ? std::optional(robot_named(network, *robot)) : std::nullopt;
    network.add_sink(std::make_shared<History>(History{&network, hearing, visit}));
    play_until(network, start_of_run + played.scenario.duration, tell);
}

std::string link_history_csv_head(bool places) {
    std::string line = "time_s,from,to,event";
    for (const auto& [column, value] : coordinates({})) {
        if (places) line += fmt::format(",{}", column);
    }
    return line + '\n';
}

std::string link_history_csv(const LinkHistoryRow& row, bool places) {
    std::string line = fmt::format("{},{},{},{}", exact_seconds(row.time), csv_field(row.from),
                                   csv_field(row.to), event_of(row));
    for (const auto& [column, value] : coordinates(row)) {
        if (places) line += fmt::format(",{:.6f}", value);
    }
    return line + '\n';
}

Table link_history_document(const LinkHistoryRow& row, bool places) {
    Table out;
    out.set("time_s", seconds(row.time));
    out.set("from", row.from);
    out.set("to", row.to);
    out.set("event", event_of(row));
    for (const auto& [column, value] : coordinates(row)) {
        if (places) out.set(column, value);
    }
    return out;
}

}  // namespace rovernet
