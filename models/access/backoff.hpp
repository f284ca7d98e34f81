// SPDX-License-Identifier: MIT
#pragma once

#include "models/phy/wifi.hpp"
#include "sim/time.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace rovernet {

/// Backoff of one station of the 802.11 DCF: the slots that it has left, and since when they count.
/// From that follows when the station may send. It is evaluated lazily: there is no event for a
/// slot, and none while the medium is busy.
///
///   medium   ====frame====|      |   |   |   |   |=====frame=====|      |   |
///   counts                | DIFS | 7 | 6 | 5 | 4 |               | DIFS | 3 | ...
///
/// Slots count once the medium has been idle for an interframe space; one in which it is busy does
/// not count. A station decides at the end of its last slot minus the turnaround, by what arrived
/// more than the CCA time before that: so two stations whose slots run out together both send,
/// whatever the delay between them and the order of events.
///
/// Dcf has one for each station. It writes what the station senses as a frame goes on air, and asks
/// grant() when its timer is due.
///
/// Source: IEEE 802.11-2020, 10.3.4.
class Backoff {
  public:
    /// @param timing  slots and interframe spaces; outlives this
    explicit Backoff(const WifiTiming& timing) : timing_(&timing) {}

    /// Takes note that the station senses energy from `begin` to `end`. Begins may come out of
    /// order by less than an interframe space.
    void energy(Time begin, Time end) {
        if (busy_since_ == never || begin >= anchor()) {
            slots_ = left();
            counted_from_ = anchor();
            busy_since_ = begin;
        }
        busy_since_ = std::min(busy_since_, begin);
        busy_until_ = std::max(busy_until_, end);
    }
    /// Takes note that a frame ended with errors at `t`: no slot counts for `eifs` [ns], unless a
    /// good frame ends meanwhile.
    void frame_lost(Time t, Duration eifs) { eifs_until_ = t + eifs; }
    /// Takes note that a frame ended without errors.
    /// @return whether one with errors came before it: grant() may be earlier now
    bool frame_decoded() { return std::exchange(eifs_until_, long_ago) != long_ago; }

    /// Begins a backoff of so many slots, which do not count before `from`.
    void begin(int slots, Time from) {
        slots_ = slots;
        not_before_ = from;
        busy_since_ = never;
    }
    /// Time at which the slots have run out if the medium stays idle: the station may send then. A
    /// timer that is due then asks again, as the medium may have been busy meanwhile.
    Time grant() const {
        if (busy_since_ == never) return anchor() + slots_ * timing_->slot;
        if (!was_busy()) return counted_from_ + slots_ * timing_->slot;
        return anchor() + left() * timing_->slot;
    }
    /// Whether the station sensed energy since the backoff began or last stood still, early enough
    /// to count for its decision.
    bool was_busy() const {
        return busy_since_ <
               counted_from_ + slots_ * timing_->slot - timing_->turnaround - timing_->cca_time;
    }
    /// Whether the station senses energy at `t`, as far as is known.
    bool is_busy(Time t) const { return busy_until_ > t; }

  private:
    // Time before all others that matter: a station starts with an idle medium.
    static constexpr Time long_ago{Duration{-1'000'000'000'000}};

    // Time from which slots count again, as far as is known.
    Time anchor() const {
        return std::max({not_before_, busy_until_ + timing_->difs, eifs_until_});
    }
    // Slots left when the medium became busy: those that were over by then count, the one under way
    // does not.
    int left() const {
        if (busy_since_ == never) return slots_;
        const Duration idle = busy_since_ + timing_->turnaround + timing_->cca_time - counted_from_;
        if (idle <= Duration{0}) return slots_;
        return static_cast<int>(std::max<std::int64_t>(slots_ - idle / timing_->slot, 0));
    }

    // Slots and spaces of the standard.
    const WifiTiming* timing_;
    // Slots that were left at counted_from_.
    int slots_ = 0;
    // Time before which this backoff does not count.
    Time not_before_ = start_of_run;
    // Slots count from here, and until the medium became busy.
    Time counted_from_ = start_of_run;
    // Begin of the energy that has stopped the count; never: none has.
    Time busy_since_ = never;
    // End of the energy, as far as is known.
    Time busy_until_ = long_ago;
    // End of the EIFS after a frame with errors.
    Time eifs_until_ = long_ago;
};

}  // namespace rovernet
