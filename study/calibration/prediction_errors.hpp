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

/// Share of one group in the errors: groups are independent of one another.
struct GroupErrors {
    std::size_t losses = 0;
    double squares = 0;  ///< sum of squared errors [dB^2]
    std::size_t decisions = 0, wrong = 0;
};

/// Errors of predicted losses: predicted less known [dB], and decisions on links.
struct PredictionErrors {
    std::size_t losses = 0;      ///< losses that the next three values are about
    double rmse = 0;             ///< [dB]
    double bias = 0;             ///< mean error [dB]
    double most_in_95 = 0;       ///< 95 % of the errors are no larger [dB]
    std::size_t decisions = 0;   ///< links that the next two values are about
    std::size_t false_up = 0;    ///< called up, but down
    std::size_t false_down = 0;  ///< called down, but up
    std::map<std::uint32_t, GroupErrors> groups = {};  ///< by KnownLink::group

    double wrong() const {
        return decisions == 0
                   ? 0
                   : static_cast<double>(false_up + false_down) / static_cast<double>(decisions);
    }
};

/// Link that a fitted model predicts badly.
struct WorstLink {
    std::string name;
    double error;  ///< predicted less known [dB]
};

/// Predictions of known links, one after the other, and what comes of them.
class Predictions {
  public:
    /// @param decided_within  decisions count on links no longer than this
    Predictions(const KnownLinks& known, Meters decided_within)
        : known_(known), decided_within_(decided_within) {}

    /// Adds a predicted loss [dB] of the i-th link, or nothing for a model that only decides.
    void add(std::size_t i, std::optional<double> loss, bool up);
    /// Adds a predicted loss [dB], which decides the link, too.
    void add(std::size_t i, double loss) { add(i, loss, loss <= known_.links[i].budget); }

    PredictionErrors errors() const;
    /// The five largest errors, the largest first.
    std::vector<WorstLink> worst() const;

  private:
    const KnownLinks& known_;
    Meters decided_within_;
    PredictionErrors decisions_;
    std::vector<std::pair<double, std::size_t>> errors_;  // [dB], of which link
};

}  // namespace rovernet
