// SPDX-License-Identifier: MIT
#include "study/measurement.hpp"

#include "experiment/build.hpp"
#include "experiment/run.hpp"
#include "experiment/summary.hpp"
#include "experiment/version.hpp"
#include "experiment/warmup.hpp"
#include "mobility/kept_planners.hpp"
#include "scenario/scenario.hpp"
#include "traces/fingerprint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <ctime>

namespace rovernet {
namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::optional<double> number_of(const Value& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value.data)) {
        return static_cast<double>(*whole);
    }
    if (const auto* number = std::get_if<double>(&value.data)) return *number;
    return std::nullopt;
}

std::vector<MetricValue> flat(const MetricValues& values, std::uint64_t events, Duration warmup) {
    std::vector<MetricValue> list = metric_list(values);
    list.push_back({"events", static_cast<double>(events)});
    list.push_back({"warmup_s", seconds(warmup)});
    return list;
}

/// "delivery_ratio.FLOW" of the table of that flow, and so on.
void append_flat(std::vector<MetricValue>& list, const Table& parts) {
    for (const Entry& kind : parts.entries) {
        const std::string_view at = kind.key == "robots" ? "at." : "";
        for (const Entry& part : kind.value.table()->entries) {
            const Table* values = part.value.table();
            if (!values) {
                list.push_back({part.key, number_of(part.value)});
                continue;
            }
            for (const Entry& each : values->entries) {
                list.push_back(
                    {fmt::format("{}.{}{}", each.key, at, part.key), number_of(each.value)});
            }
        }
    }
}

/// Cuts the text before the next `end` off the front; all of it if there is none.
std::string_view cut(std::string_view& text, char end) {
    const std::string_view piece = text.substr(0, text.find(end));
    text.remove_prefix(std::min(piece.size() + 1, text.size()));
    return piece;
}

std::optional<double> number_in(std::string_view text) {
    double v = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
    return error == std::errc{} ? std::optional(v) : std::nullopt;
}

}  // namespace

std::vector<MetricValue> metric_list(const MetricValues& values) {
    Table table;
    append_metrics(table, values);
    std::vector<MetricValue> list;
    for (const Entry& entry : table.entries) {
        if (!entry.value.table()) list.push_back({entry.key, number_of(entry.value)});
    }
    for (const DropCount& drop : values.drops) {
        list.push_back({fmt::format("drops.{}", drop.reason), static_cast<double>(drop.count)});
    }
    return list;
}

const std::vector<std::string>& metric_names() {
    static const auto names = [] {
        std::vector<std::string> list;
        for (auto& metric : flat({}, 0, {})) list.push_back(std::move(metric.name));
        return list;
    }();
    return names;
}

std::vector<std::string> metric_names(const Scenario& scenario) {
    Network network(network_settings(scenario));
    populate(network, scenario);
    Table parts;
    append_parts(parts, scenario, network, {}, scenario.scenario.duration, nullptr);
    std::vector<MetricValue> list;
    append_flat(list, parts);
    std::vector<std::string> names = metric_names();
    for (MetricValue& metric : list) names.push_back(std::move(metric.name));
    return names;
}

void check_metric(const std::string& name, const Scenario& scenario, const Location& where) {
    const std::vector<std::string>& usual = metric_names();
    if (std::find(usual.begin(), usual.end(), name) != usual.end()) return;
    const std::vector<std::string> names = metric_names(scenario);
    if (std::find(names.begin(), names.end(), name) != names.end()) return;
    const std::string near = did_you_mean(name, names);
    throw InputError(where, fmt::format("there is no metric \"{}\"; expected one of {}{}{}", name,
                                        fmt::join(names, ", "), near.empty() ? "" : "; ", near));
}

Measurement measure(const Scenario& scenario, KeptPlanners& kept) {
    Measurement result;
    result.started = utc_now();
    result.host = host_name();
    const auto started = std::chrono::steady_clock::now();
    const double cpu = cpu_seconds();
    NetworkSettings settings = network_settings(scenario);
    settings.planners = kept.of(settings.scene);
    const std::uint64_t searched = settings.planners ? settings.planners->searches() : 0;
    settings.warmup = warmup_of(scenario, settings);
    Network network(settings);
    populate(network, scenario);
    const auto fingerprint = std::make_shared<Fingerprint>();
    network.add_sink(fingerprint);
    const auto topology = add_topology(network, scenario, settings.warmup);
    network.run_for(scenario.scenario.duration);
    result.fingerprint = fingerprint->text();
    network.finish();
    const MetricValues values = network.metrics();
    result.metrics = flat(values, network.events(), settings.warmup);
    Table parts;
    append_parts(parts, scenario, network, values, scenario.scenario.duration - settings.warmup,
                 topology.get());
    append_flat(result.metrics, parts);
    if (settings.planners) result.searches = settings.planners->searches() - searched;
    result.cpu_s = cpu_seconds() - cpu;
    result.wall_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    return result;
}

std::string to_text(const Measurement& m) {
    std::string text = fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n", m.fingerprint, m.cpu_s, m.wall_s,
                                   m.started, m.host, m.searches);
    for (const MetricValue& metric : m.metrics) {
        text += metric.name + ' ';
        if (metric.value) fmt::format_to(std::back_inserter(text), "{}", *metric.value);
        text += '\n';
    }
    return text;
}

Measurement measurement_of(std::string_view text) {
    Measurement m;
    m.fingerprint = cut(text, '\n');
    m.cpu_s = number_in(cut(text, '\n')).value_or(0);
    m.wall_s = number_in(cut(text, '\n')).value_or(0);
    m.started = cut(text, '\n');
    m.host = cut(text, '\n');
    m.searches = static_cast<std::uint64_t>(number_in(cut(text, '\n')).value_or(0));
    while (!text.empty()) {
        std::string_view line = cut(text, '\n');
        const std::size_t end = std::min(line.rfind(' '), line.size());  // names may have blanks
        m.metrics.push_back({std::string(line.substr(0, end)), number_in(line.substr(end + 1))});
    }
    return m;
}

}  // namespace rovernet
