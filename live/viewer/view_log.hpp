// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/viewer/view_stream.hpp"

#include <cstddef>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace rovernet {

/// Files of a ViewStream, kept for pages that come later or read slowly. Beyond a number of bytes
/// the oldest frames are left out; the rest is kept.
class ViewLog {
  public:
    /// Bytes of files with frames that are kept.
    static constexpr std::size_t most_frame_bytes = std::size_t{64} << 20U;

    /// Place of a page in the log: number of parts that it has got; 0: not even the start.
    using Place = std::size_t;

    bool is_empty() const { return start_.empty(); }
    void begin(std::string start) { start_ = std::move(start); }
    void add(ViewStream::Part part) {
        frame_bytes_ += part.frames.size();
        parts_.push_back(std::move(part));
        for (; frame_bytes_ > most_frame_bytes; ++forgotten_) {
            std::string& frames = parts_[forgotten_].frames;
            frame_bytes_ -= frames.size();
            left_out_ += parts_[forgotten_].number_of_frames;
            frames = {};
        }
    }
    /// Number of frames that pages which come now do not get.
    std::size_t left_out() const { return left_out_; }
    /// Sends the next files to a page as long as it reads them.
    /// @param goes_on  whether the page has read enough for more
    void send(Place& place, const std::function<bool()>& goes_on,
              const std::function<void(std::string_view)>& send) const {
        for (; place <= parts_.size() && !is_empty() && goes_on(); ++place) {
            if (place == 0) {
                send(start_);
                continue;
            }
            const ViewStream::Part& part = parts_[place - 1];
            send(part.rest);
            if (!part.frames.empty()) send(part.frames);
        }
    }
    void clear() { *this = {}; }

  private:
    std::string start_;
    std::deque<ViewStream::Part> parts_;
    std::size_t frame_bytes_ = 0, forgotten_ = 0, left_out_ = 0;
};

}  // namespace rovernet
