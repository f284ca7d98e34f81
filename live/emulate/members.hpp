// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <set>
#include <sys/types.h>
#include <utility>
#include <vector>

namespace rovernet {

/// Numbers of network namespaces, by which the kernel tells one from another.
class NamespaceSet {
  public:
    /// @param descriptor  of a namespace
    void add(int descriptor);
    /// Processes whose network is one of these, as far as this one may know; not itself.
    std::vector<pid_t> members() const;

  private:
    std::set<std::pair<dev_t, ino_t>> numbers_;
};

/// Processes that this one has started, those that these have started, and so on.
std::vector<pid_t> descendants();

/// Ends processes, and those that they start meanwhile: by SIGTERM, after one second by SIGHUP (a
/// shell at a terminal passes over SIGTERM), after two by SIGKILL. Returns once none is left, or
/// none that ends.
/// @param find  those that are there now
void end_processes(const std::function<std::vector<pid_t>()>& find);

}  // namespace rovernet
