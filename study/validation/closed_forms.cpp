// SPDX-License-Identifier: MIT
#include "models/link_gain.hpp"
#include "models/phy/error_rate.hpp"
#include "models/propagation/friis.hpp"
#include "models/propagation/itu_indoor.hpp"
#include "models/propagation/itu_site_general.hpp"
#include "models/propagation/log_distance.hpp"
#include "models/propagation/multi_wall.hpp"
#include "models/propagation/propagation.hpp"
#include "models/propagation/raytrace_2007.hpp"
#include "models/propagation/two_ray.hpp"
#include "models/variation/fading.hpp"
#include "scene/materials/p2040.hpp"
#include "scene/scene.hpp"
#include "sim/math.hpp"
#include "study/validation/validation_charts.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

// Numbers whose digits were computed elsewhere, with more digits than a double has.

namespace rovernet {
namespace {

constexpr double closed_form = 1e-9;  // [dB]

/// Link over flat ground.
struct GroundLink {
    Hertz frequency;
    double distance, from_height = 1, to_height = 1;  // [m]
};

double loss_over(const Propagation& model, const GroundLink& link, const Scene& scene = {}) {
    const LinkBatch batch{.frequency = link.frequency,
                          .from = {0, 0.5, link.from_height},
                          .from_key = 1,
                          .scene = &scene,
                          .floor_height = Meters{3}};
    return model.loss_to({link.distance, 0.5, link.to_height}, batch, 2);
}

/// Computed values and the true ones.
using Pairs = std::vector<std::pair<double, double>>;

Promise promise_of(std::string what, double limit, const Pairs& pairs, std::string unit = "dB") {
    double worst = 0;
    for (const auto& [computed, truth] : pairs) worst = std::max(worst, std::abs(computed - truth));
    return {std::move(what), std::move(unit), limit, worst, pairs.size()};
}

/// A wall of cells of 10 cm across a link along x. @param thickness  [m], from x = 2
Scene wall_across(double thickness) {
    OccupancyGrid grid;
    grid.columns = 40;
    grid.rows = 10;
    grid.cell_width = grid.cell_height = 0.1;
    grid.cells.assign(400, Cell::free);
    for (std::size_t i = 0; i < 400; ++i) {
        const double x = 0.1 * (static_cast<double>(i % 40) + 0.5);
        if (x > 2 && x < 2 + thickness) grid.cells[i] = Cell::occupied;
    }
    return Scene(std::move(grid));
}

Pairs models_by_distance() {
    const Hertz f{2450e6};
    const LogDistance office{.exponent = 2.6, .sigma = Db{0}};
    const LogDistance factory{.exponent = 2.1, .sigma = Db{0}};
    return {
        {loss_over(Friis{}, {Hertz{868e6}, 10}), 51.2181777254132},
        {loss_over(Friis{}, {f, 1}), 40.2311049091740},
        {loss_over(office, {Hertz{1900e6}, 20}), 71.8496351282035},
        {loss_over(factory, {Hertz{4000e6}, 50}), 80.1673531394990},
        {loss_over(ItuIndoor{.coefficient = 30}, {Hertz{1900e6}, 10}), 67.5750720190566},
        {loss_over(ItuSiteGeneral{.los = LineOfSight::yes}, {Hertz{914e6}, 5}), 44.0321698367027},
        {loss_over(ItuSiteGeneral{.los = LineOfSight::no}, {Hertz{914e6}, 10}), 53.2005194584652},
        {loss_over(ItuSiteGeneral{.site = Site::industrial, .los = LineOfSight::yes},
                   {Hertz{2400e6}, 10}),
         55.4523515792591}};
}

Pairs walled_models() {
    const Hertz f{2450e6};
    const Scene heavy = wall_across(0.3);
    return {{loss_over(MultiWall{}, {Hertz{1800e6}, 5}), 51.5326334106699},
            {loss_over(MultiWall{}, {f, 5}, heavy), 57.6105049958944 - 3.4 + 6.9},
            {loss_over(Raytrace2007{}, {f, 5}, heavy), 60.7524218173712 + 30}};
}

Pairs two_rays() {
    const auto loss = [](Polarization polarization, const GroundLink& link) {
        return loss_over(TwoRay{.form = TwoRayForm::exact, .polarization = polarization}, link);
    };
    const GroundLink near{Hertz{2398339664}, 10, 1.5, 1.5}, low{Hertz{914e6}, 10, 0.3, 0.3},
        far{Hertz{914e6}, 100, 1.5, 1.5};
    return {{loss(Polarization::horizontal, near), 54.8584734406206},
            {loss(Polarization::vertical, near), 60.6346772484585},
            {loss(Polarization::horizontal, far), 73.2986698153544},
            {loss(Polarization::vertical, far), 73.9282496253468},
            {loss(Polarization::horizontal, low), 61.0707369181708},
            {loss(Polarization::vertical, low), 58.1904387339233},
            {loss_over(TwoRay{}, near), 60.0459970202808}};
}

Pairs slabs() {
    constexpr double degree = 3.14159265358979323846 / 180;
    Pairs out;
    const auto add = [&](ItuMaterial material, double thickness, double ghz, double angle,
                         double te, double tm) {
        const SlabLosses slab =
            slab_losses(material, Meters{thickness}, Hertz{ghz * 1e9}, Radians{angle * degree});
        out.emplace_back(slab.te_transmission.value, te);
        out.emplace_back(slab.tm_transmission.value, tm);
    };
    add(ItuMaterial::concrete, 0.1, 2.4, 30, 8.87473614763109, 7.93624642312082);
    add(ItuMaterial::concrete, 0.1, 2.4, 75, 15.8789029449570, 7.60288046950588);
    add(ItuMaterial::brick, 0.2, 2.4, 89, 35.3527858519569, 23.7828156770359);
    add(ItuMaterial::wood, 0.044, 5.2, 30, 1.61831780256619, 1.54817318117506);
    add(ItuMaterial::metal, 0.001, 5.2, 0, 3998.81063642091, 3998.81063642091);
    return out;
}

/// Quantiles of the power of fading over its mean, over the true ones.
Pairs fading_quantiles() {
    const Fading rayleigh{.model = FadingModel::rayleigh};
    const Fading rician{.model = FadingModel::rician, .k_factor = Db{0}};
    const Fading nakagami{.model = FadingModel::nakagami, .m = 0.5};
    Pairs out;
    for (const double p : {0.001, 0.01, 0.1, 0.5, 0.9, 0.99})
        out.emplace_back(rayleigh.quantile(p) / -math::log(1 - p), 1);
    for (const auto& [p, power] : {std::pair{0.001, 0.00135914175037052},
                                   {0.1, 0.136691698835160},
                                   {0.99, 3.89828501550124}})
        out.emplace_back(rician.quantile(p) / power, 1);
    for (const auto& [p, power] : {std::pair{0.001, 1.57079714926249e-6},
                                   {0.1, 0.0157907740934312},
                                   {0.99, 6.63489660102122}})
        out.emplace_back(nakagami.quantile(p) / power, 1);
    return out;
}

/// Bit error rates of a modulation over the true ones, at ratios of signal to noise.
void add_error_rates(Pairs& out, Modulation modulation,
                     std::initializer_list<std::pair<double, double>> truth) {
    for (const auto& [sinr, rate] : truth) {
        out.emplace_back(bit_error_rate(modulation, sinr) / rate, 1);
    }
}

Pairs error_rates_of_1_mbps() {
    Pairs out;
    add_error_rates(out, Modulation::dsss_1,
                    {{0.1, 0.0554015791811669},
                     {math::exp10(-0.95), 0.0423584317866261},
                     {math::exp10(-0.85), 0.0223544520983215}});
    return out;
}

/// Bit error rates of 2 to 12 Mb/s, over the true ones: of CCK an integral by Simpson's rule, of
/// OFDM the union bound. QPSK has the error rate of BPSK at half the ratio.
Pairs error_rates() {
    Pairs out;
    add_error_rates(out, Modulation::dsss_2,
                    {{0.3, 0.032255864726463315}, {1, 0.0001942047831906988}});
    const auto cck = {std::pair{0.2, 0.1480648434673162},
                      {0.5, 0.043931331064230875},
                      {1.0, 0.006054462611854079}};
    add_error_rates(out, Modulation::cck_5_5, cck);
    for (const auto& [sinr, rate] : cck)
        add_error_rates(out, Modulation::cck_11, {{2 * sinr, rate}});
    const auto bpsk = {std::pair{math::exp10(0.2), 0.00876921036350663},
                       {math::exp10(0.4), 7.62024682838725e-6},
                       {math::exp10(0.8), 4.69056230711569e-15}};
    add_error_rates(out, Modulation::ofdm_6, bpsk);
    for (const auto& [sinr, rate] : bpsk) {
        add_error_rates(out, Modulation::ofdm_12, {{2 * sinr, rate}});
    }
    return out;
}

/// Gains [dB] of a sector antenna of 60 degrees, and of a table between its points.
Pairs antennas() {
    constexpr double degree = 3.14159265358979323846 / 180;
    const Radio sector{.antenna = AntennaShape::cosine, .antenna_beamwidth = Radians{60 * degree}};
    const Radio table{.antenna = AntennaShape::table,
                      .antenna_pattern = std::vector<PatternPoint>{{-90, -20}, {0, 0}, {90, -10}}};
    Pairs out;
    const auto add = [&](const Radio& radio, double angle, double gain) {
        const auto to = math::sincos(angle * degree);
        out.emplace_back(pattern_gain(radio, Pose{}, {7 * to.cos, 7 * to.sin, 0}).value, gain);
    };
    for (const auto& [angle, gain] : {std::pair{0.0, 0.0},
                                      {30.0, -3.0},
                                      {45.0, -6.8512514587508395},
                                      {60.0, -12.447219906212926},
                                      {90.0, -20.0},
                                      {180.0, -20.0}}) {
        add(sector, angle, gain);
        add(sector, -angle, gain);
    }
    for (const auto& [angle, gain] :
         {std::pair{0.0, 0.0}, {45.0, -5.0}, {-45.0, -10.0}, {90.0, -10.0}, {180.0, -15.0}})
        add(table, angle, gain);
    return out;
}

}  // namespace

void check_closed_forms(Promises& promises) {
    promises.push_back(promise_of("losses of models without walls, against closed forms",
                                  closed_form, models_by_distance()));
    promises.push_back(promise_of("losses of models with walls, against closed forms", closed_form,
                                  walled_models()));
    promises.push_back(
        promise_of("losses of two_ray, against closed forms", closed_form, two_rays()));
    promises.push_back(promise_of(
        "losses through slabs of building materials, at several angles, against closed forms", 1e-8,
        slabs()));
    promises.push_back(
        promise_of("quantiles of the power under fading, against known values (relative error)",
                   1e-9, fading_quantiles(), ""));
    promises.push_back(
        promise_of("bit error rates at 1 Mb/s, against known values (relative error)", 1e-10,
                   error_rates_of_1_mbps(), ""));
    promises.push_back(
        promise_of("bit error rates at 2 to 12 Mb/s, against known values (relative error)", 1e-9,
                   error_rates(), ""));
    promises.push_back(
        promise_of("gains of antennas, against closed forms", closed_form, antennas()));
}

}  // namespace rovernet
