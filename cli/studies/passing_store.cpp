// SPDX-License-Identifier: MIT
#include "cli/studies/passing_store.hpp"

#include "sim/error.hpp"

#include <filesystem>
#include <stdlib.h>
#include <system_error>

namespace rovernet::cli {

PassingStore::PassingStore() {
    path_ = (std::filesystem::temp_directory_path() / "rovernet-study-XXXXXX").string();
    if (!mkdtemp(path_.data())) throw RunError(path_ + ": no folder can be made there");
}

PassingStore::~PassingStore() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace rovernet::cli
