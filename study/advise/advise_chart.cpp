// SPDX-License-Identifier: MIT
#include "study/advise/advise_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace rovernet {
namespace {

/// Both errors of a candidate.
struct ErrorPoints {
    ChartPoint bias, run;
};

ErrorPoints error_points(const JudgedCandidate& each) {
    ErrorPoints out;
    out.bias = {.y = std::abs(each.bias), .label = each.name, .n = each.decision.n()};
    if (const auto& interval = each.bias_interval) {
        const double a = std::abs(interval->low), b = std::abs(interval->high);
        out.bias.low = interval->low <= 0 && interval->high >= 0 ? 0 : std::min(a, b);
        out.bias.high = std::max(a, b);
    }
    out.run = {.y = each.run_error, .n = each.decision.n()};
    if (const auto& interval = each.run_error_interval) {
        out.run.low = interval->low;
        out.run.high = interval->high;
    }
    return out;
}

Chart error_chart(const Advice& advice, const std::string& title, const std::string& x_label) {
    const AdviceCandidates& c = advice.candidates;
    Chart chart{
        .kind = ChartKind::scatter,
        .title = title,
        .x_label = x_label,
        .y_label = "error of " + advice.metric,
        .note = fmt::format(
            "errors are differences from {}, drawn with {:.4g} % intervals; coloured band: errors "
            "up to the tolerance of {:.4g} {}",
            c.name_of(c.reference_path_loss(), c.reference_reception()),
            100 * (1 - advice.rule.alpha), advice.rule.tolerance,
            advice.rule.criterion == ErrorCriterion::mean ? "for the mean" : "for a single run"),
        .log_x = true,
        .y_limits = {.low = 0}};
    chart.band = advice.rule.tolerance;
    chart.series = {ChartSeries{.name = "of the mean"}, ChartSeries{.name = "of a single run"}};
    return chart;
}

void add_both_errors(Chart& chart, const JudgedCandidate& each, double x) {
    ErrorPoints points = error_points(each);
    points.bias.x = points.run.x = x;
    if (chart.kind == ChartKind::bars) points.bias.category = points.run.category = each.name;
    chart.series[0].points.push_back(points.bias);
    chart.series[1].points.push_back(points.run);
}

/// The reference: no error, by definition.
void add_reference(Chart& chart, const Advice& advice, double x) {
    const AdviceCandidates& c = advice.candidates;
    chart.series[0].points.push_back(
        {.x = x, .y = 0, .label = c.name_of(c.reference_path_loss(), c.reference_reception())});
}

/// Intervals of the costs along x, of the point that came last.
void add_cost_interval(Chart& chart, const CandidateCost& cost) {
    for (ChartSeries& series : chart.series) {
        if (series.points.empty()) continue;
        series.points.back().x_low = 1e6 * *cost.low_s;
        series.points.back().x_high = 1e6 * *cost.high_s;
    }
}

/// Adds the line along the points that no other beats in both cost and the error that is judged.
void add_front(Chart& chart, ErrorCriterion criterion) {
    std::vector<ChartPoint> points = chart.series[criterion == ErrorCriterion::run ? 1 : 0].points;
    if (criterion == ErrorCriterion::run) points.push_back(chart.series[0].points.back());
    std::stable_sort(points.begin(), points.end(), [](const ChartPoint& a, const ChartPoint& b) {
        return a.x < b.x || (a.x == b.x && a.y < b.y);
    });
    ChartGuide front;
    for (const ChartPoint& point : points) {
        if (front.points.empty() || point.y < front.points.back().y) front.points.push_back(point);
    }
    chart.guides.push_back(std::move(front));
}

}  // namespace

std::vector<Chart> advice_charts(const Advice& advice) {
    const CandidateCost& reference = advice.reference_cost;
    if (!(reference.run_s > 0)) {
        Chart bars = error_chart(advice, "", "candidate");
        bars.kind = ChartKind::bars;
        bars.log_x = false;
        for (const JudgedCandidate& each : advice.judged) add_both_errors(bars, each, 0);
        return {bars};
    }
    std::vector<Chart> out;
    if (reference.transmission_s) {
        Chart& medium = out.emplace_back(
            error_chart(advice, "path loss", "CPU time to find receivers per transmission [us]"));
        for (const JudgedCandidate& each : advice.judged) {
            if (each.step != AdviceStep::path_loss) continue;
            add_both_errors(medium, each, 1e6 * *each.cost.transmission_s);
            add_cost_interval(medium, each.cost);
        }
        add_reference(medium, advice, 1e6 * *reference.transmission_s);
        add_front(medium, advice.rule.criterion);
    }
    Chart& runs = out.emplace_back(error_chart(advice, "whole runs", "CPU time of a run [ms]"));
    for (const JudgedCandidate& each : advice.judged)
        add_both_errors(runs, each, 1e3 * each.cost.run_s);
    add_reference(runs, advice, 1e3 * reference.run_s);
    add_front(runs, advice.rule.criterion);
    return out;
}

}  // namespace rovernet
