// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <mutex>

namespace rovernet {

/// Execution of some work once, on first use, by the first thread that calls. Other threads that
/// call meanwhile wait until the work is done.
///
/// A later call costs only the test of a flag; std::call_once would call the C library.
class Once {
  public:
    /// Calls work(), unless an earlier call has completed it. If work() throws, the exception
    /// reaches the caller, and the next call runs work() again.
    template <class Work>
    void operator()(Work work) {
        if (done_.load(std::memory_order_acquire)) return;
        const std::scoped_lock lock(mutex_);
        if (done_.load(std::memory_order_relaxed)) return;
        work();
        done_.store(true, std::memory_order_release);
    }

  private:
    std::mutex mutex_;
    std::atomic<bool> done_ = false;
};

}  // namespace rovernet
