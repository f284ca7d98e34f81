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

/// Prediction errors of one group of links; groups are independent of each other.
struct GroupErrors {
    std::size_t losses = 0;
    double squares = 0;  ///< sum of squared errors [dB^2]
    std::size_t decisions = 0, wrong = 0;
};

/// Errors of predicted losses (predicted minus known [dB]) and of decisions (link up or down).
struct PredictionErrors {
    std::size_t losses = 0;      ///< number of predicted losses, for rmse, bias and most_in_95
    double rmse = 0;             ///< root mean square error [dB]
    double bias = 0;             ///< mean error [dB]
    double most_in_95 = 0;       ///< 95 % quantile of the absolute errors [dB]
    std::size_t decisions = 0;   ///< number of decisions, for false_up and false_down
    std::size_t false_up = 0;    ///< number of links predicted up, but down
    std::size_t false_down = 0;  ///< number of links predicted down, but up
    std::map<std::uint32_t, GroupErrors> groups = {};  ///< errors by KnownLink::group

    double wrong() const {
        return decisions == 0
                   ? 0
                   : static_cast<double>(false_up + false_down) / static_cast<double>(decisions);
    }
};

/// Link with a large prediction error.
struct WorstLink {
    std::string name;
    double error;  ///< predicted minus known loss [dB]
};

/// Collector of predictions for known links; computes their errors.
class Predictions {
  public:
    /// @param decided_within  decisions (link up or down) are counted on links up to this length
    Predictions(const KnownLinks& known, Meters decided_within)
        : known_(known), decided_within_(decided_within) {}

    /// Adds a prediction for link i: the loss [dB] (none for a model without losses) and the
    /// decision.
    void add(std::size_t i, std::optional<double> loss, bool up);
    /// Adds a predicted loss [dB] of link i; the decision follows from the link budget.
    void add(std::size_t i, double loss) { add(i, loss, loss <= known_.links[i].budget); }

    PredictionErrors errors() const;
    /// Links with the five largest errors, in descending order.
    std::vector<WorstLink> worst() const;

  private:
    const KnownLinks& known_;
    Meters decided_within_;
    PredictionErrors decisions_;
    std::vector<std::pair<double, std::size_t>> errors_;  // error [dB] and link
};

}  // namespace rovernet
