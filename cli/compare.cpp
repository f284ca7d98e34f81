// SPDX-License-Identifier: MIT
#include "study/compare.hpp"

#include "cli/commands.hpp"
#include "cli/diagnostics.hpp"
#include "cli/study_run.hpp"
#include "cli/text_table.hpp"
#include "experiment/json.hpp"
#include "experiment/output.hpp"
#include "study/precision.hpp"
#include "study/study_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdlib.h>

namespace rovernet::cli {
namespace {

/// A store that vanishes with its object.
class PassingStore {
  public:
    PassingStore() {
        path_ = (std::filesystem::temp_directory_path() / "rovernet-compare-XXXXXX").string();
        if (!mkdtemp(path_.data())) throw RunError(path_ + ": no folder can be made there");
    }
    ~PassingStore() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    PassingStore(const PassingStore&) = delete;
    PassingStore& operator=(const PassingStore&) = delete;
    std::string file() const { return path_ + "/compare.db"; }

  private:
    std::string path_;
};

/// What varies: the models that were asked for, or those of the file's [study].
std::vector<Vary> models_to_vary(const CompareArguments& a) {
    const std::string path = "propagation.model";
    const Location option{"--models " + fmt::format("{}", fmt::join(a.models, ",")), 0, 0, true};
    Vary vary{path, option, {}};
    for (const std::string& model : a.models) {
        vary.values.emplace_back(model);
        vary.values.back().where = option;
    }
    if (vary.values.empty()) {
        for (const Vary& each : ScenarioFile(a.file, options_of(a)).scenario().study.vary) {
            if (each.path == path) vary = each;
        }
    }
    if (vary.values.size() < 2) {
        throw std::invalid_argument(
            "compare needs two models: give --models disc,friis or a file "
            "whose [study] varies propagation.model");
    }
    return {vary};
}

Value optional_value(const std::optional<double>& v) {
    return v && std::isfinite(*v) ? Value(*v) : Value();
}

Table as_table(const ComparedModel& m) {
    const auto around = [](double middle, const std::optional<double>& half, int sign) {
        return half ? Value(middle + sign * *half) : Value();
    };
    Table row;
    row.set("model", m.model);
    row.set("mean", m.summary.mean);
    row.set("low", around(m.summary.mean, m.half_width, -1));
    row.set("high", around(m.summary.mean, m.half_width, 1));
    row.set("n", std::uint64_t{m.summary.n});
    const auto& d = m.difference;
    row.set("difference", d ? Value(d->difference.mean) : Value());
    row.set("difference_low", d ? around(d->difference.mean, d->half_width, -1) : Value());
    row.set("difference_high", d ? around(d->difference.mean, d->half_width, 1) : Value());
    row.set("holm_p", d ? Value(m.holm_p) : Value());
    row.set("detectable", d ? optional_value(d->detectable) : Value());
    row.set("error", m.error);
    row.set("cpu_s", m.cpu_s);
    return row;
}

void print_json(const Comparison& c) {
    Table table;
    table.set("metric", c.metric);
    table.set("baseline", c.baseline);
    table.set("dearest", c.dearest);
    table.set("confidence", c.confidence);
    Array rows, pairs;
    for (const ComparedModel& model : c.models) rows.emplace_back(as_table(model));
    for (const PairedVariance& pair : c.pairs) {
        Table row;
        row.set("a", pair.a);
        row.set("b", pair.b);
        row.set("variance_ratio", optional_value(pair.ratio));
        pairs.emplace_back(std::move(row));
    }
    table.set("rows", std::move(rows));
    table.set("pairs", std::move(pairs));
    fmt::print("{}", to_json(table));
}

std::string interval(double mean, const std::optional<double>& half) {
    if (!half) return fmt::format("{:.4g}", mean);
    return fmt::format("{:.4g} ({:.4g} to {:.4g})", mean, mean - *half, mean + *half);
}

void print_text(const Comparison& c) {
    TextTable table({"model", c.metric, "minus " + c.baseline, "error to " + c.dearest, "CPU/run"});
    for (const ComparedModel& m : c.models) {
        const auto& d = m.difference;
        table.add({m.model, interval(m.summary.mean, m.half_width),
                   d ? interval(d->difference.mean, d->half_width) : "-",
                   fmt::format("{:.3g}", m.error), fmt::format("{:.3g} ms", 1e3 * m.cpu_s)});
    }
    fmt::print("{}\n", table.text());
    for (const ComparedModel& m : c.models) {
        if (!m.sentence.empty()) fmt::print("{}\n", m.sentence);
    }
    fmt::print("\ncommon random numbers: variance of unpaired over that of paired differences\n");
    for (const PairedVariance& pair : c.pairs) {
        if (pair.ratio) fmt::print("  {:<32} {:.3g}\n", pair.a + ", " + pair.b, *pair.ratio);
    }
}

}  // namespace

void compare(const CompareArguments& a) {
    Study study(a.file, study_options(a), models_to_vary(a));
    for (const std::string& text : study.base().notices) notice(text);
    const PassingStore passing;
    Store store = open_store(a.store.value_or(passing.file()), study);
    const SweepResult result = run_study(a, study, store);
    check_end(a, store, result);
    const std::string metric = a.metric.empty() ? first_metric(study.table()) : a.metric;
    const Comparison comparison = compare_models(store, metric, a.baseline);
    if (a.picture) {
        write_file(*a.picture, chart_svg(comparison_charts(comparison), {.width = 480}));
    }
    if (a.json) {
        print_json(comparison);
    } else {
        print_text(comparison);
    }
    check_precision(study, result);
}

}  // namespace rovernet::cli
