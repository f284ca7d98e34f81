// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <mutex>

namespace rovernet {

/// Work that is done at the first question, by whichever thread asks it; others wait for it.
///
/// Questions that come later cost the test of a flag; std::call_once would enter the C library.
class Once {
  public:
    /// Calls work(), unless that was done. What it throws goes to the caller, and the next question
    /// tries again.
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
