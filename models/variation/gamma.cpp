// SPDX-License-Identifier: MIT
#include "models/variation/gamma.hpp"

#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rovernet {
namespace {

constexpr double precision = 1e-16;

/// Logarithm of y^m e^-y / Gamma(m).
double log_density(double m, double y) { return m * math::log(y) - y - log_gamma(m); }

/// Lower function P(m, y) by its series, accurate for y < m + 1.
double gamma_p(double m, double y) {
    double term = 1 / m, sum = term;
    for (double k = m + 1; term > precision * sum; ++k) sum += term *= y / k;
    return sum * math::exp(log_density(m, y));
}

/// Ratio of Q(m, y) to its density, by the continued fraction (modified Lentz), accurate for y >= m
/// + 1.
double gamma_q_ratio(double m, double y) {
    double b = y + 1 - m, c = 1e300, d = 1 / b, ratio = d;
    for (double i = 1; i < 10000; ++i) {
        const double a = -i * (i - m);
        b += 2;
        d = 1 / (a * d + b);
        c = b + a / c;
        const double step = c * d;
        ratio *= step;
        if (std::abs(step - 1) < precision) break;
    }
    return ratio;
}

/// Slope of log p with respect to log y, with p = -log Q(m, y).
double log_slope(double m, double y, double p) { return math::exp(log_density(m, y) + p) / p; }

// Range of log p in a GammaTable, and number of its cells.
constexpr double first = -46.06, last = 3;
constexpr std::size_t cells = 512;
constexpr double cell_width = (last - first) / cells;

}  // namespace

double log_gamma(double x) {
    double shift = 0;
    for (; x < 10; ++x) shift += math::log(x);
    const double r = 1 / (x * x);
    const double series =
        (1.0 / 12 - r * (1.0 / 360 -
                         r * (1.0 / 1260 - r * (1.0 / 1680 - r * (1.0 / 1188 - r * (691.0 / 360360 -
                                                                                    r / 156)))))) /
        x;
    constexpr double half_log_turn = 0.91893853320467274178;
    return (x - 0.5) * math::log(x) - x + half_log_turn + series - shift;
}

double minus_log_gamma_q(double m, double y) {
    if (y < m + 1) return -math::log1p(-gamma_p(m, y));
    return -log_density(m, y) - math::log(gamma_q_ratio(m, y));
}

double gamma_of_exponential(double m, double p) {
    // Newton's method for log p as a function of log y, which is nearly linear: of slope m for
    // small p.
    double log_y = (math::log(p) + log_gamma(m + 1)) / m;
    if (log_y > math::log(m)) log_y = math::log(m + p);
    for (int i = 0; i < 60; ++i) {
        const double y = math::exp(log_y);
        const double here = minus_log_gamma_q(m, y);
        const double step = math::log(here / p) / log_slope(m, y, here);
        log_y -= step;
        if (std::abs(step) < 1e-14) break;
    }
    return math::exp(log_y);
}

GammaTable::GammaTable(double m) {
    edges_.reserve(cells + 1);
    for (std::size_t i = 0; i <= cells; ++i) {
        const double p = math::exp(first + static_cast<double>(i) * cell_width);
        const double y = gamma_of_exponential(m, p);
        edges_.push_back({math::log(y), cell_width / log_slope(m, y, p)});
    }
}

double GammaTable::operator()(double p) const {
    const double place = std::clamp((math::log(p) - first) / cell_width, 0.0, double{cells});
    const std::size_t i = std::min(static_cast<std::size_t>(place), cells - 1);
    const double t = place - static_cast<double>(i);
    const Edge &a = edges_[i], &b = edges_[i + 1];
    const double rise = b.log_y - a.log_y;
    const double bend = a.slope - rise, other_bend = rise - b.slope;
    return math::exp(a.log_y + t * rise + t * (1 - t) * ((1 - t) * bend + t * other_bend));
}

}  // namespace rovernet
