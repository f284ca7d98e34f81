// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace rovernet {

/// Writes a whole file: under a temporary name first, then renamed, so that `path` never holds
/// half of it. @throws RunError if it cannot be written
void write_file(const std::string& path, std::string_view text);

/// Takes a piece of a text.
using Write = std::function<void(std::string_view)>;
/// The same of a text that comes in pieces: calls make(write), which writes all of them.
void write_file(const std::string& path, const std::function<void(const Write&)>& make);

/// Makes a folder and those above it. @throws RunError if that fails or `path` is a file
void make_folder(const std::string& path);

}  // namespace rovernet
