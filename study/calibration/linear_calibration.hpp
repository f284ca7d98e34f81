// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"
#include "scenario/document/value.hpp"
#include "study/calibration/free_parameters.hpp"
#include "study/calibration/known_links.hpp"
#include "study/statistics/least_squares.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Parameter that a fit finds.
struct FittedParameter {
    std::string key;   ///< in [propagation]; "power" in [radio]
    std::string unit;  ///< empty: a bare number
    double value = 0;  ///< as fitted, or as it stands if the links do not determine it
    bool determined = true;
    bool at_bound = false;  ///< it would be negative, and is held at 0
    /// Standard errors, see Coefficient; not a number if the fit gives none.
    double se_plain = 0, se_by_group = 0;
};

/// Gains of transmitters: one for all, which the model's constant holds, or one for each.
enum class Gains { equal, by_transmitter };

/// Gain of a transmitter beyond the mean of all.
struct TransmitterGain {
    Vec3 at;           ///< its antenna [m]
    Coefficient gain;  ///< [dB]
};

/// Parameters, and the tables of a scenario file that hold them.
struct FittedSettings {
    std::vector<FittedParameter> parameters;
    /// [propagation], and [radio] if its power was fitted.
    Table tables;
};

/// A model whose loss is linear in its free parameters, fitted to known links: by least squares in
/// dB, or by the Tobit model if some were unseen. What no link tells stays as it stands.
class LinearCalibration {
  public:
    /// Values of the parameters that some link tells, with errors where the method has them.
    struct Solution {
        std::vector<Coefficient> coefficients;
        std::vector<bool> at_bound;
        double sigma = 0;                         ///< [dB]
        std::vector<TransmitterGain> gains = {};  ///< none if they are equal
    };

    /// @throws InputError, std::invalid_argument if the model cannot be asked
    LinearCalibration(const KnownLinks& known, const Scenario& scenario, std::string_view model,
                      Gains gains);

    /// Fits to the links that `takes` wants.
    /// @throws std::invalid_argument if they do not tell the parameters apart
    Solution fit(const std::function<bool(const KnownLink&)>& takes) const;
    /// Loss of the i-th link [dB].
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
    std::vector<std::size_t> used_;   // of the free parameters: those that matter for some link
    std::vector<Vec3> transmitters_;  // whose gains are free
    std::vector<std::size_t> transmitter_;  // of each link, an index into these
};

}  // namespace rovernet
