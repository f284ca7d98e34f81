// SPDX-License-Identifier: MIT
#include "models/propagation/list.hpp"
#include "scene/scene.hpp"
#include "study/calibration/calibration.hpp"
#include "study/calibration/free_parameters.hpp"
#include "study/validation/cases/measured_levels.hpp"
#include "study/validation/validation_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {
namespace {

constexpr const char *with_defaults = "as given", *with_fit = "fitted";

/// Mean of losses less those of a model [dB]: the constant that every model may have.
double constant_of(const KnownLinks& known, const Propagation& model) {
    double sum = 0;
    for (const KnownLink& link : known.links) sum += link.loss - known.loss_by(model, link);
    return sum / static_cast<double>(known.links.size());
}

/// Errors on `judged` of a model whose constant is that of `own`.
PredictionErrors errors_with_constant(const KnownLinks& own, const KnownLinks& judged,
                                      const Propagation& model) {
    const double constant = constant_of(own, model);
    Predictions predictions(judged, Propagation::anything);
    for (std::size_t i = 0; i < judged.links.size(); ++i) {
        predictions.add(i, judged.loss_by(model, judged.links[i]) + constant);
    }
    return predictions.errors();
}

KnownLinks only(const KnownLinks& known, const std::function<bool(const KnownLink&)>& takes) {
    KnownLinks out = known;
    std::erase_if(out.links, [&](const KnownLink& link) { return !takes(link); });
    return out;
}

/// Calibrations of all models to the first set, checked on the second.
std::map<std::string, CalibratedModel> checked_models(const KnownLinks& first,
                                                      const KnownLinks& second,
                                                      const Scenario& scenario) {
    Calibration calibration;
    calibration.known = first;
    calibration.models = calibrate(first, scenario, "", Propagation::anything);
    check(calibration, scenario, second);
    std::map<std::string, CalibratedModel> out;
    for (CalibratedModel& model : calibration.models) {
        if (model.failure.empty() && model.checked && model.checked->losses > 0)
            out.emplace(model.model, std::move(model));
    }
    return out;
}

/// Root mean square errors [dB] where each receiver is predicted without its own levels.
std::map<std::string, double> without_receiver(const MeasuredBuilding& building) {
    std::set<std::uint32_t> groups;
    for (const KnownLink& link : building.second.links) groups.insert(link.group);
    std::map<std::string, double> squares;
    for (const std::uint32_t group : groups) {
        const auto of_group = [=](const KnownLink& link) { return link.group == group; };
        const KnownLinks left = only(building.second, of_group);
        for (const auto& [name, model] :
             checked_models(only(building.first, std::not_fn(of_group)), left, building.scenario)) {
            squares[name] +=
                model.checked->rmse * model.checked->rmse * static_cast<double>(left.links.size());
        }
    }
    for (auto& [name, sum] : squares)
        sum = std::sqrt(sum / static_cast<double>(building.second.links.size()));
    return squares;
}

/// Fitted model, with its parameters in it.
Propagation fitted_model(const Scenario& scenario, const CalibratedModel& model) {
    std::map<std::string, double> values;
    for (const FittedParameter& p : model.parameters) {
        if (p.determined && p.key != "power") values[p.key] = p.value;
    }
    return model_with(scenario, model.model, values);
}

/// Points of the models of a building, and the models themselves, for their costs.
struct JudgedModels {
    std::vector<ValidationPoint> points;
    std::vector<Propagation> models;

    void add(const Propagation& model, const char* series, const PredictionErrors& errors) {
        points.push_back({.label = std::string(model.name()),
                          .series = series,
                          .error = errors.rmse,
                          .details = {{"wrong side of -65 dBm [%]", 100 * errors.wrong()}},
                          .parts = parts_of(errors)});
        models.push_back(model);
    }

  private:
    /// Squared error [dB^2] of each receiver, weighted so that their mean is that of all levels.
    static std::vector<double> parts_of(const PredictionErrors& errors) {
        std::vector<double> parts;
        const double a_group =
            static_cast<double>(errors.losses) / static_cast<double>(errors.groups.size());
        for (const auto& [group, of] : errors.groups) parts.push_back(of.squares / a_group);
        return parts;
    }
};

JudgedModels judged_models(const MeasuredBuilding& building) {
    JudgedModels out;
    const auto models = checked_models(building.first, building.second, building.scenario);
    const auto left_out = without_receiver(building);
    for_each_model([&]<class Model>() {
        const auto at = models.find(std::string(Model::name));
        if (at == models.end()) return;
        const Propagation given = model_with(building.scenario, Model::name, {});
        out.add(given, with_defaults, errors_with_constant(building.first, building.second, given));
        const auto& parameters = at->second.parameters;
        const bool is_fitted =
            std::any_of(parameters.begin(), parameters.end(),
                        [](const FittedParameter& p) { return p.determined && p.key != "power"; });
        if (is_fitted) {
            out.add(fitted_model(building.scenario, at->second), with_fit, *at->second.checked);
        }
        ValidationPoint& point = out.points.back();
        const double other = left_out.at(at->first);
        point.error_low = std::min(point.error, other);
        point.error_high = std::max(point.error, other);
    });
    return out;
}

ValidationPanel building_panel(const MeasuredBuilding& building, const ValidationSize& size) {
    const JudgedModels judged = judged_models(building);
    const Repeatability repeated = repeatability(building.first, building.second);
    ValidationPanel panel{
        .title = building.name,
        .error_label = "error on another drive or day, rms [dB]",
        .log_error = false,
        .unknowable = repeated.one_level(),
        .interval_label = "end of a bar: error if a receiver's own levels are left out of the fit",
        .points = judged.points};
    panel.unknowable_label = fmt::format(
        "repeated measurements differ by {:.2f} dB, so even a perfect model errs by {:.2f} dB",
        repeated.rms, repeated.one_level());
    std::vector<TimedMethod> timed;
    for (const Propagation& model : judged.models) {
        timed.push_back(timed_sum(building.second.links, [&](const KnownLink& link) {
            return building.second.loss_by(model, link);
        }));
    }
    set_costs(panel, timed, size.turns());
    return panel;
}

std::string best_sentence(const ValidationPanel& panel, const Repeatability& repeated) {
    const Nearest nearest = nearest_to_truth(panel, [](const ValidationPoint&) { return true; });
    return fmt::format(
        "{} (levels of {} receivers): {}. The rms error of free space (friis) is {:.2f} dB. "
        "The rms difference of repeated measurements at the same positions is {:.2f} dB, so even a "
        "perfect model would have an rms error of {:.2f} dB (the difference divided by the square "
        "root of 2).",
        panel.title, nearest.point->parts.size(),
        nearest_text(nearest,
                     [](double error) { return fmt::format("rms error {:.2f} dB", error); }),
        point_of(panel, "friis", with_defaults).error, repeated.rms, repeated.one_level());
}

/// Whether rays are worth their cost, and what of it is due to a fit.
std::string rays_sentence(const ValidationPanel& panel) {
    const auto is_rays = [](const ValidationPoint& p) { return p.label == "rays"; };
    const Nearest rays = nearest_to_truth(panel, is_rays);
    const ValidationPoint &walls = point_of(panel, "multi_wall", with_fit), &best = *rays.point;
    const double excess = best.error - walls.error;
    std::string out = fmt::format(
        "{}: the rms error of rays is {:.2f} dB {} than the rms error of the fitted multi_wall, "
        "and rays cost {} times as much CPU time.",
        panel.title, std::abs(excess), excess <= 0 ? "smaller" : "larger",
        two_digits(best.cost.median / walls.cost.median));
    if (best.series == with_defaults)
        return out + " Only one constant was fitted for rays (the sum of power and gains).";
    return out + fmt::format(
                     " With walls of concrete (the default), the rms error of rays is {:.2f} dB. "
                     "With the wall loss that the fit estimates, the rms error is {:.2f} dB.",
                     point_of(panel, "rays", with_defaults).error, best.error);
}

/// Errors that an independent analysis of the same measurements has published [dB].
void check_anchors(const ValidationPanel& panel, Promises& promises) {
    constexpr double allowed = 0.2;  // [dB] for walls as the map draws them
    const auto add = [&](const char* model, const char* series, double published) {
        const double excess = point_of(panel, model, series).error - published;
        promises.push_back(
            {fmt::format("amount by which the rms error of {} ({}) in the {} exceeds "
                         "the {} dB that an independent analysis found",
                         model, series, panel.title, published),
             "dB", allowed, std::max(0.0, excess), 1});
    };
    const bool flat = panel.title == "flat";
    add("friis", with_defaults, flat ? 5.39 : 4.90);
    if (flat) add("multi_wall", with_fit, 4.29);
    if (!flat) add("log_distance", with_fit, 4.75);
}

}  // namespace

Db error_against(const MeasuredBuilding& building, const Propagation& model) {
    const double all = errors_with_constant(building.first, building.second, model).rmse;
    const double of_levels = repeatability(building.first, building.second).one_level();
    return Db{std::sqrt(std::max(0.0, all * all - of_levels * of_levels))};
}

ValidationChart measured_chart(const std::string& folder, const ValidationSize& size,
                               Promises& promises) {
    ValidationChart chart{
        .name = "measured",
        .title = "How wrong are the models in measured buildings?",
        .truth =
            "The levels are local means in a furnished flat, from drives of a robot (Kolakowski, "
            "Sensors 21, 2021, CC BY 4.0), and medians in an open laboratory (Danis et al., "
            "Pervasive and Mobile Computing 81, 2022, CC0). The models are fitted to the levels of "
            "one drive or day, and judged by the levels of a different drive or day. As given: the "
            "model has its default parameters; only one constant (the sum of power and gains) is "
            "fitted. In the picture, a bar leads from the error of a model to the error of the "
            "same model if the levels of each receiver are predicted by a fit without this "
            "receiver."};
    for (const auto& building : {measured_flat(folder), measured_lab(folder)}) {
        const ValidationPanel panel = building_panel(building, size);
        check_anchors(panel, promises);
        chart.sentences.push_back(
            best_sentence(panel, repeatability(building.first, building.second)));
        chart.sentences.push_back(rays_sentence(panel));
        chart.panels.push_back(panel);
    }
    std::erase(chart.sentences, "");
    return chart;
}

}  // namespace rovernet
