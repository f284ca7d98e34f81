// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace rovernet::cli {

/// Temporary folder for a store, removed by the destructor.
class PassingStore {
  public:
    /// @throws RunError if the folder for temporary files cannot be written
    PassingStore();
    ~PassingStore();
    PassingStore(const PassingStore&) = delete;
    PassingStore& operator=(const PassingStore&) = delete;
    /// Path of the store in the temporary folder.
    std::string file() const { return path_ + "/study.db"; }

  private:
    std::string path_;
};

}  // namespace rovernet::cli
