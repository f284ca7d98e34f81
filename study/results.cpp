// SPDX-License-Identifier: MIT
#include "study/results.hpp"

#include "experiment/json.hpp"
#include "experiment/toml.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

const std::vector<std::string> usual_metrics = {"delivery_ratio", "latency_mean_s",
                                                "transmissions"};

Table study_of(const Store& store) {
    const std::string text = store.property("study");
    if (text.empty()) return {};
    const Value study = parse_json(text);
    return study.table() ? *study.table() : Table{};
}

std::vector<std::string> metrics_of(const Store& store) {
    const Table study = study_of(store);
    const Value* given = study.find("metrics");
    std::vector<std::string> metrics;
    if (given && given->array()) {
        for (const Value& each : *given->array()) metrics.push_back(*each.string());
    }
    return metrics.empty() ? usual_metrics : metrics;
}

void check_known(const std::string& word, const std::vector<std::string>& known,
                 std::string_view what) {
    if (std::find(known.begin(), known.end(), word) != known.end()) return;
    const std::string near = did_you_mean(word, known);
    throw std::invalid_argument(
        fmt::format("{} \"{}\" is not in this study; expected one of {}{}{}", what, word,
                    fmt::join(known, ", "), near.empty() ? "" : "; ", near));
}

/// Those of every run, and those of the flows and robots of its runs.
std::vector<std::string> known_metrics(const Store& store) {
    std::vector<std::string> names = metric_names();
    for (std::string& name : store.metric_names()) {
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            names.push_back(std::move(name));
        }
    }
    return names;
}

/// The points that agree in some keys.
struct Group {
    Table settings;
    std::vector<std::uint32_t> points;
};

bool meets(const StoredPoint& point, const Condition& condition) {
    const Value* value = point.settings.find(condition.path);
    return value && plain_text(*value) == condition.value;
}

/// The points that meet all conditions.
std::vector<StoredPoint> points_where(const Store& store, const std::vector<Condition>& where) {
    std::vector<StoredPoint> points = store.points();
    for (const Condition& condition : where) {
        std::vector<std::string> values;
        for (const StoredPoint& point : points) {
            const Value* value = point.settings.find(condition.path);
            if (value) values.push_back(plain_text(*value));
        }
        std::erase_if(points, [&](const StoredPoint& p) { return !meets(p, condition); });
        if (!points.empty()) continue;
        std::sort(values.begin(), values.end());
        values.erase(std::unique(values.begin(), values.end()), values.end());
        throw std::invalid_argument(fmt::format("no point has {} = {}; there are {}",
                                                condition.path, condition.value,
                                                fmt::join(values, ", ")));
    }
    return points;
}

std::vector<Group> groups_of(const std::vector<StoredPoint>& points,
                             const std::vector<std::string>& paths) {
    std::vector<Group> groups;
    std::map<std::string, std::size_t> by_text;
    for (const StoredPoint& point : points) {
        Table settings;
        for (const std::string& path : paths) {
            if (const Value* value = point.settings.find(path)) settings.set(path, *value);
        }
        const auto [found, is_new] = by_text.try_emplace(to_toml(settings), groups.size());
        if (is_new) groups.push_back({std::move(settings), {}});
        groups[found->second].points.push_back(point.number);
    }
    return groups;
}

void conclude(Answer& answer, const Question& question, double confidence) {
    std::vector<double> values;
    for (const auto& [replication, value] : answer.values) values.push_back(value);
    answer.summary = summary_of(values);
    if (!answer.summary) return;
    if (question.quantile) {
        const auto quantile = quantile_of(values, *question.quantile, confidence);
        answer.value = quantile->value;
        if (!quantile->interval) return;
        answer.low = quantile->interval->low;
        answer.high = quantile->interval->high;
        return;
    }
    answer.value = answer.summary->mean;
    const auto interval =
        interval_of(values, bounds_of(answer.metric), confidence, question.interval);
    if (!interval) return;
    answer.low = interval->low;
    answer.high = interval->high;
    answer.method = interval->method;
    answer.skewed = interval->skewed;
}

/// A cell of a CSV file.
std::string cell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += c;
        quoted += c;
    }
    return quoted + '"';
}

std::string cell(const Value* value) { return value ? cell(plain_text(*value)) : ""; }

}  // namespace

std::vector<std::string> varied_paths(const Store& store) {
    std::vector<std::string> paths;
    for (const StoredPoint& point : store.points()) {
        for (const Entry& entry : point.settings.entries) paths.push_back(entry.key);
        break;
    }
    return paths;
}

std::optional<IntervalMethod> interval_method_of(const Store& store) {
    const Table study = study_of(store);
    const Value* given = study.find("interval");
    std::optional<IntervalMethod> method;
    if (given) read_value(*given, "interval", method);
    return method;
}

double confidence_of(const Store& store) {
    const Table study = study_of(store);
    const Value* given = study.find("confidence");
    const double* number = given ? std::get_if<double>(&given->data) : nullptr;
    return number ? *number : StudyTable{}.confidence;
}

std::vector<Answer> answers(const Store& store, const Question& given) {
    Question question = given;
    if (!question.interval) question.interval = interval_method_of(store);
    const std::vector<std::string> varied = varied_paths(store);
    const auto paths = question.group_by.value_or(varied);
    for (const auto& path : paths) check_known(path, varied, "the key");
    const auto metrics = question.metrics.empty() ? metrics_of(store) : question.metrics;
    for (const auto& metric : metrics) check_known(metric, known_metrics(store), "the metric");
    const double confidence = question.confidence.value_or(confidence_of(store));
    for (const Condition& condition : question.where) {
        check_known(condition.path, varied, "the key");
    }
    const auto groups = groups_of(points_where(store, question.where), paths);
    std::map<std::uint32_t, std::size_t> group_of;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        for (const std::uint32_t point : groups[g].points) group_of[point] = g;
    }

    std::vector<Answer> list(groups.size() * metrics.size());
    for (std::size_t m = 0; m < metrics.size(); ++m) {
        std::vector<std::map<std::uint32_t, std::vector<double>>> values(groups.size());
        const auto answer = [&](std::size_t g) -> Answer& { return list[g * metrics.size() + m]; };
        for (const StoredValue& v : store.values(metrics[m])) {
            const auto found = group_of.find(v.point);
            if (found == group_of.end()) continue;
            const std::size_t g = found->second;
            if (v.value) {
                values[g][v.replication].push_back(*v.value);
            } else {
                ++answer(g).undefined;
            }
        }
        for (std::size_t g = 0; g < groups.size(); ++g) {
            answer(g).settings = groups[g].settings;
            answer(g).metric = metrics[m];
            for (const auto& [replication, each] : values[g]) {
                answer(g).values[replication] = summary_of(each)->mean;
            }
            conclude(answer(g), question, confidence);
        }
    }
    return list;
}

void write_csv(const Store& store, bool provenance,
               const std::function<void(std::string_view)>& write) {
    const std::vector<std::string> paths = varied_paths(store);
    std::string head = "point";
    for (const std::string& path : paths) head += "," + cell(path);
    std::map<std::uint32_t, std::string> settings;  // of each point, as cells
    for (const StoredPoint& point : store.points()) {
        std::string& cells = settings[point.number] = fmt::format("{}", point.number);
        for (const std::string& path : paths) cells += "," + cell(point.settings.find(path));
    }
    if (provenance) {
        write(head + ",replication,run,fingerprint,error,cpu_s,wall_s,started,host\n");
        for (const StoredRun& run : store.runs()) {
            const Measurement& m = run.measurement;
            write(fmt::format("{},{},{},{},{},{},{},{},{}\n", settings[run.point], run.replication,
                              run.id, m.fingerprint, cell(run.error), m.cpu_s, m.wall_s, m.started,
                              cell(m.host)));
        }
        return;
    }
    write(head + ",replication,metric,value\n");
    store.for_each_value([&](const StoredValue& v, const std::string& metric) {
        write(fmt::format("{},{},{},{}\n", settings[v.point], v.replication, metric,
                          v.value ? fmt::format("{}", *v.value) : ""));
    });
}

}  // namespace rovernet
