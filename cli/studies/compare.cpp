// SPDX-License-Identifier: MIT
#include "study/advise/compare.hpp"

#include "cli/display/picture_output.hpp"
#include "cli/runs/run_commands.hpp"
#include "cli/studies/compare_report.hpp"
#include "cli/studies/study_run.hpp"
#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/stop.hpp"
#include "files/temporary_directory.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario_file.hpp"
#include "scenario/unlikely.hpp"
#include "study/advise/compare_cost.hpp"
#include "study/explain.hpp"
#include "study/inventory.hpp"
#include "study/part_of_store.hpp"
#include "study/precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace rovernet::cli {
namespace {

/// Key of --vary and its values: a TOML list, or values between commas.
/// @throws InputError whose place is the option, for less than two values
Vary key_to_vary(const std::string& given) {
    const std::string typed = "--vary " + given;
    const Location option{typed, 0, 0, true};
    const std::size_t equals = find_equals(given);
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

/// Values of an option such as --models disc,friis, for the key at `path`.
Vary values_of(const char* option, std::string_view path, const std::vector<std::string>& words) {
    const Location place{fmt::format("{} {}", option, fmt::join(words, ",")), 0, 0, true};
    Vary vary{std::string(path), place, {}};
    for (const std::string& word : words) {
        vary.values.emplace_back(word);
        vary.values.back().where = place;
    }
    return vary;
}

/// Values that vary: those of --vary, the protocols or models that were asked for, or those of the
/// file's [study], of which models go first.
Vary values_to_vary(const CompareArguments& a, const StudyTable& study) {
    if (a.vary) return key_to_vary(*a.vary);
    Vary vary = a.protocols.empty() ? values_of("--models", model_path, a.models)
                                    : values_of("--protocols", protocol_path, a.protocols);
    if (!a.protocols.empty() && vary.values.size() < 2) {
        throw InputError(vary.where, "expected at least two protocols, such as flood,aodv");
    }
    for (const std::string_view path : {model_path, protocol_path}) {
        if (!vary.values.empty()) break;
        const auto found = std::ranges::find(study.vary, path, &Vary::path);
        if (found != study.vary.end()) vary = *found;
    }
    if (vary.values.size() >= 2) return vary;
    throw std::invalid_argument(
        "compare: expected at least two models (--models disc,friis, or a file whose [study] "
        "varies propagation.model), two protocols (--protocols flood,aodv), or two values of "
        "another key (--vary routing.ttl=4,8)");
}

/// Metrics that are compared: those that were asked for; of protocols what they deliver, and what
/// that costs; else the study's first.
std::vector<std::string> metrics_of(const CompareArguments& a, const Vary& vary,
                                    const StudyTable& study) {
    if (!a.metrics.empty()) return a.metrics;
    if (vary.path != protocol_path) return {first_metric(study)};
    return {"delivery_ratio", "latency_mean_s", "routing_load", "airtime_per_byte_us"};
}

std::vector<std::string> names_of(const Vary& vary) {
    std::vector<std::string> names;
    for (const Value& value : vary.values) names.push_back(compared_name(vary.path, value));
    return names;
}

/// The value at a path such as "robot.A.radio.power"; null if there is none.
const Value* value_at(const Value& document, std::string_view path) {
    const Value* at = &document;
    while (at && !path.empty()) {
        const std::string_view step = take_key(path);
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

/// The other keys that the file's [study] varies, which have their values of the file.
std::string held_keys(const StudyTable& study, const Scenario& base, const std::string& varied) {
    std::vector<std::string> keys;
    const Value document(to_document(base));
    for (const Vary& vary : study.vary) {
        if (vary.path == varied) continue;
        const Value* value = value_at(document, vary.path);
        keys.push_back(value ? fmt::format("{} = {}", vary.path, plain_text(*value)) : vary.path);
    }
    if (keys.empty()) return "";
    return fmt::format(
        "not varied in this comparison, but kept at the values of the scenario file: {}",
        fmt::join(keys, ", "));
}

/// Name of the baseline: of other keys than the model the first value, if none is given; empty for
/// the most detailed model. A value of --vary stands for its name. @throws std::invalid_argument if
/// it is not compared
std::string baseline_of(const CompareArguments& a, const Vary& vary) {
    const std::vector<std::string> names = names_of(vary);
    const bool is_model = !a.vary && vary.path == model_path;
    if (a.baseline.empty()) return is_model ? "" : names.front();
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (plain_text(vary.values[i]) == a.baseline) return names[i];
    }
    return names[place_of(a.baseline, names)];
}

/// Copies the requested runs from a store, and prints which runs remain there.
void take_part_of(const std::string& path, const Study& study, Store& store) {
    const Store whole = Store::open(path);
    take_part(whole, study, store);
    if (const auto most = more_replications(whole, study)) {
        notice(
            fmt::format("the store {} has up to {} replications; the first {} are compared, as "
                        "requested (--replications {} compares all)",
                        path, *most, study.table().replications, *most));
    }
}

/// @throws InputError for a margin that every difference of the metric is within
void check_margin(const CompareArguments& a, const std::string& metric) {
    const Bounds range = difference_bounds(bounds_of(metric));
    if (!a.margin || !range.closed() || *a.margin < *range.high) return;
    throw InputError(
        {fmt::format("--margin {}", *a.margin), 0, 0, true},
        fmt::format("expected a value below {}, because the difference between two values of {} is "
                    "never larger",
                    *range.high, metric));
}

/// Prints the study's notices, and that one run of each value shows no difference.
void tell_notices(const Study& study) {
    for (const std::string& text : study.base().notices) notice(text);
    const StudyTable& table = study.table();
    if (table.replications > 1 || table.precision) return;
    notice(
        "one replication of each value does not show how certain the differences are; "
        "--replications 30 repeats the runs with other random numbers");
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

/// Whether the protocol of a point of the study routes unicasts.
bool routes_unicasts(Study& study, std::size_t point) {
    return study.scenario(point, 0).routing.make().traits().routes_unicasts;
}

/// Whether the scenario has unicasts, or else broadcasts, that a protocol may forward.
bool has_messages(const Scenario& scenario, bool unicasts) {
    const auto is_one = [&](const TrafficTable& t) {
        return t.to.has_value() == unicasts && is_for_protocol(scenario, t);
    };
    const auto sends_one = [&](const ReactionTable& r) {
        return r.send && r.to.has_value() == unicasts;
    };
    return std::ranges::any_of(scenario.traffic, is_one) ||
           std::ranges::any_of(scenario.robots, [&](const RobotTable& robot) {
               return std::ranges::any_of(robot.reactions, sends_one);
           });
}

/// Text on protocols that send messages of the scenario over one hop only; empty: there are none.
std::string one_hop_text(Study& study, const Vary& vary) {
    if (vary.path != protocol_path) return "";
    std::vector<std::string> unicasts, broadcasts, parts;
    for (std::uint32_t point = 0; point < vary.values.size(); ++point) {
        auto& protocols = routes_unicasts(study, point) ? broadcasts : unicasts;
        protocols.push_back(compared_name(vary.path, vary.values[point]));
    }
    const auto tell = [&](bool is_unicast, const std::vector<std::string>& protocols) {
        if (protocols.empty() || !has_messages(study.base(), is_unicast)) return;
        parts.push_back(fmt::format("{} under {}", is_unicast ? "unicasts" : "broadcasts",
                                    fmt::join(protocols, ", ")));
    };
    tell(true, unicasts);
    tell(false, broadcasts);
    if (parts.empty()) return "";
    return fmt::format("over one hop only: {}", fmt::join(parts, "; "));
}

/// Prints that delivery_ratio counts unicasts that are on their way at the end of a run if the
/// protocol routes them, and leaves them out if it does not.
void tell_cut_off(Study& study, const Store& store, const Vary& vary,
                  const std::vector<std::string>& metrics) {
    if (vary.path != protocol_path || std::ranges::count(metrics, "delivery_ratio") == 0) return;
    if (!has_messages(study.base(), true)) return;
    std::vector<std::string> routing, others;
    double most_of_routing = 0, most_of_others = 0;
    for (std::uint32_t point = 0; point < vary.values.size(); ++point) {
        double sum = 0;
        for (const StoredValue& run : store.values("cut_off", point)) sum += run.value.value_or(0);
        const bool routes = routes_unicasts(study, point);
        double& most = routes ? most_of_routing : most_of_others;
        most = std::max(most, sum);
        (routes ? routing : others).push_back(compared_name(vary.path, vary.values[point]));
    }
    if (routing.empty() || most_of_others <= most_of_routing) return;
    notice(fmt::format(
        "some unicasts are still on their way when a run ends. The delivery_ratio of {} leaves out "
        "these unicasts ({}{} in all runs); the delivery_ratio of {} counts them as not delivered",
        fmt::join(others, ", "), others.size() > 1 ? "up to " : "",
        most_of_others - most_of_routing, fmt::join(routing, ", ")));
}

/// @throws CommandEnd if the user has ended it before it was done: a part of a comparison is none
void check_interrupted(const CompareArguments& a, bool done) {
    if (stops_asked() == 0 || done) return;
    throw CommandEnd(
        interrupted,
        a.store ? "interrupted; finished runs are kept; continue with\n  " + a.command
                : "interrupted; the runs are lost, because they were not kept by --store FILE");
}

/// @throws CommandEnd if runs failed
void check_failures(const CompareArguments& a, const Store& store, const SweepResult& result) {
    if (a.store) return check_end(a, store, result);
    if (result.progress.failed == 0) return;
    throw CommandEnd(partly_failed,
                     fmt::format("{} failed; the error of the first: {}\nto repeat this run:\n  {}",
                                 runs_text(result.progress.failed), result.failure->error,
                                 run_command(store, store.points().at(result.failure->point),
                                             result.failure->replication)));
}

}  // namespace

void compare(const CompareArguments& a) {
    if (a.picture) check_picture_name(*a.picture);
    const StudyTable given = ScenarioFile(a.file, options_of(a)).scenario().study;
    const Vary vary = values_to_vary(a, given);
    const std::vector<std::string> metrics = metrics_of(a, vary, given);
    ScenarioOptions options = study_options(a);
    if (std::ranges::count(metrics, "reach") > 0) options.set.push_back("metrics.reach=true");
    Study study(a.file, options, std::vector<Vary>{vary});
    tell_notices(study);
    tell_ignored(study, IgnoredBy::command);
    const std::string baseline = baseline_of(a, vary);
    for (const std::string& metric : metrics) {
        check_metric(metric, study.base(), {"--metric " + metric, 0, 0, true});
        check_margin(a, metric);
    }
    const HeldStop until_gone;
    const TemporaryDirectory passing;
    const bool is_part = a.store && takes_part_of(*a.store, study);
    Store store = open_store(a.store && !is_part ? *a.store : passing.path() + "/study.db", study);
    if (is_part) take_part_of(*a.store, study, store);
    const SweepResult result = run_study(a, study, store, {.replication_on_one_worker = true},
                                         a.store ? Finished::is_kept : Finished::is_lost);
    if (is_part) {
        Store whole = Store::open_to_write(*a.store);
        give_back(store, whole);
    }
    check_interrupted(a, result.progress.left == 0);
    std::vector<Comparison> all = comparisons_of(store, metrics, baseline, a.margin);
    if (vary.path == model_path) {
        add_costs(all.front(), study, store, [] { return stops_asked() > 0; });
        check_interrupted(a, false);
    }
    const std::string one_hop = one_hop_text(study, vary);
    for (Comparison& c : all) {
        tell_other_methods(c, interval_method_of(store));
        c.held = held_keys(given, study.base(), vary.path);
        c.one_hop = one_hop;
    }
    tell_cut_off(study, store, vary, metrics);
    if (a.picture) write_comparison(*a.picture, all.front(), store);
    print_comparisons(all, a.json ? ReportForm::json : a.csv ? ReportForm::csv : ReportForm::text);
    check_failures(a, store, result);
    check_precision(study, result);
}

}  // namespace rovernet::cli
