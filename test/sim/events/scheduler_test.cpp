// SPDX-License-Identifier: MIT
#include "sim/events/scheduler.hpp"

#include "sim/error.hpp"
#include "sim/random.hpp"
#include "test/counted_allocations.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <tuple>
#include <vector>

namespace scheduler_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

constexpr Time at(std::int64_t ns) { return Time{Duration{ns}}; }

/// A stream of small random numbers for one test.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : seed_(seed) {}
    std::size_t operator()(std::size_t n) {
        return below({.seed = seed_, .purpose = Purpose::order, .index = rolled_++}, n);
    }

  private:
    std::uint64_t seed_;
    std::uint64_t rolled_ = 0;
};

/// The queue and a sorted map, driven alike and compared at every step.
class Pair {
  public:
    void schedule(Time t, Priority priority) {
        const int id = static_cast<int>(handles_.size());
        handles_.push_back(queue_.schedule(t, priority, id));
        sorted_[{t, priority, static_cast<std::uint64_t>(id)}] = id;
        places_.push_back({t, priority, static_cast<std::uint64_t>(id)});
        requeued_.push_back(false);
    }

    void cancel(std::size_t id) {
        const bool pending = sorted_.contains(places_[id]);
        REQUIRE(queue_.cancel(handles_[id]) == (pending && !requeued_[id]));
        if (pending && !requeued_[id]) sorted_.erase(places_[id]);
    }

    /// Serves one event; puts it back `delay` later unless that is 0.
    void serve(Duration delay) {
        const auto first = sorted_.begin();
        REQUIRE(queue_.next_time() == std::get<Time>(first->first));
        REQUIRE(queue_.next() == first->second);
        const auto event = queue_.pop();
        REQUIRE(event.payload == first->second);
        REQUIRE(event.key.time() == std::get<Time>(first->first));
        REQUIRE(event.key.priority() == std::get<Priority>(first->first));
        sorted_.erase(first);
        now_ = event.key.time();
        if (delay == 0ns) return;
        const Place later{now_ + delay, event.key.priority(), event.key.sequence()};
        REQUIRE(queue_.runs_before_next(event.key.at(now_ + delay)) ==
                (sorted_.empty() || later < sorted_.begin()->first));
        queue_.requeue(event.key.at(now_ + delay), event.payload);
        sorted_[later] = event.payload;
        places_[static_cast<std::size_t>(event.payload)] = later;
        requeued_[static_cast<std::size_t>(event.payload)] = true;
    }

    void check_sizes() const {
        REQUIRE(queue_.size() == sorted_.size());
        REQUIRE(queue_.empty() == sorted_.empty());
        REQUIRE(queue_.scheduled() == handles_.size());
        REQUIRE(queue_.next_time().has_value() != sorted_.empty());
    }

    Time now() const { return now_; }
    std::size_t scheduled() const { return handles_.size(); }
    std::size_t pending() const { return sorted_.size(); }

  private:
    using Place = std::tuple<Time, Priority, std::uint64_t>;
    Scheduler<int> queue_;
    std::map<Place, int> sorted_;
    std::vector<EventHandle> handles_;
    std::vector<Place> places_;
    std::vector<bool> requeued_;
    Time now_ = start_of_run;
};

/// A random mix of everything; `spread` [ns] is the range of delays: few values, many ties.
void drive(std::uint64_t seed, std::size_t spread, std::size_t most_pending) {
    Dice dice(seed);
    Pair pair;
    bool filling = true;
    for (int step = 0; step < 30'000; ++step) {
        if (pair.pending() >= most_pending) filling = false;
        if (pair.pending() == 0) filling = true;
        const std::size_t what = dice(10);
        const auto delay = Duration{static_cast<std::int64_t>(dice(spread))};
        if (what < (filling ? 6U : 3U)) {
            pair.schedule(pair.now() + delay, static_cast<Priority>(dice(4)));
        } else if (what < 8 && pair.scheduled() > 0) {
            const std::size_t recent = std::min<std::size_t>(pair.scheduled(), 2 * most_pending);
            pair.cancel(pair.scheduled() - 1 - dice(recent));
        } else if (pair.pending() > 0) {
            pair.serve(dice(4) == 0 ? delay : 0ns);
        }
        pair.check_sizes();
    }
}

std::vector<int> served(Scheduler<int>& queue) {
    std::vector<int> order;
    while (!queue.empty()) order.push_back(queue.pop().payload);
    return order;
}

}  // namespace

TEST_CASE(
    "event key: the largest sequence number and memory slot fit into 16 bytes; at(t) gives the "
    "same key with the time t") {
    static_assert(sizeof(EventKey) == 16);
    constexpr std::uint64_t last_sequence = (std::uint64_t{1} << 36) - 1;
    constexpr std::uint32_t last_slot = (1U << 24) - 1;
    constexpr EventKey key(at(-5), Priority::user, last_sequence, last_slot);
    CHECK(key.time() == at(-5));
    CHECK(key.priority() == Priority::user);
    CHECK(key.sequence() == last_sequence);
    CHECK(key.slot() == last_slot);
    CHECK(key.at(at(7)) == EventKey(at(7), Priority::user, last_sequence, last_slot));
    CHECK(EventKey(never, Priority::user, last_sequence, last_slot) < EventKey{});
    CHECK(EventKey(at(-1), Priority::user, 9, 9) < EventKey(at(0), Priority::frame_end, 0, 0));
}

TEST_CASE(
    "scheduler: for any sequence of calls, events are served in the order of a sorted map, also at "
    "equal times") {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        drive(seed, 3, 10);
        drive(seed, 5, 300);
        drive(seed, 1'000'000, 3000);
    }
}

TEST_CASE("scheduler: events of equal time and priority are served in the order of scheduling") {
    Scheduler<int> queue;
    std::vector<int> expected;
    for (int i = 0; i < 1000; ++i) {
        queue.schedule(at(10), Priority::timer, i);
        expected.push_back(i);
    }
    CHECK(served(queue) == expected);
}

TEST_CASE(
    "scheduler: at equal times, ends of frames are served first, then timers, starts of frames and "
    "user events") {
    Scheduler<int> queue;
    queue.schedule(at(10), Priority::user, 4);
    queue.schedule(at(10), Priority::frame_start, 3);
    queue.schedule(at(10), Priority::timer, 2);
    queue.schedule(at(10), Priority::frame_end, 1);
    queue.schedule(at(9), Priority::user, 0);
    CHECK(served(queue) == std::vector{0, 1, 2, 3, 4});
}

TEST_CASE("scheduler: an event may be scheduled at the current time") {
    Scheduler<int> queue;
    queue.schedule(at(10), Priority::timer, 1);
    queue.schedule(at(10), Priority::user, 3);
    CHECK(queue.pop().payload == 1);
    queue.schedule(at(10), Priority::frame_end, 2);
    CHECK(served(queue) == std::vector{2, 3});
}

TEST_CASE("scheduler: an event can be cancelled only once, and only while it is pending") {
    Scheduler<int> queue;
    CHECK_FALSE(queue.cancel({}));
    const auto popped = queue.schedule(at(1), Priority::timer, 1);
    queue.pop();
    CHECK_FALSE(queue.cancel(popped));
    const auto cancelled = queue.schedule(at(2), Priority::timer, 2);
    CHECK(queue.cancel(cancelled));
    CHECK_FALSE(queue.cancel(cancelled));
    CHECK_FALSE(queue.next_time().has_value());
    const auto reuser = queue.schedule(at(3), Priority::timer, 3);
    CHECK(reuser.slot == cancelled.slot);
    CHECK_FALSE(queue.cancel(cancelled));
    CHECK_FALSE(queue.cancel({}));
    CHECK(served(queue) == std::vector{3});
}

TEST_CASE("scheduler: after an event was queued again, its old handle cannot cancel this event") {
    Scheduler<int> queue;
    const auto handle = queue.schedule(at(1), Priority::timer, 1);
    const auto event = queue.pop();
    queue.requeue(event.key.at(at(5)), event.payload);
    CHECK_FALSE(queue.cancel(handle));
    CHECK(queue.scheduled() == 1);
    CHECK(queue.next_time() == at(5));
    CHECK(queue.pop().payload == 1);
}

TEST_CASE(
    "scheduler: an event that is queued again keeps its position among events of equal time") {
    Scheduler<int> queue;
    queue.schedule(at(1), Priority::timer, 1);
    queue.schedule(at(5), Priority::timer, 2);
    const auto event = queue.pop();
    CHECK(queue.runs_before_next(event.key.at(at(5))));
    CHECK_FALSE(queue.runs_before_next(event.key.at(at(6))));
    queue.requeue(event.key.at(at(5)), event.payload);
    CHECK(served(queue) == std::vector{1, 2});
    CHECK(queue.runs_before_next(event.key.at(never)));
}

TEST_CASE(
    "scheduler: the memory of an event's payload is released when the event is served or "
    "cancelled") {
    const auto shared = std::make_shared<int>(1);
    Scheduler<std::shared_ptr<int>> queue;
    const auto handle = queue.schedule(at(1), Priority::timer, shared);
    queue.schedule(at(2), Priority::timer, shared);
    CHECK(queue.cancel(handle));
    CHECK(shared.use_count() == 2);
    queue.pop();
    CHECK(shared.use_count() == 1);

    Scheduler<std::unique_ptr<int>> movable_only;
    movable_only.schedule(at(1), Priority::timer, std::make_unique<int>(7));
    CHECK(*movable_only.pop().payload == 7);
}

TEST_CASE(
    "scheduler: too many events give an error that ends the run, and the queue stays intact") {
    Scheduler<int> narrow({.pending = 2});
    const auto first = narrow.schedule(at(1), Priority::timer, 1);
    narrow.schedule(at(2), Priority::timer, 2);
    CHECK_THROWS_WITH_AS(
        narrow.schedule(at(3), Priority::timer, 3),
        "more than 2 events are pending; the run requests too many events at once, "
        "or schedules events without end",
        RunError);
    CHECK(narrow.cancel(first));
    narrow.schedule(at(3), Priority::timer, 3);
    CHECK(served(narrow) == std::vector{2, 3});

    Scheduler<int> brief({.scheduled = 1});
    brief.schedule(at(1), Priority::timer, 1);
    CHECK_THROWS_WITH_AS(brief.schedule(at(2), Priority::timer, 2),
                         doctest::Contains("more than 1 events are scheduled"), RunError);
    CHECK(served(brief) == std::vector{1});
}

TEST_CASE("scheduler: in steady state no memory is allocated, however many events are cancelled") {
    Scheduler<std::array<int, 12>> queue;
    Dice dice(1);
    const auto soon = [&] { return Duration{static_cast<std::int64_t>(dice(1000))}; };
    Time now = start_of_run;
    std::vector<EventHandle> timers(100);
    const auto churn = [&](int events) {
        for (int i = 0; i < events; ++i) {
            auto& timer = timers[dice(timers.size())];
            queue.cancel(timer);
            timer = queue.schedule(now + soon(), Priority::timer, {});
            queue.cancel(timer);
            timer = queue.schedule(now + 1s + soon(), Priority::timer, {});
            const auto event = queue.pop();
            now = event.key.time();
            queue.requeue(event.key.at(now + soon()), event.payload);
            queue.schedule(now + 1us + soon() / 100, Priority::frame_end, {});
            while (queue.size() > 300) now = queue.pop().key.time();
        }
    };
    churn(100'000);
    const std::size_t before = test::allocations();
    churn(100'000);
    CHECK(test::allocations() == before);
}

TEST_CASE("scheduler: in steady state no memory is allocated, however many events are served") {
    Scheduler<int> queue;
    Dice dice(2);
    const auto serve = [&](int events) {
        for (int i = 0; i < events; ++i) {
            const auto event = queue.pop();
            if (event.key.priority() == Priority::frame_end) continue;
            const Duration delay{static_cast<std::int64_t>(dice(1'000'000))};
            queue.schedule(event.key.time() + delay, Priority::timer, 0);
            queue.schedule(event.key.time() + 50us, Priority::frame_end, 0);
        }
    };
    for (int i = 0; i < 1'000; ++i) queue.schedule(at(i), Priority::timer, 0);
    serve(100'000);
    const std::size_t before = test::allocations();
    serve(1'000'000);
    CHECK(test::allocations() == before);
}

TEST_CASE(
    "scheduler: postponing a distant timer again and again does not take more and more memory") {
    Scheduler<int> queue;
    queue.schedule(at(0), Priority::user, 0);  // stays on top, so that no dead key comes up
    auto timer = queue.schedule(start_of_run + 1h, Priority::timer, 1);
    const auto put_off = [&](int times) {
        for (int i = 0; i < times; ++i) {
            queue.cancel(timer);
            timer = queue.schedule(start_of_run + 1h, Priority::timer, 1);
        }
    };
    put_off(10);
    const std::size_t before = test::allocations();
    put_off(100'000);
    CHECK(test::allocations() == before);
    CHECK(served(queue) == std::vector{0, 1});
}

namespace {

/// A toy radio: each frame reaches its receivers within 1 us; some answer 1 us or more later. The
/// order of all receptions is logged, with one event for each, or with one for each frame.
class ToyRadio {
  public:
    explicit ToyRadio(bool one_event_per_frame) : one_event_per_frame_(one_event_per_frame) {}

    std::vector<std::tuple<Time, std::uint64_t, std::size_t>> run() {
        for (std::uint64_t i = 0; i < 20; ++i) {
            queue_.schedule(at(static_cast<std::int64_t>(i) % 3), Priority::frame_start, {});
        }
        while (!queue_.empty() && frames_ < 3000) {
            auto event = queue_.pop();
            if (event.key.priority() == Priority::frame_start) {
                start(event.key.time());
            } else {
                serve(event.key, event.payload);
            }
        }
        return log_;
    }

  private:
    struct Batch {
        std::uint64_t frame = 0;
        std::size_t first = 0;  // the next of its receptions, in the order of arrival
        std::size_t last = 0;
    };
    static constexpr std::size_t receivers = 8;

    std::uint64_t draw(std::uint64_t frame, std::size_t receiver, std::uint64_t n) const {
        return below({.purpose = Purpose::order, .a = frame, .b = receiver}, n);
    }

    Time arrival(const Batch& batch, std::size_t i) const {
        return arrivals_[batch.frame * receivers + i];
    }

    void start(Time now) {
        const std::uint64_t frame = frames_++;
        std::array<Time, receivers> all;
        for (std::size_t i = 0; i < receivers; ++i) {
            all[i] = now + Duration{static_cast<std::int64_t>(500 + draw(frame, i, 40) * 10)};
        }
        std::sort(all.begin(), all.end());
        arrivals_.insert(arrivals_.end(), all.begin(), all.end());
        const std::size_t events = one_event_per_frame_ ? 1 : receivers;
        for (std::size_t i = 0; i < events; ++i) {
            queue_.schedule(all[i], Priority::frame_end, {frame, i, receivers / events + i});
        }
    }

    void serve(EventKey key, Batch batch) {
        do {
            receive(batch);
            ++batch.first;
        } while (batch.first < batch.last &&
                 queue_.runs_before_next(key.at(arrival(batch, batch.first))));
        if (batch.first < batch.last) {
            queue_.requeue(key.at(arrival(batch, batch.first)), batch);
        }
    }

    void receive(const Batch& batch) {
        const Time now = arrival(batch, batch.first);
        log_.emplace_back(now, batch.frame, batch.first);
        if (draw(batch.frame, 100 + batch.first, 5) != 0) return;
        const auto wait = 1000 + 10 * draw(batch.frame, 200 + batch.first, 30);
        queue_.schedule(now + Duration{static_cast<std::int64_t>(wait)}, Priority::frame_start, {});
    }

    bool one_event_per_frame_;
    Scheduler<Batch> queue_;
    std::uint64_t frames_ = 0;
    std::vector<Time> arrivals_;
    std::vector<std::tuple<Time, std::uint64_t, std::size_t>> log_;
};

}  // namespace

TEST_CASE(
    "scheduler: the order of receptions is the same with one event per frame or per reception") {
    const auto one_each = ToyRadio(false).run();
    const auto one_per_frame = ToyRadio(true).run();
    CHECK(one_each.size() > 10'000);
    CHECK(one_per_frame == one_each);
}

}  // namespace scheduler_test
