// SPDX-License-Identifier: MIT
#include "study/results_csv.hpp"

#include "files/csv_field.hpp"
#include "scenario/document/toml.hpp"
#include "study/quotient.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace rovernet {
namespace {

std::string cell(const Value* value) { return value ? csv_field(plain_text(*value)) : ""; }

/// The cells of each point: its number and its settings.
class PointCells {
  public:
    PointCells(const Store& store, const std::vector<Condition>& where) {
        const std::vector<std::string> paths = varied_paths(store);
        for (const std::string& path : paths) head += "," + csv_field(path);
        for (const StoredPoint& point : points_where(store, where)) {
            std::string& text = of[point.number] = fmt::format("{}", point.number);
            for (const std::string& path : paths) text += "," + cell(point.settings.find(path));
        }
    }
    std::string head = "point";
    std::map<std::uint32_t, std::string> of;  // by the number of a point that meets the conditions
};

void write_rows(const Store& store, const Question& question, const Write& write) {
    std::string head;
    for (const std::string& path : *question.group_by) head += csv_field(path) + ",";
    write(head + "replication,metric,value\n");
    for (const Answer& answer : answers(store, question).list) {
        std::string settings;
        for (const std::string& path : *question.group_by) {
            settings += cell(answer.settings.find(path)) + ",";
        }
        for (const auto& [replication, value] : answer.values) {
            write(fmt::format("{}{},{},{}\n", settings, replication, answer.metric, value));
        }
    }
}

}  // namespace

void write_csv(const Store& store, const Question& question, const Write& write) {
    if (question.group_by) return write_rows(store, question, write);
    const std::vector<std::string> metrics = metrics_of(store, question);
    const auto asked = [&](const std::string& metric) {
        return question.metrics.empty() ||
               std::find(metrics.begin(), metrics.end(), metric) != metrics.end();
    };
    for (const std::string& metric : question.metrics) {
        if (!quotient_of(metric) || !store.values(metric).empty()) continue;
        throw std::invalid_argument(
            fmt::format("--csv: {} is a quotient of two metrics and has no value for a single run; "
                        "expected --csv together with --group-by",
                        metric));
    }
    const PointCells points(store, question.where);
    write(points.head + ",replication,metric,value\n");
    store.for_each_value([&](const StoredValue& v, const std::string& metric) {
        const auto point = points.of.find(v.point);
        if (point == points.of.end() || !asked(metric)) return;
        write(fmt::format("{},{},{},{}\n", point->second, v.replication, metric,
                          v.value ? fmt::format("{}", *v.value) : ""));
    });
}

void write_provenance_csv(const Store& store, const std::vector<Condition>& where,
                          const Write& write) {
    const PointCells points(store, where);
    write(points.head + ",replication,run,fingerprint,error,cpu_s,wall_s,started,host\n");
    for (const StoredRun& run : store.runs()) {
        const auto point = points.of.find(run.point);
        if (point == points.of.end()) continue;
        const Measurement& m = run.measurement;
        write(fmt::format("{},{},{},{},{},{},{},{},{}\n", point->second, run.replication, run.id,
                          m.fingerprint, csv_field(run.error), m.cpu_s, m.wall_s, m.started,
                          csv_field(m.host)));
    }
}

}  // namespace rovernet
