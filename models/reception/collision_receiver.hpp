// SPDX-License-Identifier: MIT
#pragma once

#include "models/arrival.hpp"
#include "sim/time.hpp"

namespace rovernet {

/// Receiver of the model "collision" with CaptureOrder::first. Frames arrive in the order of their
/// beginnings, and the receiver has at most one current frame:
///
///   receiver free           the frame becomes the current frame
///   current frame stronger  the frame is ignored, if it is weaker by at least the capture ratio
///   otherwise               both collide; the one that ends last becomes the current frame
///
/// The receiver is free again when the current frame ends. An ignored frame has no effect on frames
/// that arrive after it.
///
/// Source: Mac802_11::recv(), capture() and collision() of ns-2.35.
class CollisionReceiver {
  public:
    /// Whether the receiver has no current frame at `t`, which is not before the last arrival.
    bool is_free(Time t) const { return !current_ || current_->end <= t; }

    /// Takes the next frame, which must outlive the receiver.
    /// @param ignores  ignores(frame, current): whether `frame` is weaker than `current` by at
    ///                 least the capture ratio; called only if the result matters
    template <class Ignores>
    void arrives(Arrival& frame, Ignores ignores) {
        const bool stays =
            !is_free(frame.begin) && (ignores(frame, *current_) || frame.end <= current_->end);
        if (!stays) current_ = &frame;
    }

  private:
    Arrival* current_ = nullptr;
};

}  // namespace rovernet
