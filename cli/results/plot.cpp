// SPDX-License-Identifier: MIT
#include "cli/results/result_commands.hpp"
#include "cli/terminal/picture_output.hpp"
#include "cli/terminal/stop.hpp"
#include "pictures/draw/picture_file.hpp"
#include "sim/error.hpp"
#include "study/advise/study_chart.hpp"

#include <fmt/format.h>

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
    throw std::invalid_argument(fmt::format("--kind: unknown value \"{}\"; expected one of {}{}{}",
                                            word, fmt::join(names, ", "), near.empty() ? "" : "; ",
                                            near));
}

/// A picture of 672 points, fewer if they are to be larger, as so many pixels.
ChartLayout layout_of(const PlotArguments& a) {
    constexpr double usual_font_size = 12;
    const ChartLayout usual;
    const double points = usual_font_size / a.font_size;
    ChartLayout out{.width = usual.width * points, .height = usual.height * points, .columns = 1};
    out.scale = a.width / out.picture_width();
    return out;
}

}  // namespace

void plot(const PlotArguments& a) {
    if (!is_picture_name(a.out) && !a.out.ends_with(".gp")) {
        throw std::invalid_argument(fmt::format(
            "-o: \"{}\"; expected NAME.svg, NAME.png, NAME.pdf or NAME.gp (gnuplot)", a.out));
    }
    const Store store = Store::open(a.store);
    const Chart chart = study_chart(store, {.kind = kind_of(a.kind),
                                            .x = a.x,
                                            .y = a.y,
                                            .by = a.by,
                                            .where = conditions_of(varied_paths(store), a.where),
                                            .confidence = a.confidence,
                                            .quantile = a.quantile,
                                            .interval = method_named(a.interval),
                                            .log_x = a.log_x,
                                            .log_y = a.log_y,
                                            .common = a.common});
    if (is_picture_name(a.out)) {
        write_picture(a.out, chart_svg(std::span(&chart, 1), layout_of(a)));
    } else {
        write_whole({{a.out, chart_gnuplot(chart)}});
    }
}

}  // namespace rovernet::cli
