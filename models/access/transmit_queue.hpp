// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
#include "sim/message.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace rovernet {

/// Interface queue of a station: frames that wait for channel access, first in, first out. The
/// station contends for its first frame.
///
/// With priority, control packets of the routing protocol go before messages of applications, but
/// never before the first frame.
class TransmitQueue {
  public:
    /// State of the queue: whether it is empty, and its number of frames.
    bool empty() const { return begin_ == frames_.size(); }
    std::size_t size() const { return frames_.size() - begin_; }
    /// First frame; the queue must not be empty.
    const QueuedFrame& front() const { return frames_[begin_]; }

    /// Appends a frame. A full queue refuses the frame; but with priority, a control packet
    /// displaces the last message of an application.
    /// @param most      largest number of frames
    /// @param priority  whether control packets have priority
    /// @return frame for which there was no space, if any
    std::optional<QueuedFrame> push(const QueuedFrame& frame, std::size_t most, bool priority) {
        const bool goes_ahead = priority && frame.is_control && !empty();
        auto at = frames_.end();
        if (goes_ahead) {
            at = std::find_if(frames_.begin() + offset() + 1, frames_.end(),
                              [](const QueuedFrame& each) { return !each.is_control; });
        }
        if (size() < most) {
            frames_.insert(at, frame);
            return std::nullopt;
        }
        if (!goes_ahead || at == frames_.end()) return frame;
        const QueuedFrame displaced = frames_.back();
        std::move_backward(at, frames_.end() - 1, frames_.end());
        *at = frame;
        return displaced;
    }
    /// Removes the first frame and returns it; the queue must not be empty.
    QueuedFrame pop() {
        const QueuedFrame first = frames_[begin_++];
        // Removed entries are erased when they are half of all entries: O(1) per frame on average.
        if (begin_ * std::size_t{2} >= frames_.size()) {
            frames_.erase(frames_.begin(), frames_.begin() + offset());
            begin_ = 0;
        }
        return first;
    }
    /// Removes the frames for which `is_taken` is true and returns them; other frames keep their
    /// order.
    /// @param keeps_first  whether the first frame stays, because it is on air
    std::vector<QueuedFrame> take(const FrameTest& is_taken, bool keeps_first) {
        const auto first = frames_.begin() + offset() + (keeps_first && !empty() ? 1 : 0);
        const auto taken = std::stable_partition(
            first, frames_.end(), [&](const QueuedFrame& each) { return !is_taken(each.frame); });
        std::vector<QueuedFrame> frames(taken, frames_.end());
        frames_.erase(taken, frames_.end());
        return frames;
    }
    /// Removes all frames and returns them.
    std::vector<QueuedFrame> take_all() {
        frames_.erase(frames_.begin(), frames_.begin() + offset());
        begin_ = 0;
        return std::exchange(frames_, {});
    }

  private:
    std::ptrdiff_t offset() const { return static_cast<std::ptrdiff_t>(begin_); }

    // Frames of the queue, from index begin_ on; entries before begin_ were removed.
    std::vector<QueuedFrame> frames_;
    std::uint32_t begin_ = 0;
};

}  // namespace rovernet
