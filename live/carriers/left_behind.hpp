// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <span>
#include <string>
#include <sys/types.h>

// What a process that serves programs outside must not leave behind, however it ends.

namespace rovernet {

/// Time that programs have between SIGTERM and SIGKILL.
inline constexpr std::chrono::milliseconds before_kill{1000};

/// Ends process groups: SIGTERM, then SIGKILL to those of which a process is left before_kill
/// later. Their leaders, which are children of this process, are waited for, so no zombie is left.
/// Safe in a handler of a signal.
/// @param leaders  numbers of the groups; a leader may have ended, but nobody has waited for it
void end_groups(std::span<const pid_t> leaders);

/// Process group that is ended by clear_away() while this lives. At most 1,024 are noted.
class NotedGroup {
  public:
    explicit NotedGroup(pid_t leader);
    NotedGroup(NotedGroup&& other) noexcept;
    NotedGroup& operator=(NotedGroup&&) = delete;
    ~NotedGroup();

  private:
    std::size_t place_;
};

/// File that is removed by clear_away() while this lives, and by its end. At most 16 are noted.
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

/// Ends the groups and removes the files that this process has noted; a process that was forked
/// from it has noted none. Safe in a handler of a signal, before _exit().
void clear_away();

}  // namespace rovernet
