// SPDX-License-Identifier: MIT
#include "cli/commands.hpp"
#include "experiment/output.hpp"
#include "sim/error.hpp"
#include "study/study_chart.hpp"

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

}  // namespace

void plot(const PlotArguments& a) {
    const auto writes = [&](const char* ending) { return a.out.ends_with(ending); };
    if (!writes(".svg") && !writes(".gp") && !writes(".vl.json")) {
        throw std::invalid_argument(fmt::format(
            "-o: \"{}\"; expected NAME.svg, NAME.gp (gnuplot) or NAME.vl.json (Vega-Lite)", a.out));
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
                                            .log_y = a.log_y});
    if (writes(".svg")) {
        const ChartLayout layout{.width = static_cast<double>(a.width), .columns = 1};
        write_file(a.out, chart_svg(std::span(&chart, 1), layout));
    } else {
        write_file(a.out, writes(".gp") ? chart_gnuplot(chart) : chart_vega_lite(chart));
    }
}

}  // namespace rovernet::cli
