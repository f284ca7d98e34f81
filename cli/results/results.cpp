// SPDX-License-Identifier: MIT
#include "study/results.hpp"

#include "cli/results/result_commands.hpp"
#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/text_table.hpp"
#include "scenario/document/json.hpp"
#include "scenario/document/toml.hpp"
#include "study/advise/study_chart.hpp"
#include "study/explain.hpp"
#include "study/results_csv.hpp"
#include "study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace rovernet::cli {
namespace {

constexpr std::size_t few_replications = 5;

Table as_table(const Answer& answer, const Answers& all) {
    Table row;
    row.set("settings", answer.settings);
    row.set("metric", answer.metric);
    row.set("n", std::uint64_t{answer.values.size()});
    row.set("value", answer.value);
    row.set("low", answer.low);
    row.set("high", answer.high);
    row.set("skewed", answer.skewed);
    row.set("interval", answer.method ? Value(std::string(name_of(*answer.method))) : Value());
    const auto& s = answer.summary;
    row.set("sd", s ? s->standard_deviation : std::nullopt);
    row.set("min", s ? Value(s->min) : Value());
    row.set("max", s ? Value(s->max) : Value());
    row.set("averaged", Array(all.averaged.begin(), all.averaged.end()));
    row.set("failed", answer.gaps.failed);
    row.set("missing", answer.gaps.missing);
    row.set("undefined", answer.gaps.undefined);
    row.set("left_out", answer.left_out);
    return row;
}

std::string cell(const Answer& answer) {
    if (!answer.value) return "none";
    if (!answer.low) return fmt::format("{:.4g}", *answer.value);
    return fmt::format("{:.4g} ({:.4g} to {:.4g})", *answer.value, *answer.low, *answer.high);
}

/// Number of metrics that the answers of one row are about.
std::size_t metrics_in(const std::vector<Answer>& list) {
    std::size_t metrics = 1;
    while (metrics < list.size() && list[metrics].metric != list[0].metric) ++metrics;
    return metrics;
}

/// The answers as a table, a line per row: its keys, its metrics, and its runs that failed or are
/// missing, if there are any. A column n stands before the metrics if in each row all of them are
/// of as many replications, or else behind each.
class AnswerTable {
  public:
    explicit AnswerTable(const std::vector<Answer>& list)
        : list_(list), metrics_(metrics_in(list)) {
        for (std::size_t i = 0; i < list.size(); ++i) {
            const Answer& first = list[i - i % metrics_];
            one_n_ = one_n_ && list[i].values.size() == first.values.size();
            failed_ = failed_ || list[i].gaps.failed > 0;
            missing_ = missing_ || list[i].gaps.missing > 0;
        }
    }

    std::string text() const {
        TextTable table(head());
        for (std::size_t row = 0; row < list_.size(); row += metrics_) table.add(line(row));
        return table.text();
    }

  private:
    TextTable::Line head() const {
        TextTable::Line head;
        for (const Entry& entry : list_.front().settings.entries) head.push_back(entry.key);
        if (one_n_) head.emplace_back("n");
        for (std::size_t m = 0; m < metrics_; ++m) {
            head.push_back(list_[m].metric);
            if (!one_n_) head.emplace_back("n");
        }
        if (failed_) head.emplace_back("failed");
        if (missing_) head.emplace_back("missing");
        return head;
    }

    TextTable::Line line(std::size_t row) const {
        const auto n_of = [](const Answer& a) { return fmt::format("{}", a.values.size()); };
        const Answer& first = list_[row];
        TextTable::Line line;
        for (const Entry& entry : first.settings.entries) line.push_back(plain_text(entry.value));
        if (one_n_) line.push_back(n_of(first));
        for (std::size_t m = 0; m < metrics_; ++m) {
            line.push_back(cell(list_[row + m]));
            if (!one_n_) line.push_back(n_of(list_[row + m]));
        }
        if (failed_) line.push_back(fmt::format("{}", first.gaps.failed));
        if (missing_) line.push_back(fmt::format("{}", first.gaps.missing));
        return line;
    }

    const std::vector<Answer>& list_;
    std::size_t metrics_;
    bool one_n_ = true, failed_ = false, missing_ = false;
};

void warn_of_few(const std::vector<Answer>& list) {
    const auto few = std::count_if(list.begin(), list.end(), [](const Answer& a) {
        return a.values.size() < few_replications;
    });
    if (few == 0) return;
    notice(
        fmt::format("warning: {} of {} values are computed from fewer than {} replications; the "
                    "intervals of these values are unreliable; make more replications",
                    few, list.size(), few_replications));
}

void warn_of_skewness(const std::vector<Answer>& list) {
    const auto skewed = std::ranges::count_if(list, &Answer::skewed);
    if (skewed == 0) return;
    notice(fmt::format(
        "warning: {} of {} intervals were computed by Student's t from values that are too skewed "
        "for this method (it needs more values than 25 times the square of their skewness); these "
        "intervals may cover the true mean less often than stated; make more replications",
        skewed, list.size()));
}

/// Prints the metrics whose intervals do not use the requested method.
void tell_other_methods(const std::vector<Answer>& list, std::optional<IntervalMethod> wish) {
    std::map<std::string, std::vector<IntervalMethod>> methods;
    for (const Answer& answer : list) {
        if (answer.method) methods[answer.metric].push_back(*answer.method);
    }
    for (const auto& [metric, used] : methods) {
        const std::string text = other_method_text(metric, wish, used);
        if (!text.empty()) notice(text);
    }
}

/// Prints the missing runs of the study.
void warn_of_gaps(const RunCounts& runs, const std::string& store) {
    const std::string text = incompleteness(runs);
    if (!text.empty()) notice(fmt::format("{}: {}", store, text));
    if (runs.failed > 0)
        notice(fmt::format("to list the errors of the failed runs: rovernet results {} --failures",
                           store));
}

std::optional<std::vector<std::string>> group_by_of(const ResultsArguments& a, const Store& store) {
    if (a.group_by.empty()) return std::nullopt;
    std::vector<std::string> paths;
    for (const std::string& word : a.group_by) {
        paths.push_back(varied_path(varied_paths(store), word));
    }
    return paths;
}

Question question_of(const ResultsArguments& a, const Store& store) {
    return {.metrics = a.metrics,
            .group_by = group_by_of(a, store),
            .where = conditions_of(varied_paths(store), a.where),
            .confidence = a.confidence,
            .quantile = a.quantile,
            .interval = method_named(a.interval),
            .common = a.common};
}

void print_json(const ResultsArguments& a, const Store& store, const Answers& all) {
    Array rows;
    for (const Answer& answer : all.list) rows.emplace_back(as_table(answer, all));
    Table table;
    table.set("version", store.property("version"));
    table.set("confidence", a.confidence.value_or(confidence_of(store)));
    if (a.quantile) table.set("quantile", *a.quantile);
    table.set("runs", all.runs.all());
    table.set("failed", all.runs.failed);
    table.set("missing", all.runs.missing);
    if (!all.averaged.empty()) table.set("weights", "equal for each point in each replication");
    table.set("rows", std::move(rows));
    fmt::print("{}", to_json(table));
}

void print_answers(const ResultsArguments& a, const Store& store) {
    const Answers all = answers(store, question_of(a, store));
    if (a.json) {
        print_json(a, store, all);
    } else {
        fmt::print("{}", AnswerTable(all.list).text());
        const std::string covered = coverage_text(all);
        if (!covered.empty()) fmt::print("\n{}\n", covered);
    }
    tell_other_methods(all.list, method_named(a.interval));
    warn_of_few(all.list);
    warn_of_skewness(all.list);
    warn_of_gaps(all.runs, a.store);
}

void print_csv(const ResultsArguments& a, const Store& store) {
    const Write write = [](std::string_view text) { fmt::print("{}", text); };
    const Question question = question_of(a, store);
    if (a.provenance) {
        write_provenance_csv(store, question.where, write);
    } else {
        write_csv(store, question, write);
    }
    warn_of_gaps(counts_of(inventory_of(store)), a.store);
}

void print_failures(const ResultsArguments& a, const Store& store) {
    std::map<std::uint32_t, StoredPoint> points;
    for (StoredPoint& p : points_where(store, conditions_of(varied_paths(store), a.where))) {
        points[p.number] = std::move(p);
    }
    for (const StoredRun& run : store.runs()) {
        const auto point = points.find(run.point);
        if (run.error.empty() || point == points.end()) continue;
        fmt::print("{}/{}  {}\n  {}\n  {}\n", run.point, run.replication,
                   settings_text(point->second.settings), run.error,
                   run_command(store, point->second, run.replication));
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
        print_csv(a, store);
    } else if (a.failures) {
        print_failures(a, store);
    } else {
        print_answers(a, store);
    }
}

}  // namespace rovernet::cli
