// SPDX-License-Identifier: MIT
#include "models/propagation/edges/diffraction.hpp"

#include "sim/math.hpp"
#include "study/validation/validation_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <string>
#include <vector>

namespace rovernet {
namespace {

/// Receiver in the shadow of an edge, behind which a plane wave of amplitude 1 arrives.
struct Shadowed {
    double k_rho;             // [rad] wave number times distance from the edge
    double incident, at;      // [degrees] from face 0
    double soft_db, hard_db;  // exact total field
};

// Exact fields: A. Sommerfeld's integral for the screen, his series of Bessel functions for the
// corner, computed with 40 digits.
constexpr Shadowed behind_screen[] = {{10, 30, 224, -12.6204614602012, -7.43234032877492},
                                      {10, 30, 240, -17.7968614045181, -10.3873664036028},
                                      {10, 30, 300, -32.5560693766652, -16.2569012016461},
                                      {10, 30, 350, -50.3067617603955, -17.6583539380175},
                                      {10, 45, 260, -18.2268109711001, -11.6259515564681},
                                      {10, 90, 300, -16.3764797328924, -11.0897105223464},
                                      {50, 30, 224.9, -16.3466961566711, -12.2814856045768},
                                      {50, 30, 260, -29.8417930322203, -19.9092744854383},
                                      {50, 30, 350, -57.2350638291192, -24.6331218495208},
                                      {50, 45, 226, -7.18778663503233, -6.07147857619558},
                                      {50, 45, 240, -15.8197873487041, -12.7099766589392},
                                      {50, 90, 300, -22.0947064069026, -17.2756050914332}};
constexpr Shadowed behind_corner[] = {{10, 30, 224, -13.2521094913745, -6.11794600238412},
                                      {10, 30, 240, -19.6630867903598, -8.22635575513557},
                                      {10, 30, 260, -31.0001097754537, -9.57372443957435},
                                      {10, 45, 225.1, -7.62504286542908, -3.95371698691047},
                                      {10, 45, 240, -13.6409629722840, -6.27475610999242},
                                      {10, 45, 260, -25.1987213977571, -8.11145067882007},
                                      {50, 30, 225.1, -16.9678245524232, -11.2572064140201},
                                      {50, 30, 260, -37.1938287069023, -16.3949580029872},
                                      {50, 45, 226, -7.39980086359778, -5.57194524268029},
                                      {50, 45, 260, -30.6175828262283, -14.6598264788113}};

constexpr double degree = std::numbers::pi / 180;

/// Fields of a method [dB].
struct Fields {
    double soft, hard;
};

/// Parameter nu of the edge, whose source is infinitely far: sin b sqrt(k rho / (pi cos b)), b < 90
/// degrees below the border of the shadow.
double nu_of(const Shadowed& s) {
    const auto [sin, cos] = math::sincos((s.at - s.incident - 180) * degree);
    return sin * std::sqrt(s.k_rho / (std::numbers::pi * cos));
}

Fields by_knife_edge(const Shadowed& s, double (*loss)(double)) {
    // Beyond a right angle there is no height over the line any more: the edge is looked at there.
    constexpr double steepest = 89;  // [degrees]
    Shadowed held = s;
    held.at = std::min(s.at, s.incident + 180 + steepest);
    const double db = -loss(nu_of(held));
    return {db, db};
}

Fields by_wedge(const Shadowed& s, double n) {
    const WedgePath path{n, Radians{s.at * degree}, Radians{s.incident * degree}};
    const auto level = [&](const WedgeFaces& faces) {
        const math::Complex d = wedge_coefficient(path, s.k_rho, Meters{1}, faces);
        return 10 * math::log10(d.real() * d.real() + d.imag() * d.imag());
    };
    return {level(soft_faces), level(hard_faces)};
}

/// A way to find the field in a shadow.
struct ShadowMethod {
    std::string label;
    std::function<Fields(const Shadowed&)> fields;
};

ValidationPanel shadow_panel(std::string title, std::span<const Shadowed> cases, double n,
                             const ValidationSize& size, double& worst_of_wedge) {
    const std::vector<ShadowMethod> methods{
        {"without any shadow",
         [](const Shadowed&) {
             return Fields{0, 0};
         }},
        {"knife edge, P.526",
         [](const Shadowed& s) { return by_knife_edge(s, knife_edge_loss_p526_db); }},
        {"knife edge, exact integral",
         [](const Shadowed& s) { return by_knife_edge(s, knife_edge_loss_db); }},
        {"UTD", [n](const Shadowed& s) { return by_wedge(s, n); }}};
    ValidationPanel panel{.title = std::move(title),
                          .cost_label = "CPU per edge [ns]",
                          .error_label = "error of the field, rms [dB]"};
    std::vector<TimedMethod> timed;
    for (const ShadowMethod& method : methods) {
        double squares = 0, worst = 0;
        for (const Shadowed& s : cases) {
            const auto [soft, hard] = method.fields(s);
            for (const double error : {soft - s.soft_db, hard - s.hard_db}) {
                squares += error * error;
                worst = std::max(worst, std::abs(error));
            }
        }
        if (method.label == "UTD") worst_of_wedge = worst;
        const double values = 2 * static_cast<double>(cases.size());
        panel.points.push_back({.label = method.label,
                                .error = std::sqrt(squares / values),
                                .details = {{"largest error [dB]", worst}}});
        timed.push_back(timed_sum(cases, [&](const Shadowed& s) { return method.fields(s).hard; }));
    }
    set_costs(panel, timed, size.turns());
    return panel;
}

}  // namespace

ValidationChart diffraction_chart(const ValidationSize& size, Promises& promises) {
    double screen = 0, corner = 0;
    ValidationChart chart{
        .name = "diffraction",
        .title = "How deep is the shadow of an edge?",
        .truth =
            fmt::format("Each method computes the field at {} positions behind a metal screen and "
                        "at {} positions behind a right-angled metal corner. The positions are 1.6 "
                        "and 8 wavelengths from the edge; both polarisations are computed. The "
                        "reference is Sommerfeld's exact solution of the wave equation at an edge.",
                        std::size(behind_screen), std::size(behind_corner)),
        .panels = {shadow_panel("screen", behind_screen, 2, size, screen),
                   shadow_panel("right-angled corner", behind_corner, 1.5, size, corner)}};
    promises.push_back(
        {"field behind a screen, computed by UTD (uniform theory of diffraction), against "
         "Sommerfeld's exact solution",
         "dB", 1e-6, screen, std::size(behind_screen)});
    promises.push_back(
        {"field behind a right-angled corner, computed by UTD, against Sommerfeld's exact solution",
         "dB", 0.05, corner, std::size(behind_corner)});
    for (const ValidationPanel& panel : chart.panels) {
        const ValidationPoint &edge = point_of(panel, "knife edge, P.526"),
                              &utd = point_of(panel, "UTD");
        chart.sentences.push_back(fmt::format(
            "Behind a {}, UTD (uniform theory of diffraction) has an rms error of {:.2g} dB and "
            "takes {} times the CPU time of the knife-edge formula of ITU-R P.526. The knife-edge "
            "formula has an rms error of {:.2g} dB. A model that ignores the {} has an rms error "
            "of {:.2g} dB.",
            panel.title, utd.error, two_digits(utd.cost.median / edge.cost.median), edge.error,
            panel.title, panel.points.front().error));
    }
    return chart;
}

}  // namespace rovernet
