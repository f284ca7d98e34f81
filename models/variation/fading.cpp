// SPDX-License-Identifier: MIT
#include "models/variation/fades.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace rovernet {
namespace {

constexpr double rarest = 1e-6;    // of fades that are cut
constexpr double deepest = 1e-20;  // power, so that its logarithm is finite

/// Poisson probabilities, from 0 up, and their cumulative sums.
class Poisson {
  public:
    explicit Poisson(double mean) : mean_(mean), log_here_(-mean), here_(math::exp(-mean)) {
        up_to_here_ = here_;
    }
    double here() const { return here_; }
    double up_to_here() const { return up_to_here_; }
    void next() {
        log_here_ += math::log(mean_ / ++n_);
        here_ = math::exp(log_here_);
        up_to_here_ += here_;
    }

  private:
    double mean_, log_here_, here_, up_to_here_ = 0, n_ = 0;
};

/// Probabilities that a Rician power is below x and above x: 2 (K + 1) x is a noncentral chi-square
/// variate with two degrees of freedom, a Poisson mixture of gamma variates.
struct Tails {
    double below = 0, above = 0;
};
Tails rician_tails(double k, double x) {
    const double y = (k + 1) * x, larger = std::max(k, y);
    const double last = larger + 12 * std::sqrt(larger) + 60;
    Tails tails;
    Poisson sight(k), power(y);
    for (double n = 0; n < last; ++n) {
        tails.above += sight.here() * power.up_to_here();
        power.next();
        tails.below += power.here() * sight.up_to_here();
        sight.next();
    }
    return tails;
}

double rician_quantile(double k, double p) {
    double low = -30, high = 3.1;  // logarithms of powers; of rayleigh's 1 - 1e-9 it is 3.03
    for (int i = 0; i < 64; ++i) {
        const double middle = (low + high) / 2;
        const Tails tails = rician_tails(k, math::exp(middle));
        const bool too_low = p < 0.5 ? tails.below < p : tails.above > 1 - p;
        (too_low ? low : high) = middle;
    }
    return math::exp((low + high) / 2);
}

/// Bessel function J0(x), x >= 0, to 1e-7: M. Abramowitz and I. Stegun, 9.4.1 and 9.4.3.
double bessel_j0(double x) {
    if (x < 3) {
        const double t = x * x / 9;
        return 1 + t * (-2.2499997 +
                        t * (1.2656208 +
                             t * (-0.3163866 + t * (0.0444479 + t * (-0.0039444 + t * 0.00021)))));
    }
    const double t = 3 / x;
    const double size =
        0.79788456 +
        t * (-0.00000077 +
             t * (-0.0055274 +
                  t * (-0.00009512 + t * (0.00137237 + t * (-0.00072805 + t * 0.00014476)))));
    const double phase =
        x - 0.78539816 +
        t * (-0.04166397 +
             t * (-0.00003954 +
                  t * (0.00262573 + t * (-0.00054125 + t * (-0.00029333 + t * 0.00013558)))));
    return size * math::sincos(phase).cos / std::sqrt(x);
}

PairWaves::Wave unit_wave(Key key) {
    const auto draw = [&](std::uint64_t index) {
        key.index = index;
        return uniform(key);
    };
    constexpr double turn = 2 * std::numbers::pi;
    const auto at_a = math::sincos(turn * draw(0)), at_b = math::sincos(turn * draw(1));
    return {at_a.cos, at_a.sin, at_b.cos, at_b.sin, draw(2)};
}

}  // namespace

double Fading::quantile(double p) const {
    if (model == FadingModel::rician) return rician_quantile(math::exp10(k_factor.value / 10), p);
    const double exponential = -math::log1p(-p);
    if (model == FadingModel::nakagami) return gamma_of_exponential(m, exponential) / m;
    return exponential;
}

Fades::Fades(const Fading& settings, std::uint64_t seed, std::uint32_t replication)
    : settings_(settings), draws_(seed, replication, Purpose::frame_fading) {
    check_fields(settings, "fading");
    most_ = Db{10 * math::log10(settings.quantile(1 - rarest))};
    if (settings.model == FadingModel::rician) {
        const double k = math::exp10(settings.k_factor.value / 10);
        direct_ = std::sqrt(k / (k + 1));
        scattered_ = std::sqrt(1 / (k + 1));
    }
    const bool of_places = settings.coherence == Coherence::place;
    if (settings.model == FadingModel::nakagami) {
        if (of_places) parts_ = std::max(1.0, std::floor(2 * settings.m + 0.5));
        if (!of_places || parts_ != 2 * settings.m) gamma_.emplace(settings.m);
    }
    if (!of_places) return;
    for (std::uint64_t field = 0; 2 * static_cast<double>(field) < parts_; ++field) {
        fields_.emplace_back([&](std::size_t number) {
            return unit_wave({.seed = seed,
                              .replication = replication,
                              .purpose = Purpose::place_fading,
                              .a = number,
                              .b = field});
        });
    }
}

Fades::Scale Fades::scale(const Frame& frame) const {
    const double per_metre = frame.frequency.value / speed_of_light;
    const double dx = frame.from.x - frame.to.x, dy = frame.from.y - frame.to.y;
    const double turns = std::sqrt(dx * dx + dy * dy) * per_metre;
    const double both = bessel_j0(std::min(2 * std::numbers::pi * turns, 1e9));
    return {per_metre, 1 / std::sqrt(2 * PairWaves::count * (1 + both * both))};
}

/// Complex amplitude z of all waves without the line of sight.
PairWaves::Value Fades::scattered(const Frame& frame) const {
    if (fields_.empty()) {
        const double power = -math::log(draws_.uniform(frame.key, frame.receiver));
        const double turns = draws_.uniform(combine(frame.key, 1), frame.receiver);
        const double size = std::sqrt(power);
        return {size * cos_of_turns(turns), size * cos_of_turns(turns - 0.25)};
    }
    const auto [per_metre, size] = scale(frame);
    const auto [re, im] = fields_.front().complex(frame.from, frame.to, per_metre);
    return {size * re, size * im};
}

/// Sum of the squares of parts_ real fields, a gamma variate of shape parts_ / 2: unchanged, or
/// transformed to shape m by its probability.
double Fades::nakagami_of_places(const Frame& frame) const {
    const auto [per_metre, size] = scale(frame);
    double sum = 0, parts = parts_;
    for (const PairWaves& field : fields_) {
        const auto [re, im] = field.complex(frame.from, frame.to, per_metre);
        sum += parts > 1 ? re * re + im * im : re * re;
        parts -= 2;
    }
    const double power = std::max(size * size * sum, deepest);
    if (!gamma_) return power / settings_.m;
    return (*gamma_)(minus_log_gamma_q(parts_ / 2, power)) / settings_.m;
}

double Fades::power(const Frame& frame) const {
    const bool adds_fields = settings_.model == FadingModel::nakagami && !fields_.empty();
    if (adds_fields) return nakagami_of_places(frame);
    auto [re, im] = scattered(frame);
    if (settings_.model == FadingModel::rician) {
        const double turns =
            distance(frame.from, frame.to) * frame.frequency.value / speed_of_light;
        re = scattered_ * re + direct_ * cos_of_turns(turns);
        im = scattered_ * im + direct_ * cos_of_turns(turns - 0.25);
    }
    const double power = std::max(re * re + im * im, deepest);
    return gamma_ ? (*gamma_)(power) / settings_.m : power;
}

Db Fades::gain(const Frame& frame) const {
    return {std::min(most_.value, 10 * math::log10(std::max(power(frame), deepest)))};
}

}  // namespace rovernet
