// SPDX-License-Identifier: MIT
#pragma once

#include "files/left_behind.hpp"

#include <string>

namespace rovernet {

/// New directory in the system's folder for temporary files. The destructor removes the folder with
/// its content, also if a signal ends the process.
class TemporaryDirectory {
  public:
    /// @throws RunError if the folder cannot be made
    TemporaryDirectory();
    TemporaryDirectory(const TemporaryDirectory&) = delete;
    TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
    ~TemporaryDirectory();

    const std::string& path() const { return path_; }

  private:
    std::string path_;
    NotedFolder noted_;
};

}  // namespace rovernet
