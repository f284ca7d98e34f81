// SPDX-License-Identifier: MIT
#include "experiment/output.hpp"

#include "files/part_file.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace rovernet {

void write_files(const std::vector<OutputFile>& files) {
    std::vector<PartFile> parts;
    for (const OutputFile& file : files) {
        parts.emplace_back(file.path).write(file.bytes);
        parts.back().close();
    }
    for (PartFile& part : parts) part.give_name();
}

void write_file(const std::string& path, std::string_view bytes) {
    PartFile part(path);
    part.write(bytes);
    part.give_name();
}

void make_folder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (!error && std::filesystem::is_directory(path, error)) return;
    throw RunError(
        fmt::format("{}: cannot create this folder ({}); give a different folder for the results",
                    path, error ? error.message() : "a file has this name"));
}

}  // namespace rovernet
