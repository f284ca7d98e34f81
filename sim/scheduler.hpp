// SPDX-License-Identifier: MIT
#pragma once

#include "sim/event_queue.hpp"
#include "sim/time.hpp"

#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace rovernet {

/// What Scheduler::cancel wants to know; a default handle belongs to no event.
struct EventHandle {
    std::uint32_t slot = 0;
    std::uint64_t sequence = ~std::uint64_t{0};
};

/// How much a Scheduler takes before it throws; the defaults are the most that a key can hold.
struct SchedulerLimits {
    std::uint64_t pending = std::uint64_t{1} << 24;    ///< events queued at once
    std::uint64_t scheduled = std::uint64_t{1} << 36;  ///< calls of schedule() in one run
};

/// @throws RunError "more than {limit} events are {state}; ..."
[[noreturn]] void throw_too_many_events(const char* state, std::uint64_t limit);

/// The queue of events to come, served in the order of EventKey.
///
/// Payloads lie apart from the keys in reused slots; memory grows only beyond the most keys that
/// were ever pending. A cancelled key stays until it comes up, or until half of all keys are dead.
///
/// @tparam Payload  movable, default-constructible; best small, and what tells events apart
template <class Payload>
class Scheduler {
  public:
    using Key = EventKey;
    using Handle = EventHandle;
    struct Event {
        Key key;
        Payload payload;
    };

    explicit Scheduler(SchedulerLimits limits = {}) : limits_(limits) {
        static_assert(std::movable<Payload> && std::default_initializable<Payload>);
        assert(limits.pending <= SchedulerLimits{}.pending);
        assert(limits.scheduled <= SchedulerLimits{}.scheduled);
    }

    /// Queues an event; `t` must not lie before the last event popped.
    /// @throws RunError when more events are pending or scheduled than the limits allow
    Handle schedule(Time t, Priority priority, Payload payload) {
        if (scheduled_ == limits_.scheduled) throw_too_many_events("scheduled", limits_.scheduled);
        const std::uint32_t slot = queue(t, priority, scheduled_, scheduled_, payload);
        return {slot, scheduled_++};
    }

    /// Queues the rest of a popped event under its key, perhaps moved to a later time by Key::at.
    /// It keeps its place among equals, does not count as scheduled, and cannot be cancelled.
    /// At most once per pop. @throws RunError as schedule()
    void requeue(Key key, Payload payload) {
        assert(key.sequence() < scheduled_);
        queue(key.time(), key.priority(), key.sequence(), key.sequence() | requeued, payload);
    }

    /// Takes an event out of the queue. False if it was already popped, cancelled or requeued.
    bool cancel(Handle handle) {
        const std::size_t i = handle.slot;
        if (i >= slots_.size() || slots_[i].tag != handle.sequence) return false;
        slots_[i].payload = Payload{};
        release(handle.slot);
        ++dead_;
        drop_dead_tops();
        if (2 * dead_ > queue_.size()) purge();
        return true;
    }

    /// Removes the event that is served next; there must be one.
    Event pop() {
        assert(!empty());
        const Key key = queue_.top();
        last_popped_ = key.time();
        Event event{key, std::move(slots_[key.slot()].payload)};
        release(key.slot());
        queue_.pop();
        drop_dead_tops();
        return event;
    }

    /// The key of the event that is served next; if there is none, one after every event.
    Key next_key() const { return queue_.top(); }
    /// The time of the event that is served next.
    std::optional<Time> next_time() const {
        return empty() ? std::nullopt : std::optional(queue_.top().time());
    }
    /// What the event is about that is served next; there must be one.
    const Payload& next() const { return slots_[queue_.top().slot()].payload; }
    /// Would an event with this key be served before everything that is queued?
    bool runs_before_next(Key key) const { return key < queue_.top(); }

    bool empty() const { return queue_.empty(); }
    std::size_t size() const { return queue_.size() - dead_; }  ///< events queued and not cancelled
    std::uint64_t scheduled() const { return scheduled_; }      ///< calls of schedule() so far

  private:
    // The tag of a live slot is its event's sequence, perhaps with `requeued`; that of a free slot
    // is `released` | the next free slot.
    static constexpr std::uint64_t released = std::uint64_t{1} << 63;
    static constexpr std::uint64_t requeued = std::uint64_t{1} << 62;
    static constexpr std::uint32_t no_slot = 0xffffffff;
    struct Slot {
        std::uint64_t tag;
        Payload payload;
    };

    std::uint32_t queue(Time t, Priority priority, std::uint64_t sequence, std::uint64_t tag,
                        Payload& payload) {
        assert(t >= last_popped_);
        const std::uint32_t slot = take_slot();
        slots_[slot].tag = tag;
        slots_[slot].payload = std::move(payload);
        queue_.push({t, priority, sequence, slot});
        return slot;
    }

    std::uint32_t take_slot() {
        if (first_free_ == no_slot) [[unlikely]]
            add_slot();
        return std::exchange(first_free_, static_cast<std::uint32_t>(slots_[first_free_].tag));
    }

    // Out of line, as it is rare: schedule() takes fewer registers.
    [[gnu::noinline]] void add_slot() {
        if (slots_.size() == limits_.pending) throw_too_many_events("pending", limits_.pending);
        slots_.push_back({released | first_free_, Payload{}});
        first_free_ = static_cast<std::uint32_t>(slots_.size() - 1);
    }

    void release(std::uint32_t slot) {
        slots_[slot].tag = released | std::exchange(first_free_, slot);
    }

    bool is_live(Key key) const { return (slots_[key.slot()].tag & ~requeued) == key.sequence(); }

    // Keeps a live key on top, so that looking at it changes nothing.
    void drop_dead_tops() {
        for (; dead_ > 0 && !is_live(queue_.top()); --dead_) queue_.pop();
    }

    void purge() {
        queue_.filter([this](Key key) { return is_live(key); });
        dead_ = 0;
    }

    EventQueue queue_;
    std::vector<Slot> slots_;
    std::uint32_t first_free_ = no_slot;
    std::size_t dead_ = 0;  // cancelled keys that are still in the queue
    std::uint64_t scheduled_ = 0;
    Time last_popped_ = Time::min();
    SchedulerLimits limits_;
};

}  // namespace rovernet
