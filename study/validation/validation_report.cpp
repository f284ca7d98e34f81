// SPDX-License-Identifier: MIT
#include "study/validation/validation_report.hpp"

#include "pictures/chart/dot_plot.hpp"
#include "pictures/draw/svg.hpp"

#include <fmt/format.h>

#include <algorithm>

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

std::size_t series_named(DotPlot& plot, const std::string& name) {
    const auto at = std::find(plot.series.begin(), plot.series.end(), name);
    if (at == plot.series.end()) plot.series.push_back(name);
    return static_cast<std::size_t>(std::find(plot.series.begin(), plot.series.end(), name) -
                                    plot.series.begin());
}

/// Row of a label.
DotRow& row_of(DotPlot& plot, const std::string& label) {
    for (DotRow& row : plot.rows) {
        if (row.name == label) return row;
    }
    return plot.rows.emplace_back(DotRow{.name = label});
}

/// The panel as a dot plot, its rows from cheap to dear.
DotPlot plot_of(const ValidationPanel& panel) {
    DotPlot plot{.title = panel.title,
                 .value_label = panel.error_label,
                 .beside_label = panel.cost_label,
                 .log = axis_begin(panel) > 0,
                 .least = axis_begin(panel),
                 .band = panel.unknowable,
                 .band_label = panel.unknowable_label,
                 .whisker_label = panel.interval_label};
    bool below = false;
    for (const ValidationPoint& p : panel.points) {
        row_of(plot, p.label)
            .dots.push_back({.series = series_named(plot, p.series),
                             .value = p.error,
                             .low = p.error_low,
                             .high = p.error_high,
                             .beside = p.cost.median});
        below = below || p.error < plot.least;
    }
    for (const std::size_t i : pareto_front(panel.points))
        row_of(plot, panel.points[i].label).bold = true;
    std::stable_sort(plot.rows.begin(), plot.rows.end(), [](const DotRow& a, const DotRow& b) {
        return a.dots.back().beside < b.dots.back().beside;
    });
    plot.note =
        fmt::format("cheapest method first; bold: {} to the reference than all cheaper methods",
                    have_intervals(panel.points) ? "surely nearer" : "in these cases nearer");
    if (below)
        plot.note += fmt::format("; errors below {:.1g} are drawn at the left end", plot.least);
    return plot;
}

/// Whether every error of a panel is 0: a sentence says that better than a picture.
bool all_right(const ValidationPanel& panel) {
    return std::all_of(panel.points.begin(), panel.points.end(),
                       [](const ValidationPoint& p) { return p.error == 0; });
}

/// Sentence about the panels that have no picture, or nothing.
std::string not_drawn(const ValidationChart& chart) {
    std::vector<std::string> titles;
    for (const ValidationPanel& panel : chart.panels) {
        if (all_right(panel)) titles.push_back("\"" + panel.title + "\"");
    }
    if (titles.empty()) return "";
    return fmt::format(" There is no picture of the errors of {}, because all these errors are 0.",
                       fmt::join(titles, ", "));
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
    if (has_series) head.push_back("variant");
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
    std::vector<std::vector<std::string>> rows{{"promise", "cases", "limit", "worst case", "kept"}};
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
    "This page compares the errors of methods and models with their costs. The errors depend on "
    "the version of rovernet, but not on the machine. The costs are CPU times of one machine, on "
    "which all methods were measured in turns. Other machines have different times, but about the "
    "same order and ratios of costs. One method cannot be distinguished from a second method if "
    "the difference of their errors is not significant.";

/// Section of a page: sentences, picture, and links to the numbers.
/// @param numbers  folder of the numbers, as seen from the page
std::string chart_section(const ValidationChart& chart, const std::string& numbers) {
    std::string out = fmt::format("{} {}\n\n", chart.continues ? "###" : "##", chart.title);
    for (const std::string& sentence : chart.sentences) out += fmt::format("* {}\n", sentence);
    const bool is_drawn = !std::all_of(chart.panels.begin(), chart.panels.end(), all_right);
    if (is_drawn)
        out += fmt::format("\n![{}](../pictures/accuracy-{}.svg)\n", chart.title, chart.name);
    if (!chart.continues) out += fmt::format("\n{}{}", chart.truth, not_drawn(chart));
    return out + fmt::format("{}Numbers: [{}.csv]({}{}.csv)\n\n", chart.continues ? "\n" : " ",
                             chart.name, numbers, chart.name);
}

}  // namespace

std::string validation_svg(const ValidationChart& chart) {
    constexpr double widths[] = {760, 640, 520};  // [px] by plots side by side
    std::vector<DotPlot> plots;
    for (const ValidationPanel& panel : chart.panels) {
        if (!all_right(panel)) plots.push_back(plot_of(panel));
    }
    if (plots.empty()) return "";
    const std::size_t columns = plots.size() == 4 ? 2 : std::min<std::size_t>(plots.size(), 3);
    return dot_plot_svg(plots, chart.title, widths[columns - 1], columns);
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
        out +=
            fmt::format("<p class=\"truth\">{}</p>\n", html_text(chart.truth + not_drawn(chart)));
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

std::string accuracy_page(const Validation& validation) {
    std::string out = fmt::format(
        "# Accuracy against speed\n\n{} [models.md](models.md) describes the models. `rovernet "
        "validate` makes this page and its files. [Limits that the code "
        "promises](../inside/promises.md) have a page of their own.\n\n",
        introduction);
    for (const ValidationChart& chart : validation.charts)
        if (!chart.for_contributors) out += chart_section(chart, "accuracy/");
    for (const std::string& text : validation.left_out)
        out += fmt::format("Left out: {}.\n\n", text);
    out.pop_back();
    return out;
}

std::string promises_page(const Validation& validation) {
    std::string out =
        "# What the code promises\n\n`rovernet validate` measures the errors in this table. If an "
        "error exceeds its limit, the command fails. In each row, the words before \"against\" "
        "name what is measured, and the words after \"against\" name the reference. The column "
        "\"worst case\" has the largest error of all cases.\n\n";
    out += markdown_table(rows_of(validation.promises)) + "\n";
    for (const ValidationChart& chart : validation.charts)
        if (chart.for_contributors) out += chart_section(chart, "../methods/accuracy/");
    out.pop_back();
    return out;
}

}  // namespace rovernet
