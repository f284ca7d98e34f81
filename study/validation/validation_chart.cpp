// SPDX-License-Identifier: MIT
#include "study/validation/validation_chart.hpp"

#include "study/statistics/distributions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace rovernet {

void set_costs(ValidationPanel& panel, std::span<const TimedMethod> methods, const Turns& turns) {
    const std::vector<TurnCost> costs = costs_in_turns(methods, turns);
    for (std::size_t i = 0; i < costs.size(); ++i) panel.points[i].cost = costs[i];
}

namespace {

/// Whether the mean difference of the parts of two errors differs significantly from 0 at this
/// level.
bool told_apart(const ValidationPoint& a, const ValidationPoint& b, double level) {
    constexpr std::size_t fewest = 6;
    const std::size_t n = std::min(a.parts.size(), b.parts.size());
    if (n < fewest) return false;
    const auto count = static_cast<double>(n);
    double mean = 0, squares = 0;
    for (std::size_t i = 0; i < n; ++i) mean += (a.parts[i] - b.parts[i]) / count;
    for (std::size_t i = 0; i < n; ++i) {
        const double off = a.parts[i] - b.parts[i] - mean;
        squares += off * off;
    }
    const double error = std::sqrt(squares / (count - 1) / count);
    return std::abs(mean) > t_critical(count - 1, level) * error;
}

/// Whether two errors differ, by their parts or intervals; see pareto_front().
bool differ(const ValidationPoint& a, const ValidationPoint& b, double level) {
    if (!a.parts.empty() && !b.parts.empty()) return told_apart(a, b, level);
    return a.error_high.value_or(a.error) < b.error_low.value_or(b.error) ||
           b.error_high.value_or(b.error) < a.error_low.value_or(a.error);
}

std::string name_of(const ValidationPoint& p) {
    return p.series.empty() ? p.label : p.label + " " + p.series;
}

}  // namespace

std::vector<std::size_t> pareto_front(const std::vector<ValidationPoint>& points) {
    std::vector<std::size_t> order(points.size()), front;
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        if (points[a].cost.median != points[b].cost.median)
            return points[a].cost.median < points[b].cost.median;
        return points[a].error < points[b].error;
    });
    const auto n = static_cast<double>(points.size());
    const double level = 0.05 / std::max(1.0, n * (n - 1) / 2);
    for (auto i = order.begin(); i != order.end(); ++i) {
        const ValidationPoint& point = points[*i];
        const bool is_nearer = std::all_of(order.begin(), i, [&](std::size_t cheaper) {
            return point.error < points[cheaper].error && differ(point, points[cheaper], level);
        });
        if (is_nearer) front.push_back(*i);
    }
    return front;
}

bool have_intervals(const std::vector<ValidationPoint>& points) {
    return std::any_of(points.begin(), points.end(), [](const ValidationPoint& p) {
        return !p.parts.empty() || p.error_low.has_value();
    });
}

Nearest nearest_to_truth(const ValidationPanel& panel,
                         const std::function<bool(const ValidationPoint&)>& takes) {
    constexpr double level = 0.05;
    std::vector<const ValidationPoint*> points;
    for (const ValidationPoint& p : panel.points) {
        if (takes(p)) points.push_back(&p);
    }
    std::stable_sort(points.begin(), points.end(),
                     [](const auto* a, const auto* b) { return a->error < b->error; });
    if (points.empty()) return {};
    Nearest out{.point = points.front()};
    const double pairs = std::max(1.0, static_cast<double>(points.size() - 1));
    for (const ValidationPoint* p : points) {
        if (p != out.point && !told_apart(*out.point, *p, level / pairs)) out.alike.push_back(p);
    }
    return out;
}

std::string nearest_text(const Nearest& nearest, const std::function<std::string(double)>& off) {
    constexpr std::size_t most_named = 3;
    if (nearest.alike.empty())
        return fmt::format("{} has the smallest error ({})", name_of(*nearest.point),
                           off(nearest.point->error));
    std::string out = fmt::format("{} ({}) cannot be distinguished from ", name_of(*nearest.point),
                                  off(nearest.point->error));
    const std::size_t named = std::min(most_named, nearest.alike.size());
    for (std::size_t i = 0; i < named; ++i) {
        if (i > 0) out += i + 1 == nearest.alike.size() ? " and " : ", ";
        out += fmt::format("{} ({})", name_of(*nearest.alike[i]), off(nearest.alike[i]->error));
    }
    if (named < nearest.alike.size())
        out += fmt::format(" and {} others", nearest.alike.size() - named);
    return out;
}

const ValidationPoint& point_of(const ValidationPanel& panel, std::string_view label,
                                std::string_view series) {
    for (const ValidationPoint& point : panel.points) {
        if (point.label == label && point.series == series) return point;
    }
    throw std::out_of_range(
        fmt::format("no point with the label \"{}\" and the series \"{}\" in the panel \"{}\"",
                    label, series, panel.title));
}

std::string two_digits(double value) {
    return fmt::format("{}", std::stod(fmt::format("{:.1e}", value)));
}

double detail_of(const ValidationPoint& point, const std::string& name) {
    for (const auto& [key, value] : point.details) {
        if (key == name) return value;
    }
    throw std::out_of_range(
        fmt::format("the point \"{1}\" has no value with the name \"{0}\"", name, point.label));
}

}  // namespace rovernet
