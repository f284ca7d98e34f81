// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <mutex>

namespace rovernet {

/// Work done once, on first use, by the first thread that calls; other threads wait for it.
///
/// A later call costs only the test of a flag; std::call_once would call the C library.
class Once {
  public:
    /// Calls work(), unless it was done. An exception of work() reaches the caller, and the next
    /// call tries again.
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
