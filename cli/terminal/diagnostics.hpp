// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string_view>

namespace rovernet::cli {

/// Amount of what is said on standard error.
enum class Verbosity { errors, notices, everything };
void set_verbosity(Verbosity verbosity);
/// Progress is shown: somebody looks at standard error, and wants more than errors.
bool shows_progress();

bool tells_details();

/// Says something to the person at the terminal, on standard error.
void detail(std::string_view message);
void notice(std::string_view message);
void error(std::string_view message);

/// Writes to standard error as it is, for what changes on a terminal. That it fails is nobody's
/// business.
void to_terminal(std::string_view text);

/// Ends standard output. If its reader has gone, that ends the process as quietly as any other.
/// @return ok; failed, with a message, if not all could be written
int end_output();

/// Runs a command and turns what it throws into a message. @return the exit code
int guarded(const std::function<void()>& command);

}  // namespace rovernet::cli
