// SPDX-License-Identifier: MIT
#include "models/propagation/friis.hpp"
#include "models/propagation/propagation.hpp"
#include "models/propagation/rays.hpp"
#include "scene/scene.hpp"
#include "sim/math.hpp"
#include "study/validation/validation_charts.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace rovernet {
namespace {

constexpr double sender_y = 0.7, receiver_y = 1.3;  // [m] from a wall

/// Link along a corridor between two walls of metal.
struct CorridorLink {
    double width, frequency, along;  // [m], [Hz], [m]
    double exact_db;                 // loss by the modal series
};

// Loss of the modal series, field along the walls, computed with 40 digits: G = (j / 2a) sum over n
// of sin(n pi y / a) sin(n pi y' / a) H0(1)(beta_n rho), L = -20 log10(lambda |G|).
constexpr CorridorLink corridor_links[] = {
    {2.0, 2.45e9, 3, 40.8820203000900},  {2.0, 2.45e9, 7, 46.7607898756857},
    {2.0, 2.45e9, 10, 43.3102660647027}, {2.0, 2.45e9, 20, 55.4548349664917},
    {2.0, 2.45e9, 40, 53.8894314214893}, {2.0, 914e6, 3, 38.7065865462789},
    {2.0, 914e6, 7, 33.5688669296121},   {2.0, 914e6, 10, 43.6215265109357},
    {2.0, 914e6, 20, 49.1965156686426},  {2.0, 914e6, 40, 52.1000598049353},
    {2.5, 2.45e9, 3, 46.5455300128971},  {2.5, 2.45e9, 7, 57.5738526870738},
    {2.5, 2.45e9, 10, 58.5779025884558}, {2.5, 2.45e9, 20, 49.4101273774956},
    {2.5, 2.45e9, 40, 59.1719418013773}, {2.5, 914e6, 3, 30.7337856871837},
    {2.5, 914e6, 7, 38.3020967482228},   {2.5, 914e6, 10, 41.0366657821906},
    {2.5, 914e6, 20, 39.7451568891071},  {2.5, 914e6, 40, 53.7731994579301}};

/// Corridor of a width, 240 m long, with walls of half a metre.
std::shared_ptr<const Scene> corridor(double width) {
    constexpr double cell = 0.5, length = 240;  // [m]
    OccupancyGrid grid;
    grid.columns = static_cast<int>(length / cell);
    grid.rows = static_cast<int>(width / cell) + 2;
    grid.cell_width = grid.cell_height = cell;
    grid.origin = {-length / 2, -cell};
    for (int row = 0; row < grid.rows; ++row) {
        const bool wall = row == 0 || row == grid.rows - 1;
        grid.cells.insert(grid.cells.end(), static_cast<std::size_t>(grid.columns),
                          wall ? Cell::occupied : Cell::free);
    }
    return std::make_shared<const Scene>(std::move(grid));
}

/// Loss [dB] of the sum of all images' powers, which has a closed form:
///   sum over m of 1 / (x^2 + (2 m a + y)^2)
///   = (pi / 2 a x) sinh(pi x / a) / (cosh(pi x / a) - cos(pi y / a)).
double power_of_images_db(const CorridorLink& link) {
    const double q = math::exp(-std::numbers::pi * link.along / link.width);
    double sum = 0;
    for (const double y : {sender_y - receiver_y, sender_y + receiver_y}) {
        const double cos = math::sincos(std::numbers::pi * y / link.width).cos;
        sum += (1 - q * q) / (1 + q * q - 2 * q * cos);
    }
    sum *= std::numbers::pi / (2 * link.width * link.along);
    return free_space_db(1, Hertz{link.frequency}) - 10 * math::log10(sum);
}

double corridor_loss(const Propagation& model, const CorridorLink& link, const Scene& scene) {
    const LinkBatch batch{.frequency = Hertz{link.frequency},
                          .from = {0, sender_y, 1},
                          .from_key = 1,
                          .scene = &scene};
    return model.loss_to({link.along, receiver_y, 1}, batch, 2);
}

Rays rays_of(int order, RaySum sum) {
    return {.order = order, .sum = sum, .wall = ItuMaterial::metal, .max_paths = 1000};
}

ValidationPanel corridor_panel(std::string title, RaySum sum, double (*truth)(const CorridorLink&),
                               const ValidationSize& size) {
    ValidationPanel panel{.title = std::move(title),
                          .error_label = "error of the loss, rms [dB]",
                          .log_error = false};
    const std::array scenes{corridor(2.0), corridor(2.5)};
    std::vector<Propagation> models{Friis{}};
    for (const int order : {0, 1, 2, 3}) models.push_back(rays_of(order, sum));
    std::vector<TimedMethod> timed;
    for (std::size_t i = 0; i < models.size(); ++i) {
        const auto loss = [&scenes, &model = models[i]](const CorridorLink& link) {
            return corridor_loss(model, link, *scenes[link.width == 2.0 ? 0 : 1]);
        };
        double squares = 0, worst = 0;
        std::vector<double> parts;
        for (const CorridorLink& link : corridor_links) {
            const double error = loss(link) - truth(link);
            parts.push_back(error * error);
            squares += parts.back();
            worst = std::max(worst, std::abs(error));
        }
        const double n = static_cast<double>(std::size(corridor_links));
        panel.points.push_back({.label = i == 0 ? "friis" : fmt::format("rays, order {}", i - 1),
                                .error = std::sqrt(squares / n),
                                .details = {{"largest error [dB]", worst}},
                                .parts = std::move(parts)});
        timed.push_back(timed_sum(corridor_links, loss));
    }
    set_costs(panel, timed, size.turns());
    return panel;
}

}  // namespace

ValidationChart corridor_chart(const ValidationSize& size) {
    ValidationChart chart{
        .name = "corridor",
        .title = "How many reflections, and how to add them?",
        .truth = fmt::format(
            "The cases are {} links along corridors between walls of metal. The corridors are 2 m "
            "and 2.5 m wide. The links are 3 to 40 m long, at 914 and 2450 MHz. For the coherent "
            "sum, the reference is the exact field (modal series). For the sum of powers, the "
            "reference is the sum over infinitely many image sources, in closed form.",
            std::size(corridor_links)),
        .panels = {corridor_panel("sum of powers", RaySum::power, power_of_images_db, size),
                   corridor_panel(
                       "coherent sum", RaySum::coherent,
                       [](const CorridorLink& link) { return link.exact_db; }, size)}};
    for (const ValidationPanel& panel : chart.panels) {
        const ValidationPoint &none = point_of(panel, "rays, order 0"),
                              &one = point_of(panel, "rays, order 1"),
                              &three = point_of(panel, "rays, order 3");
        chart.sentences.push_back(fmt::format(
            "{}: the rms error of rays is {:.2g} dB with order 0 (no reflections), {:.2g} dB with "
            "order 1 and {:.2g} dB with order 3. Order 3 takes {} times the CPU time of order 1.",
            panel.title, none.error, one.error, three.error,
            two_digits(three.cost.median / one.cost.median)));
    }
    return chart;
}

}  // namespace rovernet
