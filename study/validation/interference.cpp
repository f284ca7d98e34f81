// SPDX-License-Identifier: MIT
#include "study/validation/cases/validation_scene.hpp"
#include "study/validation/validation_charts.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

// What frames on air do to one another: how weak ones are counted, and by which model of reception.

namespace rovernet {
namespace {

constexpr double complete_cut = 60;  // [dB] leaves out only what is 10 dB below the noise

/// Robots that stand, and send to those within two hops without listening first.
/// @param every  time from one message to the next
ValidationScene storm(const std::string& every) {
    return {.name = "storm",
            .text = fmt::format(R"([scenario]
name = "storm"
duration = "2 s"
seed = 22

[radio]
sensitivity = "-80 dBm"
rate = "1 Mb/s"

[propagation]
model = "log_distance"
exponent = 3
sigma = "0 dB"

[reception]
model = "sinr"
interference_cut = "{} dB"

[[robot]]
name = "r"
count = 60
place = {{ model = "uniform", area = [["0 m", "0 m"], ["300 m", "300 m"]] }}

[routing]
protocol = "flood"
ttl = 2
jitter = "50 ms"

[[traffic]]
from = "random"
size = "64 B"
every = "{}"
)",
                                complete_cut, every)};
}

Variant variant_of(const std::string& label, const char* key, Value value) {
    Table reception, settings;
    reception.set(key, std::move(value));
    settings.set("reception", std::move(reception));
    return {.label = label, .series = "", .settings = settings};
}

/// Panel of the delivery ratio of variants; the last of them is the truth.
ValidationPanel delivery_panel(std::string title, const ValidationScene& scene,
                               const std::vector<Variant>& variants, std::size_t replications) {
    const std::vector<VariantRuns> runs = paired_runs(scene, variants, replications);
    ValidationPanel panel{.title = std::move(title),
                          .cost_label = "CPU per transmission [ns]",
                          .error_label = "error of a run's delivery ratio [-]",
                          .log_error = false,
                          .interval_label = "95 % interval"};
    for (std::size_t i = 0; i < variants.size(); ++i) {
        const RunErrors errors = run_errors(runs[i], runs.back());
        ValidationPoint point{.label = variants[i].label,
                              .cost = runs[i].cost,
                              .error = errors.mean,
                              .details = {{"bias [-]", errors.bias},
                                          {"replications", static_cast<double>(replications)}},
                              .parts = errors.distances};
        if (errors.likely) {
            point.error_low = errors.likely->low;
            point.error_high = errors.likely->high;
        }
        panel.points.push_back(std::move(point));
    }
    return panel;
}

}  // namespace

ValidationChart interference_cut_chart(const ValidationSize& size) {
    std::vector<Variant> variants;
    for (const double cut : {0.0, 5.0, 10.0, 15.0, 20.0, complete_cut}) {
        variants.push_back(variant_of(fmt::format("cut {:g} dB", cut), "interference_cut",
                                      fmt::format("{} dB", cut)));
    }
    const std::size_t replications = size.of(60, 3);
    const ValidationPanel panel = delivery_panel("", storm("10 ms"), variants, replications);
    const ValidationPoint &usual = point_of(panel, "cut 20 dB"), &none = panel.points.front();
    return {.name = "interference_cut",
            .title = "How weak may a frame be and still interfere?",
            .truth = fmt::format(
                "Every 10 ms, a random one of 60 robots sends a message, in {} replications with "
                "`sinr`. A frame does not interfere if its level is below the sensitivity by more "
                "than the cut. The reference is a cut of {:g} dB, which ignores only frames more "
                "than 10 dB below the noise. The cost is the CPU time of the whole run.",
                replications, complete_cut),
            .panels = {panel},
            .sentences = {fmt::format(
                "The default `interference_cut` of 20 dB changes the delivery ratio of a run by "
                "{:.2g} on average, compared with the reference. With a cut of 0 dB, only frames "
                "above the sensitivity interfere: the delivery ratio changes by {:.2g}, and the "
                "run takes {:.2g} times the CPU time of the reference.",
                usual.error, none.error, none.cost.median / panel.points.back().cost.median)}};
}

ValidationChart reception_chart(const ValidationSize& size) {
    std::vector<Variant> variants;
    for (const char* model : {"threshold", "collision", "sinr"}) {
        variants.push_back(variant_of(model, "model", model));
    }
    const std::size_t replications = size.of(60, 3);
    ValidationChart chart{
        .name = "reception",
        .title = "Which model of reception?",
        .truth = fmt::format("In {} replications, 60 robots send messages. The sender of each "
                             "message is drawn at random. The reference is `sinr` with all "
                             "interference. The cost is the CPU time of the whole run.",
                             replications),
        .panels = {delivery_panel("a message each 100 ms", storm("100 ms"), variants, replications),
                   delivery_panel("a message each 10 ms", storm("10 ms"), variants, replications)}};
    chart.sentences = {
        "Errors are differences from `sinr`. The error of `sinr` itself is not measured here."};
    for (const ValidationPanel& panel : chart.panels) {
        const ValidationPoint &threshold = panel.points[0], &collision = panel.points[1];
        chart.sentences.push_back(
            fmt::format("With {} in the whole network, the delivery ratio of a run is wrong by "
                        "{:.2g} under `threshold` and by {:.2g} under `collision`. These two "
                        "models take {:.2g} and {:.2g} times the CPU time of `sinr`.",
                        panel.title, threshold.error, collision.error,
                        threshold.cost.median / panel.points[2].cost.median,
                        collision.cost.median / panel.points[2].cost.median));
    }
    return chart;
}

}  // namespace rovernet
