// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"

#include <string>
#include <utility>
#include <vector>

namespace rovernet::test {

constexpr ChartKind chart_kinds[] = {ChartKind::lines, ChartKind::bars, ChartKind::scatter,
                                     ChartKind::cdf, ChartKind::heat_map};

/// Chart with one series, named "s".
inline Chart one_series(ChartKind kind, std::vector<ChartPoint> points) {
    return {.kind = kind, .series = {{"s", std::move(points)}}};
}

inline std::string drawn(const Chart& chart) { return chart_svg({&chart, 1}); }

}  // namespace rovernet::test
