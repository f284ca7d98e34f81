// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/left_behind.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace rovernet {

/// Program that was started by the shell, with its standard input and output at one socket. It is
/// in a process group of its own: Ctrl-C at the terminal reaches it through its parent only. With
/// it end all that it has started, but for what has left its group.
class Child {
  public:
    /// @throws RunError if it cannot be started
    explicit Child(std::string command);
    Child(Child&& other) noexcept;
    Child& operator=(Child&&) = delete;
    /// Ends its group if something of it is still there, see end_groups().
    ~Child();

    /// The parent's end of the socket, which the caller then owns.
    int take_socket();
    /// Waits for its end, at most so long. Its group may go on.
    /// @return what went wrong: "python3 x.py ended with 1"; empty if nothing, or if it goes on
    std::string wait_until(std::chrono::steady_clock::time_point most);
    /// Ends the groups of all, see end_groups().
    static void end(std::vector<Child>& children);

  private:
    bool has_ended();

    std::string command_;
    pid_t pid_ = -1;  // of the shell, and of the group; -1: the group has ended
    int socket_ = -1;
    std::string fault_;       // of its end
    bool has_ended_ = false;  // the shell, which is a zombie until the group is ended
    std::optional<NotedGroup> noted_;
};

}  // namespace rovernet
