// SPDX-License-Identifier: MIT
#include "study/validation/validation_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace rovernet {

void set_costs(ValidationPanel& panel, std::span<const TimedMethod> methods, const Turns& turns) {
    const std::vector<TurnCost> costs = costs_in_turns(methods, turns);
    for (std::size_t i = 0; i < costs.size(); ++i) panel.points[i].cost = costs[i];
}

std::vector<std::size_t> pareto_front(const std::vector<ValidationPoint>& points) {
    std::vector<std::size_t> order(points.size()), front;
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        if (points[a].cost.median != points[b].cost.median)
            return points[a].cost.median < points[b].cost.median;
        return points[a].error < points[b].error;
    });
    for (const std::size_t i : order) {
        if (front.empty() || points[i].error < points[front.back()].error) front.push_back(i);
    }
    return front;
}

const ValidationPoint& point_of(const ValidationPanel& panel, std::string_view label,
                                std::string_view series) {
    for (const ValidationPoint& point : panel.points) {
        if (point.label == label && point.series == series) return point;
    }
    throw std::out_of_range(fmt::format("no point {} {} in {}", label, series, panel.title));
}

std::string two_digits(double value) {
    return fmt::format("{}", std::stod(fmt::format("{:.1e}", value)));
}

double detail_of(const ValidationPoint& point, const std::string& name) {
    for (const auto& [key, value] : point.details) {
        if (key == name) return value;
    }
    throw std::out_of_range(fmt::format("no detail {} of {}", name, point.label));
}

}  // namespace rovernet
