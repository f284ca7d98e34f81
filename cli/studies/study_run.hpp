// SPDX-License-Identifier: MIT
#pragma once

#include "cli/runs/run_commands.hpp"
#include "scenario/scenario_file.hpp"
#include "study/sweep.hpp"

namespace rovernet::cli {

/// Options that override a study's scenario file, including options for keys of its table [study],
/// such as the number of replications.
ScenarioOptions study_options(const StudyArguments& arguments);

/// What varies a key: [study] vary of the scenario file, or an option of the command.
enum class IgnoredBy { file, command };

/// Prints a notice for each option --set of a key that the study varies: the varied values replace
/// the value of the option.
void tell_ignored(const Study& study, IgnoredBy by);

/// Whether finished runs are kept or lost when a study is interrupted.
enum class Finished { is_kept, is_lost };

/// Runs a study with worker processes, and shows its progress. Ctrl-C stops the study. If finished
/// runs are kept, the current runs are completed first.
/// @param options  only the selection of runs is used; all other members are set from `arguments`
SweepResult run_study(const StudyArguments& arguments, Study& study, Store& store,
                      SweepOptions options = {}, Finished finished = Finished::is_kept);

/// Checks that a study was completed. @throws CommandEnd if the study was interrupted, or if runs
/// failed
void check_end(const StudyArguments& arguments, const Store& store, const SweepResult& result);

/// Checks that every point of a study (combination of varied values) has reached the precision that
/// the study requires. @throws CommandEnd if points have not; the message names these points and
/// their precision
void check_precision(const Study& study, const SweepResult& result);

}  // namespace rovernet::cli
