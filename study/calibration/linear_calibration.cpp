// SPDX-License-Identifier: MIT
#include "study/calibration/linear_calibration.hpp"

#include "study/statistics/tobit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

/// Observations without the columns whose coefficients are fixed at 0.
Observations without(const Observations& all, const std::vector<bool>& held) {
    Observations out{.columns =
                         static_cast<std::size_t>(std::count(held.begin(), held.end(), false))};
    for (std::size_t i = 0; i < all.rows(); ++i) {
        std::vector<double> row;
        for (std::size_t k = 0; k < all.columns; ++k)
            if (!held[k]) row.push_back(all.row(i)[k]);
        out.add(row, all.y[i], all.group[i]);
    }
    return out;
}

}  // namespace

LinearCalibration::LinearCalibration(const KnownLinks& known, const Scenario& scenario,
                                     std::string_view model, Gains gains)
    : known_(known),
      scenario_(scenario),
      model_(model),
      free_(with_bases(free_parameters(model), known, scenario)) {
    losses_ = linear_losses(known, scenario, model, free_);
    const bool has_constant = std::any_of(
        free_.begin(), free_.end(), [](const auto& p) { return p.fit.way == Fit::Way::constant; });
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
    if (gains == Gains::equal) return;
    for (const KnownLink& link : known.links) {
        const auto at = std::find(transmitters_.begin(), transmitters_.end(), link.from);
        transmitter_.push_back(static_cast<std::size_t>(at - transmitters_.begin()));
        if (at == transmitters_.end()) transmitters_.push_back(link.from);
    }
}

LinearCalibration::Solution LinearCalibration::fit(
    const std::function<bool(const KnownLink&)>& takes) const {
    // Gains are relative to their mean, so that the last gain is minus the sum of the others.
    std::vector<char> sends(transmitters_.size(), false);
    for (std::size_t i = 0; i < transmitter_.size(); ++i)
        if (takes(known_.links[i])) sends[transmitter_[i]] = true;
    std::vector<std::size_t> present;
    for (std::size_t t = 0; t < sends.size(); ++t)
        if (sends[t]) present.push_back(t);
    const std::size_t free_gains = present.empty() ? 0 : present.size() - 1;
    Observations data{.columns = used_.size() + free_gains};
    if (data.columns == 0) return {};
    std::vector<bool> unseen;
    for (std::size_t i = 0; i < losses_.size(); ++i) {
        const KnownLink& link = known_.links[i];
        if (!takes(link)) continue;
        // As levels: what was not seen lies below.
        std::vector<double> row;
        for (const std::size_t j : used_) row.push_back(-losses_[i].columns[j]);
        for (std::size_t g = 0; g < free_gains; ++g) {
            const std::size_t t = transmitter_[i];
            row.push_back(t == present[g] ? 1 : t == present.back() ? -1 : 0);
        }
        data.add(row, losses_[i].offset - link.loss, link.group);
        unseen.push_back(link.unseen);
    }
    const bool all_seen = std::find(unseen.begin(), unseen.end(), true) == unseen.end();
    Solution out = all_seen ? by_least_squares(data) : by_tobit(data, unseen);
    take_gains(out, present);
    return out;
}

/// Moves the gains, which follow the coefficients of the parameters, into their own list. A gain
/// that no link determines is 0.
void LinearCalibration::take_gains(Solution& solution,
                                   const std::vector<std::size_t>& present) const {
    if (transmitters_.empty()) return;
    constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
    for (const Vec3 at : transmitters_)
        solution.gains.push_back({at, {.se_plain = no_number, .se_by_group = no_number}});
    double sum = 0;
    for (std::size_t k = used_.size(); k < solution.coefficients.size(); ++k) {
        const double gain = solution.coefficients[k].value;
        solution.gains[present[k - used_.size()]].gain.value = gain;
        sum += gain;
    }
    if (!present.empty()) solution.gains[present.back()].gain.value = -sum;
    solution.coefficients.resize(used_.size());
    solution.at_bound.resize(used_.size());
}

LinearCalibration::Solution LinearCalibration::by_least_squares(const Observations& data) const {
    std::vector<bool> held;
    for (const std::size_t j : used_) held.push_back(free_[j].non_negative);
    held.resize(data.columns, false);
    const LinearFit fit = least_squares(data, held);
    Solution out{.coefficients = {}, .at_bound = fit.at_bound, .sigma = fit.sigma};
    for (std::size_t k = 0; k < data.columns; ++k) {
        if (!fit.coefficients[k]) {
            throw std::invalid_argument(
                fmt::format("the links do not determine {} separately from the other parameters",
                            k < used_.size() ? free_[used_[k]].key : "the gains"));
        }
        out.coefficients.push_back(*fit.coefficients[k]);
    }
    return out;
}

LinearCalibration::Solution LinearCalibration::by_tobit(const Observations& data,
                                                        const std::vector<bool>& unseen) const {
    constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
    Solution out{.coefficients = {}, .at_bound = std::vector<bool>(data.columns), .sigma = 0};
    out.coefficients.assign(data.columns, {.se_plain = no_number, .se_by_group = no_number});
    // Coefficients that must not be negative but would be are fixed at 0 one by one, the most
    // negative first.
    for (;;) {
        const TobitFit fit = tobit(without(data, out.at_bound), unseen);
        out.sigma = fit.sigma;
        std::optional<std::size_t> worst;
        for (std::size_t k = 0, column = 0; k < data.columns; ++k) {
            Coefficient& c = out.coefficients[k];
            c.value = out.at_bound[k] ? 0 : fit.coefficients[column++];
            const bool may_be_negative = k >= used_.size() || !free_[used_[k]].non_negative;
            const bool wrong = !may_be_negative && c.value < 0;
            if (wrong && (!worst || c.value < out.coefficients[*worst].value)) worst = k;
        }
        if (!worst) return out;
        out.at_bound[*worst] = true;
    }
}

double LinearCalibration::predict(const Solution& solution, std::size_t i) const {
    double loss = losses_[i].offset;
    for (std::size_t k = 0; k < used_.size(); ++k) {
        loss += solution.coefficients[k].value * losses_[i].columns[used_[k]];
    }
    if (!solution.gains.empty()) loss -= solution.gains[transmitter_[i]].gain.value;
    return std::max(0.0, loss);
}

FittedParameter LinearCalibration::parameter(const Solution& solution, std::size_t j) const {
    FittedParameter out{.key = std::string(free_[j].key),
                        .unit = std::string(free_[j].unit),
                        .is_constant = free_[j].fit.way == Fit::Way::constant};
    const auto at = std::find(used_.begin(), used_.end(), j);
    out.determined = at != used_.end();
    if (!out.determined) return out;
    const auto k = static_cast<std::size_t>(at - used_.begin());
    const Coefficient& c = solution.coefficients[k];
    // Additional loss of a link means a smaller gain of its sender.
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
    if (const auto key = key_determined(model_, Fit::Way::spread); !key.empty())
        propagation.set(key, fmt::format("{:.6g} dB", solution.sigma));
    if (!radio.entries.empty()) out.tables.set("radio", std::move(radio));
    out.tables.set("propagation", std::move(propagation));
    return out;
}

}  // namespace rovernet
