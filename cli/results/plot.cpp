// SPDX-License-Identifier: MIT
#include "cli/display/picture_output.hpp"
#include "cli/results/result_commands.hpp"
#include "cli/terminal/stop.hpp"
#include "pictures/draw/picture_file.hpp"
#include "sim/error.hpp"
#include "study/advise/study_chart.hpp"
#include "study/advise/table_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rovernet::cli {
namespace {

std::optional<ChartKind> kind_of(const std::string& word) {
    if (word.empty()) return std::nullopt;
    const std::vector<std::string> names = {"lines", "bars", "cdf", "heat_map"};
    constexpr ChartKind kinds[] = {ChartKind::lines, ChartKind::bars, ChartKind::cdf,
                                   ChartKind::heat_map};
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == word) return kinds[i];
    }
    const std::string near = did_you_mean(word, names);
    throw std::invalid_argument(fmt::format("--kind: found \"{}\"; expected one of {}{}{}", word,
                                            fmt::join(names, ", "), near.empty() ? "" : "; ",
                                            near));
}

/// A picture of 672 points, or of up to three charts of 352 points side by side; fewer points if
/// they are to be larger, as so many pixels.
ChartLayout layout_of(const PlotArguments& a) {
    constexpr double usual_font_size = 12;
    constexpr int most_columns = 3;
    const bool one = a.y.size() == 1;
    const ChartLayout usual =
        one ? ChartLayout{} : ChartLayout{.width = 320, .height = 240, .columns = most_columns};
    const double points = usual_font_size / a.font_size;
    const int columns = std::min(static_cast<int>(a.y.size()), most_columns);
    ChartLayout out{
        .width = usual.width * points, .height = usual.height * points, .columns = columns};
    const double pixels = a.width ? *a.width : usual.picture_width(columns);
    out.scale = pixels / out.picture_width(columns);
    return out;
}

/// Checks that no option is given that needs the runs of a study.
void check_options_of_table(const PlotArguments& a) {
    const std::pair<const char*, bool> given[] = {{"--confidence", a.confidence.has_value()},
                                                  {"--quantile", a.quantile.has_value()},
                                                  {"--interval", a.interval.has_value()},
                                                  {"--common", a.common},
                                                  {"--beside", !a.beside.empty()}};
    for (const auto& [option, is_given] : given) {
        if (is_given) {
            throw std::invalid_argument(
                fmt::format("{}: this option needs the runs of a study, and the table {} has no "
                            "runs; expected the store of a study, as written by rovernet sweep",
                            option, a.store));
        }
    }
}

/// A chart for each y, of the store of a study or of a CSV file.
std::vector<Chart> charts_of(const PlotArguments& a) {
    ChartQuestion question{.kind = kind_of(a.kind),
                           .x = a.x,
                           .by = a.by,
                           .confidence = a.confidence,
                           .quantile = a.quantile,
                           .interval = method_named(a.interval),
                           .log_x = a.log_x,
                           .log_y = a.log_y,
                           .common = a.common,
                           .beside = a.beside};
    const bool is_table = a.store.ends_with(".csv");
    std::optional<Store> store;
    if (is_table) {
        check_options_of_table(a);
        for (const std::string& text : a.where) question.where.push_back(condition_of(text));
    } else {
        store.emplace(Store::open(a.store));
        question.where = conditions_of(varied_paths(*store), a.where);
    }
    std::vector<Chart> charts;
    for (const std::string& metric : a.y) {
        question.y = metric;
        Chart& chart = charts.emplace_back(is_table ? table_chart(a.store, question)
                                                    : study_chart(*store, question));
        if (a.x_title) chart.x_label = *a.x_title;
        if (!a.y_titles.empty()) chart.y_label = a.y_titles[charts.size() - 1];
    }
    return charts;
}

}  // namespace

void plot(const PlotArguments& a) {
    if (!is_picture_name(a.out) && !a.out.ends_with(".gp")) {
        throw std::invalid_argument(fmt::format(
            "-o: found \"{}\"; expected NAME.svg, NAME.png, NAME.pdf or NAME.gp (gnuplot)", a.out));
    }
    if (a.out.ends_with(".gp") && a.y.size() > 1) {
        throw std::invalid_argument(fmt::format(
            "-y: found {} metrics; expected one metric for a gnuplot script", a.y.size()));
    }
    if (!a.y_titles.empty() && a.y_titles.size() != a.y.size()) {
        throw std::invalid_argument(
            fmt::format("--y-title: given {} title{} for {} metric{}; expected one title for each "
                        "metric of -y, in the same order",
                        a.y_titles.size(), a.y_titles.size() == 1 ? "" : "s", a.y.size(),
                        a.y.size() == 1 ? "" : "s"));
    }
    const std::vector<Chart> charts = charts_of(a);
    if (is_picture_name(a.out)) {
        write_picture(a.out, chart_svg(charts, layout_of(a)));
    } else {
        write_whole({{a.out, chart_gnuplot(charts.front())}});
    }
}

}  // namespace rovernet::cli
