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

// Calibration: each model gets the parameters with which it comes nearest to known losses, before
// anybody compares it. Models of which nothing is free are judged as they stand.

namespace rovernet {

/// A model with the parameters that suit the known links best.
struct CalibratedModel {
    std::string model;
    std::vector<FittedParameter> parameters;
    /// [propagation], and [radio] if its power was fitted: for a scenario file.
    Table settings;
    PredictionErrors fitted;                   ///< on the links that it was fitted to
    std::optional<PredictionErrors> left_out;  ///< each group by the fit of the others
    std::optional<PredictionErrors> as_given;  ///< with the scenario's own parameters
    std::optional<PredictionErrors> checked;   ///< on other links, see check()
    std::vector<WorstLink> worst;              ///< the five largest errors
    std::vector<TransmitterGain> gains = {};   ///< if they were free
    std::string failure;                       ///< why it could not be fitted; empty: it was
    std::string refusal = {};  ///< why nobody should use the fit; empty: see refuse_absurd()

    /// Whether the links tell any parameter of the model.
    bool is_fitted() const {
        return std::any_of(parameters.begin(), parameters.end(),
                           [](const FittedParameter& p) { return p.determined; });
    }
};

/// Fits all listed models but `except` to the known links, in the order of the list: by least
/// squares in dB; by the Tobit model if some levels were below the floor, with standard errors by a
/// jackknife over the groups; a disc by its decisions.
/// Losses of walls are >= 0. With measured levels one constant is free in each model, as powers and
/// gains are only roughly known: `excess` where a model has it, else the radios' power.
/// Decisions are counted on links no longer than `decided_within`.
/// @param gains  by_transmitter: of measured levels, each place that sends has a gain of its own in
///               each model but the disc, beyond the mean of all
std::vector<CalibratedModel> calibrate(const KnownLinks& known, const Scenario& scenario,
                                       const std::string& except, Meters decided_within,
                                       Gains gains = Gains::equal);

/// Refuses fits to measured levels that describe nothing: a power more than 30 dB from the given
/// one or an excess of more, an error above 20 dB, or of more than twice that of free space with
/// its constant, and 3 dB more.
void refuse_absurd(std::vector<CalibratedModel>& models, Dbm given_power);

/// Standard error [dB] of the loss that log_distance, fitted to the links, predicts where it
/// crosses their mean budget: whether these are enough links. Not a number with one group.
double loss_error_at_budget(const KnownLinks& known, const Scenario& scenario);

/// Links of a scenario, and its models calibrated to them.
struct Calibration {
    std::string reference;  ///< model; empty: measured levels
    KnownLinks known;
    Meters decided_within =
        Propagation::anything;  ///< decisions count on links no longer than this
    std::vector<CalibratedModel> models;
    /// See loss_error_at_budget() [dB].
    double loss_error = 0;
    /// Largest loss error [dB] at which the links are enough.
    static constexpr double enough = 0.5;
};

/// Loss over the budget that no radio overcomes.
inline constexpr Db beyond_radio{20};

/// The links with their largest losses made unknown: a loss more than `beyond` over the budget
/// becomes an unseen one, of which only this lower bound is known. No radio overcomes it, and a fit
/// to its decibels would be worse for the losses that matter.
KnownLinks censored(KnownLinks known, Db beyond);

/// Calibrates to a reference model on links of the scenario's own robots: those of 20 replications,
/// and of twice as many as long as they are not enough, up to 320; see LinkSample.
/// @param reference  listed model, with the scenario's parameters; empty: the scenario's own
/// @param tell       told the share that is done, 0 ... 1, again for each sample; may be empty
/// @param beyond     losses more than this over the budget are made unknown, see censored()
/// @throws InputError, RunError
Calibration calibrate_to_model(const Scenario& scenario, const std::string& reference,
                               const std::function<void(double)>& tell,
                               Db beyond = Db{std::numeric_limits<double>::infinity()});

/// Calibrates to measured levels, see read_levels().
/// @throws InputError as read_levels(); if no level is above the floor; if gains are free and one
///         place sends, or more than 200
Calibration calibrate_to_levels(const Scenario& scenario, const std::string& path,
                                std::optional<Dbm> floor, Gains gains = Gains::equal);
/// Judges the calibrated models on other measured levels, from another day or drive.
/// @return how well the levels of both files repeat
Repeatability check(Calibration& calibration, const Scenario& scenario, const std::string& path,
                    std::optional<Dbm> floor);
/// Judges the fits on levels that were read already, as check() above does on those of a file.
Repeatability check(Calibration& calibration, const Scenario& scenario, const KnownLinks& others);

}  // namespace rovernet
