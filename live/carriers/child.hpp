// SPDX-License-Identifier: MIT
#pragma once

#include "files/left_behind.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace rovernet {

/// Program started by the shell, with standard input and output connected to one socket. The
/// program runs in a separate process group, so that Ctrl-C at the terminal reaches only the parent
/// process. Ending the program ends its whole process group.
class Child {
  public:
    /// Starts the program by the shell. @throws RunError if it cannot be started
    explicit Child(std::string command);
    Child(Child&& other) noexcept;
    Child& operator=(Child&&) = delete;
    /// Ends the program's process group if a process of the group is left, see end_groups().
    ~Child();

    /// Parent's end of the socket to the program; the caller becomes its owner.
    int take_socket();
    /// Waits until the program ends, at most until `most`. Other processes of the program's group
    /// may continue.
    /// @return error: "python3 x.py ended with exit code 1"; empty after success, or if the program
    /// still runs
    std::string wait_until(std::chrono::steady_clock::time_point most);
    /// Ends the process groups of all programs in `children`, see end_groups().
    static void end(std::vector<Child>& children);

  private:
    bool has_ended();

    std::string command_;
    pid_t pid_ = -1;  // process id of the shell and of the group; -1: the group has ended
    int socket_ = -1;
    std::string fault_;  // error at the program's end
    // Whether the shell has ended. An ended shell stays a zombie until its group is ended.
    bool has_ended_ = false;
    std::optional<NotedGroup> noted_;
};

}  // namespace rovernet
