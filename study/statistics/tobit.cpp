// SPDX-License-Identifier: MIT
#include "study/statistics/tobit.hpp"

#include "sim/math.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace rovernet {
namespace {

constexpr double log_root_two_pi = 0.91893853320467274178;

/// log Phi(z), the normal distribution; and phi(z) / Phi(z).
struct Tail {
    double log_probability;
    double hazard;
};
Tail tail(double z) {
    const double log_density = -z * z / 2 - log_root_two_pi;
    if (z > -30) {
        const double log_probability = math::log(math::erfc(-z * (1 / std::numbers::sqrt2)) / 2);
        return {log_probability, math::exp(log_density - log_probability)};
    }
    // Phi(z) = phi(z) / -z (1 - 1 / z^2 + 3 / z^4 - ...); the next term is below 1e-8 of it.
    const double z2 = z * z;
    const double series = 1 - 1 / z2 + 3 / (z2 * z2) - 15 / (z2 * z2 * z2);
    return {log_density - math::log(-z) + math::log(series), -z / series};
}

/// What Newton's method needs of the log likelihood at (d, g) = (b / sigma, 1 / sigma).
struct Surface {
    double value = 0;
    std::vector<double> slope;
    std::vector<std::vector<double>> bend;  // minus the second derivatives
};

class Likelihood {
  public:
    Likelihood(const Observations& all, const std::vector<bool>& unseen)
        : all_(all), unseen_(unseen), size_(all.columns + 1) {}

    Surface at(const std::vector<double>& point) const {
        const double g = point.back();
        Surface out{0, std::vector<double>(size_),
                    std::vector<std::vector<double>>(size_, std::vector<double>(size_))};
        if (!(g > 0)) {
            out.value = -std::numeric_limits<double>::infinity();
            return out;
        }
        for (std::size_t i = 0; i < all_.rows(); ++i) {
            const auto x = all_.row(i);
            double middle = 0;
            for (std::size_t j = 0; j < x.size(); ++j) middle += x[j] * point[j];
            const double y = all_.y[i];
            const double z = g * y - middle;
            double pull = z, stiffness = 1;  // of the row: -d/dz and -d2/dz2
            if (unseen_[i]) {
                const Tail below = tail(z);
                out.value += below.log_probability;
                pull = -below.hazard;
                stiffness = below.hazard * (z + below.hazard);
            } else {
                out.value += math::log(g) - z * z / 2 - log_root_two_pi;
                out.slope.back() += 1 / g;
                out.bend.back().back() += 1 / (g * g);
            }
            // dz/d(point) is -x, and y for the last.
            const auto dz = [&](std::size_t j) { return j < x.size() ? -x[j] : y; };
            for (std::size_t j = 0; j < size_; ++j) {
                out.slope[j] -= pull * dz(j);
                for (std::size_t k = 0; k < size_; ++k) out.bend[j][k] += stiffness * dz(j) * dz(k);
            }
        }
        return out;
    }

  private:
    const Observations& all_;
    const std::vector<bool>& unseen_;
    std::size_t size_;
};

/// Solves A s = v by Cholesky's method; nothing if A is not positive definite.
std::optional<std::vector<double>> newton_step(std::vector<std::vector<double>> A,
                                               std::vector<double> v) {
    const std::size_t n = v.size();
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < j; ++k) A[j][j] -= A[j][k] * A[j][k];
        if (!(A[j][j] > 0)) return std::nullopt;
        A[j][j] = std::sqrt(A[j][j]);
        for (std::size_t i = j + 1; i < n; ++i) {
            for (std::size_t k = 0; k < j; ++k) A[i][j] -= A[i][k] * A[j][k];
            A[i][j] /= A[j][j];
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) v[i] -= A[i][k] * v[k];
        v[i] /= A[i][i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) v[i] -= A[k][i] * v[k];
        v[i] /= A[i][i];
    }
    return v;
}

void check_rows(const Observations& observations, const std::vector<bool>& unseen) {
    if (unseen.size() != observations.rows()) {
        throw std::invalid_argument("tobit: the list \"unseen\" must have one value for each row");
    }
    for (const double y : observations.y) {
        if (!std::isfinite(y)) throw std::invalid_argument("tobit: numbers must be finite");
    }
}

/// Point of least squares over the rows that are seen.
std::vector<double> starting_point(const Observations& observations,
                                   const std::vector<bool>& unseen) {
    Observations seen{.columns = observations.columns};
    for (std::size_t i = 0; i < observations.rows(); ++i) {
        if (!unseen[i]) seen.add(observations.row(i), observations.y[i]);
    }
    if (seen.rows() < observations.columns + 1) {
        throw std::invalid_argument("tobit: too few levels are above the floor");
    }
    const LinearFit start = least_squares(seen);
    const double g = 1 / std::max(start.rmse, 1e-6);
    std::vector<double> point;
    for (const auto& c : start.coefficients) point.push_back(c ? c->value * g : 0);
    point.push_back(g);
    return point;
}

std::vector<double> stepped(std::vector<double> point, const std::vector<double>& way,
                            double share) {
    for (std::size_t j = 0; j < point.size(); ++j) point[j] += share * way[j];
    return point;
}

/// Moves a point to the maximum by Newton's steps, each halved until it leads up.
/// @return value there
double climb(const Likelihood& likelihood, std::vector<double>& point) {
    Surface here = likelihood.at(point);
    constexpr int most_steps = 200;
    for (int step = 0; step < most_steps; ++step) {
        const auto way = newton_step(here.bend, here.slope);
        if (!way) throw std::invalid_argument("tobit: the columns are linearly dependent");
        double gain = 0;
        for (std::size_t j = 0; j < way->size(); ++j) gain += (*way)[j] * here.slope[j];
        if (gain < 1e-18 * (1 + std::abs(here.value))) break;
        double share = 1;
        std::vector<double> next = stepped(point, *way, share);
        Surface there = likelihood.at(next);
        for (; !(there.value > here.value) && share > 1e-6; share /= 2) {
            next = stepped(point, *way, share);
            there = likelihood.at(next);
        }
        if (!(there.value > here.value)) break;
        point = std::move(next);
        here = std::move(there);
    }
    return here.value;
}

}  // namespace

TobitFit tobit(const Observations& observations, const std::vector<bool>& unseen) {
    check_rows(observations, unseen);
    std::vector<double> point = starting_point(observations, unseen);
    const double highest = climb(Likelihood(observations, unseen), point);
    TobitFit fit{
        .coefficients = {}, .sigma = 1 / point.back(), .negative_log_likelihood = -highest};
    for (std::size_t j = 0; j + 1 < point.size(); ++j) {
        fit.coefficients.push_back(point[j] / point.back());
    }
    return fit;
}

}  // namespace rovernet
