// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <span>
#include <string>
#include <sys/types.h>

// Cleanup of processes and files when a server process ends for any reason.

namespace rovernet {

/// Time between SIGTERM and SIGKILL when a process is ended.
inline constexpr std::chrono::milliseconds before_kill{1000};

/// Ends process groups: sends SIGTERM, and SIGKILL to groups with a process left after
/// `before_kill`. The leaders, which are children of this process, are reaped, so that no zombie
/// remains. Safe in a signal handler.
/// @param leaders  process ids of the groups; a leader may have ended, but must not be reaped yet
void end_groups(std::span<const pid_t> leaders);

/// Registration of a process group, which lasts as long as this object. clear_away() ends all
/// registered groups. At most 1,024 groups can be registered.
class NotedGroup {
  public:
    explicit NotedGroup(pid_t leader);
    NotedGroup(NotedGroup&& other) noexcept;
    NotedGroup& operator=(NotedGroup&&) = delete;
    ~NotedGroup();

  private:
    std::size_t place_;
};

/// Registration of a file, which lasts as long as this object. The destructor removes the file, and
/// clear_away() removes all registered files. At most 16 files can be registered.
class NotedFile {
  public:
    explicit NotedFile(std::string path);
    NotedFile(const NotedFile&) = delete;
    NotedFile& operator=(const NotedFile&) = delete;
    ~NotedFile();

  private:
    std::string path_;
    std::size_t place_;
};

/// Registration of a folder, which lasts as long as this object. clear_away() removes all
/// registered folders with their contents. At most 16 folders can be registered.
class NotedFolder {
  public:
    explicit NotedFolder(std::string path);
    NotedFolder(const NotedFolder&) = delete;
    NotedFolder& operator=(const NotedFolder&) = delete;
    ~NotedFolder();

  private:
    std::string path_;
    std::size_t place_;
};

/// Ends the process groups and removes the files and folders that this process has registered. A
/// forked process starts with no registered groups, files and folders. Safe in a signal handler,
/// before _exit().
void clear_away();

}  // namespace rovernet
