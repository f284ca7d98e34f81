// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace rovernet::cli {

/// Folder for a store that vanishes with its object.
class PassingStore {
  public:
    /// @throws RunError if the folder for temporary files cannot be written
    PassingStore();
    ~PassingStore();
    PassingStore(const PassingStore&) = delete;
    PassingStore& operator=(const PassingStore&) = delete;
    /// Name of the store in it.
    std::string file() const { return path_ + "/study.db"; }

  private:
    std::string path_;
};

}  // namespace rovernet::cli
