// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace rovernet {

/// New folder in the system's folder for temporary files. The destructor removes the folder with
/// its content.
class TemporaryFolder {
  public:
    /// @throws RunError if the folder cannot be made
    TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();

    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

}  // namespace rovernet
