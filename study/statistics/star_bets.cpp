// SPDX-License-Identifier: MIT
#include "study/statistics/star_bets.hpp"

#include "sim/math.hpp"
#include "study/statistics/scaled_values.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace rovernet {
namespace {

/// Values so far and half a value at each bound, as the stakes see them.
class Past {
  public:
    explicit Past(double m) : m_(m) {}

    void add(double x) { offsets_.push_back(x - m_); }

    /// Variance about m of the distribution of mean m that is nearest to these values.
    double variance() {
        tilt();
        const auto add_to = [this](double& sum, double weight, double offset) {
            sum += weight * offset * offset / (1 + kappa_ * offset);
        };
        double squares = 0;
        add_to(squares, 0.5, -m_);
        add_to(squares, 0.5, 1 - m_);
        for (const double offset : offsets_) add_to(squares, 1, offset);
        return squares / (static_cast<double>(offsets_.size()) + 1);
    }

  private:
    struct Slope {
        double value, derivative;  ///< derivative <= 0
    };
    /// Mean offset of the tilted values, and how it changes with kappa.
    Slope slope(double kappa) const {
        Slope sum{0, 0};
        const auto add_to = [&](double weight, double offset) {
            const double tilted = offset / (1 + kappa * offset);
            sum.value += weight * tilted;
            sum.derivative -= weight * tilted * tilted;
        };
        add_to(0.5, -m_);
        add_to(0.5, 1 - m_);
        for (const double offset : offsets_) add_to(1, offset);
        return sum;
    }
    /// Finds kappa in [0, 1 / m) by Newton's method, kept in a bracket.
    void tilt() {
        constexpr int most_steps = 40;
        constexpr double accuracy = 0.01;  // a stake needs no more
        double low = 0, high = 1 / m_;
        if (slope(0).value <= 0) {
            kappa_ = 0;
            return;
        }
        for (int i = 0; i < most_steps; ++i) {
            const auto [value, derivative] = slope(kappa_);
            (value > 0 ? low : high) = kappa_;
            double next = kappa_ - value / derivative;
            if (!(next > low && next < high)) next = (low + high) / 2;
            const double step = std::abs(next - kappa_);
            kappa_ = next;
            if (step <= accuracy * (1 / m_ - kappa_)) break;
        }
    }

    double m_;
    double kappa_ = 0;
    std::vector<double> offsets_;  // x - m
};

/// Gambler against "the mean is at most m" in n rounds.
class Gambler {
  public:
    Gambler(double m, std::size_t rounds, double level)
        : m_(m), enough_(1 / level), left_(rounds), past_(m) {}

    /// Stake on the next value being above m.
    double stake() {
        if (seen_ >= next_look_) {
            variance_ = past_.variance();
            next_look_ = seen_ + std::max<std::size_t>(1, seen_ / 4);
        }
        if (left_ == 1 || !(wealth_ > 0)) return 1 / m_;
        const double wanted = 2 * math::log(enough_ / wealth_);
        return std::min(std::sqrt(wanted / (static_cast<double>(left_) * variance_)), 1 / m_);
    }
    void see(double x, double stake) {
        wealth_ *= std::max(0.0, 1 + stake * (x - m_));
        past_.add(x);
        ++seen_;
        --left_;
    }
    bool rich() const { return wealth_ >= enough_; }

  private:
    double m_, enough_;
    double wealth_ = 1, variance_ = 1;
    std::size_t left_, seen_ = 0, next_look_ = 0;
    Past past_;
};

/// Whether a gambler with these stakes on "above m" has 1 / level at some time.
bool ever_rich(std::span<const double> values, std::span<const double> stakes, double m,
               double level) {
    double wealth = 1;
    for (std::size_t i = 0; i < values.size(); ++i) {
        wealth *= std::max(0.0, 1 + stakes[i] * (values[i] - m));
        if (wealth * level >= 1) return true;
    }
    return false;
}

/// Lower end of the interval for the mean of values in [0, 1]: every m below it is refuted.
double star_bets_lower_end(std::span<const double> values, double level) {
    constexpr std::size_t coarsest_cells = 128, finest_cells = 512;  // both even: 1/2 is an end
    const std::size_t n = values.size();
    const std::size_t cells = std::clamp(2 * n, coarsest_cells, finest_cells);
    std::vector<double> stakes(n);
    for (std::size_t cell = 1; cell <= cells; ++cell) {
        const double end = static_cast<double>(cell) / static_cast<double>(cells);
        Gambler gambler(end, n, level);
        for (std::size_t i = 0; i < n && !gambler.rich(); ++i) {
            stakes[i] = gambler.stake();
            gambler.see(values[i], stakes[i]);
        }
        if (gambler.rich()) continue;
        constexpr int bisections = 32;
        double low = static_cast<double>(cell - 1) / static_cast<double>(cells), high = end;
        for (int i = 0; i < bisections; ++i) {
            const double m = (low + high) / 2;
            (ever_rich(values, stakes, m, level) ? low : high) = m;
        }
        return low;
    }
    return 1;
}

}  // namespace

bool star_refutes(std::span<const double> values, double m, double level) {
    Gambler gambler(m, values.size(), level);
    for (const double x : values) {
        gambler.see(x, gambler.stake());
        if (gambler.rich()) return true;
    }
    return false;
}

BoundedMean star_mean(std::span<const double> values, const Bounds& bounds, double confidence) {
    const ScaledValues x = scaled_values(values, bounds, confidence, "star_mean");
    const double level = (1 - confidence) / 2;
    double low = star_bets_lower_end(x.values, level),
           high = 1 - star_bets_lower_end(x.mirrored, level);
    if (low > high) std::swap(low, high);  // no m is left: the values have drifted
    const double mean = x.mean();
    return {x.unscaled(std::min(low, mean)), x.unscaled(std::max(high, mean))};
}

}  // namespace rovernet
