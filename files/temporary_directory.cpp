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

TemporaryDirectory::TemporaryDirectory()
    : path_((std::filesystem::temp_directory_path() / "rovernet-XXXXXX").string()) {
    if (mkdtemp(path_.data())) return;
    throw RunError(
        fmt::format("{}: cannot create this temporary folder: {}", path_, std::strerror(errno)));
}

TemporaryDirectory::~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace rovernet
