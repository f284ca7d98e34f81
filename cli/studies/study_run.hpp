// SPDX-License-Identifier: MIT
#pragma once

#include "cli/runs/run_commands.hpp"
#include "scenario/scenario_file.hpp"
#include "study/sweep.hpp"

namespace rovernet::cli {

/// Options that override a study's scenario file, including options for its replications.
ScenarioOptions study_options(const StudyArguments& arguments);

/// Whether finished runs are kept or lost when a study is interrupted.
enum class Finished { is_kept, is_lost };

/// Runs a study with workers, and shows its progress. Ctrl-C stops it; running runs are completed
/// first if finished runs are kept.
/// @param options  selection of the runs to make; other options are set from `arguments`
SweepResult run_study(const StudyArguments& arguments, Study& study, Store& store,
                      SweepOptions options = {}, Finished finished = Finished::is_kept);

/// Checks how a study ended. @throws CommandEnd if it was interrupted, or some runs failed
void check_end(const StudyArguments& arguments, const Store& store, const SweepResult& result);

/// Checks that every point has the precision of the study. @throws CommandEnd with the reached
/// precision if not
void check_precision(const Study& study, const SweepResult& result);

}  // namespace rovernet::cli
