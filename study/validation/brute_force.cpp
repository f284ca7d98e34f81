// SPDX-License-Identifier: MIT
#include "models/propagation/ray_tracer.hpp"
#include "models/variation/fades.hpp"
#include "models/variation/shadowing_field.hpp"
#include "scene/scene.hpp"
#include "sim/math.hpp"
#include "study/calibration/disc_fit.hpp"
#include "study/statistics/equivalence.hpp"
#include "study/statistics/least_squares.hpp"
#include "study/statistics/tobit.hpp"
#include "study/validation/validation_charts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

// Numbers that a sum over everything, a mean over many draws, or a solution by hand gives as well.

namespace rovernet {
namespace {

/// Room whose lower left corner is (0, 0), with the two ends of a link.
struct Room {
    double width, depth;  // [m]
    Vec3 from, to;
};

/// A room between walls one cell thick.
Scene walls_of(const Room& room) {
    constexpr double cell = 0.5;
    OccupancyGrid grid;
    grid.columns = static_cast<int>(room.width / cell) + 2;
    grid.rows = static_cast<int>(room.depth / cell) + 2;
    grid.cell_width = grid.cell_height = cell;
    grid.origin = {-cell, -cell};
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column) {
            const bool edge =
                row == 0 || row + 1 == grid.rows || column == 0 || column + 1 == grid.columns;
            grid.cells.push_back(edge ? Cell::occupied : Cell::free);
        }
    return Scene(grid);
}

/// Power [1/m^2] over the paths of up to `order` reflections, each of which keeps half of it.
double power_by_images(const Room& room, int order) {
    const auto image = [](int m, double size, double at) {
        return m % 2 == 0 ? m * size + at : (m + 1) * size - at;
    };
    double sum = 0;
    for (int m = -order; m <= order; ++m) {
        const int rest = order - std::abs(m);
        for (int n = -rest; n <= rest; ++n) {
            const Vec3 to{image(m, room.width, room.to.x), image(n, room.depth, room.to.y),
                          room.to.z};
            sum += std::ldexp(1 / squared_distance(room.from, to), -std::abs(m) - std::abs(n));
        }
    }
    return sum;
}

double power_by_tracer(const Room& room, int order) {
    constexpr double wavelength = 0.1;  // [m]
    const Scene scene = walls_of(room);
    RayTracer tracer(scene, room.from, order, wavelength);
    RayPaths paths;
    tracer.trace(room.to, nullptr, paths);
    double sum = 0;
    for (const RayPath& path : paths.paths) {
        const auto reflections = static_cast<int>(paths.hits(path).size());
        sum += std::ldexp(1 / (path.length * path.length), -reflections);
    }
    return sum;
}

Promise rooms() {
    constexpr double limit = 1e-9;  // [dB]
    Promise out{"sum of the powers of all ray paths in a room, against a sum over image sources",
                "dB", limit, 0, 0};
    for (const Room& room :
         {Room{6, 4, {1, 1, 1}, {4.5, 3, 1.5}}, Room{10, 7.5, {0.3, 7, 1}, {9.1, 0.4, 1}},
          Room{30, 2.5, {1.2, 1.1, 2}, {28, 1.9, 1}}}) {
        for (const int order : {0, 1, 2, 3, 6}) {
            const double ratio = power_by_tracer(room, order) / power_by_images(room, order);
            out.add(10 * math::log10(ratio));
        }
    }
    return out;
}

/// Correlation over seeds of the field for ends 50 m apart, as one end moves by `moved` [m].
double field_correlation(double moved, std::uint32_t seeds) {
    double xx = 0, yy = 0, xy = 0;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        const ShadowingField field(Meters{10}, seed, 0);
        const double angle = 2 * std::numbers::pi * validation_draw("field", seed, 0);
        const auto [sine, cosine] = math::sincos(angle);
        const double x = field({0, 0, 0}, {50, 0, 0});
        const double y = field({0, 0, 0}, {50 + moved * cosine, moved * sine, 0});
        xx += x * x;
        yy += y * y;
        xy += x * y;
    }
    return xy / std::sqrt(xx * yy);
}

Promise shadowing_field() {
    constexpr double limit = 0.03;
    constexpr std::uint32_t seeds = 20'000;
    Promise out{
        "correlation of the shadowing field over a distance D, against exp(-D / d_cor) with the "
        "decorrelation distance d_cor",
        "", limit, 0, 0};
    for (const double moved : {1.0, 5.0, 10.0, 20.0, 40.0}) {
        out.add(field_correlation(moved, seeds) - math::exp(-moved / 10));
    }
    return out;
}

/// A line through four points: its slope 3/5, its intercept 1/2, and the squares left, 1/5.
Promise fitted_lines() {
    constexpr double limit = 1e-12;
    Observations points{.columns = 2};
    for (const auto& [x, y] : {std::pair{1.0, 1.0}, {2.0, 2.0}, {3.0, 2.0}, {4.0, 3.0}})
        points.add(std::vector{1.0, x}, y);
    const LinearFit line = least_squares(points);
    double worst = std::abs(line.rmse - std::sqrt(0.05));
    for (const auto& [column, truth] : {std::pair{0U, 0.5}, {1U, 0.6}}) {
        const auto& found = line.coefficients[column];
        const double error =
            found ? std::abs(found->value - truth) : std::numeric_limits<double>::infinity();
        worst = std::max(worst, error);
    }
    return {"line fitted by least squares, against a line computed by hand", "", limit, worst, 3};
}

/// With nothing unseen the most likely line is that of least squares.
Promise seen_levels() {
    constexpr double limit = 1e-9;
    Observations points{.columns = 2};
    for (const auto& [x, y] : {std::pair{1.0, 1.0}, {2.0, 2.0}, {3.0, 2.0}, {4.0, 3.0}})
        points.add(std::vector{1.0, x}, y);
    const TobitFit line = tobit(points, std::vector<bool>(points.rows()));
    const double worst =
        std::max({std::abs(line.coefficients[0] - 0.5), std::abs(line.coefficients[1] - 0.6),
                  std::abs(line.sigma - std::sqrt(0.05))});
    return {
        "line fitted by Tobit regression without missing levels, against a line of least squares "
        "computed by hand",
        "", limit, worst, 3};
}

/// Wrong decisions of the disc that was found, beyond those of the best of all.
Promise discs() {
    Promise out{
        "number of links that the fitted disc decides wrongly, against the smallest such number "
        "that a disc can have",
        "", 0, 0, 0};
    for (std::uint64_t set = 0; set < 20; ++set) {
        std::vector<DiscLink> links;
        for (std::uint64_t i = 0; i < 40; ++i) {
            const double distance = 1 + 29 * validation_draw("disc", set, 2 * i);
            links.push_back(
                {distance, distance + 20 * validation_draw("disc", set, 2 * i + 1) < 25});
        }
        const auto wrong = [&](double range) {
            return std::count_if(links.begin(), links.end(), [&](const DiscLink& link) {
                return link.up != (link.distance <= range);
            });
        };
        auto best = wrong(0);
        for (const DiscLink& link : links) best = std::min(best, wrong(link.distance));
        out.add(static_cast<double>(wrong(fit_disc(links).range.value) - best));
    }
    return out;
}

/// Downward crossings of levels as one end of a link drives, against
/// N / f_D = sqrt(2 pi) m^(m - 1/2) / Gamma(m) rho^(2 m - 1) e^(-m rho^2) per wavelength, by
/// M. D. Yacoub, J. E. V. Bautista and L. Guedes, IEEE Trans. Vehicular Technology 48(3), 1999.
Promise level_crossings() {
    constexpr std::uint64_t seeds = 60;
    constexpr int steps = 8'000;
    constexpr double step = 0.015;  // wavelengths
    constexpr Hertz frequency{2450e6};
    constexpr double limit = 0.2;  // of 60 fields of 32 waves; 270 crossings of -15 dB by m = 2
    Promise out{
        "rate at which nakagami fading (m = 1 and 2, coherence = \"place\") crosses a level, "
        "against the closed form (relative error)",
        "", limit, 0, 0};
    for (const double m : {1.0, 2.0}) {                     // Gamma(m) = 1
        const std::vector<double> levels{-15, -10, -5, 0};  // [dB]
        std::vector<double> crossings(levels.size());
        for (std::uint64_t seed = 0; seed < seeds; ++seed) {
            const Fades fades(
                {.model = FadingModel::nakagami, .coherence = Coherence::place, .m = m}, seed, 0);
            double before = -1e9;
            for (int i = 0; i < steps; ++i) {
                const Vec3 to{step * i * speed_of_light / frequency.value, 0, 0};
                const double now = fades.gain({1, 1, {0, 70, 0}, to, frequency}).value;
                for (std::size_t k = 0; k < levels.size(); ++k)
                    crossings[k] += before >= levels[k] && now < levels[k];
                before = now;
            }
        }
        for (std::size_t k = 0; k < levels.size(); ++k) {
            const double power = math::exp10(levels[k] / 10);
            const double theory = std::sqrt(2 * std::numbers::pi * m * power) *
                                  math::exp((m - 1) * math::log(m * power) - m * power);
            const double found = crossings[k] / (static_cast<double>(seeds) * steps * step);
            out.add(found / theory - 1);
        }
    }
    return out;
}

/// Share of studies that call a model sufficient or insufficient whose error is just the
/// tolerance, where both are false: the largest of three distributions.
Promise false_advice() {
    constexpr int studies = 1000, most_replications = 1000;
    constexpr double tolerance = 0.05, alpha = 0.05;
    constexpr double limit = 0.07;  // alpha, and three standard deviations of the share
    const auto spread = [](std::uint64_t study, std::uint64_t r) {
        return tolerance + 0.5 * (validation_draw("advice", study, r) - 0.5);
    };
    const auto rare_loss = [](std::uint64_t study, std::uint64_t r) {
        return validation_draw("advice", study, r) < tolerance ? 1.0 : 0.0;
    };
    const auto one_in_two = [](std::uint64_t study, std::uint64_t r) {
        return validation_draw("advice", study, r) < 0.5 ? 2 * tolerance : 0;
    };
    Promise out{
        "share of false verdicts if rovernet advise judges models whose error equals the tolerance",
        "", limit, 0, 0};
    const auto share_of = [&](const auto& difference) {
        double wrong = 0;
        for (std::uint64_t study = 0; study < studies; ++study) {
            EquivalenceTest test(tolerance, alpha, 1);
            for (std::uint64_t r = 0; r < most_replications; ++r) test.add(difference(study, r));
            wrong += test.verdict() != Equivalence::undecided;
        }
        out.n += studies;
        return wrong / studies;
    };
    out.worst = std::max({share_of(spread), share_of(rare_loss), share_of(one_in_two)});
    return out;
}

}  // namespace

void check_by_brute_force(Promises& promises) {
    for (const Promise& promise : {rooms(), shadowing_field(), level_crossings(), fitted_lines(),
                                   seen_levels(), discs(), false_advice()})
        promises.push_back(promise);
}

}  // namespace rovernet
