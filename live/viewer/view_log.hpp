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

/// Files of a ViewStream, kept for pages that connect later or read slowly. If the files with
/// frames exceed most_frame_bytes, the oldest of them are removed; all other files are kept.
class ViewLog {
  public:
    /// Largest total size of the files with frames [bytes].
    static constexpr std::size_t most_frame_bytes = std::size_t{64} << 20U;

    /// Position of a page in the log: number of files sent to the page; 0: none yet.
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
    /// Number of removed frames: a page that connects now does not get these.
    std::size_t left_out() const { return left_out_; }
    /// Sends the next files to a page, as long as the page reads them.
    /// @param goes_on  function that returns whether the page can take more data
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
