// SPDX-License-Identifier: MIT
#include "experiment/output.hpp"

#include "sim/error.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace rovernet {

void write_file(const std::string& path, std::string_view text) {
    write_file(path, [&](const Write& write) { write(text); });
}

void write_file(const std::string& path, const std::function<void(const Write&)>& make) {
    const std::string part = path + ".part";
    std::ofstream file(part, std::ios::binary | std::ios::trunc);
    make([&](std::string_view text) { file << text; });
    file.close();
    if (!file || std::rename(part.c_str(), path.c_str()) != 0) {
        std::remove(part.c_str());
        throw RunError(
            fmt::format("{}: cannot be written; check the folder's permissions and the "
                        "space on its disk",
                        path));
    }
}

void make_folder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (std::filesystem::is_directory(path)) return;
    throw RunError(fmt::format("{}: no folder can be made there ({}); give another with --out",
                               path, error ? error.message() : "a file is in the way"));
}

}  // namespace rovernet
