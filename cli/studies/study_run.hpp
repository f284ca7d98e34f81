// SPDX-License-Identifier: MIT
#pragma once

#include "cli/runs/run_commands.hpp"
#include "study/sweep.hpp"

namespace rovernet::cli {

/// The options over the file of a study, those for its replications among them.
ScenarioOptions study_options(const StudyArguments& arguments);

/// What becomes of the runs that are finished when a study is interrupted.
enum class Finished { is_kept, is_lost };

/// Runs a study with workers, shows how far it is, and stops as Ctrl-C says: runs that have begun
/// are waited for if they are kept.
/// @param options  which of the runs; the arguments say the rest
SweepResult run_study(const StudyArguments& arguments, Study& study, Store& store,
                      SweepOptions options = {}, Finished finished = Finished::is_kept);

/// @throws CommandEnd if the study was interrupted, or a part of it failed
void check_end(const StudyArguments& arguments, const Store& store, const SweepResult& result);

/// @throws CommandEnd, which tells what was reached, if a point is not as precise as the study asks
void check_precision(const Study& study, const SweepResult& result);

}  // namespace rovernet::cli
