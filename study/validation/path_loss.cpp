// SPDX-License-Identifier: MIT
#include "scenario/document/toml.hpp"
#include "sim/math.hpp"
#include "study/advise/medium_cost.hpp"
#include "study/calibration/calibration.hpp"
#include "study/calibration/free_parameters.hpp"
#include "study/calibration/known_links.hpp"
#include "study/calibration/prediction_errors.hpp"
#include "study/validation/cases/measured_levels.hpp"
#include "study/validation/cases/validation_scene.hpp"
#include "study/validation/validation_charts.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {
namespace {

constexpr const char *as_given = "as given", *after_fit = "fitted", *reference_series = "reference",
                     *fewer_paths = "the reference with fewer paths";

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

/// Model whose losses are taken as true, cheaper forms of it, and the building that it was held
/// against.
struct Truth {
    Form model;
    std::span<const Form> cheaper = {};
    std::optional<Db> own_error = {};  ///< see error_against(); none if there is no measurement
    const char* building = "";
    const char* form = "";  ///< settings of the model, in words
};
constexpr Form exact_two_rays{"two_ray", "model = 'two_ray'\nform = 'exact'"};
constexpr Form all_rays{"rays", "model = 'rays'\norder = 3\ndiffraction = 'utd'"};

Table propagation_settings(Table propagation) {
    Table settings;
    settings.set("propagation", std::move(propagation));
    return settings;
}
Table settings_of(const Form& form) {
    return propagation_settings(*parse_toml(form.keys, form.label).table());
}
/// Model with all default parameters.
Table settings_of(const std::string& model) {
    Table propagation;
    propagation.set("model", model);
    return propagation_settings(std::move(propagation));
}

/// Variant, and the links that it decides wrongly.
struct JudgedModel {
    Variant variant;
    PredictionErrors links = {};
};

/// Share of links decided wrongly in each group [%], weighted so that their mean is that of all.
std::vector<double> wrong_by_group(const PredictionErrors& errors) {
    std::vector<double> parts;
    const double a_group =
        static_cast<double>(errors.decisions) / static_cast<double>(errors.groups.size());
    for (const auto& [group, of] : errors.groups)
        parts.push_back(100 * static_cast<double>(of.wrong) / a_group);
    return parts;
}

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

/// Errors of a form on the known links.
PredictionErrors link_errors(const Scenario& scenario, const Calibration& calibration) {
    const Propagation model = scenario.propagation.make();
    Predictions predictions(calibration.known, calibration.decided_within);
    for (std::size_t i = 0; i < calibration.known.links.size(); ++i) {
        predictions.add(i, calibration.known.loss_by(model, calibration.known.links[i]));
    }
    return predictions.errors();
}

/// Models of a scene, the reference first.
std::vector<JudgedModel> models_of(const ValidationScene& scene, const Truth& truth,
                                   const Calibration& calibration) {
    std::vector<JudgedModel> out{{{truth.model.label, reference_series, settings_of(truth.model)}}};
    for (const CalibratedModel& model : calibration.models) {
        if (!model.failure.empty()) continue;
        if (model.as_given && model.model != "disc")
            out.push_back({{model.model, as_given, settings_of(model.model)}, *model.as_given});
        if (!model.is_fitted()) continue;
        out.push_back({{model.model, after_fit, model.settings},
                       model.left_out ? *model.left_out : model.fitted});
    }
    for (const Form& form : truth.cheaper) {
        const Table fewer = settings_of(form);
        out.push_back(
            {{form.label, fewer_paths, fewer}, link_errors(scene.scenario(fewer), calibration)});
    }
    return out;
}

/// Reference with an error as large as in the measured building: a shadowing field added to its
/// losses.
Table moved_by_its_error(const Truth& truth) {
    Table settings = settings_of(truth.model), shadowing;
    shadowing.set("model", "field");
    shadowing.set("sigma", fmt::format("{} dB", truth.own_error->value));
    settings.set("shadowing", std::move(shadowing));
    return settings;
}

/// Share of the known links that the truth decides wrongly if its losses have a normal error.
double wrong_by_its_error(const Calibration& calibration, Db error) {
    double wrong = 0, decisions = 0;
    for (const KnownLink& link : calibration.known.links) {
        if (link.distance() > calibration.decided_within.value) continue;
        const double margin = std::abs(link.loss - link.budget);
        wrong += math::erfc(margin / error.value / std::numbers::sqrt2) / 2;
        ++decisions;
    }
    return wrong / decisions;
}

std::vector<MediumCost> medium_costs(const ValidationScene& scene,
                                     const std::vector<Variant>& variants,
                                     const ValidationSize& size) {
    std::vector<Scenario> scenarios;
    for (const Variant& variant : variants) scenarios.push_back(scene.scenario(variant.settings));
    const auto never_stopped = [] { return false; };
    const CostTurns turns{
        .turns = size.quick ? 1 : 5,
        .total_s = (size.quick ? 0.05 : 1.0) * static_cast<double>(variants.size())};
    std::vector<MediumCost> costs = measure_medium(record_medium(scenarios.front(), never_stopped),
                                                   scenarios, turns, never_stopped)
                                        .models;
    costs.resize(variants.size());
    return costs;
}

/// The two panels of a scene, and its sentences.
struct ScenePanels {
    ValidationPanel delivery, links;
    std::vector<std::string> delivery_sentences, links_sentences;
};

constexpr const char* receivers_found = "receivers per frame";

std::string off_in_a_run(double error) {
    return fmt::format("delivery ratio wrong by {:.2g}", error);
}
std::string links_wrong(double error) { return fmt::format("{:.2g} % of the links wrong", error); }

/// The model that is nearest to the truth, at what cost, and what a fit did to it. Forms of the
/// truth itself do not compete: that they come near shows that paths converge.
std::string nearest_sentence(const ValidationPanel& panel,
                             const std::function<std::string(double)>& off) {
    const ValidationPoint& reference = panel.points.front();
    const Nearest nearest = nearest_to_truth(panel, [](const ValidationPoint& p) {
        return p.series != reference_series && p.series != fewer_paths;
    });
    std::string out = fmt::format("{}: {}. The cost of {} is {} times the cost of {}.", panel.title,
                                  nearest_text(nearest, off), nearest.point->label,
                                  two_digits(nearest.point->cost.median / reference.cost.median),
                                  reference.label);
    if (nearest.point->series != after_fit) return out;
    for (const ValidationPoint& p : panel.points) {
        if (p.label == nearest.point->label && p.series == as_given)
            out += fmt::format(" If {} is not fitted: {}.", p.label, off(p.error));
    }
    return out;
}

/// How far the truth itself is known to be true; first of all sentences.
std::string truth_sentence(const ValidationPanel& panel, const Truth& truth) {
    if (!truth.own_error) {
        return fmt::format(
            "{}: {} is the reference; the error of this reference is not known here.", panel.title,
            truth.model.label);
    }
    return fmt::format(
        "{0}: {1} is the reference. In a measured {2}, the rms error of {1} itself ({5}) is "
        "{3:.1f} dB, after the errors of the measurement are subtracted. An error of this size "
        "alone makes the delivery ratio of a run wrong by {4:.2g}. So a model whose error is below "
        "{4:.2g} agrees with {1}, but perhaps not with measurements.",
        panel.title, truth.model.label, truth.building, truth.own_error->value, *panel.unknowable,
        truth.form);
}

/// Remaining error with fewer paths.
std::string convergence_sentence(const ValidationPanel& panel,
                                 const std::function<std::string(double)>& off) {
    std::vector<std::string> forms;
    for (const ValidationPoint& p : panel.points) {
        if (p.series == fewer_paths) forms.push_back(fmt::format("{} ({})", p.label, off(p.error)));
    }
    if (forms.empty()) return "";
    return fmt::format("{}: errors of the reference model with fewer paths: {}.", panel.title,
                       fmt::join(forms, "; "));
}

/// Models that cost more, or less, because their reach is another one.
std::string reach_sentence(const ValidationPanel& panel) {
    constexpr double much = 1.5;
    std::vector<std::string> models;
    for (const ValidationPoint& given : panel.points) {
        if (given.series != as_given) continue;
        for (const ValidationPoint& fitted : panel.points) {
            if (fitted.series != after_fit || fitted.label != given.label) continue;
            const double before = detail_of(given, receivers_found),
                         after = detail_of(fitted, receivers_found);
            const bool more = after > much * before && fitted.cost.median > given.cost.median;
            const bool less = before > much * after && fitted.cost.median < given.cost.median;
            if (more || less)
                models.push_back(fmt::format("{} with {:.1f} receivers ({:.1f} without the fit)",
                                             given.label, after, before));
        }
    }
    if (models.empty()) return "";
    return fmt::format(
        "{}: the fit changes the mean number of receivers of a frame, and therefore the cost of "
        "these models: {}.",
        panel.title, fmt::join(models, ", "));
}

/// Point of a model in the panel of delivery ratios, made of its point in the panel of links.
ValidationPoint delivery_point(ValidationPoint point, const RunErrors& errors,
                               std::size_t replications) {
    point.error = errors.mean;
    point.parts = errors.distances;
    if (errors.likely) {
        point.error_low = errors.likely->low;
        point.error_high = errors.likely->high;
    }
    point.details.insert(
        point.details.begin(),
        {{"bias [-]", errors.bias}, {"replications", static_cast<double>(replications)}});
    return point;
}

ScenePanels panels_of(const ValidationScene& scene, const Truth& truth, std::size_t replications,
                      const ValidationSize& size) {
    const Calibration calibration =
        calibrated(scene.scenario(settings_of(truth.model)), truth.model.label, size);
    const std::vector<JudgedModel> models = models_of(scene, truth, calibration);
    std::vector<Variant> variants;
    for (const JudgedModel& model : models) variants.push_back(model.variant);
    const std::vector<MediumCost> costs = medium_costs(scene, variants, size);
    if (truth.own_error) variants.push_back({"", "", moved_by_its_error(truth)});
    const std::vector<VariantRuns> runs = paired_runs(scene, variants, replications);
    ValidationPanel delivery{.title = scene.name,
                             .cost_label = "CPU per transmission [ns]",
                             .error_label = "error of a run's delivery ratio [-]",
                             .log_error = false,
                             .interval_label = "95 % interval"};
    ValidationPanel links = delivery;
    links.error_label = "links decided wrongly [%]";
    if (truth.own_error) {
        delivery.unknowable = run_errors(runs.back(), runs.front()).mean;
        links.unknowable = 100 * wrong_by_its_error(calibration, *truth.own_error);
        delivery.unknowable_label = links.unknowable_label =
            fmt::format("error of {} itself (losses wrong by {:.1f} dB in one measured {})",
                        truth.model.label, truth.own_error->value, truth.building);
    }
    for (std::size_t i = 0; i < models.size(); ++i) {
        const MediumCost& cost = costs[i];
        ValidationPoint point{.label = variants[i].label,
                              .series = variants[i].series,
                              .cost = {1e9 * cost.median_s, 1e9 * cost.low_s, 1e9 * cost.high_s},
                              .error = 100 * models[i].links.wrong(),
                              .details = {{receivers_found, cost.receivers}},
                              .parts = wrong_by_group(models[i].links)};
        links.points.push_back(point);
        delivery.points.push_back(
            delivery_point(std::move(point), run_errors(runs[i], runs.front()), replications));
    }
    ScenePanels out{std::move(delivery), std::move(links), {}, {}};
    out.delivery_sentences = {
        truth_sentence(out.delivery, truth), nearest_sentence(out.delivery, off_in_a_run),
        convergence_sentence(out.delivery, off_in_a_run), reach_sentence(out.delivery)};
    out.links_sentences = {nearest_sentence(out.links, links_wrong),
                           convergence_sentence(out.links, links_wrong)};
    return out;
}

/// What is taken as true in the open and among walls.
struct Truths {
    Truth in_the_open{
        .model = exact_two_rays, .building = "open laboratory", .form = "exact sum of two rays"};
    Truth among_walls{.model = all_rays,
                      .cheaper = fewer_rays,
                      .building = "flat",
                      .form = "up to three reflections, UTD"};
};

Truths truths_of(const std::optional<std::string>& field) {
    Truths out;
    if (!field) return out;
    const auto error = [](const MeasuredBuilding& building, const Form& form) {
        Scenario scenario = building.scenario;
        scenario.propagation = {};
        read_propagation(*settings_of(form).find("propagation"), scenario.propagation);
        return error_against(building, scenario.propagation.make().median());
    };
    out.in_the_open.own_error = error(measured_lab(*field), exact_two_rays);
    out.among_walls.own_error = error(measured_flat(*field), all_rays);
    return out;
}

}  // namespace

std::vector<ValidationChart> path_loss_charts(const ValidationSize& size,
                                              const std::optional<std::string>& field) {
    const std::size_t replications = size.of(40, 2);
    const Truths truths = truths_of(field);
    std::vector<ScenePanels> scenes;
    scenes.push_back(panels_of(open_field_scene(), truths.in_the_open, replications, size));
    scenes.push_back(panels_of(office_scene(), truths.among_walls, replications, size));
    scenes.push_back(panels_of(cave_scene(), truths.among_walls, replications, size));
    const std::string truth = fmt::format(
        "In {} replications of each scene, the robots move, and one of them floods a message every "
        "two seconds. On the open field, the reference is the exact sum of two rays. In the office "
        "and in the cave, the reference is the model rays with three reflections and diffraction "
        "by UTD (uniform theory of diffraction). Fitted: the model is fitted to losses of the "
        "reference in other replications, as `rovernet advise` does. The grey band reaches up "
        "to the error of the reference itself, if its losses deviate from the truth as much as in "
        "measured buildings. The cost is the CPU time to find the receivers of frames.",
        replications);
    ValidationChart delivery{.name = "path_loss",
                             .title = "How near do cheap models come to a detailed model?",
                             .truth = truth};
    ValidationChart links{
        .name = "wrong_links",
        .title = "How many links does a path loss model decide wrongly?",
        .truth = truth,
        .sentences = {"A link is decided wrongly if the model says that the link is up and the "
                      "reference says that it is down, or the other way round."},
        .continues = true};
    const auto append = [](ValidationChart& chart, ValidationPanel panel,
                           const std::vector<std::string>& sentences) {
        for (const std::string& sentence : sentences)
            if (!sentence.empty()) chart.sentences.push_back(sentence);
        chart.panels.push_back(std::move(panel));
    };
    for (ScenePanels& scene : scenes) {
        append(delivery, std::move(scene.delivery), scene.delivery_sentences);
        append(links, std::move(scene.links), scene.links_sentences);
    }
    return {delivery, links};
}

}  // namespace rovernet
