// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

// The gamma distribution, for Nakagami fading: on sim/math.hpp, so that its bits are the same from
// every compiler.

namespace rovernet {

/// Logarithm of the gamma function, for x >= 0.5; relative error of gamma below 1e-13.
///
/// Source: Stirling's series, NIST Digital Library of Mathematical Functions, 5.11.1.
double log_gamma(double x);

/// -log Q(m, y) for m >= 0.5 and y > 0, with Q the regularised upper incomplete gamma function: the
/// probability that a gamma variate of shape m and scale 1 exceeds y is e to the minus that.
///
/// Sources: the series DLMF 8.11.4 for small y, the continued fraction DLMF 8.9.2 otherwise.
double minus_log_gamma_q(double m, double y);

/// y > 0 with -log Q(m, y) = p, for p > 0 that is no smaller than 1e-290; relative error below
/// 1e-12. A standard exponential p so becomes a gamma variate of shape m.
double gamma_of_exponential(double m, double p);

/// Table of gamma_of_exponential() for one m: cubic in log p, within a relative error of 1e-6, and
/// 30 times as fast.
class GammaTable {
  public:
    explicit GammaTable(double m);
    /// y for p from 1e-20 to 20; beyond 20 it is that for 20.
    double operator()(double p) const;

  private:
    // log y at the edge of a cell, and its slope over log p, in cells.
    struct Edge {
        double log_y, slope;
    };
    std::vector<Edge> edges_;
};

}  // namespace rovernet
