// SPDX-License-Identifier: MIT
#include "scenario/toml.hpp"
#include "study/calibration.hpp"
#include "study/free_parameters.hpp"
#include "study/known_links.hpp"
#include "study/medium_cost.hpp"
#include "study/prediction_errors.hpp"
#include "study/validation/validation_charts.hpp"
#include "study/validation/validation_scene.hpp"

#include <fmt/format.h>

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {
namespace {

constexpr const char *as_given = "as given", *after_fit = "fitted", *reference_series = "reference";

/// Form of a model: keys of [propagation]. The label of the most detailed one is the name of the
/// model.
struct Form {
    const char *label, *keys;
};

/// Cheaper forms of `rays`.
constexpr std::array fewer_rays{
    Form{"rays, order 0", "model = 'rays'\norder = 0\ndiffraction = 'none'"},
    Form{"rays, order 1", "model = 'rays'\norder = 1\ndiffraction = 'none'"},
    Form{"rays, order 2, knife edge", "model = 'rays'\norder = 2\ndiffraction = 'knife_edge'"},
    Form{"rays, order 2, UTD", "model = 'rays'\norder = 2\ndiffraction = 'utd'"}};

/// Model whose losses are taken as true, and cheaper forms of it.
struct Truth {
    Form model;
    std::span<const Form> cheaper = {};
};
constexpr Truth in_the_open{{"two_ray", "model = 'two_ray'\nform = 'exact'"}};
constexpr Truth among_walls{{"rays", "model = 'rays'\norder = 3\ndiffraction = 'utd'"}, fewer_rays};

Table propagation_settings(Table propagation) {
    Table settings;
    settings.set("propagation", std::move(propagation));
    return settings;
}
Table settings_of(const Form& form) {
    return propagation_settings(*parse_toml(form.keys, form.label).table());
}
/// A model as a user would write it who gives nothing but its name.
Table settings_of(const std::string& model) {
    Table propagation;
    propagation.set("model", model);
    return propagation_settings(std::move(propagation));
}

/// Variant, and the share of links that it decides wrongly.
struct JudgedModel {
    Variant variant;
    double wrong_links = 0;
};

/// Models fitted to the reference on links of the scene, as by `rovernet advise`; quickly: on
/// fewer.
Calibration calibrated(const Scenario& scenario, const std::string& reference,
                       const ValidationSize& size) {
    if (!size.quick) return calibrate_to_model(scenario, reference, {}, beyond_radio);
    Calibration out;
    out.known = censored(sample_links(scenario, model_with(scenario, reference, {}),
                                      {.replications = 4, .times = 10, .links = 400}),
                         beyond_radio);
    out.models = calibrate(out.known, scenario, reference, out.decided_within);
    return out;
}

/// Share of the known links that a form decides wrongly.
double wrong_links(const Scenario& scenario, const Calibration& calibration) {
    const Propagation model = scenario.propagation.make();
    Predictions predictions(calibration.known, calibration.decided_within);
    for (std::size_t i = 0; i < calibration.known.links.size(); ++i) {
        predictions.add(i, calibration.known.loss_by(model, calibration.known.links[i]));
    }
    return predictions.errors().wrong();
}

/// Models of a scene, the reference first.
std::vector<JudgedModel> models_of(const ValidationScene& scene, const Truth& truth,
                                   const ValidationSize& size) {
    const Table settings = settings_of(truth.model);
    std::vector<JudgedModel> out{{{truth.model.label, reference_series, settings}, 0}};
    const Calibration calibration = calibrated(scene.scenario(settings), truth.model.label, size);
    for (const CalibratedModel& model : calibration.models) {
        if (!model.failure.empty()) continue;
        if (model.as_given && model.model != "disc") {
            out.push_back(
                {{model.model, as_given, settings_of(model.model)}, model.as_given->wrong()});
        }
        if (model.parameters.empty()) continue;
        const PredictionErrors& errors = model.left_out ? *model.left_out : model.fitted;
        out.push_back({{model.model, after_fit, model.settings}, errors.wrong()});
    }
    for (const Form& form : truth.cheaper) {
        const Table fewer = settings_of(form);
        out.push_back(
            {{form.label, as_given, fewer}, wrong_links(scene.scenario(fewer), calibration)});
    }
    return out;
}

std::vector<TurnCost> medium_costs(const ValidationScene& scene,
                                   const std::vector<Variant>& variants,
                                   const ValidationSize& size) {
    std::vector<Scenario> scenarios;
    for (const Variant& variant : variants) scenarios.push_back(scene.scenario(variant.settings));
    const auto never_stopped = [] { return false; };
    const CostTurns turns{
        .turns = size.quick ? 1 : 5,
        .total_s = (size.quick ? 0.05 : 1.0) * static_cast<double>(variants.size())};
    const MediumCosts costs = measure_medium(record_medium(scenarios.front(), never_stopped),
                                             scenarios, turns, never_stopped);
    std::vector<TurnCost> out;
    for (const MediumCost& cost : costs.models) {
        out.push_back({1e9 * cost.median_s, 1e9 * cost.low_s, 1e9 * cost.high_s});
    }
    out.resize(variants.size());
    return out;
}

/// The two panels of a scene.
struct ScenePanels {
    ValidationPanel delivery, links;
};

ScenePanels panels_of(const ValidationScene& scene, const Truth& truth, std::size_t replications,
                      const ValidationSize& size) {
    const std::vector<JudgedModel> models = models_of(scene, truth, size);
    std::vector<Variant> variants;
    for (const JudgedModel& model : models) variants.push_back(model.variant);
    const std::vector<VariantRuns> runs = paired_runs(scene, variants, replications);
    const std::vector<TurnCost> costs = medium_costs(scene, variants, size);
    ValidationPanel delivery{.title = scene.name,
                             .cost_label = "CPU of the medium per transmission [ns]",
                             .error_label = "error of a run's delivery ratio [-]",
                             .log_error = false,
                             .joined = true};
    ValidationPanel links = delivery;
    links.error_label = "links decided wrongly [%]";
    for (std::size_t i = 0; i < models.size(); ++i) {
        const RunErrors errors = run_errors(runs[i], runs.front());
        ValidationPoint point{.label = variants[i].label,
                              .series = variants[i].series,
                              .cost = costs[i],
                              .error = 100 * models[i].wrong_links};
        links.points.push_back(point);
        point.error = errors.mean;
        if (errors.likely) {
            point.error_low = errors.likely->low;
            point.error_high = errors.likely->high;
        }
        point.details = {{"bias [-]", errors.bias},
                         {"replications", static_cast<double>(replications)}};
        delivery.points.push_back(std::move(point));
    }
    return {delivery, links};
}

/// The point of least error that costs at most `cost` [ns], but for the reference.
const ValidationPoint* best_within(const ValidationPanel& panel, double cost) {
    const ValidationPoint* best = nullptr;
    for (const ValidationPoint& p : panel.points) {
        if (p.series == reference_series || p.cost.median > cost) continue;
        if (!best || p.error < best->error) best = &p;
    }
    return best;
}

std::string name_of(const ValidationPoint& p) { return p.label + " " + p.series; }

/// The best model, the best that costs a hundredth, and what fitting did to that.
std::string nearest_sentence(const ValidationPanel& panel) {
    const ValidationPoint& reference = panel.points.front();
    const ValidationPoint* best = best_within(panel, reference.cost.median);
    const ValidationPoint* cheap = best_within(panel, 0.01 * reference.cost.median);
    if (!best) return "";
    const auto share = [&](const ValidationPoint& p) {
        return two_digits(p.cost.median / reference.cost.median);
    };
    std::string out =
        fmt::format("In the {}, {} comes nearest to {}: {:.2g} off, at {} of its cost.",
                    panel.title, name_of(*best), reference.label, best->error, share(*best));
    if (!cheap) return out;
    if (cheap != best) {
        out += fmt::format(" Of those that cost a hundredth {} comes nearest: {:.2g} off, at {}.",
                           name_of(*cheap), cheap->error, share(*cheap));
    }
    if (cheap->series != after_fit) return out;
    for (const ValidationPoint& p : panel.points) {
        if (p.label == cheap->label && p.series == as_given)
            out += fmt::format(" Without the fit it is {:.2g} off.", p.error);
    }
    return out;
}

}  // namespace

std::vector<ValidationChart> path_loss_charts(const ValidationSize& size) {
    const std::size_t replications = size.of(40, 2);
    std::vector<ScenePanels> panels;
    panels.push_back(panels_of(open_field_scene(), in_the_open, replications, size));
    panels.push_back(panels_of(office_scene(), among_walls, replications, size));
    panels.push_back(panels_of(cave_scene(), among_walls, replications, size));
    const std::string truth = fmt::format(
        "Robots on the move flood a message every two seconds, {} replications of each scene. True "
        "is the exact sum of two rays on the open field, and in the office and in the cave rays of "
        "three reflections with diffraction by UTD. Fitted: to losses of the true model on other "
        "replications, as `rovernet advise` does.",
        replications);
    ValidationChart delivery{
        .name = "path_loss", .title = "Which path loss model, and is it fitted?", .truth = truth};
    ValidationChart links{.name = "wrong_links",
                          .title = "How many links does a path loss model decide wrongly?",
                          .truth = truth};
    for (ScenePanels& scene : panels) {
        delivery.sentences.push_back(nearest_sentence(scene.delivery));
        links.sentences.push_back(nearest_sentence(scene.links));
        delivery.panels.push_back(std::move(scene.delivery));
        links.panels.push_back(std::move(scene.links));
    }
    return {delivery, links};
}

}  // namespace rovernet
