// SPDX-License-Identifier: MIT
#include "study/validation/validation_report.hpp"

#include "pictures/chart/chart.hpp"
#include "pictures/draw/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace rovernet {
namespace {

/// Error below which a logarithmic axis shows nothing: a millionth of the largest one; 0 if the
/// axis has to be linear.
double axis_begin(const ValidationPanel& panel) {
    constexpr double share = 1e-6;
    double largest = 0;
    for (const ValidationPoint& p : panel.points) largest = std::max(largest, p.error);
    return panel.log_error ? std::max(share * largest, panel.unknowable.value_or(0) / 2) : 0;
}

ChartPoint chart_point(const ValidationPoint& p, double begin) {
    const auto shown = [&](std::optional<double> v) {
        return v ? std::optional(std::max(*v, begin)) : std::nullopt;
    };
    return {.x = p.cost.median,
            .y = std::max(p.error, begin),
            .low = shown(p.error_low),
            .high = shown(p.error_high),
            .x_low = p.cost.low,
            .x_high = p.cost.high,
            .label = p.label};
}

ChartSeries& series_named(Chart& chart, const std::string& name) {
    for (ChartSeries& series : chart.series) {
        if (series.name == name) return series;
    }
    return chart.series.emplace_back(ChartSeries{.name = name});
}

/// Joins points of one label, which then stands at the last of them alone.
void join_labels(Chart& chart) {
    std::map<std::string, ChartPoint*> last;
    for (ChartSeries& series : chart.series) {
        for (ChartPoint& point : series.points) {
            ChartPoint*& before = last[point.label];
            if (before) {
                chart.guides.push_back({.points = {*before, point}});
                before->label.clear();
            }
            before = &point;
        }
    }
}

Chart chart_of(const ValidationPanel& panel) {
    const double begin = axis_begin(panel);
    Chart chart{.kind = ChartKind::scatter,
                .title = panel.title,
                .x_label = panel.cost_label,
                .y_label = panel.error_label,
                .log_x = true,
                .log_y = begin > 0,
                .y_limits = {.low = begin},
                .band = panel.unknowable,
                .band_label = panel.unknowable_label};
    ChartGuide front{.dashed = true};
    for (const std::size_t i : pareto_front(panel.points)) {
        front.points.push_back(chart_point(panel.points[i], begin));
    }
    chart.guides.push_back(std::move(front));
    bool below = false;
    for (const ValidationPoint& p : panel.points) {
        series_named(chart, p.series).points.push_back(chart_point(p, begin));
        below = below || p.error < begin;
    }
    if (panel.joined) join_labels(chart);
    chart.note = "dashed: what nothing beats; whiskers along x: lowest and highest turn";
    if (below) chart.note += fmt::format("; errors below {:.1g} stand at the lower edge", begin);
    return chart;
}

std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
    return out + "\"";
}

std::string optional_number(const std::optional<double>& v) {
    return v ? fmt::format("{}", *v) : "";
}

/// Table of a panel as rows of cells, the first row its head.
std::vector<std::vector<std::string>> rows_of(const ValidationPanel& panel) {
    const bool has_series = std::any_of(panel.points.begin(), panel.points.end(),
                                        [](const auto& p) { return !p.series.empty(); });
    std::vector<std::string> head{"method"};
    if (has_series) head.push_back("");
    head.push_back(panel.error_label);
    for (const Detail& detail : panel.points.front().details) head.push_back(detail.first);
    head.push_back(panel.cost_label);
    std::vector<std::vector<std::string>> rows{head};
    for (const ValidationPoint& p : panel.points) {
        std::vector<std::string> row{p.label};
        if (has_series) row.push_back(p.series);
        row.push_back(fmt::format("{:.3g}", p.error));
        for (const Detail& detail : p.details) row.push_back(fmt::format("{:.3g}", detail.second));
        row.push_back(two_digits(p.cost.median));
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<std::vector<std::string>> rows_of(const std::vector<Promise>& promises) {
    std::vector<std::vector<std::string>> rows{{"promise", "cases", "limit", "worst", "kept"}};
    for (const Promise& p : promises) {
        const std::string unit = p.unit.empty() ? "" : " " + p.unit;
        rows.push_back({p.what, fmt::format("{}", p.n), fmt::format("{:g}{}", p.limit, unit),
                        fmt::format("{:.2g}{}", p.worst, unit), p.kept() ? "yes" : "NO"});
    }
    return rows;
}

std::string html_table(const std::vector<std::vector<std::string>>& rows) {
    std::string out = "<table>\n";
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const char* cell = i == 0 ? "th" : "td";
        out += "<tr>";
        for (const std::string& text : rows[i])
            out += fmt::format("<{0}>{1}</{0}>", cell, xml_text(text));
        out += "</tr>\n";
    }
    return out + "</table>\n";
}

std::string markdown_table(const std::vector<std::vector<std::string>>& rows) {
    std::string out;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        out += fmt::format("| {} |\n", fmt::join(rows[i], " | "));
        if (i > 0) continue;
        for (std::size_t k = 0; k < rows[0].size(); ++k) out += k == 0 ? "|---|" : "--:|";
        out += "\n";
    }
    return out;
}

/// Text for HTML, with what stands between `...` as code.
std::string html_text(const std::string& text) {
    std::string out;
    bool code = false;
    for (const char c : xml_text(text)) {
        if (c != '`') {
            out += c;
            continue;
        }
        out += code ? "</code>" : "<code>";
        code = !code;
    }
    return out;
}

constexpr const char* html_head = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Accuracy against speed</title><style>
body { font: 16px/1.5 sans-serif; max-width: 1500px; margin: 2em auto; padding: 0 1em; color: #222 }
table { border-collapse: collapse; font-size: 14px; margin: 1em 0 }
td, th { border-bottom: 1px solid #ddd; padding: 2px 12px; text-align: right }
td:first-child, th:first-child { text-align: left }
svg { max-width: 100%; height: auto } .truth { color: #555 }
</style></head><body>
<h1>Accuracy against speed</h1>
)";

constexpr const char* introduction =
    "Errors are those of this build, the same on every machine. Costs are CPU times of one "
    "machine, all methods measured in turns: trust their order and their ratios.";

}  // namespace

std::string validation_svg(const ValidationChart& chart) {
    std::vector<Chart> charts;
    for (const ValidationPanel& panel : chart.panels) charts.push_back(chart_of(panel));
    const int columns = std::clamp(static_cast<int>(charts.size()), 1, 3);
    const double width = columns == 1 ? 760 : columns == 2 ? 600 : 500;  // [px]
    return chart_svg(charts, {.title = chart.title,
                              .width = width,
                              .height = 360,
                              .columns = charts.size() == 4 ? 2 : columns});
}

std::string validation_csv(const ValidationChart& chart) {
    std::string out =
        "panel,method,series,cost_ns,cost_low_ns,cost_high_ns,error,error_low,error_high";
    for (const Detail& detail : chart.panels.front().points.front().details)
        out += "," + csv_cell(detail.first);
    out += "\n";
    for (const ValidationPanel& panel : chart.panels) {
        for (const ValidationPoint& p : panel.points) {
            out += fmt::format("{},{},{},{:.4g},{:.4g},{:.4g},{},{},{}", csv_cell(panel.title),
                               csv_cell(p.label), csv_cell(p.series), p.cost.median, p.cost.low,
                               p.cost.high, p.error, optional_number(p.error_low),
                               optional_number(p.error_high));
            for (const Detail& detail : p.details) out += fmt::format(",{}", detail.second);
            out += "\n";
        }
    }
    return out;
}

std::string validation_html(const Validation& validation) {
    std::string out = html_head;
    out += fmt::format("<p>{}</p>\n", introduction);
    for (const ValidationChart& chart : validation.charts) {
        out += fmt::format("<h2 id=\"{}\">{}</h2>\n", chart.name, xml_text(chart.title));
        for (const std::string& sentence : chart.sentences)
            out += fmt::format("<p>{}</p>\n", html_text(sentence));
        out += validation_svg(chart);
        out += fmt::format("<p class=\"truth\">{}</p>\n", html_text(chart.truth));
        for (const ValidationPanel& panel : chart.panels) {
            if (!panel.title.empty()) out += fmt::format("<h3>{}</h3>\n", xml_text(panel.title));
            out += html_table(rows_of(panel));
        }
    }
    out += "<h2 id=\"promises\">What the code promises</h2>\n";
    out += html_table(rows_of(validation.promises));
    for (const std::string& text : validation.left_out)
        out += fmt::format("<p>Left out: {}.</p>\n", html_text(text));
    return out + "</body></html>\n";
}

std::string validation_page(const Validation& validation) {
    std::string out = fmt::format("# Accuracy against speed\n\n{}\n\n", introduction);
    for (const ValidationChart& chart : validation.charts) {
        out += fmt::format("## {}\n\n", chart.title);
        for (const std::string& sentence : chart.sentences) out += fmt::format("* {}\n", sentence);
        out += fmt::format("\n![{0}](accuracy-{1}.svg)\n\n{2}\n\n", chart.title, chart.name,
                           chart.truth);
        for (const ValidationPanel& panel : chart.panels) {
            if (!panel.title.empty()) out += fmt::format("**{}**\n\n", panel.title);
            out += markdown_table(rows_of(panel)) + "\n";
        }
    }
    out += "## What the code promises\n\n" + markdown_table(rows_of(validation.promises));
    for (const std::string& text : validation.left_out)
        out += fmt::format("\nLeft out: {}.\n", text);
    return out;
}

}  // namespace rovernet
