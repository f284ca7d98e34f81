// SPDX-License-Identifier: MIT
#pragma once

#include "models/phy/wifi.hpp"
#include "sim/time.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace rovernet {

/// Backoff of one station of the 802.11 DCF: the number of slots left, and the time from which
/// these slots count. Both determine the time at which the station may send. The backoff is
/// evaluated lazily: there is no event for a slot, and none while the medium is busy.
///
///   medium   ====frame====|      |   |   |   |   |=====frame=====|      |   |
///   counts                | DIFS | 7 | 6 | 5 | 4 |               | DIFS | 3 | ...
///
/// Slots count once the medium has been idle for an interframe space; a slot in which the medium is
/// busy does not count. A station decides to send one turnaround time before the end of its last
/// slot. The decision uses only energy that arrived more than one CCA time earlier. So two stations
/// whose slots end at the same time both send: neither the propagation delay between them nor the
/// order of events matters.
///
/// Dcf has one Backoff for each station. Dcf reports sensed frames to the Backoff when they start,
/// and calls grant() when the station's timer is due.
///
/// Source: IEEE 802.11-2020, 10.3.4.
class Backoff {
  public:
    /// @param timing  slot and interframe spaces; must outlive the Backoff
    explicit Backoff(const WifiTiming& timing) : timing_(&timing) {}

    /// Reports that the station senses energy from `begin` to `end`. Calls may be out of order by
    /// less than an interframe space.
    void energy(Time begin, Time end) {
        if (busy_since_ == never || begin >= anchor()) {
            slots_ = left();
            counted_from_ = anchor();
            busy_since_ = begin;
        }
        busy_since_ = std::min(busy_since_, begin);
        busy_until_ = std::max(busy_until_, end);
    }
    /// Reports that a frame ended with errors at `t`: no slot counts for `eifs` [ns], unless an
    /// error-free frame ends in that time.
    void frame_lost(Time t, Duration eifs) { eifs_until_ = t + eifs; }
    /// Reports that a frame ended without errors.
    /// @return whether the frame ended an EIFS, so that grant() may now be earlier
    bool frame_decoded() { return std::exchange(eifs_until_, long_ago) != long_ago; }

    /// Starts a backoff of `slots` slots, which do not count before `from`.
    void begin(int slots, Time from) {
        slots_ = slots;
        not_before_ = from;
        busy_since_ = never;
    }
    /// Time at which the station may send: end of its last slot, if the medium stays idle. A timer
    /// due at that time must call grant() again, because the medium may have become busy.
    Time grant() const {
        if (busy_since_ == never) return anchor() + slots_ * timing_->slot;
        if (!was_busy()) return counted_from_ + slots_ * timing_->slot;
        return anchor() + left() * timing_->slot;
    }
    /// Whether the station sensed energy since the backoff started or last paused, early enough to
    /// affect its decision.
    bool was_busy() const {
        return busy_since_ <
               counted_from_ + slots_ * timing_->slot - timing_->turnaround - timing_->cca_time;
    }
    /// Whether the station senses energy at `t`, by the calls of energy() so far.
    bool is_busy(Time t) const { return busy_until_ > t; }

  private:
    // Time before all relevant times: a station starts with an idle medium.
    static constexpr Time long_ago{Duration{-1'000'000'000'000}};

    // Earliest time at which slots can count again, from the energy and the damaged frames that
    // were reported so far.
    Time anchor() const {
        return std::max({not_before_, busy_until_ + timing_->difs, eifs_until_});
    }
    // Number of slots left when the medium became busy: slots_ minus the slots that were complete
    // at that time. The interrupted slot is not subtracted.
    int left() const {
        if (busy_since_ == never) return slots_;
        const Duration idle = busy_since_ + timing_->turnaround + timing_->cca_time - counted_from_;
        if (idle <= Duration{0}) return slots_;
        return static_cast<int>(std::max<std::int64_t>(slots_ - idle / timing_->slot, 0));
    }

    // Slot and interframe spaces of the standard.
    const WifiTiming* timing_;
    // Number of slots left at counted_from_.
    int slots_ = 0;
    // Time before which no slot counts.
    Time not_before_ = start_of_run;
    // Start of the current counting period, which ends when the medium becomes busy.
    Time counted_from_ = start_of_run;
    // Start of the energy that paused the count; `never` if the count runs.
    Time busy_since_ = never;
    // End of the latest energy reported so far.
    Time busy_until_ = long_ago;
    // End of the EIFS after a frame with errors.
    Time eifs_until_ = long_ago;
};

}  // namespace rovernet
