// SPDX-License-Identifier: MIT
#pragma once

#include "study/validation/cases/turns.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Charts of error against cost, as plain data. Validations produce the charts; the report shows
// them.

namespace rovernet {

/// Entry of an additional column in a table of results: name of the column with unit, and number.
using Detail = std::pair<std::string, double>;

/// Method in a chart, with its cost and its error.
struct ValidationPoint {
    std::string label;        ///< name of the method
    std::string series = {};  ///< name of a group of related methods, such as "fitted"
    TurnCost cost = {};       ///< CPU time of an operation [ns], see ValidationPanel::cost_label
    double error = 0;         ///< error in the panel's unit, >= 0
    std::optional<double> error_low = {}, error_high = {};  ///< confidence interval of the error
    /// Entries of additional columns in the table of results. All points of a panel have the same
    /// columns.
    std::vector<Detail> details = {};
    /// Independent parts of the error, such as one part for each replication, in the same order in
    /// all points of a panel. The mean of the parts is the error or the square of the error.
    std::vector<double> parts = {};
};

/// Panel of a chart: the methods that are compared for one question on one scene.
struct ValidationPanel {
    std::string title = {};
    std::string cost_label = "CPU per link [ns]";
    std::string error_label = {};  ///< label of the error, with unit
    bool log_error = true;         ///< true: logarithmic error axis, with 0 at the left end
    /// Uncertainty of the reference, in the unit of the error. Errors below this value are
    /// meaningless. None: the uncertainty is unknown.
    std::optional<double> unknowable = {};
    std::string unknowable_label = {};  ///< text on the uncertainty of the reference
    std::string interval_label = {};    ///< meaning of the error intervals, for the legend
    std::vector<ValidationPoint> points = {};
};

/// Chart for one question, with the reference of its errors.
struct ValidationChart {
    std::string name;   ///< name of the chart's files, without ending
    std::string title;  ///< question that the chart answers, or subject of the chart
    std::string truth;  ///< sentence on the reference ("truth") and the number of cases
    std::vector<ValidationPanel> panels = {};
    std::vector<std::string> sentences = {};  ///< conclusions for users, with numbers
    bool for_contributors = false;  ///< true: about the code; no user chooses a method by it
    bool continues = false;         ///< true: another view of the chart before it
};

/// Claimed limit of an error of the program, and the largest error found in this run.
struct Promise {
    std::string what;   ///< description, such as "loss of friis against its closed form"
    std::string unit;   ///< unit of `limit` and `worst`; empty: both are counts
    double limit = 0;   ///< claimed limit of the error
    double worst = 0;   ///< largest error found in this run
    std::size_t n = 0;  ///< number of cases that were checked

    bool kept() const { return worst <= limit; }
    /// Adds the error in one more case of the check.
    void add(double error) {
        worst = std::max(worst, std::abs(error));
        ++n;
    }
};

/// Measures the CPU time of methods in turns, and sets the costs of a panel's points.
/// @param methods  one method for each point, in the order of the points
void set_costs(ValidationPanel& panel, std::span<const TimedMethod> methods, const Turns& turns);

/// Indices of the points on the Pareto front, in order of cost. The front contains the cheapest
/// point (by median cost), and each point with a significantly smaller error than all cheaper
/// points. Errors with parts are compared by their parts, at 95 % for all pairs together
/// (Bonferroni). Errors with intervals differ if the intervals do not overlap. Errors without parts
/// and intervals always differ.
std::vector<std::size_t> pareto_front(const std::vector<ValidationPoint>& points);

/// Whether the uncertainty of the error is known for any of the points, by an interval or by parts
/// of the error.
bool have_intervals(const std::vector<ValidationPoint>& points);

/// Point of smallest error, and other points whose errors do not differ significantly from the
/// smallest error.
struct Nearest {
    const ValidationPoint* point = nullptr;  ///< point of smallest error; null: there is no point
    /// Points whose errors do not differ significantly from the smallest error.
    std::vector<const ValidationPoint*> alike = {};
};

/// Finds the point of smallest error among the points for which `takes` returns true. The error of
/// a point differs significantly from the smallest error if Student's interval for the mean
/// difference of the parts of both errors excludes 0, at 95 % for all pairs together (Bonferroni).
/// With fewer than six parts no error differs: five differences have the same sign by chance in 6 %
/// of cases.
Nearest nearest_to_truth(const ValidationPanel& panel,
                         const std::function<bool(const ValidationPoint&)>& takes);

/// Sentence that names the method with the smallest error, such as "multi_wall fitted has the
/// smallest error (rms error 4.01 dB)". If errors of other methods do not differ significantly, the
/// sentence names up to three of these methods: "disc fitted (rms error 4.01 dB) cannot be
/// distinguished from friis as given (rms error 4.02 dB)".
/// @param nearest  result of nearest_to_truth() that has a point
/// @param off      function that returns an error as a text, such as "rms error 4.01 dB"
std::string nearest_text(const Nearest& nearest, const std::function<std::string(double)>& off);

/// Point of a panel with the given label and series. @throws std::out_of_range without such a point
const ValidationPoint& point_of(const ValidationPanel& panel, std::string_view label,
                                std::string_view series = "");

/// Text of a cost or a ratio of costs, with two significant digits and without an exponent:
/// "1400000", "0.0043".
std::string two_digits(double value);

/// Number in the additional column `name` of a point, see ValidationPoint::details.
/// @throws std::out_of_range without such a column
double detail_of(const ValidationPoint& point, const std::string& name);

}  // namespace rovernet
