// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

/// What the commands share that serve programs outside.
namespace rovernet::cli {

/// A time of an option, such as "30 s" or 30s. @throws InputError
std::chrono::nanoseconds time_of(const std::string& option, const std::string& text);

/// Folder for the results: `out`, or that of `rovernet run`.
std::string results_folder(const std::optional<std::string>& out, const Scenario& scenario,
                           const ScenarioOptions& options);

/// Whether nobody has asked it to stop.
bool goes_on();

/// Says something to the person at the terminal; addresses that are listened on to programs, too,
/// on standard output.
void say_to_all(std::string_view text);

}  // namespace rovernet::cli
