// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/kept_planners.hpp"
#include "scenario/scenario.hpp"
#include "study/statistics/interval.hpp"
#include "study/validation/cases/turns.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

// Scenes of the validations, and paired runs that differ in one model only.

namespace rovernet {

/// Scenario that is defined in the program: the text of a scenario file and, optionally, walls.
struct ValidationScene {
    std::string name;
    std::string text;  ///< content of a scenario file, without [scene]
    std::shared_ptr<const Scene> walls = nullptr;

    /// Scenario that `text` describes, overridden by the tables in `settings`.
    /// @param settings  tables by name, such as [propagation] of a fitted model
    Scenario scenario(const Table& settings, std::uint32_t replication = 0) const;
};

/// Open field of 900 m x 900 m with 20 moving robots. Every two seconds a message is sent, which
/// all robots forward.
ValidationScene open_field_scene();
/// Office of drawn_office() with 8 moving robots.
ValidationScene office_scene();
/// Cave of is_rock() with 8 moving robots.
ValidationScene cave_scene();

/// Variant of a scene with different settings, such as a different model.
struct Variant {
    std::string label, series;
    Table settings;
};

/// Results of the runs of one variant of a scene.
struct VariantRuns {
    std::vector<double> delivery_ratio;  ///< delivery ratio in each replication [-]
    TurnCost cost;  ///< CPU time per transmission [ns]: median, lowest and highest over the runs
};

/// Runs all variants of a scene on the same replications. In each replication, the variants run one
/// after the other, so that a slowdown of the machine affects all variants equally.
std::vector<VariantRuns> paired_runs(const ValidationScene& scene,
                                     const std::vector<Variant>& variants,
                                     std::size_t replications);

/// Differences of delivery ratios between the runs of a variant and of the reference ("truth"),
/// compared in each replication.
struct RunErrors {
    std::vector<double> distances = {};  ///< absolute difference [-] in each replication
    double mean = 0;                     ///< mean absolute difference of delivery ratios [-]
    std::optional<MeanInterval> likely;  ///< 95 % confidence interval of `mean`; none if `mean` is
                                         ///< 0
    double bias = 0;                     ///< mean of the signed differences variant - reference [-]
};
RunErrors run_errors(const VariantRuns& runs, const VariantRuns& truth);

}  // namespace rovernet
