// SPDX-License-Identifier: MIT
#include "study/linear_calibration.hpp"

#include "study/tobit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace rovernet {

LinearCalibration::LinearCalibration(const KnownLinks& known, const Scenario& scenario,
                                     std::string_view model)
    : known_(known), scenario_(scenario), model_(model), free_(free_parameters(model)) {
    losses_ = linear_losses(known, scenario, model, free_);
    const bool has_constant =
        std::any_of(free_.begin(), free_.end(), [](const auto& p) { return p.key == "excess"; });
    if (known.measured && !has_constant) {
        free_.push_back({.model = model, .key = "power", .unit = "dBm"});
        for (LinearLoss& loss : losses_) loss.columns.push_back(1);
    }
    for (std::size_t j = 0; j < free_.size(); ++j) {
        const bool says_nothing =
            std::all_of(losses_.begin(), losses_.end(),
                        [&](const LinearLoss& l) { return std::abs(l.columns[j]) < 1e-9; });
        if (!says_nothing) used_.push_back(j);
    }
}

LinearCalibration::Solution LinearCalibration::fit(
    const std::function<bool(const KnownLink&)>& takes) const {
    if (used_.empty()) return {};
    Observations data{.columns = used_.size()};
    std::vector<bool> unseen;
    for (std::size_t i = 0; i < losses_.size(); ++i) {
        const KnownLink& link = known_.links[i];
        if (!takes(link)) continue;
        // As levels: what was not seen lies below.
        std::vector<double> row;
        for (const std::size_t j : used_) row.push_back(-losses_[i].columns[j]);
        data.add(row, losses_[i].offset - link.loss, link.group);
        unseen.push_back(link.unseen);
    }
    const bool all_seen = std::find(unseen.begin(), unseen.end(), true) == unseen.end();
    return all_seen ? by_least_squares(data) : by_tobit(data, unseen);
}

LinearCalibration::Solution LinearCalibration::by_least_squares(const Observations& data) const {
    std::vector<bool> held;
    for (const std::size_t j : used_) held.push_back(free_[j].non_negative);
    const LinearFit fit = least_squares(data, held);
    Solution out{.coefficients = {}, .at_bound = fit.at_bound, .sigma = fit.sigma};
    for (std::size_t k = 0; k < used_.size(); ++k) {
        if (!fit.coefficients[k]) {
            throw std::invalid_argument(fmt::format(
                "the links do not tell {} from the other parameters", free_[used_[k]].key));
        }
        out.coefficients.push_back(*fit.coefficients[k]);
    }
    return out;
}

LinearCalibration::Solution LinearCalibration::by_tobit(const Observations& data,
                                                        const std::vector<bool>& unseen) const {
    constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
    const TobitFit fit = tobit(data, unseen);
    Solution out{
        .coefficients = {}, .at_bound = std::vector<bool>(used_.size()), .sigma = fit.sigma};
    for (const double value : fit.coefficients) {
        out.coefficients.push_back(
            {.value = value, .se_plain = no_number, .se_by_group = no_number});
    }
    return out;
}

double LinearCalibration::predict(const Solution& solution, std::size_t i) const {
    double loss = losses_[i].offset;
    for (std::size_t k = 0; k < used_.size(); ++k) {
        loss += solution.coefficients[k].value * losses_[i].columns[used_[k]];
    }
    return std::max(0.0, loss);
}

FittedParameter LinearCalibration::parameter(const Solution& solution, std::size_t j) const {
    FittedParameter out{.key = std::string(free_[j].key), .unit = std::string(free_[j].unit)};
    const auto at = std::find(used_.begin(), used_.end(), j);
    out.determined = at != used_.end();
    if (!out.determined) return out;
    const auto k = static_cast<std::size_t>(at - used_.begin());
    const Coefficient& c = solution.coefficients[k];
    // What a link loses beyond the model, its sender has less.
    out.value = out.key == "power" ? scenario_.radio.power.value - c.value : c.value;
    out.se_plain = c.se_plain;
    out.se_by_group = c.se_by_group;
    out.at_bound = solution.at_bound[k];
    return out;
}

FittedSettings LinearCalibration::settings(const Solution& solution) const {
    FittedSettings out;
    Table propagation, radio;
    propagation.set("model", model_);
    for (std::size_t j = 0; j < free_.size(); ++j) {
        FittedParameter p = parameter(solution, j);
        if (p.determined) {
            const std::string text = fmt::format("{:.6g}", p.value);
            (p.key == "power" ? radio : propagation)
                .set(p.key, p.unit.empty() ? Value(std::stod(text)) : Value(text + " " + p.unit));
        }
        out.parameters.push_back(std::move(p));
    }
    if (model_ == "log_distance") {
        propagation.set("sigma", fmt::format("{:.6g} dB", solution.sigma));
    }
    if (!radio.entries.empty()) out.tables.set("radio", std::move(radio));
    out.tables.set("propagation", std::move(propagation));
    return out;
}

}  // namespace rovernet
