// SPDX-License-Identifier: MIT
#include "pictures/chart/chart_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace rovernet {
namespace {

bool drawable(double v, bool log) {
    constexpr double most = 1e100;  // so that no difference overflows
    return std::abs(v) <= most && (!log || v > 0);
}

bool words_on_x(const Chart& chart) {
    if (chart.kind == ChartKind::cdf) return false;
    if (chart.kind == ChartKind::bars || chart.kind == ChartKind::heat_map) return true;
    for (const auto& series : chart.series) {
        for (const auto& point : series.points) {
            if (!point.category.empty()) return true;
        }
    }
    return false;
}

/// The words of the x axis: numbers in ascending order, then words as they come.
class Words {
  public:
    explicit Words(const Chart& chart) {
        for_each_point(chart, [&](const ChartPoint& p) {
            if (p.category.empty() && drawable(p.x, false)) numbers_.emplace(p.x, 0);
        });
        for (auto& [number, index] : numbers_) {
            index = words.size();
            words.push_back(fmt::format("{}", number));
        }
        for_each_point(chart, [&](const ChartPoint& p) {
            if (p.category.empty() || !categories_.emplace(p.category, words.size()).second) return;
            words.push_back(p.category);
        });
    }

    /// The index of a point's word; NaN if it has none.
    double index(const ChartPoint& p) const {
        if (!p.category.empty()) return static_cast<double>(categories_.at(p.category));
        return drawable(p.x, false) ? static_cast<double>(numbers_.at(p.x)) : std::nan("");
    }

    std::vector<std::string> words = {};

  private:
    template <class Visit>
    static void for_each_point(const Chart& chart, Visit visit) {
        for (const auto& series : chart.series) {
            for (const auto& point : series.points) visit(point);
        }
    }

    std::map<double, std::size_t> numbers_ = {};
    std::map<std::string, std::size_t> categories_ = {};
};

/// Adds the points of one series, and counts omitted points.
class SeriesView {
  public:
    SeriesView(const Chart& chart, const Words* words, ChartView& view)
        : chart_(chart), words_(words), view_(view) {}

    std::vector<DrawnPoint> points(const ChartSeries& series) {
        return chart_.kind == ChartKind::cdf ? steps(series) : plain(series);
    }

  private:
    bool log_x() const { return chart_.log_x && !words_; }
    bool log_y() const { return chart_.log_y && chart_.kind != ChartKind::heat_map; }

    /// Sets the ends of the interval, clipped to the limits of y; the lower end is kept even if a
    /// logarithmic axis cannot show it.
    void set_interval(DrawnPoint& p) {
        const ChartLimits& limits = view_.y_limits;
        p.low = p.source->low;
        p.high = p.source->high;
        if (p.low && limits.low) p.low = std::max(*p.low, std::min(*limits.low, p.y));
        if (p.high && limits.high) p.high = std::min(*p.high, std::max(*limits.high, p.y));
        for (auto* end : {&p.low, &p.high}) {
            if (!*end || drawable(**end, false)) continue;
            end->reset();
            ++view_.left_out;
        }
    }

    std::vector<DrawnPoint> plain(const ChartSeries& series) {
        std::vector<DrawnPoint> found;
        for (const auto& point : series.points) {
            const double x = words_ ? words_->index(point) : point.x;
            if (drawable(x, log_x())) {
                found.push_back({.x = x, .y = point.y, .source = &point});
            } else {
                ++view_.left_out;
            }
        }
        if (chart_.kind != ChartKind::scatter) sort(found);
        return without_gaps(found, !series.beside);
    }

    std::vector<DrawnPoint> without_gaps(const std::vector<DrawnPoint>& found, bool line) {
        std::vector<DrawnPoint> out;
        bool joined = false;
        for (DrawnPoint p : found) {
            if (drawable(p.y, log_y())) {
                set_interval(p);
                p.joined = line && joined;
                out.push_back(p);
                joined = true;
            } else {
                ++view_.left_out;
                joined = false;
            }
        }
        return out;
    }

    std::vector<DrawnPoint> steps(const ChartSeries& series) {
        std::vector<DrawnPoint> out;
        for (const auto& point : series.points) {
            if (drawable(point.x, log_x())) {
                out.push_back({.x = point.x, .joined = true, .source = &point});
            } else {
                ++view_.left_out;
            }
        }
        sort(out);
        const auto count = static_cast<double>(out.size());
        for (std::size_t i = 0; i < out.size(); ++i) out[i].y = static_cast<double>(i + 1) / count;
        return out;
    }

    static void sort(std::vector<DrawnPoint>& points) {
        std::stable_sort(points.begin(), points.end(),
                         [](const DrawnPoint& a, const DrawnPoint& b) { return a.x < b.x; });
    }

    const Chart& chart_;
    const Words* words_;
    ChartView& view_;
};

/// Whether bars from 0 to the range's ends would all look alike.
bool alike(const ChartRange& y) {
    constexpr double far = 0.8;  // of the longest bar
    const double low = std::min(std::abs(y.low()), std::abs(y.high()));
    const double high = std::max(std::abs(y.low()), std::abs(y.high()));
    return y.low() * y.high() > 0 && low > far * high;
}

void find_ranges(const Chart& chart, ChartView& view) {
    for (const auto& points : view.series) {
        view.points += points.size();
        for (const auto& p : points) {
            view.x_range.include(p.x);
            for (const auto& v : {p.low, std::optional(p.y), p.high}) {
                if (v && drawable(*v, chart.log_y)) view.y_range.include(*v);
            }
            for (const auto& v : {p.source->x_low, p.source->x_high}) {
                if (v && drawable(*v, chart.log_x)) view.x_range.include(*v);
            }
        }
    }
    constexpr double below_band = 0.8;  // of its end, so that it is seen
    if (chart.band) view.y_range.include(below_band * *chart.band);
    if (chart.kind == ChartKind::cdf) {
        view.y_range.include(0);
        view.y_range.include(1);
    } else if (chart.kind == ChartKind::bars && view.points > 0) {
        view.dots = chart.log_y || alike(view.y_range);
        if (!view.dots) view.y_range.include(0);
    }
}

void add_notes(const Chart& chart, ChartView& view) {
    if (!chart.note.empty()) view.notes.push_back(chart.note);
    if (view.left_out == 0) return;
    const bool log = chart.log_x || chart.log_y;
    view.notes.push_back(fmt::format("{} {} left out: {}", view.left_out,
                                     view.left_out == 1 ? "value" : "values",
                                     log ? "not finite, or not above 0" : "not finite"));
}

}  // namespace

bool has_band(const ChartView& view, std::size_t series) {
    constexpr std::size_t fewest = 6;  // points
    return !view.has_words && view.series[series].size() >= fewest;
}

bool long_words(const ChartView& view) {
    constexpr std::size_t most = 60;  // characters
    std::size_t characters = 0;
    for (const auto& word : view.words) characters += word.size() + 2;
    return characters > most;
}

double bar_offset(std::size_t series, std::size_t count) {
    const auto i = static_cast<double>(series),
               n = static_cast<double>(std::max<std::size_t>(count, 1));
    return bars_at_word * ((i + 0.5) / n - 0.5);
}

ChartView view_of(const Chart& chart) {
    ChartView view;
    std::optional<Words> words;
    view.has_words = words_on_x(chart);
    view.y_limits = chart.kind == ChartKind::cdf ? ChartLimits{0, 1} : chart.y_limits;
    if (view.has_words) {
        words.emplace(chart);
        view.words = words->words;
    }
    SeriesView series_view(chart, words ? &*words : nullptr, view);
    for (const auto& series : chart.series) view.series.push_back(series_view.points(series));
    find_ranges(chart, view);
    add_notes(chart, view);
    return view;
}

}  // namespace rovernet
