// SPDX-License-Identifier: MIT
#include "study/advise/compare.hpp"

#include "cli/runs/run_commands.hpp"
#include "cli/studies/passing_store.hpp"
#include "cli/studies/study_run.hpp"
#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/picture_output.hpp"
#include "cli/terminal/stop.hpp"
#include "cli/terminal/text_table.hpp"
#include "scenario/document/json.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario_file.hpp"
#include "study/advise/compare_cost.hpp"
#include "study/advise/study_chart.hpp"
#include "study/explain.hpp"
#include "study/part_of_store.hpp"
#include "study/precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace rovernet::cli {
namespace {

constexpr std::string_view model_path = "propagation.model";

/// Key of --vary and its values: a TOML list, or values between commas.
/// @throws InputError whose place is the option, for less than two values
Vary key_to_vary(const std::string& given) {
    const std::string typed = "--vary " + given;
    const Location option{typed, 0, 0, true};
    const std::size_t equals = given.find('=');
    const auto value_of = [&](const std::string& text) {
        Value document{Table{}};
        set_option(document, "value=" + text, typed);
        return *document.table()->find("value");
    };
    Vary vary{given.substr(0, equals), option, {}};
    if (equals != std::string::npos) {
        const Value all = value_of(given.substr(equals + 1));
        if (all.array()) vary.values = *all.array();
        std::istringstream words(all.string() ? *all.string() : "");
        for (std::string word; std::getline(words, word, ',');) {
            vary.values.push_back(value_of(word));
        }
    }
    if (vary.values.size() >= 2) return vary;
    throw InputError(option, "expected a key and at least two values, such as routing.ttl=4,8");
}

/// Values that vary: those of --vary, the models that were asked for, or those of the file's
/// [study].
Vary models_to_vary(const CompareArguments& a, const StudyTable& study) {
    if (a.vary) return key_to_vary(*a.vary);
    const Location option{"--models " + fmt::format("{}", fmt::join(a.models, ",")), 0, 0, true};
    Vary vary{std::string(model_path), option, {}};
    for (const std::string& model : a.models) {
        vary.values.emplace_back(model);
        vary.values.back().where = option;
    }
    if (vary.values.empty()) {
        for (const Vary& each : study.vary) {
            if (each.path == model_path) vary = each;
        }
    }
    if (vary.values.size() >= 2) return vary;
    throw std::invalid_argument(
        "compare needs two models: give --models disc,friis or a file "
        "whose [study] varies propagation.model; or another key, such as --vary routing.ttl=4,8");
}

std::vector<std::string> names_of(const Vary& models) {
    std::vector<std::string> names;
    for (const Value& value : models.values) names.push_back(compared_name(models.path, value));
    return names;
}

/// The value at a path such as "robot.A.radio.power"; null if there is none.
const Value* value_at(const Value& document, std::string_view path) {
    const Value* at = &document;
    while (at && !path.empty()) {
        const std::string_view step = path.substr(0, path.find('.'));
        path.remove_prefix(std::min(step.size() + 1, path.size()));
        const Value* next = at->table() ? at->table()->find(step) : nullptr;
        for (std::size_t i = 0; at->array() && i < at->array()->size(); ++i) {
            const Value& item = (*at->array())[i];
            const Value* name = item.table() ? item.table()->find("name") : nullptr;
            const bool named = name && name->string() && *name->string() == step;
            if (named || step == fmt::format("{}", i)) next = &item;
        }
        at = next;
    }
    return at;
}

/// The other keys that the file's [study] varies, which are held as the file has them.
std::string held_keys(const StudyTable& study, const Scenario& base, const std::string& varied) {
    std::vector<std::string> keys;
    const Value document(to_document(base));
    for (const Vary& vary : study.vary) {
        if (vary.path == varied) continue;
        const Value* value = value_at(document, vary.path);
        keys.push_back(value ? fmt::format("{} = {}", vary.path, plain_text(*value)) : vary.path);
    }
    if (keys.empty()) return "";
    return fmt::format("held as the file has {}: {}", keys.size() == 1 ? "it" : "them",
                       fmt::join(keys, ", "));
}

Table as_table(const ComparedModel& m) {
    Table row;
    row.set("model", m.model);
    row.set("mean", m.answer.value);
    row.set("low", m.answer.low);
    row.set("high", m.answer.high);
    row.set("n", std::uint64_t{m.answer.values.size()});
    row.set("failed", m.answer.gaps.failed);
    row.set("missing", m.answer.gaps.missing);
    row.set("undefined", m.answer.gaps.undefined);
    const auto& d = m.difference;
    row.set("difference", d ? Value(d->difference.mean) : Value());
    row.set("difference_low", d ? Value(d->low) : Value());
    row.set("difference_high", d ? Value(d->high) : Value());
    row.set("difference_n", d ? Value(std::uint64_t{d->difference.n}) : Value());
    row.set("p", d ? Value(d->p) : Value());
    row.set("detectable", d ? d->detectable : std::nullopt);
    row.set("method", d ? Value(std::string(name_of(d->method))) : Value());
    row.set("above", d ? Value(std::uint64_t{d->above}) : Value());
    row.set("below", d ? Value(std::uint64_t{d->below}) : Value());
    row.set("sign_p", d ? d->sign_p : std::nullopt);
    if (const auto& e = m.equivalence) {
        const auto count = [](const std::optional<std::size_t>& n) {
            return n ? Value(std::uint64_t{*n}) : Value();
        };
        constexpr const char* words[] = {"undecided", "within", "outside"};
        row.set("verdict", words[static_cast<int>(e->verdict)]);
        row.set("decided_at", count(e->decided_at));
        row.set("needed", count(e->needed));
        row.set("decidable", e->decidable);
    }
    row.set("error", m.error);
    row.set("error_n", std::uint64_t{m.error_n});
    row.set("cpu_s", m.cpu_s);
    row.set("cost_s", m.cost ? Value(m.cost->median_s) : Value());
    row.set("cost_low_s", m.cost ? Value(m.cost->low_s) : Value());
    row.set("cost_high_s", m.cost ? Value(m.cost->high_s) : Value());
    row.set("radio_share", m.radio_share);
    return row;
}

void print_json(const Comparison& c) {
    Table table;
    table.set("metric", c.metric);
    table.set("baseline", c.baseline);
    table.set("dearest", c.most_detailed);
    table.set("confidence", c.confidence);
    if (c.margin) table.set("margin", *c.margin);
    table.set("held", c.held);
    table.set("failed", c.runs.failed);
    table.set("missing", c.runs.missing);
    Array rows, pairs;
    for (const ComparedModel& model : c.models) rows.emplace_back(as_table(model));
    for (const PairedVariance& pair : c.pairs) {
        Table row;
        row.set("a", pair.a);
        row.set("b", pair.b);
        row.set("variance_ratio", pair.ratio);
        pairs.emplace_back(std::move(row));
    }
    table.set("cost", c.cost_text);
    table.set("rows", std::move(rows));
    table.set("pairs", std::move(pairs));
    fmt::print("{}", to_json(table));
}

std::string interval(double mean, const std::optional<double>& low,
                     const std::optional<double>& high) {
    if (!low || !high) return fmt::format("{:.4g}", mean);
    return fmt::format("{:.4g} ({:.4g} to {:.4g})", mean, *low, *high);
}

std::string cost_text(const std::optional<MediumCost>& cost) {
    if (!cost) return "-";
    return fmt::format("{:.3g} us ({:.3g} to {:.3g})", 1e6 * cost->median_s, 1e6 * cost->low_s,
                       1e6 * cost->high_s);
}

void print_table(const Comparison& c) {
    TextTable table({c.path == model_path ? "model" : c.path, c.metric, "n", "minus " + c.baseline,
                     "n", "error to " + c.most_detailed, "n", "CPU/frame", "of run"});
    const auto count = [](std::size_t n) { return fmt::format("{}", n); };
    for (const ComparedModel& m : c.models) {
        const Answer& a = m.answer;
        const auto& d = m.difference;
        table.add({m.model, a.value ? interval(*a.value, a.low, a.high) : "none",
                   count(a.values.size()), d ? interval(d->difference.mean, d->low, d->high) : "-",
                   d ? count(d->difference.n) : "-",
                   m.error ? fmt::format("{:.3g}", *m.error) : "-", count(m.error_n),
                   cost_text(m.cost),
                   m.radio_share ? fmt::format("{:.2g} %", 100 * *m.radio_share) : "-"});
    }
    fmt::print("{}", table.text());
}

/// Notes on the data behind the numbers, and missing runs.
void print_coverage(const Comparison& c) {
    if (!c.held.empty()) fmt::print("{}\n", c.held);
    const std::string lacking = incompleteness(c.runs);
    if (!lacking.empty()) fmt::print("{}\n", lacking);
    for (const ComparedModel& m : c.models) {
        const std::string gaps = m.unpaired.text();
        if (gaps.empty()) continue;
        if (m.model == c.baseline) {
            fmt::print("{} lacks replications: {}\n", m.model, gaps);
        } else {
            fmt::print("{} and {} lack pairs, as one of both lacks the replication: {}\n", m.model,
                       c.baseline, gaps);
        }
    }
}

void print_text(const Comparison& c) {
    print_table(c);
    if (!c.cost_text.empty()) fmt::print("{}\n", c.cost_text);
    print_coverage(c);
    fmt::print("\n");
    for (const ComparedModel& m : c.models) {
        if (!m.sentence.empty()) fmt::print("{}\n", m.sentence);
    }
    if (c.margin) fmt::print("\n");
    for (const ComparedModel& m : c.models) {
        if (!m.equivalence_sentence.empty()) fmt::print("{}\n", m.equivalence_sentence);
    }
    fmt::print("\ncommon random numbers: variance of unpaired over that of paired differences\n");
    for (const PairedVariance& pair : c.pairs) {
        if (pair.ratio) fmt::print("  {:<32} {:.3g}\n", pair.a + ", " + pair.b, *pair.ratio);
    }
}

/// Name of the baseline: of --vary the first value, if none is given; empty for the most detailed
/// model. A value of --vary stands for its name. @throws std::invalid_argument if it is not
/// compared
std::string baseline_of(const CompareArguments& a, const Vary& models) {
    const std::vector<std::string> names = names_of(models);
    if (a.baseline.empty()) return a.vary ? names.front() : "";
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (plain_text(models.values[i]) == a.baseline) return names[i];
    }
    return names[place_of(a.baseline, names)];
}

/// Copies the requested runs from a store, and prints which runs remain there.
void take_part_of(const std::string& path, const Study& study, Store& store) {
    const Store whole = Store::open(path);
    take_part(whole, study, store);
    if (const auto most = more_replications(whole, study)) {
        notice(
            fmt::format("{} has up to {} replications; compared are the first {}, as asked for "
                        "(--replications {} takes all)",
                        path, *most, study.table().replications, *most));
    }
}

/// @throws InputError for a margin that every difference of the metric is within
void check_margin(const CompareArguments& a, const std::string& metric) {
    const Bounds range = difference_bounds(bounds_of(metric));
    if (!a.margin || !range.closed() || *a.margin < *range.high) return;
    throw InputError({fmt::format("--margin {}", *a.margin), 0, 0, true},
                     fmt::format("expected a value below {}, as no two values of {} differ by more",
                                 *range.high, metric));
}

/// Prints where intervals do not use the requested method.
void tell_other_methods(const Comparison& c, std::optional<IntervalMethod> wish) {
    std::vector<IntervalMethod> methods;
    for (const ComparedModel& m : c.models) {
        if (m.answer.method) methods.push_back(*m.answer.method);
        if (m.difference) methods.push_back(m.difference->method);
    }
    const std::string text = other_method_text(c.metric, wish, methods);
    if (!text.empty()) notice(text);
}

/// @throws CommandEnd if the user has ended it before it was done: a part of a comparison is none
void check_interrupted(const CompareArguments& a, bool done) {
    if (stops_asked() == 0 || done) return;
    throw CommandEnd(interrupted,
                     a.store ? "interrupted; what was finished is kept: go on with\n  " + a.command
                             : "interrupted; --store FILE would have kept the runs");
}

/// @throws CommandEnd if runs failed
void check_failures(const CompareArguments& a, const Store& store, const SweepResult& result) {
    if (a.store) return check_end(a, store, result);
    if (result.progress.failed == 0) return;
    throw CommandEnd(partly_failed,
                     fmt::format("{} runs failed; the first: {}\n  {}", result.progress.failed,
                                 result.failure->error,
                                 run_command(store, store.points().at(result.failure->point),
                                             result.failure->replication)));
}

}  // namespace

void compare(const CompareArguments& a) {
    if (a.picture) check_picture_name(*a.picture);
    const StudyTable given = ScenarioFile(a.file, options_of(a)).scenario().study;
    const Vary models = models_to_vary(a, given);
    const std::string metric = a.metric.empty() ? first_metric(given) : a.metric;
    ScenarioOptions options = study_options(a);
    if (metric == "reach") options.set.push_back("metrics.reach=true");
    Study study(a.file, options, std::vector<Vary>{models});
    for (const std::string& text : study.base().notices) notice(text);
    const std::string baseline = baseline_of(a, models);
    check_metric(metric, study.base(), {"--metric " + metric, 0, 0, true});
    check_margin(a, metric);
    const HeldStop until_gone;
    const PassingStore passing;
    const bool is_part = a.store && takes_part_of(*a.store, study);
    Store store = open_store(a.store && !is_part ? *a.store : passing.file(), study);
    if (is_part) take_part_of(*a.store, study, store);
    const SweepResult result = run_study(a, study, store, {.replication_on_one_worker = true},
                                         a.store ? Finished::is_kept : Finished::is_lost);
    if (is_part) {
        Store whole = Store::open_to_write(*a.store);
        give_back(store, whole);
    }
    check_interrupted(a, result.progress.left == 0);
    Comparison comparison = compare_models(store, metric, baseline, a.margin);
    if (models.path == model_path) {
        add_costs(comparison, study, store, [] { return stops_asked() > 0; });
        check_interrupted(a, false);
    }
    tell_other_methods(comparison, interval_method_of(store));
    comparison.held = held_keys(given, study.base(), models.path);
    if (a.picture) {
        write_picture(*a.picture, chart_svg(comparison_charts(comparison), {.width = 480}));
    }
    if (a.json) {
        print_json(comparison);
    } else {
        print_text(comparison);
    }
    check_failures(a, store, result);
    check_precision(study, result);
}

}  // namespace rovernet::cli
