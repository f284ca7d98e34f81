// SPDX-License-Identifier: MIT
#include "models/propagation/list.hpp"
#include "models/propagation/propagation.hpp"
#include "scene/redrawing.hpp"
#include "scene/scene.hpp"
#include "sim/math.hpp"
#include "study/validation/cases/drawn_map.hpp"
#include "study/validation/validation_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {
namespace {

constexpr double askew = 0.35;  // [rad] the building stands askew to the cells of the maps
constexpr Hertz carrier{2450e6};

/// Turns a point of the building into the world; back with -askew.
Vec3 turned_by(double angle, Vec3 p) {
    const auto [sin, cos] = math::sincos(angle);
    return {cos * p.x - sin * p.y, sin * p.x + cos * p.y};
}

using Link = std::pair<Vec3, Vec3>;

std::vector<Link> links_of(const DrawnBuilding& office, std::size_t n) {
    std::vector<Link> links;
    const auto point = [&](std::uint64_t i) {
        return Vec3{office.width * validation_draw("map_drawing", i, 0),
                    office.depth * validation_draw("map_drawing", i, 1), 1};
    };
    for (std::uint64_t i = 0; links.size() < n; i += 2) {
        const Vec3 a = point(i), b = point(i + 1);
        if (!office.is_wall(a) && !office.is_wall(b))
            links.emplace_back(turned_by(askew, a), turned_by(askew, b));
    }
    return links;
}

double drawn_loss(const Propagation& model, const Scene& scene, const Link& link) {
    return model.loss_to(
        link.second, {.frequency = carrier, .from = link.first, .from_key = 1, .scene = &scene}, 2);
}

/// Listed models, with their defaults, whose losses follow what is drawn.
std::vector<Propagation> models_that_see(const Scene& scene, const std::vector<Link>& links) {
    std::vector<Propagation> out;
    for_each_model([&]<class Model>() {
        try {
            const Propagation model = Propagation(Model{}).median();
            const auto sees = [&](const Link& link) {
                return drawn_loss(model, scene, link) != drawn_loss(model, Scene(), link);
            };
            if (std::any_of(links.begin(), links.end(), sees)) out.push_back(model);
        } catch (const std::invalid_argument&) {  // of a model that has to be told something
        }
    });
    return out;
}

/// Map of the building in cells along the axes of the world.
OccupancyGrid redrawn(const DrawnBuilding& office, const Scene& exact, double cell) {
    const Vec3 low = exact.lower_left(), high = exact.upper_right();
    OccupancyGrid map = drawn_map(high.x - low.x, high.y - low.y, cell, [&](Vec3 p) {
        return office.is_wall(turned_by(-askew, p + low));
    });
    map.origin = low;
    return map;
}

ValidationPoint judged_drawing(const Propagation& model, const Scene& scene, const Scene& exact,
                               const std::vector<Link>& links) {
    constexpr double budget = 90;  // [dB]
    double squares = 0, sum = 0, flipped = 0;
    std::vector<double> parts;
    for (const Link& link : links) {
        const double truth = drawn_loss(model, exact, link), found = drawn_loss(model, scene, link);
        parts.push_back((found - truth) * (found - truth));
        squares += parts.back();
        sum += found - truth;
        flipped += (found <= budget) != (truth <= budget);
    }
    const auto n = static_cast<double>(links.size());
    return {.label = {},
            .series = std::string(model.name()),
            .error = std::sqrt(squares / n),
            .details = {{"bias [dB]", sum / n}, {"flipped decisions [%]", 100 * flipped / n}},
            .parts = std::move(parts)};
}

/// A drawing of the building: its cells, and whether the inside of thick walls is filled.
struct Drawing {
    std::string label;
    const char* series;
    std::shared_ptr<const Scene> scene;
};

ValidationPanel drawing_panel(const Propagation& model, const std::vector<Drawing>& drawings,
                              const Scene& exact, const std::vector<Link>& links,
                              const ValidationSize& size) {
    ValidationPanel panel{.title = std::string(model.name()),
                          .error_label = "error of the loss, rms [dB]"};
    std::vector<TimedMethod> timed;
    for (const Drawing& drawing : drawings) {
        ValidationPoint point = judged_drawing(model, *drawing.scene, exact, links);
        point.label = drawing.label;
        point.series = drawing.series;
        panel.points.push_back(std::move(point));
        timed.push_back(timed_sum(
            links, [&](const Link& link) { return drawn_loss(model, *drawing.scene, link); }));
    }
    set_costs(panel, timed, size.turns());
    return panel;
}

std::string cell_sentence(const ValidationPanel& panel) {
    const ValidationPoint &fine = point_of(panel, "5 cm", "filled"),
                          &coarse = point_of(panel, "20 cm", "filled"),
                          &outline = point_of(panel, "5 cm", "outline");
    return fmt::format(
        "{}: with cells of 5 cm the rms error is {:.2g} dB (mean error {:+.2g} dB). With cells of "
        "20 cm, which are wider than a wall, the rms error is {:.2g} dB. With cells of 5 cm and "
        "walls drawn as outlines, the rms error is {:.2g} dB.",
        panel.title, fine.error, detail_of(fine, "bias [dB]"), coarse.error, outline.error);
}

}  // namespace

ValidationChart map_drawing_chart(const ValidationSize& size) {
    const DrawnBuilding office = drawn_office();
    OccupancyGrid grid = drawn_map(office.width, office.depth, office_cell.value,
                                   [&](Vec3 p) { return office.is_wall(p); });
    grid.yaw = askew;
    const Scene exact(grid);
    const std::vector<Link> links = links_of(office, size.of(300, 60));
    std::vector<Drawing> drawings;
    for (const int cm : {2, 5, 10, 20, 50}) {
        if (size.quick && cm < 5) continue;
        const OccupancyGrid filled = redrawn(office, exact, cm / 100.0);
        const std::string label = fmt::format("{} cm", cm);
        drawings.push_back({label, "filled", std::make_shared<const Scene>(filled)});
        if (cm > 10) continue;
        drawings.push_back(
            {label, "outline", std::make_shared<const Scene>(outline_walls(filled))});
    }
    ValidationChart chart{
        .name = "map_drawing",
        .title = "How fine must a map be, and how must walls be drawn?",
        .truth = fmt::format("The cases are {} links in an office whose walls stand at 20 degrees "
                             "to the cells of the maps. Each model has its default parameters. The "
                             "reference is the same model with the exact walls. Outlines: the map "
                             "shows only those cells of a wall that touch a free cell.",
                             links.size())};
    for (const Propagation& model : models_that_see(exact, links)) {
        chart.panels.push_back(drawing_panel(model, drawings, exact, links, size));
        chart.sentences.push_back(cell_sentence(chart.panels.back()));
    }
    return chart;
}

}  // namespace rovernet
