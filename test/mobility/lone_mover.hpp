// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "mobility/planners.hpp"
#include "sim/legs.hpp"
#include "sim/random.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

namespace rovernet::test {

/// Robot that moves by a movement model without a Network, for tests of many independent robots.
class LoneMover {
  public:
    /// @param planners  path planners; their scene must outlive the mover
    /// @param robot     key of the robot, which determines its random draws
    explicit LoneMover(Planners& planners, std::uint64_t robot = 0, Vec3 at = {},
                       Meters radius = {0.2})
        : planners_(&planners), robot_(robot), radius_(radius) {
        leg = {.start = start_of_run, .end = start_of_run, .from = at, .to = at};
    }

    Mover mover(const Legs& legs) const {
        return {.now = leg.end,
                .position = leg.to,
                .radius = radius_,
                .planners = *planners_,
                .legs = legs,
                .heading = leg.heading_at(leg.end),
                .top_speed = top_speed,
                .draws = {.seed = 7, .a = robot_}};
    }

    /// Begins the model's next leg. @return false if there is no further leg
    template <class Model>
    bool walk(Model& model, const Legs& legs = {}) {
        Mover asking = mover(legs);
        const Step step = model.next_leg(asking);
        if (const auto* next = std::get_if<Leg>(&step)) leg = *next;
        return std::holds_alternative<Leg>(step);
    }
    /// Moves until the current leg contains the time `t` after the start.
    template <class Model>
    bool walk_until(Model& model, Duration t) {
        while (leg.end <= start_of_run + t)
            if (!walk(model)) return false;
        return true;
    }

    double speed() const { return std::sqrt(dot(leg.velocity, leg.velocity)); }
    double length() const { return distance(leg.from, leg.to); }

    Leg leg;  ///< current leg
    MetersPerSecond top_speed{std::numeric_limits<double>::infinity()};

  private:
    Planners* planners_;
    std::uint64_t robot_;
    Meters radius_;
};

/// Mean and standard deviation of a sequence of numbers.
struct Sample {
    double n = 0, sum = 0, squares = 0;
    void add(double x) {
        ++n;
        sum += x;
        squares += x * x;
    }
    double mean() const { return sum / n; }
    double deviation() const { return std::sqrt(squares / n - mean() * mean()); }
    /// Deviation of the mean from `mean_expected` in standard errors, for a known standard
    /// deviation `sigma` of one number.
    double errors_off(double mean_expected, double sigma) const {
        return std::abs(mean() - mean_expected) / (sigma / std::sqrt(n));
    }
};

/// Numbers of positions in the cells of a square grid over an area, for comparison with a density.
class Histogram {
  public:
    Histogram(Vec3 lower, Vec3 upper, int side)
        : lower_(lower),
          upper_(upper),
          side_(side),
          counts_(static_cast<std::size_t>(side * side)) {}

    void add(Vec3 p) {
        ++counts_[index(cell(p.x, lower_.x, upper_.x), cell(p.y, lower_.y, upper_.y))];
        ++n_;
    }
    /// Deviation of Pearson's chi-square from its mean, in standard deviations. `share(column,
    /// row)` is the expected share of all positions in a cell [-].
    template <class Share>
    double chi_square_sigmas(Share share) const {
        double chi = 0;
        for (int row = 0; row < side_; ++row)
            for (int column = 0; column < side_; ++column) {
                const double expected = n_ * share(column, row);
                const double off = counts_[index(column, row)] - expected;
                chi += off * off / expected;
            }
        const double freedom = side_ * side_ - 1;
        return (chi - freedom) / std::sqrt(2 * freedom);
    }
    double uniform_chi_square_sigmas() const {
        return chi_square_sigmas([&](int, int) { return 1.0 / (side_ * side_); });
    }

  private:
    int cell(double x, double low, double high) const {
        return std::min(static_cast<int>((x - low) / (high - low) * side_), side_ - 1);
    }
    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row * side_ + column);
    }
    Vec3 lower_, upper_;
    int side_;
    double n_ = 0;
    std::vector<double> counts_;
};

}  // namespace rovernet::test
