// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

// Gamma distribution, for Nakagami fading. The functions are based on sim/math.hpp, so that every
// compiler gives the same bits.

namespace rovernet {

/// Logarithm of the gamma function, for x >= 0.5; relative error of gamma below 1e-13.
///
/// Source: Stirling's series, NIST Digital Library of Mathematical Functions, 5.11.1.
double log_gamma(double x);

/// -log Q(m, y) for m >= 0.5 and y > 0, with the regularised upper incomplete gamma function Q: the
/// probability that a gamma variate of shape m and scale 1 exceeds y.
///
/// Sources: NIST Digital Library of Mathematical Functions: the series 8.11.4 for small y, the
/// continued fraction 8.9.2 otherwise.
double minus_log_gamma_q(double m, double y);

/// Solution y > 0 of minus_log_gamma_q(m, y) = p, for p >= 1e-290; relative error below 1e-12. The
/// function transforms a standard exponential variate p into a gamma variate of shape m.
double gamma_of_exponential(double m, double p);

/// Table of gamma_of_exponential(m, p) for one shape m, as a function of the exponential variate p.
/// The table interpolates cubically in log p with a relative error of 1e-6. A look-up is 30 times
/// as fast as the function.
class GammaTable {
  public:
    explicit GammaTable(double m);
    /// Gamma variate y for a standard exponential variate p from 1e-20 to 20; for larger p the
    /// value at 20.
    double operator()(double p) const;

  private:
    // Support point of the table. p is the exponential variate of the point, and y is the gamma
    // variate of p. The point has log y, and the derivative of log y with respect to log p, times
    // the spacing of the points in log p.
    struct Edge {
        double log_y, slope;
    };
    std::vector<Edge> edges_;
};

}  // namespace rovernet
