// SPDX-License-Identifier: MIT
#include "study/advise.hpp"

#include "cli/advise_report.hpp"
#include "cli/diagnostics.hpp"
#include "cli/passing_store.hpp"
#include "cli/picture_output.hpp"
#include "cli/run_commands.hpp"
#include "cli/stop.hpp"
#include "cli/study_display.hpp"
#include "cli/study_run.hpp"
#include "cli/waiting.hpp"
#include "study/advise_chart.hpp"
#include "study/advise_cost.hpp"
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
                         fmt::format("{} has no upper bound; expected a --tolerance in its unit, "
                                     "too, such as --tolerance 0.1",
                                     a.metric));
    }
    if (range.closed() && rule.tolerance >= *range.high) {
        throw InputError({fmt::format("--tolerance {}", rule.tolerance), 0, 0, true},
                         fmt::format("expected a value below {}, as no two values of {} differ by "
                                     "more",
                                     *range.high, a.metric));
    }
    return rule;
}

/// @throws CommandEnd if the user has ended it before it was done: a part of an advice is none
void check_not_stopped(const AdviseArguments& a) {
    if (stops_asked() == 0) return;
    throw CommandEnd(interrupted,
                     a.store ? "interrupted; what was finished is kept: go on with\n  " + a.command
                             : "interrupted; --store FILE would have kept the runs");
}

/// Makes the runs of a block.
/// @throws CommandEnd if it was stopped, or a run failed: the others could not be told apart then
void make_block(const AdviseArguments& a, Study& study, Store& store,
                const std::vector<std::uint32_t>& replications) {
    StudyArguments arguments = a;
    arguments.fail_fast = true;
    SweepOptions options;
    options.replications = replications;
    const SweepResult result = run_study(arguments, study, store, std::move(options),
                                         a.store ? Finished::is_kept : Finished::is_lost);
    if (result.progress.left > 0) check_not_stopped(a);
    if (result.progress.failed == 0) return;
    const StoredRun& run = *result.failure;
    throw CommandEnd(
        partly_failed,
        fmt::format("a run failed, and without it there is no advice: {}\n  {}", run.error,
                    run_command(store, store.points().at(run.point), run.replication)));
}

/// Makes the first run of the reference, which is needed anyway, and says what all may take.
void tell_time(const AdviseArguments& a, const AdviceCandidates& candidates, std::uint64_t most,
               Study& study, Store& store) {
    const std::size_t top = candidates.reference_path_loss();
    const auto& with_it = candidates.points[top];
    std::vector<std::uint32_t> one(candidates.family() + 1);
    one[*with_it[candidates.reference_reception()]] = 1;
    const auto begin = std::chrono::steady_clock::now();
    make_block(a, study, store, one);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    const auto receptions = std::count_if(with_it.begin(), with_it.end(),
                                          [](const auto& point) { return point.has_value(); });
    const double all = taken.count() * static_cast<double>(most) * static_cast<double>(receptions);
    constexpr double long_time = 60;  // [s]
    if (all < long_time) return;
    notice(fmt::format(
        "a run with the reference, {}, takes about {:.2g} s; up to {} runs with each of {} "
        "receptions may take {} on one worker. --max-replications, a larger --tolerance or a "
        "cheaper --reference take less",
        candidates.path_losses[top].name, taken.count(), most, receptions, duration_text(all)));
}

}  // namespace

void advise(const AdviseArguments& a) {
    if (a.picture) check_picture_name(*a.picture);
    ScenarioOptions options = options_of(a);
    if (a.metric == "reach") options.set.emplace_back("metrics.reach=true");
    const Scenario scenario = ScenarioFile(a.file, options).scenario();
    check_metric(a.metric, scenario, {"--metric " + a.metric, 0, 0, true});
    rule_for(a, scenario.study, 1);
    const AdviceCandidates candidates = [&] {
        Waiting waiting("fitting models to the reference");
        return candidates_for(a.file, options, a.question,
                              [&](double share) { waiting.tell(share); });
    }();
    Study study(a.file, options, candidates.vary(), candidates.exclude());
    for (const std::string& text : study.base().notices) notice(text);
    const HeldStop until_gone;
    const PassingStore passing;
    Store store = open_store(a.store.value_or(passing.file()), study);
    const DecisionRule rule = rule_for(a, scenario.study, candidates.family());
    tell_time(a, candidates, rule.most, study, store);
    Advice advice = rovernet::advise(
        candidates, store, a.metric, rule,
        [&](const auto& replications) { make_block(a, study, store, replications); });
    if (!a.no_cost) {
        add_costs(advice, study, [] { return stops_asked() > 0; });
        check_not_stopped(a);
    }
    if (a.picture) {
        write_picture(*a.picture, chart_svg(advice_charts(advice), {.width = 480}));
    }
    print_advice(advice, a.json);
}

}  // namespace rovernet::cli
