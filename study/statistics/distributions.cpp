// SPDX-License-Identifier: MIT
#include "study/statistics/distributions.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <cstdint>

namespace rovernet {
namespace {

constexpr double greatest_critical = 1e4;  // beyond, Boost's series get long, and fail from 1e5 on

double power_of(double shift, double degrees, double critical) {
    const boost::math::non_central_t shifted(degrees, shift);
    return cdf(complement(shifted, critical)) + cdf(shifted, -critical);
}

boost::math::binomial successes(std::size_t n, double p) {
    return boost::math::binomial(static_cast<double>(n), p);
}

}  // namespace

double t_critical(double degrees, double level) {
    return quantile(complement(boost::math::students_t(degrees), level / 2));
}

double t_exceeded(double degrees, double t) {
    return 2 * cdf(complement(boost::math::students_t(degrees), std::abs(t)));
}

std::optional<double> t_shift(double degrees, double level, double power) {
    const double critical = t_critical(degrees, level);
    if (critical > greatest_critical) return std::nullopt;
    double low = 0, high = 1;
    while (power_of(high, degrees, critical) < power) {
        low = high;
        high *= 2;
    }
    const auto excess = [&](double shift) { return power_of(shift, degrees, critical) - power; };
    std::uintmax_t steps = 100;
    const boost::math::tools::eps_tolerance<double> last_digits(51);
    return boost::math::tools::toms748_solve(excess, low, high, last_digits, steps).second;
}

double binomial_at_most(std::size_t k, std::size_t n, double p) {
    return cdf(successes(n, p), static_cast<double>(k));
}

double binomial_above(std::size_t k, std::size_t n, double p) {
    return cdf(complement(successes(n, p), static_cast<double>(k)));
}

}  // namespace rovernet
