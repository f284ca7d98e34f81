// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <set>
#include <sys/types.h>
#include <utility>
#include <vector>

namespace rovernet {

/// Set of network namespaces, identified by their numbers in the kernel (device and inode).
class NamespaceSet {
  public:
    /// @param descriptor  open file descriptor of a namespace
    void add(int descriptor);
    /// Processes in the namespaces that are visible to this process, without this process.
    std::vector<pid_t> members() const;

  private:
    std::set<std::pair<dev_t, ino_t>> numbers_;
};

/// Descendants of this process: its children, their children, and so on.
std::vector<pid_t> descendants();

/// Ends all processes that `find` lists, and calls `find` again until no process is left. Processes
/// get SIGTERM first, after 1 s SIGHUP (an interactive shell ignores SIGTERM), and after 2 s
/// SIGKILL. The function also returns if only processes remain that this process may not kill, and
/// after 3 s at the latest.
/// @param find  function that lists the current processes
void end_processes(const std::function<std::vector<pid_t>()>& find);

}  // namespace rovernet
