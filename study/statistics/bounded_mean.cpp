// SPDX-License-Identifier: MIT
#include "study/statistics/bounded_mean.hpp"

#include "sim/math.hpp"
#include "study/statistics/scaled_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

constexpr std::size_t gamblers = 16;
using Gamblers = std::array<double, gamblers>;

constexpr int steps_to_end = 40;  // of [0, 1]: to 1e-12
constexpr double infinity = std::numeric_limits<double>::infinity();

Gamblers chebyshev_shares() {
    Gamblers shares{};
    for (std::size_t k = 0; k < gamblers; ++k) {
        const double angle = static_cast<double>(2 * k + 1) * std::numbers::pi / (2 * gamblers);
        shares[k] = (1 - math::sincos(angle).cos) / 2;
    }
    return shares;
}

/// Share of his money that each gambler stakes in every round [-].
const Gamblers& shares() {
    static const Gamblers values = chebyshev_shares();
    return values;
}

/// Whether the total wealth of the gamblers who bet on "above m" has reached `enough` at some time.
bool ever_rich(std::span<const double> values, double m, double enough) {
    constexpr double ruined = 1e-250;  // less is dropped: subnormal numbers are slow
    const Gamblers& share = shares();
    Gamblers wealth;
    wealth.fill(1.0 / gamblers);
    for (const double x : values) {
        const double gain = x / m - 1;
        double sum = 0;
        for (std::size_t k = 0; k < gamblers; ++k) {
            const double w = wealth[k] * (1 + share[k] * gain);
            wealth[k] = w < ruined ? 0 : w;
            sum += wealth[k];
        }
        if (sum >= enough) return true;
    }
    return false;
}

/// The lower end for values in [0, 1]: every m below it has been refuted.
double betting_lower_end(std::span<const double> values, double enough) {
    double low = 0, high = 1;
    for (int i = 0; i < steps_to_end; ++i) {
        const double m = (low + high) / 2;
        (ever_rich(values, m, enough) ? low : high) = m;
    }
    return low;
}

/// The wealth at which m is refuted, one of two sides.
double enough_for(double confidence) { return 2 / (1 - confidence); }

/// Growth of each gambler's wealth by value, its logarithm, when he bets on "above m".
Gamblers growth(std::span<const double> values, double m) {
    Gamblers result{};
    for (std::size_t k = 0; k < gamblers; ++k) {
        double product = 1, sum = 0;
        for (const double x : values) {
            product *= 1 + shares()[k] * (x / m - 1);
            if (product > 1e-100 && product < 1e100) continue;
            sum += math::log(product);
            product = 1;
        }
        result[k] = (sum + math::log(product)) / static_cast<double>(values.size());
    }
    return result;
}

/// Number of values like these after which m is refuted; infinitely many if their mean is not above
/// it.
double values_to_refute(std::span<const double> values, double m, double enough) {
    if (m <= 0) return 0;
    const Gamblers rate = growth(values, m);
    const auto rich_after = [&](double n) {
        double sum = 0;
        for (const double each : rate) sum += math::exp(std::min(n * each, 700.0)) / gamblers;
        return sum >= enough;
    };
    constexpr double most = 1e12;
    if (!rich_after(most)) return infinity;
    double few = 0, many = most;
    while (many - few > 0.5) {
        const double middle = (few + many) / 2;
        (rich_after(middle) ? many : few) = middle;
    }
    return many;
}

}  // namespace

BoundedMean bounded_mean(std::span<const double> values, const Bounds& bounds, double confidence) {
    const ScaledValues x = scaled_values(values, bounds, confidence, "bounded_mean");
    const double enough = enough_for(confidence);
    double low = betting_lower_end(x.values, enough);
    double high = 1 - betting_lower_end(x.mirrored, enough);
    if (low > high) std::swap(low, high);  // no m is left: the values have drifted
    const double mean = x.mean();
    return {x.unscaled(std::min(low, mean)), x.unscaled(std::max(high, mean))};
}

std::optional<std::size_t> bounded_mean_replications(std::span<const double> values,
                                                     const Bounds& bounds, double wanted,
                                                     double confidence) {
    const ScaledValues x = scaled_values(values, bounds, confidence, "bounded_mean");
    if (!(wanted > 0)) {
        throw std::invalid_argument(
            fmt::format("bounded_mean_replications: the half-width must be > 0, got {}", wanted));
    }
    const double enough = enough_for(confidence);
    const double mean = x.mean();
    // The ends mean - below and mean + above, below + above = width, that take as many values.
    const double width = 2 * wanted / x.width;
    double low = 0, high = width, needed = infinity;
    for (int i = 0; i < steps_to_end && needed > 0; ++i) {
        const double below = (low + high) / 2;
        const double down = values_to_refute(x.values, mean - below, enough);
        const double up = values_to_refute(x.mirrored, 1 - mean - (width - below), enough);
        needed = std::min(needed, std::max(down, up));
        (down > up ? low : high) = below;
    }
    constexpr double most = 1e9;
    if (needed > most) return std::nullopt;
    return std::max(values.size(), static_cast<std::size_t>(std::ceil(needed)));
}

}  // namespace rovernet
