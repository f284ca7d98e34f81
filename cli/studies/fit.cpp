// SPDX-License-Identifier: MIT
#include "cli/runs/run_commands.hpp"
#include "cli/terminal/text_table.hpp"
#include "cli/terminal/waiting.hpp"
#include "scenario/document/json.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/tables/read_value.hpp"
#include "scenario/tables/reader.hpp"
#include "study/calibration/calibration.hpp"
#include "study/statistics/distributions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace rovernet::cli {
namespace {

struct Fit {
    Calibration calibration;
    std::optional<Repeatability> repeatability;  // of measured levels
};

Fit fit_of(const FitArguments& a, const Scenario& scenario) {
    if (!a.links) {
        Waiting waiting("sampling links of " + a.file);
        return {calibrate_to_model(
                    scenario, a.to, [&](double share) { waiting.tell(share); }, beyond_radio),
                std::nullopt};
    }
    std::optional<Dbm> floor;
    if (a.floor) {
        Value value{*a.floor};
        value.where = {"--floor " + *a.floor, 0, 0, true};
        read_value(value, "floor", floor.emplace());
    }
    const Gains gains = a.gains ? Gains::by_transmitter : Gains::equal;
    Fit out{calibrate_to_levels(scenario, *a.links, floor, gains), std::nullopt};
    out.repeatability = a.check ? check(out.calibration, scenario, *a.check, floor)
                                : repeatability(out.calibration.known, {});
    return out;
}

Table as_table(const PredictionErrors& e) {
    Table table;
    table.set("losses", std::uint64_t{e.losses});
    table.set("rmse_db", e.losses > 0 ? Value(e.rmse) : Value());
    table.set("bias_db", e.losses > 0 ? Value(e.bias) : Value());
    table.set("most_in_95_percent_db", e.losses > 0 ? Value(e.most_in_95) : Value());
    table.set("decisions", std::uint64_t{e.decisions});
    table.set("false_up", std::uint64_t{e.false_up});
    table.set("false_down", std::uint64_t{e.false_down});
    table.set("wrong", e.wrong());
    return table;
}

Table as_table(const FittedParameter& p) {
    Table table;
    table.set("key", p.key);
    table.set("unit", p.unit);
    table.set("value", p.determined ? Value(p.value) : Value());
    table.set("se_by_group", p.se_by_group);
    table.set("se", p.se_plain);
    table.set("at_bound", p.at_bound);
    return table;
}

/// Line for the [[robot]] of a transmitter: its gain over that of [radio].
std::string gain_line(const TransmitterGain& each, const Scenario& scenario) {
    Table radio, robot;
    const double gain = scenario.radio.antenna_gain.value + each.gain.value;
    radio.set("antenna_gain", fmt::format("{:.2f} dB", std::round(100 * gain) / 100 + 0.0));
    robot.set("radio", std::move(radio));
    return to_toml(robot.entries.front().value);
}

Table as_table(const CalibratedModel& m, const Scenario& scenario) {
    Table table;
    table.set("model", m.model);
    if (!m.failure.empty()) {
        table.set("failure", m.failure);
        return table;
    }
    Array parameters, worst;
    for (const FittedParameter& p : m.parameters) parameters.push_back(as_table(p));
    for (const WorstLink& link : m.worst) {
        Table each;
        each.set("link", link.name);
        each.set("error_db", link.error);
        worst.push_back(std::move(each));
    }
    table.set("parameters", std::move(parameters));
    table.set("left_out", m.left_out ? Value(as_table(*m.left_out)) : Value());
    table.set("fitted", as_table(m.fitted));
    table.set("checked", m.checked ? Value(as_table(*m.checked)) : Value());
    table.set("as_given", m.as_given ? Value(as_table(*m.as_given)) : Value());
    table.set("worst", std::move(worst));
    Array gains;
    for (const TransmitterGain& each : m.gains) {
        Table row;
        row.set("at_m", Array{each.at.x, each.at.y, each.at.z});
        row.set("gain_db", each.gain.value);
        row.set("se_by_group", each.gain.se_by_group);
        row.set("toml", fmt::format("radio = {}", gain_line(each, scenario)));
        gains.push_back(std::move(row));
    }
    table.set("gains", std::move(gains));
    table.set("refusal", m.refusal.empty() ? Value() : Value(m.refusal));
    table.set("toml", m.refusal.empty() ? Value(to_toml(m.settings)) : Value());
    return table;
}

Table as_table(const Fit& fit, const Scenario& scenario) {
    const Calibration& c = fit.calibration;
    Table table;
    table.set("reference", c.reference.empty() ? Value() : Value(c.reference));
    table.set("links", std::uint64_t{c.known.links.size()});
    table.set("groups", std::uint64_t{c.known.groups});
    table.set("group", c.known.group_name);
    table.set("loss_error_db", c.loss_error);
    const auto& r = fit.repeatability;
    table.set("repeatability_db", r && r->levels > 0 ? Value(r->rms) : Value());
    table.set("one_level_db", r && r->levels > 0 ? Value(r->one_level()) : Value());
    table.set("repeated", std::uint64_t{r ? r->levels : 0});
    Array models;
    for (const CalibratedModel& m : c.models) models.push_back(as_table(m, scenario));
    table.set("models", std::move(models));
    return table;
}

/// Half of the 95 % interval of a number that was fitted: its standard error by group times the
/// quantile of Student's t with groups - 1 degrees of freedom. Nothing with one group.
std::optional<double> half_width(double se_by_group, std::size_t groups) {
    if (groups < 2 || !std::isfinite(se_by_group)) return std::nullopt;
    return t_critical(static_cast<double>(groups - 1), 0.05) * se_by_group;
}

std::string parameter_text(const FittedParameter& p, std::size_t groups) {
    if (!p.determined) return fmt::format("{} unchanged", p.key);
    std::string out = fmt::format("{} {:.4g}", p.key, p.value);
    if (p.at_bound) {
        out += " (at its limit)";
    } else if (const auto half = half_width(p.se_by_group, groups)) {
        out += fmt::format(" +- {:.2g}", *half);
    }
    return p.unit.empty() ? out : out + " " + p.unit;
}

std::string parameters_text(const CalibratedModel& m, std::size_t groups) {
    if (!m.failure.empty()) return m.failure;
    if (m.parameters.empty()) return "no parameter to fit";
    std::vector<std::string> texts;
    for (const FittedParameter& p : m.parameters) texts.push_back(parameter_text(p, groups));
    return fmt::format("{}", fmt::join(texts, ", "));
}

void print_calibrated(const Calibration& c) {
    // With one group nothing is left out, so that errors are of the links that were fitted to.
    TextTable table({"model", c.known.groups > 1 ? "rmse" : "rmse in-sample", "bias", "95 %",
                     "wrong links", "up", "down", "as given", "checked", "fitted"});
    for (const CalibratedModel& m : c.models) {
        const PredictionErrors& e = m.left_out ? *m.left_out : m.fitted;
        const auto db = [](const PredictionErrors& of, double value) {
            return of.losses == 0 ? std::string("-")
                                  : fmt::format("{:.2f} dB", std::round(100 * value) / 100 + 0.0);
        };
        const bool failed = !m.failure.empty();
        const auto unless_failed = [&](std::string text) { return failed ? "-" : text; };
        const auto short_text = [&](const std::optional<PredictionErrors>& of) {
            if (!of || failed) return std::string("-");
            return of->losses > 0 ? db(*of, of->rmse) : fmt::format("{:.1f} %", 100 * of->wrong());
        };
        table.add({m.model, db(e, e.rmse), db(e, e.bias), db(e, e.most_in_95),
                   unless_failed(fmt::format("{:.1f} %", 100 * e.wrong())),
                   unless_failed(fmt::format("{}", e.false_up)),
                   unless_failed(fmt::format("{}", e.false_down)), short_text(m.as_given),
                   short_text(m.checked), parameters_text(m, c.known.groups)});
    }
    fmt::print("{}", table.text());
}

/// Gains of the transmitters, by model.
void print_gains(const Calibration& c) {
    std::vector<const CalibratedModel*> models;
    for (const CalibratedModel& m : c.models)
        if (!m.gains.empty()) models.push_back(&m);
    if (models.empty()) return;
    std::vector<std::string> head{"transmitter at"};
    for (const CalibratedModel* m : models) head.push_back(m->model);
    TextTable table(head);
    for (std::size_t t = 0; t < models.front()->gains.size(); ++t) {
        const Vec3 at = models.front()->gains[t].at;
        std::vector<std::string> row{fmt::format("({:.2f}, {:.2f}, {:.2f}) m", at.x, at.y, at.z)};
        for (const CalibratedModel* m : models) {
            const Coefficient& gain = m->gains[t].gain;
            const auto half = half_width(gain.se_by_group, c.known.groups);
            row.push_back(half ? fmt::format("{:+.1f} +- {:.1f} dB", gain.value, *half)
                               : fmt::format("{:+.1f} dB", gain.value));
        }
        table.add(row);
    }
    fmt::print("\ngain of the transmitter at each position, relative to the mean gain\n{}",
               table.text());
}

/// Name of the only robot whose antenna is above or below a place; empty if none or several are.
std::string robot_at(const Scenario& scenario, Vec3 place) {
    constexpr double near = 0.01;  // [m]
    std::string name;
    for (const RobotTable& robot : scenario.robots) {
        if (!robot.at || std::hypot(robot.at->x - place.x, robot.at->y - place.y) > near) continue;
        if (!name.empty()) return "";
        name = robot.name;
    }
    return name;
}

/// Lines for a scenario file that hold the gains of a model's transmitters.
std::string gains_toml(const CalibratedModel& m, const Scenario& scenario) {
    std::string out;
    for (const TransmitterGain& each : m.gains) {
        const std::string name = robot_at(scenario, each.at);
        out += fmt::format("radio = {}  # [[robot]] {}at ({:.2f}, {:.2f}, {:.2f}) m\n",
                           gain_line(each, scenario), name.empty() ? "" : name + " ", each.at.x,
                           each.at.y, each.at.z);
    }
    return out;
}

/// Description of the links, and whether they suffice.
void print_known(const Fit& fit) {
    const Calibration& c = fit.calibration;
    const KnownLinks& known = c.known;
    double least = known.links.front().distance(), most = least;
    for (const KnownLink& link : known.links) {
        least = std::min(least, link.distance());
        most = std::max(most, link.distance());
    }
    fmt::print("{} links, {:.3g} to {:.3g} m long, in {} group{} (by {}); {}\n", known.links.size(),
               least, most, known.groups, known.groups == 1 ? "" : "s", known.group_name,
               c.reference.empty() ? "losses from the measured levels"
                                   : "losses computed by " + c.reference);
    const auto far = std::count_if(known.links.begin(), known.links.end(),
                                   [](const KnownLink& link) { return link.unseen; });
    if (!known.measured && far > 0) {
        fmt::print(
            "the loss of {} links exceeds the link budget by more than {} dB; for these links, the "
            "fit uses only this lower bound of the loss\n",
            far, beyond_radio.value);
    }
    if (fit.repeatability && fit.repeatability->levels > 0) {
        fmt::print(
            "repeatability {:.2f} dB: root mean square difference of {} repeated levels; even an "
            "exact model would have an error of {:.2f} dB\n",
            fit.repeatability->rms, fit.repeatability->levels, fit.repeatability->one_level());
    }
    if (!std::isfinite(c.loss_error)) {
        fmt::print(
            "too few links: these links do not determine the loss that log_distance predicts for a "
            "link at the limit of the link budget; expected more links, in more than one group\n");
    } else if (c.loss_error > Calibration::enough) {
        fmt::print(
            "too few links: the loss that log_distance predicts for a link at the limit of the "
            "link budget has a standard error of {:.2g} dB; expected more links, for a standard "
            "error of {} dB or less\n",
            c.loss_error, Calibration::enough);
    }
}

void print_fit(const Fit& fit, const Scenario& scenario) {
    const Calibration& c = fit.calibration;
    print_known(fit);
    fmt::print("\n");
    print_calibrated(c);
    if (c.known.groups > 1) {
        fmt::print(
            "\nrmse and bias: root mean square error and mean error on each {}, with the model "
            "fitted to all others; 95 %: 95 % of the absolute errors are at most this "
            "large;\nwrong links: links that are down but are predicted to be up (column up), or "
            "are up but are predicted to be down (column down);\nas given: rmse with the "
            "parameters of the file; checked: rmse on the levels of --check\n",
            c.known.group_name);
    } else {
        fmt::print(
            "\nin-sample: errors on the fitted links, because there is only one {}; errors on "
            "other links are larger\n",
            c.known.group_name);
    }
    print_gains(c);
    for (const CalibratedModel& m : c.models) {
        if (!m.refusal.empty()) {
            fmt::print("\ndo not use the fit of {} in a scenario: {}\n", m.model, m.refusal);
        } else if (m.is_fitted()) {
            fmt::print("\n{}", to_toml(m.settings));
        }
        if (m.refusal.empty() && !m.gains.empty()) {
            fmt::print("# a line for the [[robot]] at each transmitter position, for {}:\n{}",
                       m.model, gains_toml(m, scenario));
        }
    }
}

/// @throws InputError for a model that is not listed
void check_model(const std::string& name) {
    std::vector<std::string> names;
    for_each_model([&]<class Model>() { names.emplace_back(Model::name); });
    Value value{name};
    value.where = {"--to " + name, 0, 0, true};
    if (!name.empty()) read_choice(value, "propagation model", names);
}

}  // namespace

void fit(const FitArguments& a) {
    check_model(a.to);
    const Scenario scenario = scenario_of(a);
    const Fit made = fit_of(a, scenario);
    if (a.json) {
        fmt::print("{}", to_json(as_table(made, scenario)));
    } else {
        print_fit(made, scenario);
    }
}

}  // namespace rovernet::cli
