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

// Scenes of our own, and runs on them that differ in a model alone.

namespace rovernet {

/// Scenario without a file: its text and, if it has any, its walls.
struct ValidationScene {
    std::string name;
    std::string text;  ///< as in a scenario file, without [scene]
    std::shared_ptr<const Scene> walls = nullptr;

    /// Scenario with these tables over the text's.
    /// @param settings  tables by name, such as [propagation] of a fitted model
    Scenario scenario(const Table& settings, std::uint32_t replication = 0) const;
};

/// Open field of 900 m x 900 m: 20 robots on the move, a message every two seconds that all pass
/// on.
ValidationScene open_field_scene();
/// Office of drawn_office(): 8 robots on the move.
ValidationScene office_scene();
/// Cave of is_rock(): 8 robots on the move.
ValidationScene cave_scene();

/// Variant of a scene, such as another model.
struct Variant {
    std::string label, series;
    Table settings;
};

/// Runs of a variant.
struct VariantRuns {
    std::vector<double> delivery_ratio;  ///< delivery ratio of each replication
    TurnCost cost;                       ///< [ns] CPU of a run per transmission, over the runs
};

/// Runs all variants on the same replications, one after the other in each of them.
std::vector<VariantRuns> paired_runs(const ValidationScene& scene,
                                     const std::vector<Variant>& variants,
                                     std::size_t replications);

/// Distances of the runs of a variant to those of the truth, pair by pair.
struct RunErrors {
    std::vector<double> distances = {};  ///< of each replication
    double mean = 0;                     ///< mean distance
    std::optional<MeanInterval> likely;  ///< its 95 % interval
    double bias = 0;                     ///< mean difference
};
RunErrors run_errors(const VariantRuns& runs, const VariantRuns& truth);

}  // namespace rovernet
