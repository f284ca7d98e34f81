// SPDX-License-Identifier: MIT
#include "experiment/replay/replay.hpp"

#include "experiment/build.hpp"
#include "experiment/recorded_scenario.hpp"
#include "experiment/run.hpp"
#include "experiment/session.hpp"
#include "experiment/version.hpp"
#include "experiment/warmup.hpp"
#include "files/input_file.hpp"
#include "files/text_source.hpp"
#include "scenario/scenario_file.hpp"
#include "sim/error.hpp"
#include "traces/ns2/ns2_trace.hpp"
#include "traces/recorded/record_match.hpp"
#include "traces/recorded/record_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

namespace rovernet {
namespace {

std::string_view first_line(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
}

/// The first lines in which two texts that differ do.
Verification::Difference difference_of(std::string_view recorded, std::string_view now) {
    for (;;) {
        const std::string_view a = first_line(recorded), b = first_line(now);
        if (a != b || (recorded.empty() && now.empty())) return {std::string(a), std::string(b)};
    }
}

/// Compares the records of a run with those of a trace, until they differ.
class Comparison {
  public:
    Comparison(RecordedReader& trace, bool links, Verification& result)
        : trace_(trace), links_(links), result_(result) {}

    KindMask kinds() const { return links_ ? kind_all : kind_all & ~kind_links; }
    void on(const Record& record, const RecordContext& context) {
        if (result_.difference || has_ended_) return;
        compare(trace_.next(), &record, &context);
    }
    void finish() {
        if (result_.difference || has_ended_) return;
        if (const Record* more = trace_.next()) compare(more, nullptr, nullptr);
    }

  private:
    /// Compares a record of the trace with one of the run; null: there is no more.
    void compare(const Record* recorded, const Record* now, const RecordContext* context) {
        // An incomplete trace is compared up to its end.
        has_ended_ = !recorded && !trace_.damage().empty();
        if (has_ended_) return;
        if (recorded && now &&
            are_same(*recorded, trace_.context(), *now, *context, trace_.format())) {
            ++result_.same;
            return;
        }
        std::string told, found;
        if (recorded) append_text(*recorded, trace_.context(), told);
        if (now) append_text(*now, *context, found);
        if (recorded && told == found) {
            ++result_.same;
        } else {
            result_.difference = difference_of(told, found);
        }
    }

    RecordedReader& trace_;
    bool links_;
    Verification& result_;
    bool has_ended_ = false;
};

/// Compares the ns-2 text of a run with that of a trace, until they differ.
class TextComparison {
  public:
    TextComparison(const std::string& path, Verification& result)
        : trace_(TextSource(path, TextSource::Reads::once)), result_(result) {}

    void take(std::string_view text) {
        while (!text.empty() && !result_.difference) {
            const std::string_view now = first_line(text);
            const auto recorded = trace_.next();
            if (recorded == now) {
                ++result_.same;
            } else {
                result_.difference = {std::string(recorded.value_or("")), std::string(now)};
            }
        }
    }
    void finish() {
        if (result_.difference) return;
        if (const auto more = trace_.next()) result_.difference = {std::string(*more), ""};
    }

  private:
    TextLines trace_;
    Verification& result_;
};

/// Runs on while nothing differs. @throws Interrupted
void run_until_difference(ScenarioRun& run, const Verification& result,
                          const std::function<bool(double)>& progress) {
    const bool is_done = run.session().run(
        {}, [&](double share) { return !result.difference && (!progress || progress(share)); });
    if (!is_done && !result.difference) throw Interrupted();
    if (is_done) run.finish();
}

Scenario scenario_beside(const std::string& trace) {
    const auto path = std::filesystem::path(trace).parent_path() / "scenario.toml";
    const InputKind kind = input_kind(trace);
    if (kind != InputKind::stream) need_file(trace);
    if (input_kind(path.string()) != InputKind::file) {
        throw InputError({trace},
                         fmt::format("there is no {}; expected an ns-2 trace that rovernet "
                                     "wrote, in the folder of its run",
                                     path.string()));
    }
    Scenario scenario = load_scenario(path.string(), {});
    if (scenario.trace.ns2 != Ns2Choice::none) return scenario;
    throw InputError(
        {path.string()},
        "the scenario of this run writes no ns-2 trace; expected [trace] ns2 = \"old\" or \"new\"");
}

Verification verify_ns2(const std::string& path, const std::function<bool(double)>& progress) {
    const Scenario scenario = scenario_beside(path);
    Verification result;
    result.unit = "lines";
    result.version = code_version();
    TextComparison comparison(path, result);
    ScenarioRun run(scenario, nullptr, Observed::metrics);
    run.session().network().add_sink(std::make_shared<Ns2Trace>(
        [&](std::string_view text) { comparison.take(text); },
        scenario.trace.ns2 == Ns2Choice::old_format ? Ns2Format::old_format : Ns2Format::new_format,
        scenario.trace.mac ? MacTrace::on : MacTrace::off));
    run_until_difference(run, result, progress);
    comparison.finish();
    return result;
}

}  // namespace

Verification verify_replay(const std::string& path, const std::function<bool(double)>& progress) {
    if (!is_recorded_trace(path)) return verify_ns2(path, progress);
    RecordedReader trace(path);
    const ReplayedScenario replayed(trace.run(), path);
    const Scenario scenario = replayed.with({});
    check_robots(trace.run(), scenario, path);
    Verification result;
    result.recorded_by = trace.run().version;
    result.version = code_version();
    ScenarioRun run(scenario, nullptr, Observed::metrics);
    const auto comparison = std::make_shared<Comparison>(trace, scenario.trace.links, result);
    run.session().network().add_sink(comparison);
    run_until_difference(run, result, progress);
    result.damage = trace.damage();
    return result;
}

Metrics metrics_of(const RecordedRun& run, const std::string& path) {
    if (run.scenario.empty()) return Metrics();
    const ReplayedScenario replayed(run, path);
    const Scenario scenario = replayed.with({});
    check_robots(run, scenario, path);
    const NetworkSettings settings = network_settings(scenario);
    return Metrics(start_of_run + warmup_of(scenario, settings), settings.metric_parts);
}

MetricValues recorded_metrics(const std::string& path, std::vector<std::string>& damage) {
    RecordedReader trace(path);
    const auto metrics = std::make_shared<Metrics>(metrics_of(trace.run(), path));
    trace.read(Sink(metrics));
    damage = trace.damage();
    return metrics->values();
}

}  // namespace rovernet
