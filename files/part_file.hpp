// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace rovernet {

/// Output file that gets its name only when it is complete.
///
/// Until then the file is NAME.N.part in the same folder. Every process uses its own number N, so
/// that processes can write NAME at the same time. NAME is then the file of the process that
/// finishes last. The destructor removes an incomplete file. A killed process leaves its incomplete
/// file behind; the next writer of NAME removes that file.
class PartFile {
  public:
    /// Action on the incomplete file NAME.N.part when a write fails: remove the file, or keep the
    /// file for programs that can read incomplete files. The error message names a kept file.
    enum class Failed { is_removed, is_kept };
    /// Action on incomplete files NAME.N.part left by killed processes: remove them, or keep them
    /// for programs that can read incomplete files.
    enum class Orphans { are_removed, are_kept };

    /// @throws RunError if `path` cannot be written, or exists and is not a regular file
    explicit PartFile(std::string path, Failed failed = Failed::is_removed,
                      Orphans orphans = Orphans::are_removed);
    PartFile(PartFile&& other) noexcept;
    PartFile& operator=(PartFile&&) = delete;
    ~PartFile() { discard(); }

    /// Appends bytes. @throws RunError (disk full, for example); see Failed
    void write(std::string_view bytes);
    /// Path of the incomplete file, NAME.N.part; empty after give_name() or keep().
    const std::string& part() const { return part_; }
    /// Closes the file. After this call, give_name() cannot fail for lack of disk space.
    /// @throws RunError as for write()
    void close();
    /// Closes the file and renames it to its final name, replacing any file there.
    /// @throws RunError as for write()
    void give_name();
    /// Closes the incomplete file and leaves it as NAME.N.part. @throws RunError as for write()
    void keep();

  private:
    void discard();
    [[noreturn]] void fail(std::string_view why);

    std::string path_;
    Failed failed_;
    std::string part_;  // path until the file is renamed, removed or kept; then empty
    int file_ = -1;     // descriptor; locked while open, so that no other process removes the file
};

/// Removes the incomplete files PATH.N.part that killed processes left.
void remove_orphans(const std::string& path);

/// Whether `name` has the form WHOLE.N.part, an incomplete version of the file `whole`.
bool is_part_of(std::string_view whole, std::string_view name);

/// Exclusive lock of a folder during the lifetime of the object. A process holds the lock while it
/// renames all output files of a run to their final names. Another process that locks the same
/// folder waits, so that the folder never has files of two runs. The lock has no effect if the file
/// system has no locks.
class FolderLock {
  public:
    explicit FolderLock(const std::string& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

  private:
    int folder_;
};

}  // namespace rovernet
