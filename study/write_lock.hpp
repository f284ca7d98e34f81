// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace rovernet {

/// The right to write to a store's file, held as long as the object lives.
class WriteLock {
  public:
    /// Makes the file if there is none. Waits a second for another writer.
    /// @throws RunError if it cannot be written, or another process writes to it
    explicit WriteLock(const std::string& path);
    ~WriteLock();
    WriteLock(const WriteLock&) = delete;
    WriteLock& operator=(const WriteLock&) = delete;

  private:
    int file_;
};

}  // namespace rovernet
