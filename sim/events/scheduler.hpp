// SPDX-License-Identifier: MIT
#pragma once

#include "sim/events/event_queue.hpp"
#include "sim/time.hpp"

#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace rovernet {

/// Handle of an event, for Scheduler::cancel; a default handle belongs to no event. A handle may
/// outlive its event: sequences are not reused.
struct EventHandle {
    std::uint32_t slot = 0;
    std::uint64_t sequence = ~std::uint64_t{0};
};

/// Limits beyond which a Scheduler throws; the defaults are the largest that a key can store.
struct SchedulerLimits {
    /// Largest number of events queued at the same time.
    std::uint64_t pending = std::uint64_t{1} << 24;
    /// Largest number of calls of schedule() in one run.
    std::uint64_t scheduled = std::uint64_t{1} << 36;
};

/// Throws the error for a limit that was reached.
/// @param state  "pending" or "scheduled"
/// @throws RunError "more than {limit} events are {state}; ..."
[[noreturn]] void throw_too_many_events(const char* state, std::uint64_t limit);

/// Future events, served in the order of EventKey: by time, priority, then first scheduled, first
/// served. Engine::advance is the event loop: pop(), set the clock, handle the payload.
///
/// The queue stores only keys; payloads are in slots that are reused. Memory follows the largest
/// number of pending keys. A cancelled key stays in the queue until it is the first, or until half
/// of all keys are cancelled; then all cancelled keys are removed.
///
/// Typical use, with `handle` stored for an event that may be cancelled:
///
///   const auto handle = events.schedule(now + 5ms, Priority::timer, payload);
///   events.cancel(handle);
///   while (!events.empty()) {
///       const auto event = events.pop();
///       now = event.key.time();
///       serve(event.payload);
///   }
///
/// @tparam Payload  data of an event: movable and default-constructible, preferably small
template <class Payload>
class Scheduler {
  public:
    using Key = EventKey;
    using Handle = EventHandle;
    /// Event removed from the queue: its key and its payload.
    struct Event {
        Key key;
        Payload payload;
    };

    /// @param limits  not above the default limits
    explicit Scheduler(SchedulerLimits limits = {}) : limits_(limits) {
        static_assert(std::movable<Payload> && std::default_initializable<Payload>);
        assert(limits.pending <= SchedulerLimits{}.pending);
        assert(limits.scheduled <= SchedulerLimits{}.scheduled);
    }

    /// Queues an event; `t` must not be before the last popped event.
    /// @throws RunError when more events are pending or scheduled than the limits allow
    Handle schedule(Time t, Priority priority, Payload payload) {
        if (scheduled_ == limits_.scheduled) throw_too_many_events("scheduled", limits_.scheduled);
        const std::uint32_t slot = queue(t, priority, scheduled_, scheduled_, payload);
        return {slot, scheduled_++};
    }

    /// Queues the rest of a popped event under its key, perhaps moved to a later time by Key::at.
    /// The event keeps its position among events of equal time and priority, is not counted as
    /// scheduled, and cannot be cancelled. Allowed at most once per pop. Channel uses it for a
    /// transmission whose receptions lie before and after other events.
    /// @throws RunError as schedule()
    void requeue(Key key, Payload payload) {
        assert(key.sequence() < scheduled_);
        queue(key.time(), key.priority(), key.sequence(), key.sequence() | requeued, payload);
    }

    /// Removes an event and its payload from the queue. @return false if it was already popped,
    /// cancelled or requeued
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

    /// Removes the next event and returns this event; an event must be queued.
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

    /// Key of the next event; the default key, later than every event, if there is none.
    Key next_key() const { return queue_.top(); }
    /// Time of the next event; empty if there is none.
    std::optional<Time> next_time() const {
        return empty() ? std::nullopt : std::optional(queue_.top().time());
    }
    /// Payload of the next event; an event must be queued.
    const Payload& next() const { return slots_[queue_.top().slot()].payload; }
    /// Whether an event with this key would be served before all queued events.
    bool runs_before_next(Key key) const { return key < queue_.top(); }

    /// Whether no event is queued.
    bool empty() const { return queue_.empty(); }
    /// Number of queued events, without cancelled ones.
    std::size_t size() const { return queue_.size() - dead_; }
    /// Number of calls of schedule() so far.
    std::uint64_t scheduled() const { return scheduled_; }

  private:
    // Tags of slots. Slot in use: the sequence of its event, perhaps with `requeued`. Free slot:
    // `released` | the next free slot.
    static constexpr std::uint64_t released = std::uint64_t{1} << 63;
    static constexpr std::uint64_t requeued = std::uint64_t{1} << 62;
    static constexpr std::uint32_t no_slot = 0xffffffff;
    struct Slot {
        std::uint64_t tag;
        Payload payload;
    };

    // Puts an event's key into the queue, and its tag and payload into a slot. @return the slot
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

    // Adds a slot. Not inlined, because it is rare: schedule() then needs fewer registers.
    [[gnu::noinline]] void add_slot() {
        if (slots_.size() == limits_.pending) throw_too_many_events("pending", limits_.pending);
        slots_.push_back({released | first_free_, Payload{}});
        first_free_ = static_cast<std::uint32_t>(slots_.size() - 1);
    }

    // Frees a slot, which is then the first to be reused.
    void release(std::uint32_t slot) {
        slots_[slot].tag = released | std::exchange(first_free_, slot);
    }

    // Whether a key's event is not cancelled: its slot still has its sequence.
    bool is_live(Key key) const { return (slots_[key.slot()].tag & ~requeued) == key.sequence(); }

    // Removes cancelled keys from the top, so that reading the next event changes nothing.
    void drop_dead_tops() {
        for (; dead_ > 0 && !is_live(queue_.top()); --dead_) queue_.pop();
    }

    // Removes all cancelled keys.
    void purge() {
        queue_.filter([this](Key key) { return is_live(key); });
        dead_ = 0;
    }

    EventQueue queue_;
    std::vector<Slot> slots_;
    // First free slot; free slots are chained by their tags.
    std::uint32_t first_free_ = no_slot;
    // Number of cancelled keys still in the queue.
    std::size_t dead_ = 0;
    std::uint64_t scheduled_ = 0;
    // Time of the last popped event; no event is scheduled before it.
    Time last_popped_ = Time::min();
    SchedulerLimits limits_;
};

}  // namespace rovernet
