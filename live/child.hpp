// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>
#include <sys/types.h>

namespace rovernet {

/// Program that was started by the shell, with its standard input and output at one socket. It is
/// in a process group of its own: Ctrl-C at the terminal reaches it through its parent only.
class Child {
  public:
    /// @throws RunError if it cannot be started
    explicit Child(std::string command);
    Child(Child&& other) noexcept;
    Child& operator=(Child&&) = delete;
    /// Ends it if it is still there.
    ~Child();

    /// The parent's end of the socket, which the caller then owns.
    int take_socket();
    /// Waits for its end, at most so long; then it is ended.
    /// @return what went wrong: "python3 x.py ended with 1"; empty if nothing
    std::string wait(std::chrono::milliseconds most);

  private:
    bool has_ended();
    void end();

    std::string command_;
    pid_t pid_ = -1;  // -1: it has ended
    int socket_ = -1;
    int status_ = 0;
};

}  // namespace rovernet
