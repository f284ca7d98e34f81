// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace rovernet {

/// A file that gets its name once it is whole.
///
/// Until then it is NAME.N.part in the same folder, with a number of its own, so that processes
/// that write NAME at the same time do not meet: the last to name it wins. A part that is not named
/// is removed with its object. A process that is killed leaves its part; who writes NAME next
/// removes it.
class PartFile {
  public:
    /// What becomes of the part when a write fails: it is removed, or kept for those who can read
    /// a part. The error then says its name.
    enum class Failed { is_removed, is_kept };
    /// What becomes of the parts of writers that are dead: they are removed, or kept for those who
    /// can read a part.
    enum class Orphans { are_removed, are_kept };

    /// @throws RunError if `path` cannot be written, or is there and no regular file
    explicit PartFile(std::string path, Failed failed = Failed::is_removed,
                      Orphans orphans = Orphans::are_removed);
    PartFile(PartFile&& other) noexcept;
    PartFile& operator=(PartFile&&) = delete;
    ~PartFile() { discard(); }

    /// Adds bytes to the end. @throws RunError (disk full, say); see Failed
    void write(std::string_view bytes);
    /// Ends the writing; give_name() cannot fail for want of space then. @throws RunError as
    /// write()
    void close();
    /// Closes it, and puts it in the place of whatever has the name. @throws RunError as write()
    void give_name();
    /// Leaves the part as it is. @throws RunError as write()
    void keep();

  private:
    void remove_orphans() const;
    void discard();
    [[noreturn]] void fail(std::string_view why);

    std::string path_;
    Failed failed_;
    std::string part_;  // empty: named, removed, or kept
    int file_ = -1;     // open for as long as nobody may take the part for an orphan
};

/// Whether `name` is that of a part of the file `whole`: WHOLE.N.part.
bool is_part_of(std::string_view whole, std::string_view name);

/// The right to name several files of a folder with nobody else's between them. Processes that ask
/// for it wait for one another. Where the file system has no locks it does nothing.
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
