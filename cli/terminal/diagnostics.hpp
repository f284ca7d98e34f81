// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string_view>

namespace rovernet::cli {

/// Selection of the messages that the program prints on standard error: errors only, also notices,
/// or also details.
enum class Verbosity { errors, notices, everything };
void set_verbosity(Verbosity verbosity);
/// Whether progress is shown: standard error is a terminal, and notices are not switched off.
bool shows_progress();

bool tells_details();

/// Prints a message on standard error, if the verbosity includes its level: detail, notice, error.
void detail(std::string_view message);
void notice(std::string_view message);
void error(std::string_view message);

/// Writes a text unchanged to standard error, for progress lines on a terminal. Errors of writing
/// are ignored.
void to_terminal(std::string_view text);

/// Flushes and closes standard output. If its reader has closed the pipe, the process ends
/// silently.
/// @return exit code: `ok`, or `failed` after printing a message if writing failed
int end_output();

/// Runs a command, and prints the message of its exception. @return the exit code
int guarded(const std::function<void()>& command);

}  // namespace rovernet::cli
