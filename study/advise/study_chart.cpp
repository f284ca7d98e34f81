// SPDX-License-Identifier: MIT
#include "study/advise/study_chart.hpp"

#include "scenario/document/toml.hpp"
#include "sim/error.hpp"
#include "study/advise/marks_beside.hpp"
#include "study/advise/table_numbers.hpp"
#include "study/quotient.hpp"
#include "study/statistics/metric_bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace rovernet {
namespace {

/// Numbers of a key's values; none if they are words.
std::optional<Numbers> numbers_of(const std::vector<Answer>& list, const std::string& path) {
    std::vector<std::string> texts;
    for (const Answer& answer : list) texts.push_back(plain_text(*answer.settings.find(path)));
    return rovernet::numbers_of(texts, path);
}

/// Metrics in seconds end in _s, those in microseconds in _us. A quotient "A/B" is in the unit of A
/// for each B.
std::string metric_label(const std::string& metric) {
    const auto quotient = quotient_of(metric);
    const std::string& over = quotient ? quotient->over : metric;
    for (const std::string unit : {"s", "us"}) {
        if (!over.ends_with("_" + unit)) continue;
        const std::string name = over.substr(0, over.size() - unit.size() - 1);
        return fmt::format("{}{} [{}]", name, quotient ? "/" + quotient->under : "", unit);
    }
    return metric;
}

/// The bounds of a metric as those of an axis; after a quantile of the runs they are the same.
ChartLimits limits_of(const std::string& metric) {
    const Bounds bounds = bounds_of(metric);
    return {bounds.low, bounds.high};
}

std::string percent(double share) { return fmt::format("{:.4g} %", 100 * share); }

/// Number of replications that the values are from: "30 replications", or "5 to 30 replications".
std::string replications_text(const std::vector<Answer>& list) {
    std::size_t least = SIZE_MAX, most = 0;
    for (const Answer& answer : list) {
        least = std::min(least, answer.values.size());
        most = std::max(most, answer.values.size());
    }
    if (least < most) return fmt::format("{} to {} replications", least, most);
    return fmt::format("{} replication{}", most, most == 1 ? "" : "s");
}

/// " by betting", or how else the intervals of means were made; nothing for those of quantiles.
std::string methods_text(const std::vector<Answer>& list) {
    std::string text;
    for (const IntervalMethod method : all_interval_methods) {
        if (std::ranges::count(list, method, &Answer::method) == 0) continue;
        text += fmt::format("{}{}", text.empty() ? " " : " and ", words_of(method));
    }
    const auto skewed = std::ranges::count_if(list, &Answer::skewed);
    if (skewed > 0)
        text += fmt::format(" (for {} of {} means, the values are too skewed for Student's t)",
                            skewed, list.size());
    return text;
}

std::string note_of(const Answers& all, const ChartQuestion& q, double confidence) {
    std::string where;
    for (const Condition& condition : q.where) {
        where += fmt::format("{} = {}; ", condition.path, condition.value);
    }
    const std::string what = where + (q.quantile ? percent(*q.quantile) + " quantiles" : "means");
    const std::string of = replications_text(all.list);
    const std::string covered = coverage_text(all);
    const std::string rest = covered.empty() ? "" : "; " + covered;
    if (q.kind == ChartKind::cdf) return fmt::format("{}of {}{}", where, of, rest);
    if (q.kind == ChartKind::heat_map) return fmt::format("{} of {}{}", what, of, rest);
    return fmt::format("{} of {}, with {} intervals{}{}", what, of, percent(confidence),
                       methods_text(all.list), rest);
}

/// Checks that a kind of chart has the keys that its axes need.
void check_axes(const ChartQuestion& q) {
    const bool cdf = q.kind == ChartKind::cdf;
    if (q.x.empty() && !cdf)
        throw std::invalid_argument("-x: no key is given; expected a key that varies in the study");
    if (cdf && !q.x.empty())
        throw std::invalid_argument(
            "-x: a cdf takes no -x, because its x axis is the metric of -y; leave -x out");
    if (q.kind == ChartKind::heat_map && q.by.empty()) {
        throw std::invalid_argument(
            "--by: no key is given, but a heat map needs a key for its rows; expected a key that "
            "varies in the study");
    }
}

/// A chart of no points, with its axes.
Chart frame_of(const ChartQuestion& q, const std::string& unit) {
    Chart chart{.kind = *q.kind, .log_x = q.log_x, .log_y = q.log_y};
    switch (chart.kind) {
        case ChartKind::cdf:
            chart.x_label = metric_label(q.y);
            chart.y_label = "share of replications";
            break;
        case ChartKind::heat_map:
            chart.x_label = axis_label(q.x, unit);
            chart.y_label = q.by;
            chart.value_label = metric_label(q.y);
            break;
        default: chart.x_label = axis_label(q.x, unit); chart.y_label = metric_label(q.y);
    }
    return chart;
}

void add_replications(ChartSeries& series, const Answer& answer) {
    for (const auto& [replication, value] : answer.values) series.points.push_back({.x = value});
}

/// A point of the chart, but for its x.
ChartPoint point_of(const Answer& answer) {
    return {.y = answer.value.value_or(std::nan("")),
            .low = answer.low,
            .high = answer.high,
            .n = answer.values.size()};
}

/// Mark of a routing protocol, with the intervals of both metrics.
ChartPoint mark_of(const Answer& delivery, const Answer& airtime) {
    ChartPoint mark = point_of(delivery);
    mark.x = airtime.value.value_or(std::nan(""));
    mark.x_low = airtime.low;
    mark.x_high = airtime.high;
    mark.label = plain_text(*delivery.settings.find(std::string(protocol_path)));
    return mark;
}

}  // namespace

std::string axis_label(const std::string& path, const std::string& unit) {
    return unit.empty() ? path : fmt::format("{} [{}]", path, unit);
}

ChartSeries& series_named(Chart& chart, const std::string& name) {
    for (ChartSeries& series : chart.series) {
        if (series.name == name) return series;
    }
    return chart.series.emplace_back(ChartSeries{.name = name});
}

std::string varied_path(const std::vector<std::string>& paths, const std::string& word) {
    std::vector<std::string> found;
    for (const std::string& path : paths) {
        if (path == word) return path;
        const bool is_count = path.starts_with("robot.") && path.ends_with(".count");
        if (path.ends_with("." + word) || (word == "robots" && is_count)) found.push_back(path);
    }
    if (found.size() == 1) return found.front();
    std::vector<std::string> words = paths;
    for (const std::string& path : paths) words.push_back(path.substr(path.rfind('.') + 1));
    const std::string near = did_you_mean(word, words);
    throw std::invalid_argument(fmt::format(
        "the key \"{}\" {} in this study; expected {}{}{}", word,
        found.empty() ? "does not vary" : "matches several keys", paths.empty() ? "" : "one of ",
        paths.empty() ? "no key, because this study varies none"
                      : fmt::format("{}", fmt::join(paths, ", ")),
        near.empty() ? "" : "; " + near));
}

Condition condition_of(const std::string& text) {
    const auto equals = text.find('=');
    if (equals == std::string::npos) {
        throw std::invalid_argument(
            fmt::format("--where: found \"{}\"; expected KEY=VALUE, such as ttl=6", text));
    }
    return {text.substr(0, equals), text.substr(equals + 1)};
}

std::vector<Condition> conditions_of(const std::vector<std::string>& paths,
                                     const std::vector<std::string>& texts) {
    std::vector<Condition> conditions;
    for (const std::string& text : texts) {
        Condition& condition = conditions.emplace_back(condition_of(text));
        condition.path = varied_path(paths, condition.path);
    }
    return conditions;
}

Chart study_chart(const Store& store, const ChartQuestion& question) {
    check_axes(question);
    ChartQuestion q = question;
    const std::vector<std::string> paths = varied_paths(store);
    const bool cdf = q.kind == ChartKind::cdf;
    std::vector<std::string> group_by;
    for (std::string* word : {&q.x, &q.by}) {
        if (word->empty()) continue;
        *word = varied_path(paths, *word);
        group_by.push_back(*word);
    }
    const Answers all = answers(store, {.metrics = {q.y},
                                        .group_by = group_by,
                                        .where = q.where,
                                        .confidence = q.confidence,
                                        .quantile = q.quantile,
                                        .interval = q.interval,
                                        .common = q.common});
    const std::vector<Answer>& list = all.list;
    const auto numbers = q.x.empty() ? std::nullopt : numbers_of(list, q.x);
    if (!q.kind) q.kind = numbers ? ChartKind::lines : ChartKind::bars;

    Chart chart = frame_of(q, numbers ? numbers->unit : "");
    if (*q.kind != ChartKind::heat_map) chart.legend_title = question.by;
    (cdf ? chart.x_limits : chart.y_limits) = limits_of(q.y);
    chart.note = note_of(all, q, q.confidence.value_or(confidence_of(store)));
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Answer& answer = list[i];
        ChartSeries& series =
            series_named(chart, q.by.empty() ? "" : plain_text(*answer.settings.find(q.by)));
        if (cdf) {
            add_replications(series, answer);
            continue;
        }
        ChartPoint point = point_of(answer);
        if (numbers) {
            point.x = numbers->values[i];
        } else {
            point.category = plain_text(*answer.settings.find(q.x));
        }
        series.points.push_back(point);
    }
    if (q.beside.empty()) return chart;
    if (chart.kind != ChartKind::lines || !numbers) {
        throw std::invalid_argument(
            "--beside: this option needs a chart of lines with numbers along the x axis; expected "
            "--kind lines, and a key with numbers for -x");
    }
    add_marks(chart, q.beside,
              {.x = question.x, .unit = numbers->unit, .by = question.by, .y = q.y});
    return chart;
}

std::vector<Chart> comparison_charts(const Comparison& comparison) {
    const bool costs = std::all_of(comparison.models.begin(), comparison.models.end(),
                                   [](const ComparedModel& m) { return m.cost.has_value(); });
    Chart values{.kind = ChartKind::bars,
                 .x_label = comparison.path == model_path || comparison.path.empty()
                                ? "propagation model"
                                : comparison.path,
                 .y_label = metric_label(comparison.metric),
                 .y_limits = limits_of(comparison.metric)};
    Chart errors{
        .kind = ChartKind::scatter,
        .x_label = costs ? "CPU time to find receivers per frame [us]" : "CPU time per run [ms]",
        .y_label = "mean distance to " + comparison.most_detailed,
        .log_x = true,
        .y_limits = {.low = 0}};
    ChartSeries& bars = values.series.emplace_back(ChartSeries{});
    ChartSeries& dots = errors.series.emplace_back(ChartSeries{});
    std::vector<Answer> list;
    for (const ComparedModel& m : comparison.models) {
        list.push_back(m.answer);
        ChartPoint point = point_of(m.answer);
        point.category = m.model;
        const auto& e = m.error_interval;
        bars.points.push_back(std::move(point));
        dots.points.push_back({.x = costs ? 1e6 * m.cost->median_s : 1e3 * m.cpu_s,
                               .y = m.error.value_or(std::nan("")),
                               .low = e ? std::optional(e->low) : std::nullopt,
                               .high = e ? std::optional(e->high) : std::nullopt,
                               .label = m.model,
                               .n = m.error_n});
    }
    values.note = fmt::format("means of {}, with {} intervals{}", replications_text(list),
                              percent(comparison.confidence), methods_text(list));
    for (const std::string& text : {comparison.held, incompleteness(comparison.runs)}) {
        if (!text.empty()) values.note += "; " + text;
    }
    return {values, errors};
}

Chart protocol_chart(const Store& store, std::vector<std::string> remarks) {
    const Answers all = answers(store, {.metrics = {"delivery_ratio", "airtime_per_byte_us"}});
    Chart chart{.kind = ChartKind::scatter,
                .x_label = "airtime for each byte delivered [us]",
                .y_label = "delivery_ratio",
                .x_limits = {.low = 0},
                .y_limits = limits_of("delivery_ratio")};
    ChartSeries& marks = chart.series.emplace_back(ChartSeries{});
    std::vector<std::string> without;
    std::vector<Answer> deliveries, airtimes;
    for (std::size_t i = 0; i + 1 < all.list.size(); i += 2) {
        const Answer &delivery = all.list[i], &airtime = all.list[i + 1];
        deliveries.push_back(delivery);
        airtimes.push_back(airtime);
        ChartPoint mark = mark_of(delivery, airtime);
        if (airtime.value) {
            marks.points.push_back(std::move(mark));
        } else {
            without.push_back(std::move(mark.label));
        }
    }
    chart.note = fmt::format("means of {}, with {} intervals; intervals of delivery ratios{}",
                             replications_text(deliveries), percent(confidence_of(store)),
                             methods_text(deliveries));
    const std::string of_airtimes = methods_text(airtimes);
    if (!of_airtimes.empty()) chart.note += ", intervals of airtimes" + of_airtimes;
    if (!without.empty()) {
        chart.note += fmt::format("; nothing delivered by: {}", fmt::join(without, ", "));
    }
    remarks.push_back(coverage_text(all));
    for (const std::string& text : remarks) {
        if (!text.empty()) chart.note += "; " + text;
    }
    return chart;
}

}  // namespace rovernet
