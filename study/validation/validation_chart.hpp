// SPDX-License-Identifier: MIT
#pragma once

#include "study/validation/cases/turns.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Charts of error against cost, as plain data: what each validation makes, and the report shows.

namespace rovernet {

/// Further number of a point, for the tables: its name with its unit, and the number.
using Detail = std::pair<std::string, double>;

/// Method in a chart: what it costs, and how wrong it is.
struct ValidationPoint {
    std::string label;        ///< name of the method
    std::string series = {};  ///< methods that belong together, such as "fitted"
    TurnCost cost = {};       ///< [ns] of what the panel's axis says
    double error = 0;         ///< error in the panel's unit, >= 0
    std::optional<double> error_low = {}, error_high = {};  ///< interval around the error
    std::vector<Detail> details = {};  ///< details, with the same names in all points of a panel
    /// Shares of the error that are independent, such as of each replication, in the same order in
    /// all points of a panel: their mean is the error, or its square.
    std::vector<double> parts = {};
};

/// Methods that answer one question on one scene.
struct ValidationPanel {
    std::string title = {};
    std::string cost_label = "CPU per link [ns]";
    std::string error_label = {};  ///< error and its unit
    bool log_error = true;         ///< logarithmic axis; an error of 0 stands at its left end
    /// Error below which the truth itself is not known, and why.
    std::optional<double> unknowable = {};
    std::string unknowable_label = {};
    std::vector<ValidationPoint> points = {};
};

/// Chart: one question, with what its errors are measured against.
struct ValidationChart {
    std::string name;   ///< name of its files
    std::string title;  ///< question or subject
    std::string truth;  ///< sentence: what is taken as true, and what was asked how often
    std::vector<ValidationPanel> panels = {};
    std::vector<std::string> sentences = {};  ///< conclusions for a user, with their numbers
};

/// Promise of the code about its errors, and the worst that this run has seen.
struct Promise {
    std::string what;   ///< "loss of friis against its closed form"
    std::string unit;   ///< of both numbers; empty: a count
    double limit = 0;   ///< greatest error that is promised
    double worst = 0;   ///< greatest error of this run
    std::size_t n = 0;  ///< cases that were looked at

    bool kept() const { return worst <= limit; }
};

/// Measures methods in turns, and gives their costs to the points of a panel, one for each.
void set_costs(ValidationPanel& panel, std::span<const TimedMethod> methods, const Turns& turns);

/// Points that no other point of the panel beats in both, cost (median) and error; in the order of
/// their costs.
std::vector<std::size_t> pareto_front(const std::vector<ValidationPoint>& points);

/// The point of least error, and those that the parts of its error do not tell apart from it.
struct Nearest {
    const ValidationPoint* point = nullptr;  ///< null: there is none
    std::vector<const ValidationPoint*> alike = {};
};

/// Finds the point of least error of those that `takes` wants. Another one is told apart if
/// Student's interval for the mean difference of their parts, at 95 % for all pairs together
/// (Bonferroni), leaves out 0. Fewer than six parts tell nothing apart: if all of five differences
/// have one sign, chance does that in 6 % of cases.
Nearest nearest_to_truth(const ValidationPanel& panel,
                         const std::function<bool(const ValidationPoint&)>& takes);

/// The winner in words, or that there is none: "multi_wall fitted is nearest, 4.01 dB off" or
/// "disc fitted (0.012 off) is not told apart from friis as given (0.013 off)".
/// @param nearest  with a point
/// @param off  words for an error, such as "4.01 dB off"
std::string nearest_text(const Nearest& nearest, const std::function<std::string(double)>& off);

/// Point of that label and series. @throws std::out_of_range if there is none
const ValidationPoint& point_of(const ValidationPanel& panel, std::string_view label,
                                std::string_view series = "");

/// Two digits of a cost or a ratio of costs, without an exponent: "1400000", "0.0043".
std::string two_digits(double value);

/// Detail of that name. @throws std::out_of_range if there is none
double detail_of(const ValidationPoint& point, const std::string& name);

}  // namespace rovernet
