// SPDX-License-Identifier: MIT
#pragma once

#include "models/phy/wifi.hpp"
#include "sim/time.hpp"

#include <algorithm>
#include <cstdint>

namespace rovernet {

/// When a station of the 802.11 DCF may send: the slots that its backoff has left, and since when
/// they count. Evaluated lazily: no event per slot, none while the medium is busy.
///
/// Slots count once the medium has been idle for an interframe space; one in which it is busy does
/// not count. A station decides at the end of its last slot minus the turnaround, by what arrived
/// more than the CCA time before that: so two stations whose slots run out together both send,
/// whatever the delay between them and the order of events.
/// Source: IEEE 802.11-2020, 10.3.4.
class Backoff {
  public:
    explicit Backoff(const WifiTiming& timing) : timing_(&timing) {}

    /// The station senses energy from `begin` to `end`. Begins may come out of order by less than
    /// an interframe space.
    void energy(Time begin, Time end) {
        if (busy_since_ == never || begin >= anchor()) {
            slots_ = left();
            counted_from_ = anchor();
            busy_since_ = begin;
        }
        busy_since_ = std::min(busy_since_, begin);
        busy_until_ = std::max(busy_until_, end);
    }
    /// A frame ended with errors at `t`: no slot counts for `eifs` [ns], unless a good one ends.
    void frame_lost(Time t, Duration eifs) { eifs_until_ = t + eifs; }
    void frame_decoded() { eifs_until_ = long_ago; }

    /// A backoff of `slots` begins, which do not count before `from`.
    void begin(int slots, Time from) {
        slots_ = slots;
        not_before_ = from;
        busy_since_ = never;
    }
    /// When the slots have run out if the medium stays idle: the station may send then.
    Time grant() const {
        if (busy_since_ == never) return anchor() + slots_ * timing_->slot;
        if (!was_disturbed()) return counted_from_ + slots_ * timing_->slot;
        return anchor() + left() * timing_->slot;
    }
    /// The station sensed energy since the backoff began or last stood still.
    bool was_disturbed() const {
        return busy_since_ <
               counted_from_ + slots_ * timing_->slot - timing_->turnaround - timing_->cca_time;
    }
    bool is_busy(Time t) const { return busy_until_ > t; }

  private:
    static constexpr Time long_ago{Duration{-1'000'000'000'000}};

    /// When slots count again, as far as is known.
    Time anchor() const {
        return std::max({not_before_, busy_until_ + timing_->difs, eifs_until_});
    }
    /// Slots left when the medium became busy.
    int left() const {
        if (busy_since_ == never) return slots_;
        const Duration idle = busy_since_ + timing_->turnaround + timing_->cca_time - counted_from_;
        if (idle <= Duration{0}) return slots_;
        return static_cast<int>(std::max<std::int64_t>(slots_ - idle / timing_->slot, 0));
    }

    const WifiTiming* timing_;
    int slots_ = 0;
    Time not_before_ = start_of_run;
    Time counted_from_ = start_of_run;  // slots_ counted from here ...
    Time busy_since_ = never;           // ... until here
    Time busy_until_ = long_ago;
    Time eifs_until_ = long_ago;
};

}  // namespace rovernet
