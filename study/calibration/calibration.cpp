// SPDX-License-Identifier: MIT
#include "study/calibration/calibration.hpp"

#include "models/propagation/friis.hpp"
#include "scenario/unlikely.hpp"
#include "sim/told_apart.hpp"
#include "study/calibration/disc_fit.hpp"
#include "study/calibration/free_parameters.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace rovernet {
namespace {

constexpr double least_distance = 1e-3;  // [m] a disc's range is fitted on a logarithmic scale
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

std::set<std::uint32_t> groups_of(const KnownLinks& known) {
    std::set<std::uint32_t> groups;
    for (const KnownLink& link : known.links) groups.insert(link.group);
    return groups;
}

/// Gives a fit without standard errors those of a jackknife over the groups:
///   se^2 = (G - 1) / G sum over the groups g of (b_g - mean)^2,  b_g fitted to the other groups.
void jackknife(LinearCalibration::Solution& fit,
               const std::vector<LinearCalibration::Solution>& without_a_group) {
    const auto groups = static_cast<double>(without_a_group.size());
    const auto fill = [&](Coefficient& whole, const auto& of) {
        if (std::isfinite(whole.se_by_group)) return;
        double mean = 0, squares = 0;
        for (const auto& each : without_a_group) mean += of(each).value / groups;
        for (const auto& each : without_a_group) {
            const double off = of(each).value - mean;
            squares += off * off;
        }
        whole.se_by_group = std::sqrt((groups - 1) / groups * squares);
    };
    for (std::size_t k = 0; k < fit.coefficients.size(); ++k)
        fill(fit.coefficients[k], [&](const auto& each) { return each.coefficients[k]; });
    for (std::size_t k = 0; k < fit.gains.size(); ++k)
        fill(fit.gains[k].gain, [&](const auto& each) { return each.gains[k].gain; });
}

/// Whether a model has no losses in dB, so that only its decisions (link up or down) can be wrong.
bool decides_only(std::string_view model) {
    return !key_determined(model, Fit::Way::decisions).empty();
}

void calibrate_linear(const KnownLinks& known, const Scenario& scenario, Meters decided_within,
                      Gains gains, CalibratedModel& out) {
    const LinearCalibration linear(known, scenario, out.model, gains);
    auto all = linear.fit([](const KnownLink&) { return true; });
    const auto take_parameters = [&] {
        FittedSettings settings = linear.settings(all);
        out.parameters = std::move(settings.parameters);
        out.settings = std::move(settings.tables);
        out.gains = all.gains;
    };
    take_parameters();
    Predictions fitted(known, decided_within), left_out(known, decided_within);
    for (std::size_t i = 0; i < known.links.size(); ++i) fitted.add(i, linear.predict(all, i));
    out.fitted = fitted.errors();
    out.worst = fitted.worst();
    const auto groups = groups_of(known);
    if (groups.size() < 2) return;
    std::vector<LinearCalibration::Solution> without_a_group;
    for (const std::uint32_t group : groups) {
        const auto& others = without_a_group.emplace_back(
            linear.fit([&](const KnownLink& l) { return l.group != group; }));
        for (std::size_t i = 0; i < known.links.size(); ++i) {
            if (known.links[i].group == group) left_out.add(i, linear.predict(others, i));
        }
    }
    out.left_out = left_out.errors();
    jackknife(all, without_a_group);
    take_parameters();
}

/// Disc with the fewest wrong decisions on links for which `takes(link)` is true.
template <class Takes>
DiscFit disc_of(const KnownLinks& known, Meters within, const Takes& takes) {
    std::vector<DiscLink> links;
    for (const KnownLink& link : known.links) {
        if (!takes(link) || link.distance() > within.value) continue;
        links.push_back({std::max(link.distance(), least_distance), link.up()});
    }
    return fit_disc(std::move(links));
}

/// Fits a model whose only parameter is the range within which links are up.
void calibrate_range(const KnownLinks& known, Meters decided_within, std::string_view key,
                     CalibratedModel& out) {
    const Meters range =
        disc_of(known, decided_within, [](const KnownLink&) { return true; }).range;
    out.parameters.push_back({.key = std::string(key),
                              .unit = "m",
                              .value = range.value,
                              .se_plain = no_number,
                              .se_by_group = no_number});
    Table propagation;
    propagation.set("model", out.model);
    propagation.set(key, fmt::format("{:.6g} m", range.value));
    out.settings.set("propagation", std::move(propagation));
    Predictions fitted(known, decided_within), left_out(known, decided_within);
    for (std::size_t i = 0; i < known.links.size(); ++i) {
        fitted.add(i, std::nullopt, known.links[i].distance() <= range.value);
    }
    out.fitted = fitted.errors();
    const auto groups = groups_of(known);
    if (groups.size() < 2) return;
    for (const std::uint32_t group : groups) {
        const Meters others = disc_of(known, decided_within, [&](const KnownLink& l) {
                                  return l.group != group;
                              }).range;
        for (std::size_t i = 0; i < known.links.size(); ++i) {
            const KnownLink& link = known.links[i];
            if (link.group == group) left_out.add(i, std::nullopt, link.distance() <= others.value);
        }
    }
    out.left_out = left_out.errors();
}

/// Errors of a model with the scenario's parameters; none if a required parameter is missing.
std::optional<PredictionErrors> errors_as_given(const KnownLinks& known, const Scenario& scenario,
                                                const std::string& model, Meters decided_within) {
    try {
        const Propagation given = model_with(scenario, model, {});
        Predictions predictions(known, decided_within);
        for (std::size_t i = 0; i < known.links.size(); ++i) {
            given.check_frequency(known.links[i].frequency);
            const double loss = known.loss_by(given, known.links[i]);
            if (decides_only(model)) {
                predictions.add(i, std::nullopt, loss <= known.links[i].budget);
            } else {
                predictions.add(i, loss);
            }
        }
        return predictions.errors();
    } catch (const InputError&) {
        return std::nullopt;
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
}

}  // namespace

namespace {

/// A model without a fit, and why.
CalibratedModel failed(std::string model, std::string why) {
    CalibratedModel out;
    out.model = std::move(model);
    out.failure = std::move(why);
    return out;
}

/// Reason why the parameters are invalid in a scenario; empty: they are valid.
std::string fault_of(const CalibratedModel& model, const Scenario& scenario) {
    std::map<std::string, double> values;
    for (const FittedParameter& p : model.parameters) {
        if (p.determined && p.key != "power") values[p.key] = p.value;
    }
    try {
        model_with(scenario, model.model, values);
    } catch (const InputError& e) {
        return e.message();
    } catch (const std::invalid_argument& e) {
        return e.what();
    }
    return "";
}

}  // namespace

std::vector<CalibratedModel> calibrate(const KnownLinks& known, const Scenario& scenario,
                                       const std::string& except, Meters decided_within,
                                       Gains gains, const std::function<void(double)>& tell) {
    std::vector<CalibratedModel> out;
    std::size_t begun = 0;
    for_each_model([&]<class Model>() {
        if (tell) tell(static_cast<double>(begun++) / std::tuple_size_v<PropagationModels>);
        CalibratedModel model;
        model.model = Model::name;
        if (model.model == except) return;
        try {
            const auto range = key_determined(model.model, Fit::Way::decisions);
            if (range.empty()) {
                calibrate_linear(known, scenario, decided_within, gains, model);
            } else {
                calibrate_range(known, decided_within, range, model);
            }
            model.as_given = errors_as_given(known, scenario, model.model, decided_within);
        } catch (const std::invalid_argument& e) {
            model = failed(std::move(model.model), e.what());
        } catch (const InputError& e) {
            model = failed(std::move(model.model), e.message());
        }
        if (model.failure.empty()) model.refusal = fault_of(model, scenario);
        out.push_back(std::move(model));
    });
    if (known.measured) refuse_absurd(out, scenario.radio.power);
    return out;
}

void refuse_absurd(std::vector<CalibratedModel>& models, Dbm given_power) {
    constexpr double most_db = 30, much = 2, more_db = 3, nothing_db = 20;
    const auto error_of = [](const CalibratedModel& m) {
        return m.left_out ? m.left_out->rmse : m.fitted.rmse;
    };
    const auto free_space = std::find_if(models.begin(), models.end(), [](const auto& m) {
        return m.model == Friis::name && m.failure.empty();
    });
    for (CalibratedModel& model : models) {
        if (!model.failure.empty() || model.fitted.losses == 0 || !model.refusal.empty()) continue;
        for (const FittedParameter& p : model.parameters) {
            if (p.key == "power" && std::abs(p.value - given_power.value) > most_db) {
                model.refusal = fmt::format(
                    "the fitted power of {} dBm differs by more than {} dB from the given power of "
                    "{:.4g} dBm; check the power in [radio]",
                    told_apart(
                        p.value,
                        given_power.value + (p.value > given_power.value ? most_db : -most_db), 0),
                    most_db, given_power.value);
            } else if (p.is_constant && p.determined && std::abs(p.value) > most_db) {
                model.refusal = fmt::format(
                    "the fitted {} of {} dB is more than {} dB away from 0 dB; check the power in "
                    "[radio]",
                    p.key, told_apart(p.value, p.value > 0 ? most_db : -most_db, 1), most_db);
            }
        }
        const double error = error_of(model);
        const double friis = free_space == models.end() ? error : error_of(*free_space);
        if (!model.refusal.empty()) continue;
        if (error > much * friis && error > friis + more_db) {
            model.refusal = fmt::format(
                "the error of this model, {:.1f} dB, is far above {:.1f} dB, the error of friis "
                "with a fitted constant",
                error, friis);
        } else if (error > nothing_db) {
            model.refusal = fmt::format(
                "the error of this model, {} dB, is more than {} dB: the model does not describe "
                "the levels",
                told_apart(error, nothing_db, 1), nothing_db);
        }
    }
}

double loss_error_at_budget(const KnownLinks& known, const Scenario& scenario) {
    const auto losses =
        linear_losses(known, scenario, LogDistance::name, free_parameters(LogDistance::name));
    const auto fitted = [&](double shift) {
        Observations data{.columns = 2};
        for (std::size_t i = 0; i < losses.size(); ++i) {
            if (known.links[i].unseen) continue;
            data.add(std::vector{losses[i].columns[0] - shift, losses[i].columns[1]},
                     known.links[i].loss - losses[i].offset, known.links[i].group);
        }
        return least_squares(data);
    };
    const LinearFit fit = fitted(0);
    if (!fit.coefficients[0] || !fit.coefficients[1]) return no_number;
    double budget = 0, offset = 0;
    for (std::size_t i = 0; i < losses.size(); ++i) {
        budget += known.links[i].budget / static_cast<double>(losses.size());
        offset += losses[i].offset / static_cast<double>(losses.size());
    }
    const double crossing =
        (budget - offset - fit.coefficients[1]->value) / fit.coefficients[0]->value;
    return fitted(crossing).coefficients[1]->se_by_group;
}

KnownLinks censored(KnownLinks known, Db beyond) {
    for (KnownLink& link : known.links) {
        if (link.loss <= link.budget + beyond.value) continue;
        link.unseen = true;
        link.loss = link.budget + beyond.value;
    }
    return known;
}

Calibration calibrate_to_model(const Scenario& scenario, const std::string& reference,
                               const std::function<void(double)>& tell, Db beyond) {
    constexpr std::uint32_t most_replications_sampled = 320;
    Calibration out;
    const std::string model =
        reference.empty() ? std::string(scenario.propagation.make().name()) : reference;
    const Propagation truth = model_with(scenario, model, {});
    refuse_disc(truth, scenario.propagation_where, "a fit");
    out.reference = model;
    const SampleSize first;
    LinkSample sample(scenario, truth, first);
    for (std::uint32_t replications = first.replications;; replications *= 2) {
        out.known = censored(sample.grow(replications, tell), beyond);
        out.loss_error = loss_error_at_budget(out.known, scenario);
        const bool alike = out.known.groups < replications;  // more would be the same again
        if (out.loss_error <= Calibration::enough || alike ||
            replications >= most_replications_sampled) {
            break;
        }
    }
    const KnownLink& some = out.known.links.front();
    double budget = some.budget;
    for (const KnownLink& link : out.known.links) budget = std::max(budget, link.budget);
    out.decided_within = truth.reach(Db{budget}, some.frequency);
    out.models = calibrate(out.known, scenario, model, out.decided_within, Gains::equal, tell);
    return out;
}

namespace {

/// Checks that gains of transmitter positions can be determined.
/// @throws InputError if these are one, or too many
void check_transmitters(const KnownLinks& known, const std::string& path) {
    constexpr std::size_t fewest = 2, most = 200;
    std::set<std::tuple<double, double, double>> places;
    for (const KnownLink& link : known.links) places.emplace(link.from.x, link.from.y, link.from.z);
    if (places.size() >= fewest && places.size() <= most) return;
    throw InputError(
        {path, 0, 0},
        fmt::format("found {} transmitter position{}; expected {} to {} positions, because a gain "
                    "is fitted for each position{}",
                    places.size(), places.size() == 1 ? "" : "s", fewest, most,
                    places.size() > most
                        ? "; are the columns of transmitters (from) and receivers (to) exchanged?"
                        : ""));
}

}  // namespace

Calibration calibrate_to_levels(const Scenario& scenario, const std::string& path,
                                std::optional<Dbm> floor, Gains gains) {
    Calibration out;
    out.known = read_levels(path, scenario, floor);
    const bool any_seen = std::any_of(out.known.links.begin(), out.known.links.end(),
                                      [](const KnownLink& link) { return !link.unseen; });
    if (!any_seen)
        throw InputError({path, 0, 0},
                         "found no level above the floor (--floor), below which nothing is "
                         "received; expected at least one level above the floor");
    if (gains == Gains::by_transmitter) check_transmitters(out.known, path);
    out.loss_error = loss_error_at_budget(out.known, scenario);
    out.models = calibrate(out.known, scenario, "", Propagation::anything, gains);
    return out;
}

namespace {

/// Gain of the transmitter at a place [dB]; 0, their mean, of one that is not known.
double gain_at(const std::vector<TransmitterGain>& gains, Vec3 place) {
    for (const TransmitterGain& each : gains) {
        if (each.at == place) return each.gain.value;
    }
    return 0;
}

}  // namespace

Repeatability check(Calibration& calibration, const Scenario& scenario, const std::string& path,
                    std::optional<Dbm> floor) {
    return check(calibration, scenario, read_levels(path, scenario, floor));
}

Repeatability check(Calibration& calibration, const Scenario& scenario, const KnownLinks& others) {
    for (CalibratedModel& model : calibration.models) {
        if (!model.failure.empty()) continue;
        std::map<std::string, double> values;
        double constant = 0;
        for (const FittedParameter& p : model.parameters) {
            if (p.key == "power") {
                constant = scenario.radio.power.value - p.value;
            } else if (p.determined) {
                values[p.key] = p.value;
            }
        }
        const Propagation fitted = model_with(scenario, model.model, values);
        Predictions predictions(others, Propagation::anything);
        for (std::size_t i = 0; i < others.links.size(); ++i) {
            const double loss = others.loss_by(fitted, others.links[i]) + constant -
                                gain_at(model.gains, others.links[i].from);
            const bool up = loss <= others.links[i].budget;
            predictions.add(i, decides_only(model.model) ? std::nullopt : std::optional(loss), up);
        }
        model.checked = predictions.errors();
    }
    return repeatability(calibration.known, others);
}

}  // namespace rovernet
