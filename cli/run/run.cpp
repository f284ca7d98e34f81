// SPDX-License-Identifier: MIT
#include "cli/run/run.hpp"

#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/stop.hpp"
#include "cli/terminal/waiting.hpp"
#include "experiment/run_folder.hpp"
#include "experiment/summary.hpp"
#include "experiment/timeline.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario_file.hpp"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <unistd.h>

namespace rovernet::cli {

namespace {

constexpr std::size_t longest_timeline = 100;  // lines

std::string percent(const std::optional<double>& share) {
    return share ? fmt::format("{:.1f} %", 100 * *share) : "none";
}

void print_timeline(const Scenario& scenario, const RunResult& result) {
    std::size_t width = 1;
    for (const auto& robot : scenario.robots) width = std::max(width, robot.name.size() + 1);
    const Timeline& timeline = *result.timeline;
    const std::size_t shown = std::min(timeline.size(), longest_timeline);
    for (std::size_t i = 0; i < shown; ++i) {
        const auto [time, robot, text] = timeline[i];
        fmt::print("{:>11.6f} s  {:<{}} {}\n", seconds(time), robot, width, text);
    }
    if (shown < timeline.size()) {
        const std::uint64_t left_out = timeline.left_out();
        fmt::print("... and {} more events; {} in {}/summary.json\n",
                   timeline.size() - shown + left_out,
                   left_out > 0 ? fmt::format("the first {} are", timeline.size()) : "all are",
                   result.folder);
    }
    if (shown > 0) fmt::print("\n");
}

void print_result(const Scenario& scenario, const RunResult& result) {
    print_timeline(scenario, result);
    const MetricValues& m = result.metrics;
    fmt::print("messages {}, transmissions {}, receptions {}\n", m.messages, m.transmissions,
               m.receptions);
    fmt::print("delivery ratio     {}\n", percent(m.delivery_ratio));
    if (m.cut_off > 0) {
        fmt::print(
            "not counted        {} (messages that were still at their senders when the run "
            "ended)\n",
            m.cut_off);
    }
    if (m.reach_known && !m.reach) {
        if (m.messages > 0)
            fmt::print("reach              undefined, because no robot was linked to a sender\n");
    } else if (m.reach_known) {
        fmt::print(
            "reach              {} of the robots that were linked to the sender, directly or over "
            "other robots\n",
            percent(m.reach));
    } else if (!scenario.metrics.reach) {
        fmt::print(
            "reach              not measured, because measuring the reach takes longer than the "
            "rest of the run; [metrics] reach = true measures it\n");
    }
    if (m.latency) {
        fmt::print("latency            {:.3f} ms mean, {:.3f} ms at most\n", 1e3 * m.latency->mean,
                   1e3 * m.latency->max);
        fmt::print("hops               {:.2f} mean, {} at most\n", m.mean_hops.value_or(0),
                   m.max_hops);
    }
    for (const auto& drop : m.drops) {
        if (drop.count > 0) fmt::print("dropped {:<10} {}\n", drop.reason, drop.count);
    }
    fmt::print("fingerprint        {}\n", result.fingerprint);
    if (const auto db = result.interference_left_out) {
        notice(
            fmt::format("the reception model sinr ignores frames far below the sensitivity; with "
                        "these frames, the SINR would be at most {:.2f} dB lower",
                        db->value));
    }
    if (const std::string text = result.network->routing_notice(); !text.empty()) notice(text);
    notice(fmt::format("{} events, {:.2f} s; {}{}", result.events, result.wall_s,
                       result.folder.empty() ? "no results were written" : "results in ",
                       result.folder));
}

}  // namespace

std::optional<Scenario> scenario_to_run(const RunArguments& a) {
    FileArguments given = a;
    if (a.record) given.options.set.push_back("trace.record=true");
    Scenario scenario = scenario_of(given);
    if (!a.print_scenario) return scenario;
    fmt::print("{}", to_toml(to_document(scenario)));
    return std::nullopt;
}

void run(const RunArguments& a) {
    const std::optional<Scenario> read = scenario_to_run(a);
    if (!read) return;
    const Scenario& scenario = *read;
    std::optional<Waiting> waiting("setting up the network of " + a.file);
    std::optional<HeldStop> writing;  // not while the network is set up
    const auto tell = [&](double share) {
        if (!writing) {
            waiting.reset();
            waiting.emplace("running " + a.file);
            writing.emplace();
        }
        waiting->tell(share);
        return stops_asked() == 0;
    };
    const auto end = [&](const RunResult& result) {
        waiting.reset();
        writing.reset();
        print_run(scenario, result, a.json);
    };
    try {
        end(run_scenario(scenario, {.folder = a.out ? *a.out : run_folder(scenario, a.options.set),
                                    .speed = a.speed,
                                    .progress = tell}));
    } catch (const UnwrittenResults& unwritten) {
        end(unwritten.result);
        throw;
    }
}

void print_run(const Scenario& scenario, const RunResult& result, bool json) {
    if (json) {
        write_summary(scenario, result, [](std::string_view text) { fmt::print("{}", text); });
    } else {
        print_result(scenario, result);
    }
}

}  // namespace rovernet::cli
