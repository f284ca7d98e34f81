// SPDX-License-Identifier: MIT
#include "study/advise/advise.hpp"

#include "cli/display/picture_output.hpp"
#include "cli/display/study_display.hpp"
#include "cli/runs/run_commands.hpp"
#include "cli/studies/advise_report.hpp"
#include "cli/studies/study_run.hpp"
#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/stop.hpp"
#include "cli/terminal/waiting.hpp"
#include "files/temporary_directory.hpp"
#include "scenario/document/quantity.hpp"
#include "scenario/scenario_file.hpp"
#include "study/advise/advise_chart.hpp"
#include "study/advise/advise_cost.hpp"
#include "study/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace rovernet::cli {
namespace {

constexpr double usual_tolerance = 0.02;  // of a share
constexpr std::uint64_t usual_most = 4000;

/// The rule that the options ask for.
/// @throws InputError for a tolerance that tells nothing, or none where one is needed
DecisionRule rule_for(const AdviseArguments& a, const StudyTable& study, std::size_t family) {
    DecisionRule rule{
        .criterion = a.criterion == "run" ? ErrorCriterion::run : ErrorCriterion::mean,
        .tolerance = a.tolerance.value_or(usual_tolerance),
        .bounds = bounds_of(a.metric),
        .alpha = 1 - study.confidence,
        .family = family,
        .most = a.max_replications.value_or(usual_most)};
    const Bounds range = difference_bounds(rule.bounds);
    if (!range.closed() && !a.tolerance) {
        throw InputError({"--metric " + a.metric, 0, 0, true},
                         fmt::format("{} has no upper bound, so there is no default tolerance; "
                                     "expected --tolerance in the unit of the metric, such as "
                                     "--tolerance 0.1",
                                     a.metric));
    }
    if (range.closed() && rule.tolerance >= *range.high) {
        throw InputError(
            {fmt::format("--tolerance {}", rule.tolerance), 0, 0, true},
            fmt::format("expected a value below {}, because the difference between two values of "
                        "{} is never larger",
                        *range.high, a.metric));
    }
    return rule;
}

/// Time that an advice may take, from its beginning.
class Budget {
  public:
    /// @throws InputError unless the text is a time above 0
    explicit Budget(const std::string& text) {
        Value value(text);
        value.where = {"--budget " + text, 0, 0, true};
        seconds_ = read_quantity(value, "budget", Dimension::time);
        if (!(seconds_ > 0)) throw InputError(value.where, "expected a time > 0");
    }
    double seconds() const { return seconds_; }
    bool is_spent() const {
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin_;
        return taken.count() >= seconds_;
    }

  private:
    double seconds_ = 0;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Makes the runs of a block; false if the user or the budget stopped it.
/// @throws CommandEnd if a run failed: the others could not be told apart then
bool make_block(const AdviseArguments& a, Study& study, Store& store, const Budget& budget,
                const std::vector<std::uint32_t>& replications) {
    StudyArguments arguments = a;
    arguments.fail_fast = true;
    SweepOptions options;
    options.replications = replications;
    options.stop = [&] {
        if (!budget.is_spent()) return Stop::no;
        return a.store ? Stop::when_idle : Stop::at_once;
    };
    const SweepResult result = run_study(arguments, study, store, std::move(options),
                                         a.store ? Finished::is_kept : Finished::is_lost);
    if (result.progress.failed > 0) {
        const StoredRun& run = *result.failure;
        throw CommandEnd(
            partly_failed,
            fmt::format("a run failed, so no advice is possible: {}\nto repeat this run:\n  {}",
                        run.error,
                        run_command(store, store.points().at(run.point), run.replication)));
    }
    return result.progress.left == 0;
}

/// Makes two runs of the reference, which are needed anyway, and prints an estimate of the total
/// time, from the CPU time of the second run: the first one also plans paths and reads maps.
void tell_time(const AdviseArguments& a, const AdviceCandidates& candidates, std::uint64_t most,
               const Budget& budget, Study& study, Store& store) {
    const std::size_t top = candidates.reference_path_loss();
    const std::uint32_t point = *candidates.points[top][candidates.reference_reception()];
    std::vector<std::uint32_t> two(candidates.family() + 1);
    two[point] = static_cast<std::uint32_t>(std::min<std::uint64_t>(2, most));
    if (!make_block(a, study, store, budget, two)) return;
    double run_s = 0;
    for (const StoredRun& run : store.runs()) {
        if (run.point == point && run.replication <= 1) run_s = run.measurement.cpu_s;
    }
    constexpr std::uint64_t least = 10;
    constexpr double long_time = 60;  // [s]
    const double all = run_s * static_cast<double>(most);
    if (all < long_time) return;
    notice(fmt::format(
        "one run with the reference, {}, takes about {:.2g} s of CPU time. The "
        "verdicts may need {} to {} such runs, which take {} to {} on one worker, and additional "
        "runs of the candidate models. --budget {} ends the command earlier, with a "
        "preliminary verdict. With a cheaper --reference, the command takes less time, too",
        candidates.path_losses[top].name, run_s, std::min(least, most), most,
        duration_text(run_s * static_cast<double>(std::min(least, most))), duration_text(all),
        a.budget));
}

/// End of a fit by the budget or the user.
struct FitEnded {};

/// Advice before anything was compared.
Advice advice_of_nothing(const AdviseArguments& a, const ScenarioOptions& options,
                         const Scenario& scenario, const Store& none) {
    CandidateQuestion question = a.question;
    question.as_given = true;
    const AdviceCandidates candidates = candidates_for(a.file, options, question);
    const DecisionRule rule = rule_for(a, scenario.study, candidates.family());
    return rovernet::advise(candidates, none, a.metric, rule, [](const auto&) { return false; });
}

/// Candidates, fitted unless they are wanted as given.
/// @throws FitEnded if the budget or the user ends it meanwhile
AdviceCandidates fitted_candidates(const AdviseArguments& a, const ScenarioOptions& options,
                                   const Budget& budget) {
    Waiting waiting("fitting models to the reference");
    return candidates_for(a.file, options, a.question, [&](double share) {
        if (stops_asked() > 0 || budget.is_spent()) throw FitEnded{};
        waiting.tell(share);
    });
}

/// Ends the command if the user ended it: what was known by then has been printed.
void check_not_stopped(const AdviseArguments& a) {
    if (stops_asked() == 0) return;
    throw CommandEnd(
        interrupted,
        a.store ? "interrupted; finished runs are kept; continue with\n  " + a.command
                : "interrupted; the runs are lost, because they were not kept by --store FILE");
}

/// Prints an advice, and how it ended if that was too early.
/// @throws CommandEnd if the user ended it
void tell_advice(const AdviseArguments& a, const Advice& advice) {
    print_advice(advice, a.json);
    if (advice.stopped && stops_asked() == 0) {
        notice(fmt::format("the time of --budget {} is used up; this verdict is preliminary",
                           a.budget));
    }
    check_not_stopped(a);
}

/// Judges the candidates, and prints the advice.
void judge(const AdviseArguments& a, const ScenarioOptions& options,
           const AdviceCandidates& candidates, const Budget& budget,
           const std::string& store_file) {
    Study study(a.file, options, candidates.vary(), candidates.exclude());
    for (const std::string& text : study.base().notices) notice(text);
    Store store = open_store(store_file, study);
    const DecisionRule rule = rule_for(a, study.table(), candidates.family());
    tell_time(a, candidates, rule.most, budget, study, store);
    Advice advice =
        rovernet::advise(candidates, store, a.metric, rule, [&](const auto& replications) {
            return make_block(a, study, store, budget, replications);
        });
    if (!a.no_cost && !advice.stopped) add_costs(advice, study, [] { return stops_asked() > 0; });
    if (a.picture && !advice.knows_nothing()) {
        write_picture(*a.picture, chart_svg(advice_charts(advice), {.width = 480}));
    }
    tell_advice(a, advice);
}

}  // namespace

void advise(const AdviseArguments& a) {
    const Budget budget(a.budget);
    if (a.picture) check_picture_name(*a.picture);
    ScenarioOptions options = options_of(a);
    if (a.metric == "reach") options.set.emplace_back("metrics.reach=true");
    const Scenario scenario = ScenarioFile(a.file, options).scenario();
    check_metric(a.metric, scenario, {"--metric " + a.metric, 0, 0, true});
    rule_for(a, scenario.study, 1);
    const HeldStop until_told;
    const TemporaryDirectory passing;
    try {
        const AdviceCandidates candidates = fitted_candidates(a, options, budget);
        judge(a, options, candidates, budget, a.store.value_or(passing.path() + "/study.db"));
    } catch (const FitEnded&) {
        const Store none = Store::open_to_write(passing.path() + "/study.db");
        tell_advice(a, advice_of_nothing(a, options, scenario, none));
    }
}

}  // namespace rovernet::cli
