// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "scenario/scenario.hpp"
#include "study/calibration/free_parameters.hpp"
#include "study/calibration/known_links.hpp"
#include "study/statistics/least_squares.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Parameter of a propagation model with its fitted value.
struct FittedParameter {
    std::string key;           ///< key in [propagation]; "power" is a key of [radio]
    std::string unit;          ///< unit of the parameter; empty: a number without unit
    bool is_constant = false;  ///< true: the parameter is a constant term of the loss, equal for
                               ///< all links
    double value = 0;  ///< fitted value, or the scenario's value if the links do not determine it
    bool determined = true;
    bool at_bound = false;  ///< true: `value` is the bound 0, since a free fit would give a
                            ///< negative value
    /// Standard errors of the fitted value, see Coefficient: for independent errors of the levels
    /// (`se_plain`), and clustered (`se_by_group`). NaN if the method gives none.
    double se_plain = 0, se_by_group = 0;
};

/// Choice of fitted transmitter gains: equal gains (part of the model's constant), or a separate
/// gain for each transmitter.
enum class Gains { equal, by_transmitter };

/// Fitted gain of a transmitter, relative to the mean gain of all transmitters.
struct TransmitterGain {
    Vec3 at;           ///< position of the transmitter's antenna [m]
    Coefficient gain;  ///< gain relative to the mean gain of all transmitters [dB]
};

/// Fitted parameters, and the tables of a scenario file that contain them.
struct FittedSettings {
    std::vector<FittedParameter> parameters;
    /// Table [propagation] and, if the transmit power was fitted, table [radio].
    Table tables;
};

/// Fit of a propagation model, whose loss is linear in its free parameters, to links of known loss.
/// The method is least squares in dB, or the Tobit model (regression with censored values) if some
/// links are unseen. Parameters that no link determines keep their values.
class LinearCalibration {
  public:
    /// Fitted values of the determined parameters, with standard errors if the method has them.
    struct Solution {
        std::vector<Coefficient> coefficients;
        std::vector<bool> at_bound;
        double sigma = 0;  ///< standard deviation of the error of a loss [dB]
        std::vector<TransmitterGain> gains = {};  ///< gain of each transmitter; empty: equal gains
    };

    /// @throws InputError, std::invalid_argument if the model cannot be evaluated
    LinearCalibration(const KnownLinks& known, const Scenario& scenario, std::string_view model,
                      Gains gains);

    /// Fits the model to the links for which `takes` returns true.
    /// @throws std::invalid_argument if the links do not determine the parameters
    Solution fit(const std::function<bool(const KnownLink&)>& takes) const;
    /// Loss of known link i [dB] that the model predicts with a solution of fit().
    double predict(const Solution& solution, std::size_t i) const;
    FittedSettings settings(const Solution& solution) const;

  private:
    Solution by_least_squares(const Observations& data) const;
    Solution by_tobit(const Observations& data, const std::vector<bool>& unseen) const;
    void take_gains(Solution& solution, const std::vector<std::size_t>& present) const;
    FittedParameter parameter(const Solution& solution, std::size_t j) const;

    const KnownLinks& known_;
    const Scenario& scenario_;
    std::string model_;
    std::vector<FreeParameter> free_;
    std::vector<LinearLoss> losses_;
    std::vector<std::size_t> used_;   // indices in free_ of the parameters that affect some link
    std::vector<Vec3> transmitters_;  // positions of transmitters with free gains
    // Transmitter of each known link, as an index into transmitters_; empty: equal gains.
    std::vector<std::size_t> transmitter_;
};

}  // namespace rovernet
