// SPDX-License-Identifier: MIT
#include "study/calibration/locator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rovernet {
namespace {

constexpr int grid_side = 48;           // of the grid, in each direction
constexpr double finest_step = 1e-3;    // [m]
constexpr double gradient_step = 1e-3;  // [m]
constexpr std::size_t most_grids = 4096;

/// The eight neighbours of a point.
constexpr std::array<std::pair<int, int>, 8> around{
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};

/// Symmetric matrix of 3 x 3, by its upper half.
struct Information {
    double xx = 0, xy = 0, yy = 0;  // of the place
    double xc = 0, yc = 0, cc = 0;  // of the constant
};

}  // namespace

Locator::Locator(LocatorSettings settings) : settings_(std::move(settings)) {
    settings_.model = settings_.model.median();
}

void Locator::losses_from(Vec3 anchor, std::span<const Vec3> to, std::span<double> out) const {
    static constexpr std::array<std::uint64_t, grid_side * grid_side>
        no_keys{};  // a median draws nothing
    settings_.model.loss({.frequency = settings_.frequency,
                          .from = anchor,
                          .to = to,
                          .to_keys = std::span(no_keys).first(to.size()),
                          .scene = settings_.scene.get(),
                          .floor_height = settings_.floor_height},
                         Db{std::numeric_limits<double>::infinity()}, out);
}

Vec3 Locator::point(int i, int j, double z) const {
    const auto between = [](double low, double high, int k) {
        return low + (k + 0.5) / grid_side * (high - low);
    };
    return {between(settings_.low.x, settings_.high.x, i),
            between(settings_.low.y, settings_.high.y, j), z};
}

const Locator::Grid& Locator::grid_of(Vec3 anchor, double z) {
    if (grids_.size() >= most_grids) grids_.clear();  // anchors that move
    const auto [at, is_new] = grids_.try_emplace({anchor.x, anchor.y, anchor.z, z});
    if (is_new) {
        std::vector<Vec3> to;
        for (int j = 0; j < grid_side; ++j)
            for (int i = 0; i < grid_side; ++i) to.push_back(point(i, j, z));
        at->second.resize(to.size());
        losses_from(anchor, to, at->second);
    }
    return at->second;
}

double Locator::misfit(std::size_t losses, double squares, double sum) const {
    return settings_.knows_power ? squares : squares - sum * sum / static_cast<double>(losses);
}

std::vector<Vec3> Locator::valleys(std::span<const AnchorLoss> losses, double z) {
    std::vector<double> squares(grid_side * grid_side), sums(grid_side * grid_side);
    for (const AnchorLoss& each : losses) {
        const Grid& predicted = grid_of(each.anchor, z);
        for (std::size_t k = 0; k < predicted.size(); ++k) {
            const double error = each.loss - predicted[k];
            squares[k] += error * error;
            sums[k] += error;
        }
    }
    const auto misfit_at = [&](int i, int j) {
        if (i < 0 || j < 0 || i >= grid_side || j >= grid_side)
            return std::numeric_limits<double>::infinity();
        const auto k = static_cast<std::size_t>(j * grid_side + i);
        return misfit(losses.size(), squares[k], sums[k]);
    };
    std::vector<Vec3> out;
    for (int j = 0; j < grid_side; ++j) {
        for (int i = 0; i < grid_side; ++i) {
            const double here = misfit_at(i, j);
            const bool is_lowest = std::all_of(around.begin(), around.end(), [&](auto step) {
                return here <= misfit_at(i + step.first, j + step.second);
            });
            if (is_lowest) out.push_back(point(i, j, z));
        }
    }
    return out;
}

std::pair<double, Vec3> Locator::refined(std::span<const AnchorLoss> losses, Vec3 from) const {
    const auto misfit_at = [&](Vec3 at) {
        double squares = 0, sum = 0;
        for (const AnchorLoss& each : losses) {
            double predicted = 0;
            losses_from(each.anchor, {&at, 1}, {&predicted, 1});
            const double error = each.loss - predicted;
            squares += error * error;
            sum += error;
        }
        return misfit(losses.size(), squares, sum);
    };
    const double width = settings_.high.x - settings_.low.x,
                 depth = settings_.high.y - settings_.low.y;
    double least = misfit_at(from);
    for (double step = std::max(width, depth) / grid_side; step > finest_step;) {
        Vec3 best = from;
        for (const auto& [dx, dy] :
             {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}) {
            const Vec3 at{std::clamp(from.x + dx * step, settings_.low.x, settings_.high.x),
                          std::clamp(from.y + dy * step, settings_.low.y, settings_.high.y),
                          from.z};
            const double there = misfit_at(at);
            if (there < least) {
                least = there;
                best = at;
            }
        }
        if (best == from) step /= 2;
        from = best;
    }
    return {least, from};
}

Vec3 Locator::locate(std::span<const AnchorLoss> losses, double z) {
    std::pair<double, Vec3> best{std::numeric_limits<double>::infinity(), {}};
    for (const Vec3 valley : valleys(losses, z)) {
        const auto found = refined(losses, valley);
        if (found.first < best.first) best = found;
    }
    return best.second;
}

std::optional<Meters> Locator::bound(std::span<const Vec3> anchors, Vec3 at, Db sigma) const {
    constexpr double h = gradient_step;
    const std::array near{at + Vec3{h, 0}, at - Vec3{h, 0}, at + Vec3{0, h}, at - Vec3{0, h}};
    Information f;
    for (const Vec3 anchor : anchors) {
        std::array<double, 4> loss;
        losses_from(anchor, near, loss);
        const double x = (loss[0] - loss[1]) / (2 * h * sigma.value);
        const double y = (loss[2] - loss[3]) / (2 * h * sigma.value);
        const double c = 1 / sigma.value;
        f.xx += x * x, f.xy += x * y, f.yy += y * y;
        f.xc += x * c, f.yc += y * c, f.cc += c * c;
    }
    if (!settings_.knows_power) {  // what is left of the place's once the constant is estimated
        f.xx -= f.xc * f.xc / f.cc;
        f.xy -= f.xc * f.yc / f.cc;
        f.yy -= f.yc * f.yc / f.cc;
    }
    const double trace = f.xx + f.yy, determinant = f.xx * f.yy - f.xy * f.xy;
    constexpr double singular = 1e-9;  // of a matrix that only rounding keeps from being singular
    if (!(determinant > singular * trace * trace)) return std::nullopt;
    return Meters{std::sqrt(trace / determinant)};
}

}  // namespace rovernet
