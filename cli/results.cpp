// SPDX-License-Identifier: MIT
#include "study/results.hpp"

#include "cli/commands.hpp"
#include "cli/diagnostics.hpp"
#include "cli/text_table.hpp"
#include "experiment/json.hpp"
#include "experiment/toml.hpp"
#include "study/explain.hpp"
#include "study/study.hpp"
#include "study/study_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace rovernet::cli {
namespace {

constexpr std::size_t few_replications = 5;

Value optional_value(const std::optional<double>& v) { return v ? Value(*v) : Value(); }

Table as_table(const Answer& answer) {
    Table row;
    row.set("settings", answer.settings);
    row.set("metric", answer.metric);
    row.set("n", std::uint64_t{answer.values.size()});
    row.set("value", optional_value(answer.value));
    row.set("low", optional_value(answer.low));
    row.set("high", optional_value(answer.high));
    row.set("skewed", answer.skewed);
    row.set("interval", answer.method ? Value(std::string(name_of(*answer.method))) : Value());
    const auto& s = answer.summary;
    row.set("sd", s ? optional_value(s->standard_deviation) : Value());
    row.set("min", s ? Value(s->min) : Value());
    row.set("max", s ? Value(s->max) : Value());
    row.set("undefined", std::uint64_t{answer.undefined});
    return row;
}

std::string cell(const Answer& answer) {
    if (!answer.value) return "none";
    if (!answer.low) return fmt::format("{:.4g}", *answer.value);
    return fmt::format("{:.4g} ({:.4g} to {:.4g})", *answer.value, *answer.low, *answer.high);
}

/// The answers as a table: a column per key and metric, a row per group.
TextTable table_of(const std::vector<Answer>& list, std::size_t metrics) {
    TextTable::Line head;
    for (const Entry& entry : list.front().settings.entries) head.push_back(entry.key);
    head.emplace_back("n");
    for (std::size_t m = 0; m < metrics; ++m) head.push_back(list[m].metric);
    TextTable table(std::move(head));
    for (std::size_t g = 0; g < list.size(); g += metrics) {
        TextTable::Line line;
        for (const Entry& entry : list[g].settings.entries) line.push_back(plain_text(entry.value));
        line.push_back(fmt::format("{}", list[g].values.size()));
        for (std::size_t m = 0; m < metrics; ++m) line.push_back(cell(list[g + m]));
        table.add(std::move(line));
    }
    return table;
}

/// How many metrics the answers of one group are about.
std::size_t metrics_in(const std::vector<Answer>& list) {
    std::size_t metrics = 1;
    while (metrics < list.size() && list[metrics].metric != list[0].metric) ++metrics;
    return metrics;
}

void warn(const std::vector<Answer>& list, std::size_t failures, const std::string& store) {
    const auto few = std::count_if(list.begin(), list.end(), [](const Answer& a) {
        return a.values.size() < few_replications;
    });
    if (few > 0) {
        notice(
            fmt::format("warning: {} of {} values are of fewer than {} replications: their "
                        "intervals say little",
                        few, list.size(), few_replications));
    }
    const auto skewed = std::ranges::count_if(list, &Answer::skewed);
    if (skewed > 0) {
        notice(
            fmt::format("warning: {} of {} intervals are by Student's t of values that are too "
                        "skewed for it (n <= 25 times their squared skewness): they may cover "
                        "the truth less often than they say",
                        skewed, list.size()));
    }
    if (failures > 0) {
        notice(fmt::format("{} runs failed and are not in these: rovernet results {} --failures",
                           failures, store));
    }
}

std::size_t failures_in(const Store& store) {
    const auto runs = store.runs();
    return static_cast<std::size_t>(std::count_if(
        runs.begin(), runs.end(), [](const StoredRun& run) { return !run.error.empty(); }));
}

std::optional<std::vector<std::string>> group_by_of(const ResultsArguments& a, const Store& store) {
    if (a.group_by.empty()) return std::nullopt;
    std::vector<std::string> paths;
    for (const std::string& word : a.group_by) {
        paths.push_back(varied_path(varied_paths(store), word));
    }
    return paths;
}

void print_answers(const ResultsArguments& a, const Store& store) {
    const auto list = answers(store, {.metrics = a.metrics,
                                      .group_by = group_by_of(a, store),
                                      .where = conditions_of(varied_paths(store), a.where),
                                      .confidence = a.confidence,
                                      .quantile = a.quantile,
                                      .interval = method_named(a.interval)});
    const std::size_t failures = failures_in(store);
    if (a.json) {
        Array rows;
        for (const Answer& answer : list) rows.emplace_back(as_table(answer));
        Table table;
        table.set("version", store.property("version"));
        table.set("confidence", a.confidence.value_or(confidence_of(store)));
        if (a.quantile) table.set("quantile", *a.quantile);
        table.set("failed", std::uint64_t{failures});
        table.set("rows", std::move(rows));
        fmt::print("{}", to_json(table));
    } else {
        fmt::print("{}", table_of(list, metrics_in(list)).text());
    }
    warn(list, failures, a.store);
}

void print_failures(const Store& store) {
    const auto points = store.points();
    for (const StoredRun& run : store.runs()) {
        if (run.error.empty()) continue;
        const StoredPoint& point = points.at(run.point);
        fmt::print("{}/{}  {}\n  {}\n  {}\n", run.point, run.replication,
                   settings_text(point.settings), run.error,
                   run_command(store, point, run.replication));
    }
}

}  // namespace

void results(const ResultsArguments& a) {
    const Store store = Store::open(a.store);
    if (a.sql) {
        store.query(*a.sql, [](const std::vector<std::string>& row) {
            fmt::print("{}\n", fmt::join(row, "\t"));
        });
    } else if (a.csv) {
        write_csv(store, a.provenance,
                  [](std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); });
    } else if (a.failures) {
        print_failures(store);
    } else {
        print_answers(a, store);
    }
}

void explain(const ExplainArguments& a) {
    const Store store = Store::open(a.store);
    const FoundRun found = find_run(store, a.run);
    const StoredRun& run = found.run;
    const Measurement& m = run.measurement;
    const std::string command = run_command(store, found.point, run.replication);
    Table table;
    table.set("run", run.id);
    table.set("point", std::uint64_t{run.point});
    table.set("replication", std::uint64_t{run.replication});
    table.set("settings", found.point.settings);
    table.set("command", command);
    table.set("version", store.property("version"));
    table.set("fingerprint", m.fingerprint);
    table.set("error", run.error.empty() ? Value() : Value(run.error));
    table.set("cpu_s", m.cpu_s);
    table.set("wall_s", m.wall_s);
    table.set("started", m.started);
    table.set("host", m.host);
    Table metrics;
    for (const MetricValue& metric : m.metrics) {
        metrics.set(metric.name, optional_value(metric.value));
    }
    table.set("metrics", std::move(metrics));
    if (a.json) {
        fmt::print("{}", to_json(table));
        return;
    }
    fmt::print(
        "run {}: point {} ({}), replication {}\nmade by version {}, {} on {}, {:.3g} s of "
        "CPU\n{}\nagain: {}\n",
        run.id, run.point, settings_text(found.point.settings), run.replication,
        store.property("version"), m.started, m.host, m.cpu_s,
        run.error.empty() ? "fingerprint " + m.fingerprint : "failed: " + run.error, command);
    for (const MetricValue& metric : m.metrics) {
        fmt::print("{:<20} {}\n", metric.name,
                   metric.value ? fmt::format("{}", *metric.value) : "none");
    }
}

}  // namespace rovernet::cli
