// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <string>

// Input files of a command, which no output of the command replaces.

namespace rovernet {

/// From now on, note_input() notes files, and a PartFile refuses to replace a noted file by
/// different contents. A command calls it once, at its start. Without the call, files may be
/// replaced: a program may read the results of a run, and repeat the run.
void keep_inputs();

/// Notes a file that is read as an input.
void note_input(const std::string& path);

/// Whether the path is a noted file, also by another name; false for a symbolic link.
bool is_kept_input(const std::string& path);

/// Whether an output with these contents, written to the path, would replace a noted file by
/// different contents.
bool replaces_input(const std::string& path, std::istream& contents);

}  // namespace rovernet
