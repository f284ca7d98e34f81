// SPDX-License-Identifier: MIT
#include "models/variation/shadowing_field.hpp"
#include "sim/math.hpp"
#include "sim/random.hpp"
#include "study/validation/validation_charts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace rovernet {
namespace {

constexpr double decorrelation = 10;  // [m]
constexpr double walk = 50;           // [m] that a robot goes, at 1 m/s
constexpr Vec3 peer{30, 5, 1};        // [m] where its peer stands

/// Walk of a robot away from the place of its peer, sampled every `step`.
struct Walk {
    std::uint64_t seed;
    double step;  // [m], or [s]

    std::uint64_t samples() const { return static_cast<std::uint64_t>(walk / step); }
    Vec3 at(std::uint64_t sample) const { return {step * static_cast<double>(sample), 0, 1}; }
};

std::uint64_t draw_bits(const Walk& w, std::uint64_t sample) {
    return PairDraws(w.seed, 0, Purpose::link_shadowing).bits(1, 2 + sample);
}

/// A way to shadow a link as its robot walks. @return changes of its state, at a margin of 0 dB
struct ShadowingMethod {
    std::string label;
    std::function<std::uint64_t(const Walk&)> flips;
};

/// Changes of the sign of a value from sample to sample.
template <class ValueAt>
std::uint64_t sign_changes(const Walk& w, ValueAt value_at) {
    std::uint64_t flips = 0;
    bool up = value_at(0) > 0;
    for (std::uint64_t sample = 1; sample <= w.samples(); ++sample) {
        const bool now = value_at(sample) > 0;
        flips += now != up;
        up = now;
    }
    return flips;
}

std::vector<ShadowingMethod> shadowing_methods() {
    return {{"drawn anew for each sample",
             [](const Walk& w) {
                 return sign_changes(w, [&](std::uint64_t sample) {
                     return PairDraws::normal_of(draw_bits(w, sample));
                 });
             }},
            {"stored per link (Gudmundson)",
             [](const Walk& w) {
                 const double rho = math::exp(-w.step / decorrelation);
                 double x = PairDraws::normal_of(draw_bits(w, 0));
                 return sign_changes(w, [&](std::uint64_t sample) {
                     if (sample == 0) return x;
                     x = rho * x +
                         std::sqrt(1 - rho * rho) * PairDraws::normal_of(draw_bits(w, sample));
                     return x;
                 });
             }},
            {"[shadowing] link",
             [](const Walk& w) {
                 const double x = PairDraws::normal_of(draw_bits(w, 0));
                 return sign_changes(w, [&](std::uint64_t) { return x; });
             }},
            {"[shadowing] field", [](const Walk& w) {
                 const ShadowingField field(Meters{decorrelation}, w.seed, 0);
                 return sign_changes(
                     w, [&](std::uint64_t sample) { return field(w.at(sample), peer); });
             }}};
}

/// Flips per second of the process whose correlation is e^(-D / d_cor), sampled every `step`:
/// arccos(e^(-step / d_cor)) / (pi step).
double true_rate(double step) {
    const double rho = math::exp(-step / decorrelation);
    return math::atan2(std::sqrt(1 - rho * rho), rho) / (std::numbers::pi * step);
}

ValidationPanel flips_panel(double step, std::uint64_t seeds, const ValidationSize& size) {
    ValidationPanel panel{.title = fmt::format("sampled every {:g} s", step),
                          .cost_label = "CPU per sample [ns]",
                          .error_label = "error of the link changes per second [%]"};
    const std::vector<ShadowingMethod> methods = shadowing_methods();
    const double truth = true_rate(step);
    const auto all_flips = [=](const ShadowingMethod& method) {
        std::uint64_t flips = 0;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) flips += method.flips({seed, step});
        return static_cast<double>(flips);
    };
    std::vector<TimedMethod> timed;
    for (const ShadowingMethod& method : methods) {
        const double rate = all_flips(method) / (walk * static_cast<double>(seeds));
        panel.points.push_back({.label = method.label,
                                .error = 100 * std::abs(rate - truth) / truth,
                                .details = {{"flips per second", rate}, {"exact", truth}}});
        timed.push_back({[&all_flips, &method] { return all_flips(method); },
                         static_cast<double>(seeds) * walk / step});
    }
    set_costs(panel, timed, size.turns());
    return panel;
}

}  // namespace

ValidationChart shadowing_chart(const ValidationSize& size) {
    const std::uint64_t seeds = size.of(1000, 30);
    ValidationChart chart{
        .name = "shadowing",
        .title = "How often does shadowing change the state of a link?",
        .truth =
            fmt::format("In {} cases, one robot of a link walks {:g} m at 1 m/s, and the other "
                        "robot of this link rests. Without shadowing, the link margin is 0 dB. The "
                        "reference is the rate at which the link goes up or down if shadowing is a "
                        "Gaussian process with the correlation exp(-D / {:g} m) over a distance D.",
                        seeds, walk, decorrelation)};
    for (const double step : {1.0, 0.1}) {  // [s]
        const ValidationPanel& panel = chart.panels.emplace_back(flips_panel(step, seeds, size));
        const ValidationPoint &redrawn = panel.points.front(), &field = panel.points.back();
        chart.sentences.push_back(fmt::format(
            "With a sample every {:g} s, shadowing that is drawn anew for each sample changes the "
            "state of the link {:.2g} times a second. In the reference, the state changes {:.2g} "
            "times a second. Shadowing that is a function of both positions (`field`) changes the "
            "state {:.2g} times a second. A sample of `field` takes {:.3g} ns of CPU time, and no "
            "shadowing values are stored.",
            step, detail_of(redrawn, "flips per second"), detail_of(redrawn, "exact"),
            detail_of(field, "flips per second"), field.cost.median));
    }
    chart.sentences.push_back(
        "If the Gaussian process of the reference is sampled more often, it changes the state of "
        "the link more often, without a limit. So report the sampling interval with every number "
        "of link changes. Choose `field`: with `field`, the number of link changes hardly "
        "increases if the sampling interval is 0.1 s instead of 1 s. Fit the decorrelation "
        "distance of `field` to levels, not to numbers of link changes.");
    return chart;
}

}  // namespace rovernet
