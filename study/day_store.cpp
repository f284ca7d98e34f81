// SPDX-License-Identifier: MIT
#include "study/day_store.hpp"

#include "experiment/run.hpp"
#include "experiment/version.hpp"
#include "sim/error.hpp"
#include "sim/random.hpp"
#include "study/store.hpp"
#include "study/study.hpp"
#include "study/sweep.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

namespace rovernet {
namespace {

std::vector<MetricValue> metrics_of_row(const DayRow& row, const std::vector<std::string>& robots) {
    std::vector<MetricValue> list = metric_list(row.day.metrics);
    if (!row.change) return list;
    const auto add = [&](const char* name, const std::vector<std::uint64_t>& counts,
                         std::uint64_t all) {
        list.push_back({name, static_cast<double>(all)});
        for (std::size_t i = 0; i < robots.size(); ++i) {
            list.push_back(
                {fmt::format("{}.at.{}", name, robots[i]), static_cast<double>(counts[i])});
        }
    };
    add("gained", row.change->gained, row.change->all_gained());
    add("lost", row.change->lost, row.change->all_lost());
    return list;
}

/// @throws InputError if the store holds anything else
void check_property(const Store& store, const char* key, const std::string& expected) {
    const std::string found = store.property(key);
    if (found == expected || (found.empty() && store.points().empty())) return;
    throw InputError(
        {store.path()},
        fmt::format("the rows in this store were made by {} \"{}\", but the new rows are made by "
                    "\"{}\"; expected a different --store",
                    std::string_view(key) == "replay" ? "the command" : key, found, expected));
}

/// Number of the point of this radio, which is added if it is not there.
std::uint32_t point_of(const std::string& radio, std::vector<StoredPoint>& points) {
    const std::string id = fmt::format("{:016x}", name_key(radio));
    for (const StoredPoint& point : points) {
        if (point.id == id) return point.number;
    }
    const auto number = static_cast<std::uint32_t>(points.size());
    Table settings;
    settings.set("radio", radio);
    points.push_back({number, id, std::move(settings)});
    return number;
}

}  // namespace

void store_replay(const std::string& path, const StoredReplay& replay) {
    Store store = Store::open_to_write(path);
    check_property(store, "version", code_version());
    check_property(store, "replay", replay.command);
    std::vector<StoredPoint> points = store.points();
    std::set<std::string> made = finished_runs(store);
    std::vector<std::pair<std::uint32_t, const DayRow*>> news;
    for (const DayRow& row : replay.rows) {
        const std::uint32_t number = point_of(row.radio, points);
        const std::string run = run_id(points[number].id, 0, code_version());
        if (made.insert(run).second) news.emplace_back(number, &row);
    }
    store.set_property("version", code_version());
    store.set_property("replay", replay.command);
    store.set_property("first", replay.first);
    if (store.property("created").empty()) store.set_property("created", utc_now());
    store.set_points(points);
    for (const auto& [number, row] : news) {
        StoredRun run{.id = run_id(points[number].id, 0, code_version()),
                      .point = number,
                      .replication = 0,
                      .error = {},
                      .measurement = {}};
        run.measurement.metrics = metrics_of_row(*row, replay.robots);
        run.measurement.started = utc_now();
        run.measurement.host = host_name();
        store.record(run);
    }
}

}  // namespace rovernet
