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

/// Compares the records of a run with those of a trace, until they differ. The trace may have the
/// receptions of a frame in fewer or more records than the run, since a live run may stop between
/// them. So records that are not equal are compared as lines: each reception has its own line.
class Comparison {
  public:
    Comparison(RecordedReader& trace, bool links, Verification& result)
        : trace_(trace), links_(links), result_(result) {}

    KindMask kinds() const { return links_ ? kind_all : kind_all & ~kind_links; }
    void on(const Record& record, const RecordContext& context) {
        if (is_over()) return;
        if (recorded_.empty()) {
            const Record* recorded = next();
            if (recorded &&
                are_same(*recorded, trace_.context(), record, context, trace_.format())) {
                ++result_.same;
                return;
            }
            if (recorded) take(*recorded);
        }
        std::string now;
        append_text(record, context, now);
        compare(now);
    }
    void finish() {
        if (!is_over()) read_on();
        if (is_over() || recorded_.empty()) return;
        result_.difference = {std::string(first_line(recorded_)), ""};
    }

  private:
    /// Whether nothing more is compared; an incomplete trace is compared up to its end.
    bool is_over() const { return result_.difference || has_ended_; }

    const Record* next() {
        const Record* recorded = trace_.next();
        has_ended_ = !recorded && !trace_.damage().empty();
        return recorded;
    }

    void take(const Record& recorded) {
        text_.clear();
        append_text(recorded, trace_.context(), text_);
        recorded_ = text_;
        if (recorded_.empty()) ++result_.same;
    }

    /// Takes records of the trace until there is a line that is not compared yet.
    void read_on() {
        while (recorded_.empty()) {
            const Record* recorded = next();
            if (!recorded) return;
            take(*recorded);
        }
    }

    /// Compares lines of the run with the next lines of the trace.
    void compare(std::string_view now) {
        while (!now.empty()) {
            read_on();
            if (is_over()) return;
            const std::string_view found = first_line(now), told = first_line(recorded_);
            if (told != found) {
                result_.difference = {std::string(told), std::string(found)};
                return;
            }
            if (recorded_.empty()) ++result_.same;
        }
    }

    RecordedReader& trace_;
    bool links_;
    Verification& result_;
    bool has_ended_ = false;
    std::string text_;           // lines of the last record of the trace that was taken
    std::string_view recorded_;  // rest of these lines, not compared yet
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
                         fmt::format("there is no {}; expected an ns-2 trace in the folder "
                                     "to which rovernet wrote this trace",
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
