// SPDX-License-Identifier: MIT
#include "models/propagation/friis.hpp"
#include "models/propagation/propagation.hpp"
#include "models/propagation/rays.hpp"
#include "scene/scene.hpp"
#include "sim/math.hpp"
#include "study/validation/cases/block_shadows.hpp"
#include "study/validation/cases/drawn_map.hpp"
#include "study/validation/validation_charts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

// Shadows of the model `rays`: of the end of a wall, of a block, of a wall that is drawn askew.

namespace rovernet {
namespace {

constexpr Hertz shadow_carrier{2450e6};

double loss_of(const Rays& model, const Scene& scene, Vec3 from, Vec3 to) {
    return Propagation(model).loss_to(to,
                                      {.frequency = shadow_carrier, .from = from, .scene = &scene});
}

/// Largest change of the loss over 1 mm as a receiver passes the shadow of a wall's free end; the
/// wall is of the default material.
Promise wall_ends() {
    constexpr double limit = 0.1;  // [dB]
    Promise out{
        "rays: change of the loss if the receiver moves by 1 mm behind the end of a wall whose "
        "material is not given",
        "dB", limit, 0, 0};
    const Scene scene(
        drawn_map(20, 20, 0.05, [](Vec3 p) { return std::abs(p.x - 10) < 0.05 && p.y < 10; }));
    for (const auto wall : {ItuMaterial::brick, ItuMaterial::concrete})
        for (const auto by : {RayDiffraction::knife_edge, RayDiffraction::utd}) {
            const Rays model{.order = 0, .diffraction = by, .wall = wall};
            double before = loss_of(model, scene, {4, 12, 1}, {16, 7.8, 1});
            for (int i = 1; i <= 400; ++i) {
                const double now = loss_of(model, scene, {4, 12, 1}, {16, 7.8 + 0.001 * i, 1});
                out.add(now - before);
                before = now;
            }
        }
    return out;
}

/// Loss behind blocks of metal, with utd, by the mean power of 31 places.
Promise behind_blocks() {
    constexpr double limit = 0.5;  // [dB]
    Promise out{"rays with UTD: loss behind a solid block, against a computed wave field", "dB",
                limit, 0, 0};
    for (const BlockShadow& shadow : block_shadows) {
        const Scene scene(drawn_map(20, 12, 0.05,
                                    [&](Vec3 p) {
                                        return std::abs(p.x - 10) < shadow.width / 2 &&
                                               std::abs(p.y - 6.5) < 0.5;
                                    }),
                          {Material{.slab = ItuMaterial::metal, .thickness = Meters{0.01}}});
        const Rays model{.order = 0, .diffraction = RayDiffraction::utd};
        double power = 0;
        for (int i = -15; i <= 15; ++i) {
            const Vec3 from{2, 6.3, 1}, to{18, 6 + shadow.y + 0.01 * i, 1};
            const double open = free_space_db(distance(from, to), shadow_carrier);
            power += math::exp10((open - loss_of(model, scene, from, to)) / 10) / 31;
        }
        out.add(-10 * math::log10(power) - shadow.loss);
    }
    return out;
}

/// Loss through and around a wall that is drawn at 15 angles in cells of 5 cm, against the wall as
/// it stands: root mean square of each angle, the worst one.
Promise slanting_walls() {
    constexpr double limit = 0.5;  // [dB]
    Promise out{
        "rays: loss with a wall drawn at 15 angles to the cells, against the loss with this wall "
        "drawn along the cells (rms)",
        "dB", limit, 0, 0};
    const auto is_wall = [](Vec3 p) { return std::abs(p.x) < 2 && std::abs(p.y) < 0.1; };
    const auto drawn_at = [&](double angle) {
        OccupancyGrid grid = drawn_map(16, 16, 0.05, [&](Vec3 p) {
            const auto [sin, cos] = math::sincos(angle);
            const double x = p.x - 8, y = p.y - 8;
            return is_wall({cos * x + sin * y, cos * y - sin * x});
        });
        grid.origin = {-8, -8};
        return Scene(grid);
    };
    const Scene straight = drawn_at(0);
    const Rays model{.wall = ItuMaterial::brick};
    for (int step = 1; step <= 15; ++step) {
        const double angle = 0.1 * step;
        const auto turned = [&](Vec3 p) {
            const auto [sin, cos] = math::sincos(angle);
            return Vec3{cos * p.x - sin * p.y, sin * p.x + cos * p.y, 1};
        };
        const Scene scene = drawn_at(angle);
        double squares = 0;
        int n = 0;
        for (double x = -4; x < 4; x += 0.37) {
            const Vec3 from{0.7, -3, 1}, to{x, 3.1, 1};
            const double error = loss_of(model, scene, turned(from), turned(to)) -
                                 loss_of(model, straight, from, to);
            squares += error * error;
            ++n;
        }
        out.worst = std::max(out.worst, std::sqrt(squares / n));
        out.n += static_cast<std::size_t>(n);
    }
    return out;
}

}  // namespace

void check_ray_shadows(Promises& promises) {
    for (const Promise& promise : {wall_ends(), behind_blocks(), slanting_walls()})
        promises.push_back(promise);
}

}  // namespace rovernet
