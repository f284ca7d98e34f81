// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace rovernet {

/// Limits of a worker process.
struct WorkerLimits {
    std::optional<double> timeout_s;      ///< limit of real time for one task [s]; none: no limit
    std::optional<std::uint64_t> memory;  ///< limit of address space [bytes]; none: no limit
};

/// End of a task of a worker process: kind of end, and result or reason.
struct TaskEnd {
    enum Kind {
        done,    ///< task completed; `text` is the result
        failed,  ///< the task threw an exception; `text` is its message
        died     ///< the process died or was killed; `text` is the reason, with its last output
    };
    std::uint64_t task;
    Kind kind;
    std::string text;
};

/// Worker processes. Each worker takes one task at a time over a socket and returns the task's
/// result.
///
/// A task that crashes, exceeds its time or runs out of memory affects no other task; the worker's
/// process is replaced. Workers are forked: the function `work` sees the state of this process at
/// the start of the worker, and only its result is returned. Workers are killed when this process
/// ends for any reason. This process must have a single thread.
class Workers {
  public:
    using Work = std::function<std::string(std::uint64_t task)>;

    /// @param count  number of workers, > 0; worker processes are started when first needed
    Workers(std::size_t count, Work work, WorkerLimits limits);
    /// Kills all workers.
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    /// Indices of the workers without a task.
    std::vector<std::size_t> idle() const;
    /// Number of tasks that are running.
    std::size_t busy() const;
    /// Gives a task to an idle worker. @throws RunError if the worker's process cannot be started
    void begin(std::size_t worker, std::uint64_t task);
    /// Waits up to `seconds` for a task to end, and returns the end of that task. None if no task
    /// ends in this time, or if a signal interrupts the wait.
    std::optional<TaskEnd> wait(double seconds);

  private:
    struct Worker {
        pid_t pid = 0;    // process id; 0: not running
        int socket = -1;  // socket that sends tasks and receives results
        int words = -1;   // file with the process's standard error
        std::string got;  // part of the task's result that was received so far
        std::optional<std::uint64_t> task;
        double deadline = 0;  // latest end of the task [s], by the steady clock
    };

    void start(Worker& worker);
    [[noreturn]] void serve(int socket) const;
    std::optional<TaskEnd> read_answer(Worker& worker);
    TaskEnd reap(Worker& worker, const std::string& reason);
    int wait_time(double until) const;

    Work work_;
    WorkerLimits limits_;
    std::vector<Worker> workers_;
};

}  // namespace rovernet
