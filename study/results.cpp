// SPDX-License-Identifier: MIT
#include "study/results.hpp"

#include "scenario/document/toml.hpp"
#include "sim/error.hpp"
#include "study/measurement.hpp"
#include "study/quotient.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

const std::vector<std::string> usual_metrics = {"delivery_ratio", "latency_mean_s",
                                                "transmissions"};

void check_known(const std::string& word, const std::vector<std::string>& known,
                 std::string_view what) {
    if (std::find(known.begin(), known.end(), word) != known.end()) return;
    const std::string near = did_you_mean(word, known);
    throw std::invalid_argument(
        fmt::format("{} \"{}\" does not vary in this study; expected one of {}{}{}", what, word,
                    fmt::join(known, ", "), near.empty() ? "" : "; ", near));
}

/// @throws std::invalid_argument if the store has no such metric
void check_metric_known(const std::string& metric, const std::vector<std::string>& known,
                        const Store& store) {
    if (std::find(known.begin(), known.end(), metric) != known.end()) return;
    throw std::invalid_argument(
        fmt::format("the metric \"{}\" is not in this study{}; rovernet results {} --sql 'SELECT "
                    "name FROM metric_name' lists the metrics",
                    metric, near_metrics(metric, known), store.path()));
}

/// The metrics of every run, and those of the flows and robots of the store's runs.
std::vector<std::string> known_metrics(const Store& store) {
    std::vector<std::string> names = metric_names();
    for (std::string& name : store.metric_names()) {
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            names.push_back(std::move(name));
        }
    }
    return names;
}

bool meets(const StoredPoint& point, const Condition& condition) {
    const Value* value = point.settings.find(condition.path);
    return value && plain_text(*value) == condition.value;
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

/// @throws std::invalid_argument if rows that join points would be means of different cells
void check_balanced(const Rows& rows, const Cells& cells, const std::string& metric) {
    if (rows.averaged.empty()) return;
    const std::string lines = cells.unbalanced();
    if (lines.empty()) return;
    throw std::invalid_argument(fmt::format(
        "{} cannot be averaged over {}, because some rows of the result have no value in some "
        "cells (a cell is one replication at one value of each of these keys). The means of the "
        "rows would be over different cells and could not be compared.\n{}\nexpected --where "
        "KEY=VALUE that leaves only cells in which every row has a value, or --common to average "
        "only the {} of {} cells in which every row has a value",
        metric, fmt::join(rows.averaged, ", "), lines, cells.common(), cells.count()));
}

}  // namespace

std::vector<StoredPoint> points_where(const Store& store, const std::vector<Condition>& where) {
    const std::vector<std::string> varied = varied_paths(store);
    std::vector<StoredPoint> points = store.points();
    for (const Condition& condition : where) {
        check_known(condition.path, varied, "the key");
        std::vector<std::string> values;  // in the order of the study
        std::set<std::string> listed;
        for (const StoredPoint& point : points) {
            const Value* value = point.settings.find(condition.path);
            if (!value || !listed.insert(plain_text(*value)).second) continue;
            values.push_back(plain_text(*value));
        }
        std::erase_if(points, [&](const StoredPoint& p) { return !meets(p, condition); });
        if (!points.empty()) continue;
        throw std::invalid_argument(
            fmt::format("no run of this study has {} = {}; the values in this study are {}",
                        condition.path, condition.value, fmt::join(values, ", ")));
    }
    return points;
}

std::vector<std::string> metrics_of(const Store& store, const Question& question) {
    std::vector<std::string> metrics = question.metrics;
    if (metrics.empty()) metrics = study_of(store).metrics;
    if (metrics.empty()) metrics = usual_metrics;
    const std::vector<std::string> known = known_metrics(store);
    for (const auto& metric : metrics) {
        const bool is_known = std::find(known.begin(), known.end(), metric) != known.end();
        const auto quotient = is_known ? std::nullopt : quotient_of(metric);
        check_metric_known(quotient ? quotient->over : metric, known, store);
        if (quotient) check_metric_known(quotient->under, known, store);
    }
    return metrics;
}

std::vector<std::string> varied_paths(const Store& store) {
    std::vector<std::string> paths;
    for (const StoredPoint& point : store.points()) {
        for (const Entry& entry : point.settings.entries) paths.push_back(entry.key);
        break;
    }
    return paths;
}

std::optional<IntervalMethod> interval_method_of(const Store& store) {
    return study_of(store).interval_wish();
}

double confidence_of(const Store& store) { return study_of(store).confidence; }

Answers answers(const Store& store, const Question& given) {
    Question question = given;
    if (!question.interval) question.interval = interval_method_of(store);
    const std::vector<std::string> varied = varied_paths(store);
    const auto paths = question.group_by.value_or(varied);
    for (const auto& path : paths) check_known(path, varied, "the key");
    const auto metrics = metrics_of(store, question);
    const double confidence = question.confidence.value_or(confidence_of(store));
    const Rows rows = rows_of(points_where(store, question.where), paths);
    const Inventory inventory = inventory_of(store);

    std::vector<Answer> list(rows.list.size() * metrics.size());
    for (std::size_t m = 0; m < metrics.size(); ++m) {
        const Cells cells(rows, inventory, values_of_points(store, metrics[m]));
        if (!question.common) check_balanced(rows, cells, metrics[m]);
        for (std::size_t row = 0; row < rows.list.size(); ++row) {
            Answer& answer = list[row * metrics.size() + m];
            answer.settings = rows.list[row].settings;
            answer.metric = metrics[m];
            answer.values = cells.means(row, question.common);
            answer.gaps = cells.gaps(row);
            answer.cells = cells.count();
            answer.left_out = question.common ? cells.count() - cells.common() : 0;
            conclude(answer, question, confidence);
        }
    }
    return {.list = std::move(list),
            .averaged = rows.averaged,
            .along = rows.along,
            .runs = counts_of(inventory)};
}

std::string coverage_text(const Answers& answers) {
    std::vector<std::string> texts;
    if (!answers.averaged.empty()) {
        texts.push_back(fmt::format("averaged over {}", fmt::join(answers.averaged, ", ")));
    }
    if (!answers.along.empty()) {
        texts.push_back(
            fmt::format("not averaged over {} (each row has only one value of such a key)",
                        fmt::join(answers.along, ", ")));
    }
    std::map<std::string, std::uint64_t> undefined;
    RunCounts runs;
    for (const Answer& answer : answers.list) {
        undefined[answer.metric] += answer.gaps.undefined;
        if (answer.metric != answers.list.front().metric) continue;
        runs.failed += answer.gaps.failed;
        runs.missing += answer.gaps.missing;
    }
    for (const Answer& answer : answers.list) {
        if (&answer != &answers.list.front() && answer.metric == answers.list.front().metric) break;
        if (answer.left_out == 0) continue;
        texts.push_back(fmt::format(
            "the mean of {} leaves out {} of {} cells, because some rows have no value in "
            "these cells (a cell is one replication at one value of each key that is "
            "averaged over)",
            answer.metric, answer.left_out, answer.cells));
    }
    for (const auto& [metric, count] : undefined) {
        if (count > 0)
            texts.push_back(fmt::format("{} {} no value of the metric {}", runs_text(count),
                                        count == 1 ? "has" : "have", metric));
    }
    if (runs.failed > 0) texts.push_back(runs_text(runs.failed) + " failed");
    if (runs.missing > 0) {
        texts.push_back(fmt::format("unfinished: {} {} missing", runs_text(runs.missing),
                                    runs.missing == 1 ? "is" : "are"));
    }
    return fmt::format("{}", fmt::join(texts, "; "));
}

}  // namespace rovernet
