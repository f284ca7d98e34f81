// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// A file to be written, with all its bytes.
struct OutputFile {
    std::string path;
    std::string bytes;
};

/// Writes files, each whole or not at all, see PartFile: none has its name before all are written.
/// @throws RunError if one cannot be written
void write_files(const std::vector<OutputFile>& files);
/// Writes one file. @throws RunError if it cannot be written
void write_file(const std::string& path, std::string_view bytes);

/// Takes a piece of a text.
using Write = std::function<void(std::string_view)>;

/// Makes a folder and those above it. @throws RunError if that fails or `path` is a file
void make_folder(const std::string& path);

}  // namespace rovernet
