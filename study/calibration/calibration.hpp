// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"
#include "study/calibration/known_links.hpp"
#include "study/calibration/linear_calibration.hpp"
#include "study/calibration/prediction_errors.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

// Calibration: fits the parameters of each propagation model to known losses, before models are
// compared. Models without free parameters are judged unchanged.

namespace rovernet {

/// Propagation model, its parameters fitted to links of known loss, and its prediction errors.
struct CalibratedModel {
    std::string model;
    std::vector<FittedParameter> parameters;
    /// Tables for a scenario file: [propagation], and [radio] if the power was fitted.
    Table settings;
    PredictionErrors fitted;  ///< errors on the links to which the model is fitted
    /// Errors by cross-validation: errors on each group of links, with a fit to the links of all
    /// other groups. None if there is only one group.
    std::optional<PredictionErrors> left_out;
    std::optional<PredictionErrors> as_given;  ///< errors with the scenario's own parameters
    std::optional<PredictionErrors> checked;   ///< errors on independent links, by check()
    std::vector<WorstLink> worst;              ///< links with the five largest errors
    std::vector<TransmitterGain> gains = {};   ///< fitted gains of transmitters; empty: all gains
                                               ///< are equal
    std::string failure;       ///< reason why the fit of the model failed; empty: no failure
    std::string refusal = {};  ///< reason not to use the fit, see refuse_absurd(); empty: usable
                               ///< fit

    /// Whether the links determine at least one parameter of the model.
    bool is_fitted() const {
        return std::any_of(parameters.begin(), parameters.end(),
                           [](const FittedParameter& p) { return p.determined; });
    }
};

/// Fits every model of the list of propagation models, except the model `except`, to links of known
/// loss. The results have the order of the list.
///
/// - Model `disc`: the range with the fewest wrong decisions (link up or down).
/// - Other models: least squares in dB, or the Tobit model if some links are unseen (see
///   KnownLink::unseen). Wall losses are >= 0.
///
/// Standard errors by group (see KnownLink::group) are computed by least_squares(); for the Tobit
/// model and for gains, by the jackknife over the groups. The fit of `disc` has no standard errors.
///
/// With measured levels, transmit powers and antenna gains are only roughly known. Each model
/// except `disc` then has a free constant: its parameter `excess`, or the radios' power if the
/// model has no `excess`.
/// @param decided_within  largest length [m] of links whose decisions (up or down) are counted
/// @param gains           by_transmitter: with measured levels, each model except `disc` also has a
///                        free gain for each transmitter position, relative to the mean gain
/// @param tell            called with the finished share, 0 ... 1; may be empty
std::vector<CalibratedModel> calibrate(const KnownLinks& known, const Scenario& scenario,
                                       const std::string& except, Meters decided_within,
                                       Gains gains = Gains::equal,
                                       const std::function<void(double)>& tell = {});

/// Marks meaningless fits to measured levels by CalibratedModel::refusal:
/// - a power that differs from `given_power` by more than 30 dB
/// - an excess beyond +-30 dB
/// - an error above 20 dB
/// - an error more than twice the error of the fitted free-space model, and more than 3 dB above
///   the latter error
void refuse_absurd(std::vector<CalibratedModel>& models, Dbm given_power);

/// Standard error [dB] of the loss that a fitted log_distance model predicts. It is computed at the
/// distance at which the predicted loss equals the mean link budget. A small error shows that the
/// number of links suffices for a fit. NaN with one group.
double loss_error_at_budget(const KnownLinks& known, const Scenario& scenario);

/// Links of known loss in a scenario, and the propagation models calibrated to the links.
struct Calibration {
    std::string reference;  ///< name of the reference model; empty: fitted to measured levels
    KnownLinks known;
    /// Largest length [m] of links whose decisions (link up or down) are counted.
    Meters decided_within = Propagation::anything;
    std::vector<CalibratedModel> models;
    /// Standard error of the loss at the link budget [dB], see loss_error_at_budget().
    double loss_error = 0;
    /// Largest `loss_error` [dB] at which the number of links is considered sufficient.
    static constexpr double enough = 0.5;
};

/// Excess of a path loss over the link budget [dB] at which links are certainly down. No radio
/// receives over a link with a larger excess.
inline constexpr Db beyond_radio{20};

/// Copy of links in which large losses are censored: a link with a loss above budget + `beyond` is
/// marked as unseen, with budget + `beyond` as the lower bound of its loss. No radio overcomes such
/// losses, and fitting them would worsen the fit of relevant losses.
KnownLinks censored(KnownLinks known, Db beyond);

/// Calibrates propagation models to a reference model, on links between the scenario's robots.
/// Links of 20 replications are sampled, see LinkSample. While the links do not suffice (see
/// Calibration::enough), the number of replications is doubled, up to 320.
/// @param reference  listed model, with the scenario's parameters; empty: the scenario's model
/// @param tell       called with the finished share, 0 ... 1, from 0 for each sample and for the
///                   fits; may be empty. Its exceptions end the calibration
/// @param beyond     losses more than `beyond` above the budget are censored, see censored()
/// @throws InputError, RunError
Calibration calibrate_to_model(const Scenario& scenario, const std::string& reference,
                               const std::function<void(double)>& tell,
                               Db beyond = Db{std::numeric_limits<double>::infinity()});

/// Calibrates propagation models to measured levels in a file, see read_levels().
/// @throws InputError as read_levels(); if no level is above the floor; if gains are free and the
///         number of transmitter positions is 1 or above 200
Calibration calibrate_to_levels(const Scenario& scenario, const std::string& path,
                                std::optional<Dbm> floor, Gains gains = Gains::equal);
/// Computes the errors of calibrated models on the measured levels of a second file (from a
/// different day or drive, see read_levels()), as CalibratedModel::checked.
/// @return repeatability of the levels, over the links of the calibration and of the second file
Repeatability check(Calibration& calibration, const Scenario& scenario, const std::string& path,
                    std::optional<Dbm> floor);
/// Computes the errors of calibrated models on the links `others`, as CalibratedModel::checked.
/// @return repeatability of the levels, over the links of the calibration and `others`
Repeatability check(Calibration& calibration, const Scenario& scenario, const KnownLinks& others);

}  // namespace rovernet
