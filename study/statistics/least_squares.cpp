// SPDX-License-Identifier: MIT
#include "study/statistics/least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

namespace rovernet {
namespace {

/// Columns of a matrix, as many as have a pivot, in the order of their pivots:  X P = Q R.
struct Factors {
    std::vector<std::size_t> columns;    // of X, in the order of R
    std::vector<std::vector<double>> R;  // R[j]: column j, down to the diagonal
    std::vector<double> Qty;             // the first rows of Q' y
};

double squares(std::span<const double> v) {
    return std::inner_product(v.begin(), v.end(), v.begin(), 0.0);
}

/// Reflects v by I - 2 w w' / (w' w).
void reflect(std::span<double> v, std::span<const double> w, double w2) {
    const double t = 2 * std::inner_product(v.begin(), v.end(), w.begin(), 0.0) / w2;
    for (std::size_t i = 0; i < v.size(); ++i) v[i] -= t * w[i];
}

Factors factor(const Observations& all, const std::vector<std::size_t>& used) {
    constexpr double least_pivot = 1e-9;  // of the first
    const std::size_t rows = all.rows();
    std::vector<std::vector<double>> X;  // by column
    for (const std::size_t j : used) {
        X.emplace_back();
        for (std::size_t i = 0; i < rows; ++i) X.back().push_back(all.row(i)[j]);
    }
    Factors out{.columns = used, .R = {}, .Qty = all.y};
    double first = 0;
    for (std::size_t k = 0; k < X.size() && k < rows; ++k) {
        const auto rest = [&](std::size_t j) { return std::span(X[j]).subspan(k); };
        std::size_t best = k;
        for (std::size_t j = k + 1; j < X.size(); ++j) {
            if (squares(rest(j)) > squares(rest(best))) best = j;
        }
        const double pivot = std::sqrt(squares(rest(best)));
        if (k == 0) first = pivot;
        if (!(pivot > least_pivot * first)) break;
        std::swap(X[k], X[best]);
        std::swap(out.columns[k], out.columns[best]);
        std::vector<double> w(rest(k).begin(), rest(k).end());
        w[0] += std::copysign(pivot, w[0]);
        const double w2 = squares(w);
        for (std::size_t j = k; j < X.size(); ++j) reflect(rest(j), w, w2);
        reflect(std::span(out.Qty).subspan(k), w, w2);
        out.R.emplace_back(X[k].begin(), X[k].begin() + static_cast<std::ptrdiff_t>(k) + 1);
    }
    out.columns.resize(out.R.size());
    return out;
}

/// Solves R b = v.
std::vector<double> solve(const std::vector<std::vector<double>>& R, std::vector<double> v) {
    v.resize(R.size());
    for (std::size_t k = R.size(); k-- > 0;) {
        v[k] /= R[k][k];
        for (std::size_t i = 0; i < k; ++i) v[i] -= R[k][i] * v[k];
    }
    return v;
}

/// (X' X)^-1 = R^-1 R^-T, row by row.
std::vector<std::vector<double>> inverse_gram(const std::vector<std::vector<double>>& R) {
    const std::size_t p = R.size();
    std::vector<std::vector<double>> inverse;  // column k of R^-1
    for (std::size_t k = 0; k < p; ++k) {
        std::vector<double> unit(p);
        unit[k] = 1;
        inverse.push_back(solve(R, unit));
    }
    std::vector<std::vector<double>> V(p, std::vector<double>(p));
    for (std::size_t i = 0; i < p; ++i)
        for (std::size_t j = 0; j < p; ++j)
            for (std::size_t k = std::max(i, j); k < p; ++k)
                V[i][j] += inverse[k][i] * inverse[k][j];
    return V;
}

void check(const Observations& all, const std::vector<bool>& not_below_0) {
    const auto finite = [](double v) { return std::isfinite(v); };
    if (all.rows() == 0 || all.columns == 0) {
        throw std::invalid_argument("least_squares: expected at least one row and one column");
    }
    if (all.x.size() != all.rows() * all.columns ||
        (!all.group.empty() && all.group.size() != all.rows()) ||
        (!not_below_0.empty() && not_below_0.size() != all.columns)) {
        throw std::invalid_argument(
            "least_squares: the numbers of values, groups or signs do not match the numbers of "
            "rows and columns");
    }
    if (!std::all_of(all.x.begin(), all.x.end(), finite) ||
        !std::all_of(all.y.begin(), all.y.end(), finite)) {
        throw std::invalid_argument("least_squares: numbers must be finite");
    }
}

std::uint32_t group_of(const Observations& all, std::size_t i) {
    return all.group.empty() ? 0 : all.group[i];
}

/// Standard errors of the fitted columns, in the order of the factors.
void add_errors(const Observations& all, const Factors& factors, LinearFit& fit) {
    const std::size_t p = factors.columns.size();
    const auto V = inverse_gram(factors.R);
    std::map<std::uint32_t, std::vector<double>> scores;  // by group: X_g' r_g
    for (std::size_t i = 0; i < all.rows(); ++i) {
        auto& score = scores[group_of(all, i)];
        score.resize(p);
        const double residual = all.y[i] - fit.predict(all.row(i));
        for (std::size_t k = 0; k < p; ++k) score[k] += all.row(i)[factors.columns[k]] * residual;
    }
    const double N = static_cast<double>(all.rows()), G = static_cast<double>(scores.size());
    const double small_sample = G / (G - 1) * (N - 1) / (N - static_cast<double>(p));
    for (std::size_t k = 0; k < p; ++k) {
        double between = 0;
        for (const auto& [group, score] : scores) {
            const double part = std::inner_product(score.begin(), score.end(), V[k].begin(), 0.0);
            between += part * part;
        }
        Coefficient& c = *fit.coefficients[factors.columns[k]];
        c.se_plain = fit.sigma * std::sqrt(V[k][k]);
        c.se_by_group =
            G > 1 ? std::sqrt(small_sample * between) : std::numeric_limits<double>::quiet_NaN();
    }
}

LinearFit fit_columns(const Observations& all, const std::vector<std::size_t>& used) {
    const Factors factors = factor(all, used);
    const std::vector<double> b = solve(factors.R, factors.Qty);
    LinearFit fit{.coefficients = std::vector<std::optional<Coefficient>>(all.columns),
                  .at_bound = std::vector<bool>(all.columns)};
    for (std::size_t k = 0; k < b.size(); ++k) {
        fit.coefficients[factors.columns[k]] = Coefficient{.value = b[k]};
    }
    double sse = 0;
    for (std::size_t i = 0; i < all.rows(); ++i) {
        const double residual = all.y[i] - fit.predict(all.row(i));
        sse += residual * residual;
    }
    const double N = static_cast<double>(all.rows()), p = static_cast<double>(b.size());
    fit.rmse = std::sqrt(sse / N);
    fit.sigma = std::sqrt(sse / (N - p));
    add_errors(all, factors, fit);
    return fit;
}

}  // namespace

double LinearFit::predict(std::span<const double> row) const {
    double sum = 0;
    for (std::size_t j = 0; j < coefficients.size(); ++j) {
        if (coefficients[j]) sum += coefficients[j]->value * row[j];
    }
    return sum;
}

LinearFit least_squares(const Observations& observations, const std::vector<bool>& not_below_0) {
    check(observations, not_below_0);
    std::vector<std::size_t> used(observations.columns);
    std::iota(used.begin(), used.end(), std::size_t{0});
    std::vector<std::size_t> held;
    for (;;) {
        LinearFit fit = fit_columns(observations, used);
        auto worst = used.end();
        for (auto j = used.begin(); j != used.end() && !not_below_0.empty(); ++j) {
            const auto value = [&](auto at) {
                const auto& c = fit.coefficients[*at];
                return c && not_below_0[*at] ? c->value : 0;
            };
            if (value(j) < (worst == used.end() ? 0 : value(worst))) worst = j;
        }
        if (worst == used.end()) {
            for (const std::size_t j : held) {
                fit.coefficients[j] = Coefficient{};
                fit.at_bound[j] = true;
            }
            return fit;
        }
        held.push_back(*worst);
        used.erase(worst);
    }
}

}  // namespace rovernet
