// SPDX-License-Identifier: MIT
#include "models/propagation/friis.hpp"
#include "scene/scene.hpp"
#include "sim/math.hpp"
#include "study/validation/cases/drawn_map.hpp"
#include "study/validation/cases/naive_walls.hpp"
#include "study/validation/validation_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {
namespace {

constexpr double turned = 0.35;  // [rad] the building stands askew in the world
constexpr double rate = 30;      // [dB/m] of brick, 0.3 dB/cm
constexpr double budget = 90;    // [dB]
constexpr Hertz frequency{2450e6};
constexpr double drawn_cell = office_cell.value;  // [m] in which the building is drawn without loss

struct WallLink {
    Vec3 a, b;
};

/// The office as the scene has it, and the same in the naive ways' terms.
struct AskewOffice {
    OccupancyGrid grid;
    std::shared_ptr<const Scene> scene;
    Vec3 low, high;  // of the box around it
    math::SinCos angle = math::sincos(turned);

    AskewOffice() {
        const DrawnBuilding office = drawn_office();
        grid = drawn_map(office.width, office.depth, drawn_cell,
                         [&](Vec3 p) { return office.is_wall(p); });
        grid.yaw = turned;
        scene = std::make_shared<const Scene>(grid);
        low = scene->lower_left();
        high = scene->upper_right();
    }
    Vec3 in_building(Vec3 p) const {
        return {angle.cos * p.x + angle.sin * p.y, angle.cos * p.y - angle.sin * p.x};
    }
    Vec3 in_world(Vec3 p) const {
        return {angle.cos * p.x - angle.sin * p.y, angle.sin * p.x + angle.cos * p.y};
    }
    bool is_wall(Vec3 world) const {
        const Vec3 p = in_building(world);
        const double column = p.x / drawn_cell, row = p.y / drawn_cell;
        return column >= 0 && row >= 0 && column < grid.columns && row < grid.rows &&
               grid.at(static_cast<int>(column), static_cast<int>(row)) == Cell::occupied;
    }
};

std::vector<WallLink> links_in(const AskewOffice& office, std::size_t n) {
    std::vector<WallLink> links;
    const auto point = [&](std::uint64_t i) {
        const Vec3 p{40 * validation_draw("wall_length", i, 0),
                     20 * validation_draw("wall_length", i, 1)};
        return office.in_world(p);
    };
    for (std::uint64_t i = 0; links.size() < n; i += 2) {
        const WallLink link{point(i), point(i + 1)};
        if (!office.is_wall(link.a) && !office.is_wall(link.b)) links.push_back(link);
    }
    return links;
}

/// Length of a segment inside a convex rectangle [m], by clipping it at each of the four sides.
double clipped(const WallLink& link, const std::array<Vec3, 4>& corners) {
    double enter = 0, leave = 1;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 p = corners[i], side = corners[(i + 1) % 4] - p;
        const auto left_of = [&](Vec3 q) { return side.x * (q.y - p.y) - side.y * (q.x - p.x); };
        const double at_a = left_of(link.a), at_b = left_of(link.b);
        if (at_a <= 0 && at_b <= 0) return 0;
        if (at_a < 0) enter = std::max(enter, at_a / (at_a - at_b));
        if (at_b < 0) leave = std::min(leave, at_a / (at_a - at_b));
    }
    return std::max(0.0, leave - enter) * distance(link.a, link.b);
}

/// A way to find lengths of wall [m].
struct WallMethod {
    std::string label;
    std::function<double(const WallLink&)> length;
};

std::vector<WallMethod> wall_methods(const AskewOffice& office, const ValidationSize& size) {
    const auto rectangles =
        std::make_shared<const std::vector<WallRectangle>>(office.scene->wall_rectangles());
    std::vector<WallMethod> out{
        {"every wall clipped",
         [rectangles](const WallLink& l) {
             double sum = 0;
             for (const WallRectangle& r : *rectangles) sum += clipped(l, r.corners);
             return sum;
         }},
        {"rovernet", [&office](const WallLink& l) { return office.scene->wall_length(l.a, l.b); }}};
    for (const double cm : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
        if (size.quick && cm < 5) continue;
        const double cell = cm / 100;
        const auto raster = std::make_shared<const NaiveRaster>(
            office.low, office.high, cell, [&office](Vec3 p) { return office.is_wall(p); });
        out.push_back({fmt::format("DDA {:g} cm", cm),
                       [raster](const WallLink& l) { return raster->traversed(l.a, l.b); }});
        if (cm == 5 || cm == 10 || cm == 50) {
            out.push_back({fmt::format("Bresenham {:g} cm", cm),
                           [raster](const WallLink& l) { return raster->bresenham(l.a, l.b); }});
        }
    }
    for (const double cm : {1.0, 5.0, 10.0, 50.0}) {
        out.push_back({fmt::format("samples {:g} cm", cm), [&office, cm](const WallLink& l) {
                           return sampled_wall(l.a, l.b, cm / 100,
                                               [&](Vec3 p) { return office.is_wall(p); });
                       }});
    }
    return out;
}

bool is_up(const WallLink& link, double wall) {
    return free_space_db(distance(link.a, link.b), frequency) + rate * wall <= budget;
}

/// Errors of a method against the true lengths.
ValidationPoint judged_lengths(const WallMethod& method, const std::vector<WallLink>& links,
                               const std::vector<double>& truth, double& worst) {
    constexpr double nothing = 1e-9;  // [m]
    double squares = 0, false_hits = 0, missed = 0, clear = 0, hit = 0, flipped = 0;
    std::vector<double> parts;
    worst = 0;
    for (std::size_t i = 0; i < links.size(); ++i) {
        const double found = method.length(links[i]), error = std::abs(found - truth[i]);
        worst = std::max(worst, error);
        squares += error * error;
        parts.push_back(rate * rate * error * error);
        const bool is_hit = truth[i] > nothing, seems_hit = found > nothing;
        (is_hit ? hit : clear) += 1;
        false_hits += !is_hit && seems_hit;
        missed += is_hit && !seems_hit;
        flipped += is_up(links[i], found) != is_up(links[i], truth[i]);
    }
    const auto n = static_cast<double>(links.size());
    return {.label = method.label,
            .error = rate * std::sqrt(squares / n),
            .details = {{"false hits [%]", 100 * false_hits / std::max(clear, 1.0)},
                        {"walls missed [%]", 100 * missed / std::max(hit, 1.0)},
                        {"flipped decisions [%]", 100 * flipped / n}},
            .parts = std::move(parts)};
}

/// What the naive ways cost, beside the exact one.
std::string naive_sentence(const ValidationPanel& panel) {
    const ValidationPoint& exact = point_of(panel, "rovernet");
    const Nearest naive = nearest_to_truth(panel, [](const ValidationPoint& p) {
        return p.label != "rovernet" && p.label != "every wall clipped";
    });
    const ValidationPoint& best = *naive.point;
    return fmt::format(
        "Approximate methods for this length: {}. The method with the smallest error takes {} "
        "times the CPU time of the exact method, and decides wrongly for {:.2g} % of the links "
        "whether the link is up.",
        nearest_text(naive, [](double error) { return fmt::format("rms error {:.2g} dB", error); }),
        two_digits(best.cost.median / exact.cost.median), detail_of(best, "flipped decisions [%]"));
}

}  // namespace

ValidationChart wall_length_chart(const ValidationSize& size, Promises& promises) {
    const AskewOffice office;
    const std::vector<WallLink> links = links_in(office, size.of(4000, 300));
    const std::vector<WallMethod> methods = wall_methods(office, size);
    std::vector<double> truth;
    for (const WallLink& link : links) truth.push_back(methods.front().length(link));
    ValidationPanel panel{.error_label = "error of the walls' loss, rms [dB]"};
    std::vector<TimedMethod> timed;
    for (const WallMethod& method : methods) {
        double worst = 0;
        panel.points.push_back(judged_lengths(method, links, truth, worst));
        if (method.label == "rovernet") {
            promises.push_back(
                {"total length of a link inside walls, against the sum of the lengths inside each "
                 "wall",
                 "m", 1e-8, worst, links.size()});
        }
        timed.push_back(timed_sum(links, method.length));
    }
    set_costs(panel, timed, size.turns());
    return {.name = "wall_length",
            .title = "How long is the path of a link inside walls?",
            .truth = fmt::format(
                "The cases are {} links in an office of 32 rooms whose walls stand at 20 degrees "
                "to the axes. The reference computes the length of the link inside each wall and "
                "adds up these lengths. Brick attenuates by {:g} dB per metre. The decision is "
                "whether the loss at 2450 MHz is within a budget of {:g} dB. Approximate methods: "
                "points at equal distances on the link (\"samples 1 cm\": a point every 1 cm), or "
                "a raster of square cells (DDA, Bresenham).",
                links.size(), rate, budget),
            .panels = {panel},
            .sentences = {naive_sentence(panel)},
            .for_contributors = true};
}

}  // namespace rovernet
