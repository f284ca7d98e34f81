// SPDX-License-Identifier: MIT
#include "study/measurement.hpp"

#include "experiment/run.hpp"
#include "experiment/session.hpp"
#include "experiment/summary.hpp"
#include "experiment/version.hpp"
#include "mobility/kept_planners.hpp"
#include "scenario/scenario.hpp"
#include "study/quotient.hpp"
#include "traces/metric_fold.hpp"
#include "traces/topology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <ctime>
#include <iterator>
#include <type_traits>

namespace rovernet {
namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Appends the metrics of a described struct, with `behind` at the end of each name.
template <Described T>
void append(std::vector<MetricValue>& list, const T& values, std::string_view behind = "") {
    for_each_metric(values, [&]<class V>(std::string_view name, const V& value) {
        if constexpr (std::is_same_v<V, DropCounts>) {
            for (const DropCount& drop : value)
                list.push_back(
                    {fmt::format("{}.{}", name, drop.reason), static_cast<double>(drop.count)});
        } else {
            list.push_back({fmt::format("{}{}", name, behind), number_in(value)});
        }
    });
}

/// Numbers of a run that are measured with its metrics.
struct RunNumbers {
    std::uint64_t events = 0;
    double warmup_s = 0;

    static constexpr auto fields() {
        return describe(field("events", &RunNumbers::events, "events of the run"),
                        field("warmup_s", &RunNumbers::warmup_s, "end of the warm-up"));
    }
};

/// Metrics of a run by their names; of a result without values: the names.
std::vector<MetricValue> list_of(const RunResult& result, const Scenario* scenario) {
    std::vector<MetricValue> list = metric_list(result.metrics);
    append(list, result.airtime);
    append(list, RunNumbers{result.events, seconds(result.warmup)});
    if (!scenario) return list;
    for_each_part(*scenario, result.metrics, result.measured(),
                  [&](std::string_view kind, const std::string& name, const PartMetrics& metrics,
                      const PartValues* routed) {
                      const auto behind = fmt::format(".{}{}", kind == "robots" ? "at." : "", name);
                      append(list, metrics, behind);
                      if (!routed) return;
                      append(list, metrics_of(routed->routed), behind);
                      for (std::size_t i = 0; i < routed->drops.size(); ++i)
                          list.push_back({fmt::format("drops.{}{}", loss_codes.of[i], behind),
                                          static_cast<double>(routed->drops[i])});
                  });
    if (scenario->metrics.topology)
        append(list, result.topology ? *result.topology : TopologyValues{});
    return list;
}

std::vector<std::string> names_of(const std::vector<MetricValue>& list) {
    std::vector<std::string> names;
    for (const MetricValue& metric : list) names.push_back(metric.name);
    return names;
}

bool has(const std::vector<std::string>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Key of [metrics] that the scenario lacks for a metric; none if it lacks no key.
std::optional<std::string_view> key_for(const std::string& name, const Scenario& scenario) {
    const bool is_stretch = name == "path_stretch" || name.starts_with("path_stretch.");
    if (is_stretch && !scenario.metrics.path_stretch) return "path_stretch";
    if (name == "reach" && scenario.metrics.reach == false) return "reach";
    if (has(names_of(list_of({}, &scenario)), name)) return std::nullopt;
    std::optional<std::string_view> needed;
    for_each_field<MetricsTable>([&](const auto& f) {
        Scenario asked = scenario;
        asked.metrics.*f.member = true;
        if (has(names_of(list_of({}, &asked)), name)) needed = f.name;
    });
    return needed;
}

/// Names that begin like a word, with the longest equal begin first.
std::vector<std::string> of_equal_begin(std::string_view word, std::vector<std::string> names,
                                        std::size_t most) {
    constexpr std::size_t least = 3;  // letters
    const auto equal = [&](const std::string& name) {
        const auto [end, other] = std::mismatch(word.begin(), word.end(), name.begin(), name.end());
        return static_cast<std::size_t>(end - word.begin());
    };
    std::erase_if(names, [&](const std::string& name) { return equal(name) < least; });
    std::stable_sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
        return equal(a) > equal(b);
    });
    names.resize(std::min(names.size(), most));
    return names;
}

/// Cuts the text before the next `end` off the front; all of it if there is none.
std::string_view cut(std::string_view& text, char end) {
    const std::string_view piece = text.substr(0, text.find(end));
    text.remove_prefix(std::min(piece.size() + 1, text.size()));
    return piece;
}

std::optional<double> parsed(std::string_view text) {
    double v = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
    return error == std::errc{} ? std::optional(v) : std::nullopt;
}

}  // namespace

std::vector<MetricValue> metric_list(const MetricValues& values) {
    std::vector<MetricValue> list;
    append(list, values);
    return list;
}

const std::vector<std::string>& metric_names() {
    static const std::vector<std::string> names = names_of(list_of({}, nullptr));
    return names;
}

std::vector<std::string> metric_names(const Scenario& scenario) {
    return names_of(list_of({}, &scenario));
}

void check_metric(const std::string& name, const Scenario& scenario, const Location& where) {
    if (const auto key = key_for(name, scenario)) {
        throw InputError(where,
                         fmt::format("the metric \"{}\" needs [metrics] {} = true", name, *key));
    }
    if (has(metric_names(), name)) return;
    const std::vector<std::string> names = metric_names(scenario);
    if (has(names, name)) return;
    const auto quotient = quotient_of(name);
    if (quotient && has(names, quotient->over) && has(names, quotient->under)) {
        throw InputError(
            where, fmt::format(
                       "\"{}\" is a quotient of two metrics; only `rovernet results` and `rovernet "
                       "plot` compute quotients; expected the two metrics {} and {} instead",
                       name, quotient->over, quotient->under));
    }
    throw InputError(
        where,
        fmt::format(
            "there is no metric \"{}\"{}; rovernet help output explains the metrics (a metric of "
            "one flow is named METRIC.FLOW; a metric of one robot is named METRIC.at.ROBOT)",
            name, near_metrics(name, names)));
}

std::string near_metrics(const std::string& name, std::vector<std::string> known) {
    constexpr std::size_t most = 4;
    std::vector<std::string> near;
    while (near.size() < most) {
        const std::string text = did_you_mean(name, known);
        const std::size_t begin = text.find('"') + 1;
        if (text.empty()) break;
        near.push_back(text.substr(begin, text.rfind('"') - begin));
        std::erase(known, near.back());
    }
    if (near.empty()) near = of_equal_begin(name, std::move(known), most);
    if (near.empty()) return "";
    const std::string last = near.back();
    near.pop_back();
    const char* const between = near.empty() ? "" : "\" or \"";
    return fmt::format("; did you mean \"{}{}{}\"?", fmt::join(near, "\", \""), between, last);
}

Measurement measure(const Scenario& scenario, KeptPlanners& kept) {
    const double cpu = cpu_seconds();
    ScenarioRun run(scenario, &kept, Observed::measurements);
    run.session().step(run.session().end());
    const RunResult result = run.finish();
    return {.metrics = list_of(result, &scenario),
            .fingerprint = result.fingerprint,
            .cpu_s = cpu_seconds() - cpu,
            .wall_s = result.wall_s,
            .started = result.started,
            .host = host_name(),
            .searches = result.searches};
}

std::string to_text(const Measurement& m) {
    std::string text;
    for_each_field<Measurement>(
        [&](const auto& f) { fmt::format_to(std::back_inserter(text), "{}\n", m.*f.member); });
    for (const MetricValue& metric : m.metrics) {
        text += metric.name + ' ';
        if (metric.value) fmt::format_to(std::back_inserter(text), "{}", *metric.value);
        text += '\n';
    }
    return text;
}

Measurement measurement_of(std::string_view text) {
    Measurement m;
    for_each_field<Measurement>([&](const auto& f) {
        const std::string_view line = cut(text, '\n');
        auto& member = m.*f.member;
        if constexpr (requires { member = line; }) {
            member = line;
        } else {
            set_number(member, parsed(line).value_or(0));
        }
    });
    while (!text.empty()) {
        std::string_view line = cut(text, '\n');
        const std::size_t end = std::min(line.rfind(' '), line.size());  // names may have blanks
        m.metrics.push_back({std::string(line.substr(0, end)), parsed(line.substr(end + 1))});
    }
    return m;
}

}  // namespace rovernet
