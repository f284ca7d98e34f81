// SPDX-License-Identifier: MIT
#include "files/temporary_directory.hpp"

#include "sim/error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdlib.h>
#include <system_error>

namespace rovernet {

namespace {

std::string new_folder() {
    std::string path = (std::filesystem::temp_directory_path() / "rovernet-XXXXXX").string();
    if (mkdtemp(path.data())) return path;
    throw RunError(
        fmt::format("{}: cannot create this temporary folder: {}", path, std::strerror(errno)));
}

}  // namespace

TemporaryDirectory::TemporaryDirectory() : path_(new_folder()), noted_(path_) {}

TemporaryDirectory::~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace rovernet
