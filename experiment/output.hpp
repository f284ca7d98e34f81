// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Path and content of a file to write.
struct OutputFile {
    std::string path;
    std::string bytes;
};

/// Writes files, each completely or not at all, see PartFile. The files get their final names when
/// all files are written.
/// @throws RunError if a file cannot be written
void write_files(const std::vector<OutputFile>& files);
/// Writes one file, completely or not at all. @throws RunError if the file cannot be written
void write_file(const std::string& path, std::string_view bytes);

/// Function that writes the next piece of a text.
using Write = std::function<void(std::string_view)>;

/// Makes a folder and its parent folders. @throws RunError if that fails or `path` is a file
void make_folder(const std::string& path);

}  // namespace rovernet
