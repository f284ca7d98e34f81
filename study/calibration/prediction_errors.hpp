// SPDX-License-Identifier: MIT
#pragma once

#include "sim/units.hpp"
#include "study/calibration/known_links.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {

/// Prediction errors on one group of links. Errors in different groups are independent.
struct GroupErrors {
    std::size_t losses = 0;
    double squares = 0;  ///< sum of squared errors [dB^2]
    std::size_t decisions = 0, wrong = 0;
};

/// Errors of predicted losses (predicted minus known loss [dB]) and of predicted link states (up or
/// down).
struct PredictionErrors {
    std::size_t losses = 0;      ///< number of losses over which rmse, bias, most_in_95 are
                                 ///< computed
    double rmse = 0;             ///< root mean square error [dB]
    double bias = 0;             ///< mean error, predicted minus known loss [dB]
    double most_in_95 = 0;       ///< absolute error that 95 % of the losses do not exceed [dB]
    std::size_t decisions = 0;   ///< number of links whose predicted state (up or down) is judged
    std::size_t false_up = 0;    ///< number of links predicted up that are down
    std::size_t false_down = 0;  ///< number of links predicted down that are up
    std::map<std::uint32_t, GroupErrors> groups = {};  ///< errors of each group, by group number

    double wrong() const {
        return decisions == 0
                   ? 0
                   : static_cast<double>(false_up + false_down) / static_cast<double>(decisions);
    }
};

/// Link with one of the largest prediction errors.
struct WorstLink {
    std::string name;
    double error;  ///< predicted minus known loss [dB]
};

/// Collector of predictions for links of known loss, which computes the errors of the predictions.
class Predictions {
  public:
    /// @param decided_within  largest length [m] of links whose decisions (up or down) are judged
    Predictions(const KnownLinks& known, Meters decided_within)
        : known_(known), decided_within_(decided_within) {}

    /// Adds a prediction for link i: the loss [dB] (none for a model without losses), and whether
    /// the link is up.
    void add(std::size_t i, std::optional<double> loss, bool up);
    /// Adds a predicted loss [dB] of link i. The link is predicted up if this loss does not exceed
    /// the link budget.
    void add(std::size_t i, double loss) { add(i, loss, loss <= known_.links[i].budget); }

    PredictionErrors errors() const;
    /// Links with the five largest errors, in descending order.
    std::vector<WorstLink> worst() const;

  private:
    const KnownLinks& known_;
    Meters decided_within_;
    PredictionErrors decisions_;
    std::vector<std::pair<double, std::size_t>> errors_;  // error [dB], and index of the link
};

}  // namespace rovernet
