// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace rovernet {

/// File descriptor, closed by the destructor. The descriptor is below 0 if the file cannot be
/// opened.
class FileNumber {
  public:
    /// @param flags  flags of open(2)
    FileNumber(const std::string& path, int flags);
    ~FileNumber();
    FileNumber(const FileNumber&) = delete;
    FileNumber& operator=(const FileNumber&) = delete;

    int number() const { return number_; }

  private:
    int number_;
};

/// Exclusive lock for writing to a store's file, released by the destructor.
///
/// The lock is a flock on the file if the file system supports it. Without flock, or if the file
/// system implements flock by range locks (which SQLite uses), the lock is a file `PATH.lock` that
/// names process and host. A lock file of a dead process on this host is taken over.
class WriteLock {
  public:
    /// Takes the lock of the store file at `path`; creates the file if missing. Waits up to 1 s if
    /// another process holds the lock.
    /// @throws RunError if the file cannot be written, or another process still holds the lock
    explicit WriteLock(const std::string& path);
    ~WriteLock();
    WriteLock(const WriteLock&) = delete;
    WriteLock& operator=(const WriteLock&) = delete;

    /// Whether the lock is a flock on the store's file. False: the lock is a file PATH.lock.
    bool is_whole() const { return owner_ == 0; }

  private:
    std::string path_;
    FileNumber file_;
    // Id of the process that created the lock file PATH.lock; 0: no lock file.
    int owner_ = 0;
};

/// Whether the file system of an existing file supports range locks, which SQLite needs. It is an
/// error if this process has the file open in SQLite, since this function would release SQLite's
/// locks.
bool has_range_locks(const std::string& path);

/// Whether the file is on a known type of network or cluster file system, so that several hosts may
/// share the file.
bool is_shared_by_hosts(const std::string& path);

/// Checks that no process writes to the file of a store, for readers that SQLite's locks do not
/// protect. @throws RunError if a process writes to the file, or if the check is impossible
void need_no_writer(const std::string& path);

}  // namespace rovernet
