// SPDX-License-Identifier: MIT
#include "cli/studies/study_run.hpp"

#include "cli/display/study_display.hpp"
#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/stop.hpp"
#include "scenario/document/quantity.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario_file.hpp"
#include "study/explain.hpp"
#include "study/inventory.hpp"
#include "study/precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <thread>
#include <unistd.h>

namespace rovernet::cli {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool limits_memory = false;  // the sanitizer takes more addresses than any machine has
#else
constexpr bool limits_memory = true;
#endif

/// Share of the machine's memory for each worker [bytes]; nothing if that cannot be known.
std::optional<std::uint64_t> share_of_memory(std::size_t workers) {
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGE_SIZE);
    if (!limits_memory || pages <= 0 || page <= 0) return std::nullopt;
    return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page) / workers;
}

WorkerLimits limits_of(const StudyArguments& a, std::size_t workers) {
    const auto amount = [](const char* option, const std::string& text, Dimension dimension) {
        Value value(text);
        value.where = {fmt::format("--{} {}", option, text), 0, 0, true};
        const double v = read_quantity(value, option, dimension);
        if (v > 0) return v;
        throw InputError(value.where, "expected a value > 0");
    };
    WorkerLimits limits{.timeout_s = {}, .memory = share_of_memory(workers)};
    if (a.timeout) limits.timeout_s = amount("timeout", *a.timeout, Dimension::time);
    if (a.memory) {
        limits.memory = static_cast<std::uint64_t>(amount("memory", *a.memory, Dimension::size));
    }
    return limits;
}

/// "+- 0.034 from 100 values"
std::string reached_text(const ImprecisePoint& point) {
    if (point.half_width)
        return fmt::format("+- {:.2g} from {} values", *point.half_width, point.values);
    if (point.values < 2)
        return fmt::format("no confidence interval, because the number of values is {}",
                           point.values);
    return fmt::format("no confidence interval, because all {} values are equal", point.values);
}

}  // namespace

ScenarioOptions study_options(const StudyArguments& a) {
    ScenarioOptions options = options_of(a);
    const auto set = [&](const char* key, const auto& value) {
        if (value) options.set.push_back(fmt::format("study.{}={}", key, *value));
    };
    set("replications", a.replications);
    set("max_replications", a.max_replications);
    set("precision", a.precision);
    set("confidence", a.confidence);
    set("interval", a.interval);
    return options;
}

void tell_ignored(const Study& study, IgnoredBy by) {
    for (const std::string& assignment : study.options().set) {
        const std::size_t equals = find_equals(assignment);
        const std::string key = assignment.substr(0, equals);
        const auto& all = study.table().vary;
        const auto vary = std::ranges::find_if(all, [&](const Vary& each) {
            return each.path == key || key.starts_with(each.path + ".");
        });
        if (vary == all.end() || equals == assignment.npos) continue;
        if (by == IgnoredBy::command) {
            notice(fmt::format("--set {} has no effect, because the command varies {}", assignment,
                               vary->path));
            continue;
        }
        Value typed{Table{}};
        set_option(typed, "value=" + assignment.substr(equals + 1), assignment);
        const std::string hint = vary->path == key
                                     ? fmt::format(
                                           "; to run this value alone, give --set "
                                           "'study.vary.{}=[{}]'",
                                           key, to_toml(*typed.table()->find("value")))
                                     : "";
        notice(fmt::format("--set {} has no effect, because [study] varies {}{}", assignment,
                           vary->path, hint));
    }
}

SweepResult run_study(const StudyArguments& a, Study& study, Store& store, SweepOptions options,
                      Finished finished) {
    options.workers = a.workers > 0 ? a.workers : std::max(1U, std::thread::hardware_concurrency());
    options.limits = limits_of(a, options.workers);
    options.fail_fast = a.fail_fast;
    SweepDisplay display;
    options.progress = [&](const SweepProgress& progress) { display.show(progress); };
    options.stop = [finished, given = options.stop] {
        if (stops_asked() == 0) return given ? given() : Stop::no;
        const bool is_for_nothing = finished == Finished::is_lost || stops_asked() > 1;
        return is_for_nothing ? Stop::at_once : Stop::when_idle;
    };
    const HeldStop until_kept;
    SweepResult result = rovernet::sweep(study, store, options);
    detail(
        fmt::format("the runs made {} searches for paths around walls", result.progress.searches));
    return result;
}

void check_end(const StudyArguments& a, const Store& store, const SweepResult& result) {
    if (stops_asked() > 0 && result.progress.left > 0) {
        throw CommandEnd(
            interrupted,
            fmt::format("interrupted; finished runs are kept; continue with\n  {}", a.command));
    }
    if (result.progress.failed == 0) return;
    const StoredRun& run = *result.failure;
    const auto points = store.points();
    throw CommandEnd(
        partly_failed,
        fmt::format(
            "{} failed; the error of the first: {}\nto repeat this run:\n  {}\nrovernet results {} "
            "--failures lists all failed runs; the same sweep command repeats them",
            runs_text(result.progress.failed), run.error,
            run_command(store, points.at(run.point), run.replication), store.path()));
}

void check_precision(const Study& study, const SweepResult& result) {
    if (result.imprecise.empty()) return;
    constexpr std::size_t most = 20;
    const auto& list = result.imprecise;
    std::string text =
        fmt::format("{} of {} points did not reach the precision {} for {} within {} replications:",
                    list.size(), study.points().size(), *study.table().precision,
                    first_metric(study.table()), study.table().max_replications);
    for (const ImprecisePoint& point : std::span(list).first(std::min(list.size(), most))) {
        text += fmt::format("\n  {}: {}", settings_text(study.points()[point.point].settings),
                            reached_text(point));
    }
    if (list.size() > most) text += fmt::format("\n  and {} more", list.size() - most);
    throw CommandEnd(partly_failed, text +
                                        "\nexpected a larger --max-replications, or a larger "
                                        "--precision (half-width of the confidence intervals)");
}

}  // namespace rovernet::cli
