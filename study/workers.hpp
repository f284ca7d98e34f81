// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

namespace rovernet {

/// Limits of a worker.
struct WorkerLimits {
    std::optional<double> timeout_s;      ///< real time for one task [s]
    std::optional<std::uint64_t> memory;  ///< [bytes] of address space
};

/// End of a task.
struct TaskEnd {
    enum Kind {
        done,    ///< `text` is the answer
        failed,  ///< the task threw; `text` is what
        died     ///< the process died or was ended; `text` says how, with its last words
    };
    std::uint64_t task;
    Kind kind;
    std::string text;
};

/// Processes that take tasks over a socket, one at a time each, and answer.
///
/// A task that crashes, exceeds its time or runs out of memory costs only itself: its process is
/// replaced. They are forked: whatever `work` refers to is as it was when the worker began, and
/// nothing that it changes comes back but its answer. They die with this process, however it ends.
/// Only for processes with one thread.
class Workers {
  public:
    using Work = std::function<std::string(std::uint64_t task)>;

    /// @param count  > 0; processes begin when they are first needed
    Workers(std::size_t count, Work work, WorkerLimits limits);
    /// Ends every worker at once.
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    bool has_idle() const;
    /// Tasks that are being worked on.
    std::size_t busy() const;
    /// Begins a task. @throws RunError if no process can be made; there must be an idle worker
    void begin(std::uint64_t task);
    /// The next task that ends within so many seconds, if one does; also returns early, without
    /// one, when a signal came.
    std::optional<TaskEnd> wait(double seconds);

  private:
    struct Worker {
        pid_t pid = 0;    // 0: not running
        int socket = -1;  // tasks go out, answers come in
        int words = -1;   // file with what it says on standard error
        std::string got;  // part of its answer
        std::optional<std::uint64_t> task;
        double deadline = 0;  // [s] of the steady clock
    };

    void start(Worker& worker);
    [[noreturn]] void serve(int socket) const;
    std::optional<TaskEnd> read_answer(Worker& worker);
    TaskEnd bury(Worker& worker, const std::string& reason);
    int wait_time(double until) const;

    Work work_;
    WorkerLimits limits_;
    std::vector<Worker> workers_;
};

}  // namespace rovernet
