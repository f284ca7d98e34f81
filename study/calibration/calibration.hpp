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

/// Propagation model with parameters fitted to links of known loss.
struct CalibratedModel {
    std::string model;
    std::vector<FittedParameter> parameters;
    /// Tables for a scenario file: [propagation], and [radio] if the power was fitted.
    Table settings;
    PredictionErrors fitted;  ///< errors on the links to which the model is fitted
    /// Cross-validation: errors of each group of links by a fit to the other groups.
    std::optional<PredictionErrors> left_out;
    std::optional<PredictionErrors> as_given;  ///< errors with the scenario's own parameters
    std::optional<PredictionErrors> checked;   ///< errors on independent links; none: no check()
    std::vector<WorstLink> worst;              ///< links with the five largest errors
    std::vector<TransmitterGain> gains = {};   ///< fitted gains of transmitters, if they were free
    std::string failure;       ///< reason why the fit of the model failed; empty: no failure
    std::string refusal = {};  ///< reason not to use the fit, see refuse_absurd(); empty: usable

    /// Whether the links determine any parameter of the model.
    bool is_fitted() const {
        return std::any_of(parameters.begin(), parameters.end(),
                           [](const FittedParameter& p) { return p.determined; });
    }
};

/// Fits all listed models except `except` to the known links, in the order of the list.
///
/// - Model `disc`: the range with the fewest wrong decisions (link up or down).
/// - Other models: least squares in dB, or the Tobit model if some links are unseen (see
///   KnownLink::unseen). Wall losses are >= 0.
///
/// Standard errors by group (see KnownLink::group) are those of least_squares(). For the Tobit
/// model, and for gains, they are computed by the jackknife over the groups. The fit of `disc` has
/// none.
///
/// With measured levels, powers and gains are only roughly known. Each model except `disc` then has
/// a free constant: its `excess`, or the radios' power if it has no `excess`.
/// @param decided_within  largest length [m] of links whose decisions are counted
/// @param gains           by_transmitter: with measured levels, each model except `disc` also has a
///                        free gain for each transmitter position, relative to the mean of all
/// @param tell            called with the finished share, 0 ... 1; may be empty
std::vector<CalibratedModel> calibrate(const KnownLinks& known, const Scenario& scenario,
                                       const std::string& except, Meters decided_within,
                                       Gains gains = Gains::equal,
                                       const std::function<void(double)>& tell = {});

/// Marks meaningless fits to measured levels, see CalibratedModel::refusal: a power that differs
/// from the given one by more than 30 dB, an excess beyond 30 dB, an error above 20 dB, or an error
/// above twice the error of fitted free space plus 3 dB.
void refuse_absurd(std::vector<CalibratedModel>& models, Dbm given_power);

/// Standard error [dB] of the loss of a fitted log_distance model at the distance where it equals
/// the mean link budget. It shows whether the links suffice. NaN with one group.
double loss_error_at_budget(const KnownLinks& known, const Scenario& scenario);

/// Links of known loss in a scenario, and the models calibrated to them.
struct Calibration {
    std::string reference;  ///< name of the reference model; empty: measured levels
    KnownLinks known;
    /// Largest length [m] of links whose decisions (link up or down) are counted.
    Meters decided_within = Propagation::anything;
    std::vector<CalibratedModel> models;
    /// Standard error of the loss at the link budget [dB], see loss_error_at_budget().
    double loss_error = 0;
    /// Largest loss error [dB] at which the number of links is sufficient.
    static constexpr double enough = 0.5;
};

/// Excess of a loss over the link budget [dB] that no radio overcomes.
inline constexpr Db beyond_radio{20};

/// Copy of the links with large losses censored: a loss more than `beyond` above the budget counts
/// as not received, with this limit as its lower bound. No radio overcomes such losses, and fitting
/// them would worsen the fit of relevant losses.
KnownLinks censored(KnownLinks known, Db beyond);

/// Calibrates models to a reference model, on links between the scenario's robots. Links of 20
/// replications are sampled, and of twice as many while they do not suffice, up to 320; see
/// LinkSample.
/// @param reference  listed model, with the scenario's parameters; empty: the scenario's model
/// @param tell       called with the finished share, 0 ... 1, anew for each sample and for the
///                   fits; may be empty. Its exceptions end the calibration
/// @param beyond     losses more than this above the budget are censored, see censored()
/// @throws InputError, RunError
Calibration calibrate_to_model(const Scenario& scenario, const std::string& reference,
                               const std::function<void(double)>& tell,
                               Db beyond = Db{std::numeric_limits<double>::infinity()});

/// Calibrates models to measured levels in a file, see read_levels().
/// @throws InputError as read_levels(); if no level is above the floor; if gains are free and the
///         number of transmitter positions is 1 or above 200
Calibration calibrate_to_levels(const Scenario& scenario, const std::string& path,
                                std::optional<Dbm> floor, Gains gains = Gains::equal);
/// Computes errors of the calibrated models on independent levels, from a different day or drive.
/// @return repeatability of the levels of both files
Repeatability check(Calibration& calibration, const Scenario& scenario, const std::string& path,
                    std::optional<Dbm> floor);
/// Computes the errors on levels that are already read; otherwise like check() above.
Repeatability check(Calibration& calibration, const Scenario& scenario, const KnownLinks& others);

}  // namespace rovernet
