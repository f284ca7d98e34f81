// SPDX-License-Identifier: MIT
#include "sim/events/event_queue.hpp"

#include "sim/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <set>
#include <vector>

namespace event_queue_test {
using namespace rovernet;

namespace {

constexpr std::int64_t latest = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t earliest = std::numeric_limits<std::int64_t>::min();

/// A stream of random numbers for one test.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : seed_(seed) {}
    /// Uniform in 0 ... n-1.
    std::int64_t operator()(std::int64_t n) {
        return static_cast<std::int64_t>(below(next(), static_cast<std::uint64_t>(n)));
    }
    /// Exponential, with a mean of some ns.
    std::int64_t about(double mean) {
        return static_cast<std::int64_t>(mean * exponential(next()));
    }

  private:
    Key next() { return {.seed = seed_, .purpose = Purpose::order, .index = rolled_++}; }
    std::uint64_t seed_;
    std::uint64_t rolled_ = 0;
};

/// t + delay [ns], or the last of times if that is beyond.
std::int64_t later(std::int64_t t, std::int64_t delay) {
    return t > latest - delay ? latest : t + delay;
}

/// When an event is scheduled at `now`, the next one being due at `next` [ns].
using Distribution = std::function<std::int64_t(Dice&, std::int64_t now, std::int64_t next)>;

struct Named {
    const char* name;
    std::int64_t begin;  // the first `now` [ns]
    Distribution time;
};

std::int64_t between(Dice& dice, std::int64_t now, std::int64_t next) {
    return next > now ? now + dice(std::min(next - now, std::int64_t{1} << 40)) : now;
}

const std::vector<Named>& distributions() {
    static const std::vector<Named> all{
        {"exponential", 0, [](Dice& d, auto now, auto) { return later(now, d.about(1e6)); }},
        {"bimodal", 0,
         [](Dice& d, auto now, auto) { return later(now, d.about(d(2) == 0 ? 1e3 : 1e9)); }},
        {"90 % near, 10 % far", 0,
         [](Dice& d, auto now, auto) {
             return later(now, d(10) > 0 ? d.about(1e4) : 1'000'000'000 + d.about(1e9));
         }},
        {"all at one time", 7, [](Dice&, auto now, auto) { return now; }},
        {"few times", 0, [](Dice& d, auto now, auto) { return later(now, 1'000'000 * d(3)); }},
        {"the end of time", latest - 5'000'000,
         [](Dice& d, auto now, auto) { return later(now, d.about(1e6)); }},
        {"never, or soon", 0,
         [](Dice& d, auto now, auto) { return d(2) == 0 ? latest : later(now, d.about(1e6)); }},
        {"from negative times to positive ones", -3'000'000,
         [](Dice& d, auto now, auto) { return later(now, d.about(1e6)); }},
        {"the beginning of time", earliest,
         [](Dice& d, auto now, auto) { return later(now, d(1'000)); }},
        {"any time there is", earliest,
         [](Dice& d, auto now, auto) { return std::max(now, (d(latest) - (latest / 2)) * 2); }},
        {"before the next", 0,
         [](Dice& d, auto now, auto next) {
             return d(3) > 0 ? between(d, now, next) : later(now, d.about(1e9));
         }},
        {"each later than all before", 0,
         [step = std::int64_t{0}](Dice& d, auto now, auto) mutable {
             return later(now, step += d(10));
         }},
        {"each sooner than all before", 0,
         [step = std::int64_t{1} << 40](Dice& d, auto now, auto) mutable {
             return later(now, step = std::max(std::int64_t{0}, step - d(1'000'000)));
         }},
    };
    return all;
}

/// The queue, the heap and a sorted set, driven alike and compared at every step.
class Trio {
  public:
    Trio(Named distribution, std::uint64_t seed)
        : distribution_(std::move(distribution)), dice_(seed), now_(distribution_.begin) {}

    void push() {
        const std::int64_t next = sorted_.empty() ? latest : ns(*sorted_.begin());
        const std::int64_t t = distribution_.time(dice_, now_, next);
        put({Time{Duration{t}}, static_cast<Priority>(dice_(4)), sequence_, slot()});
        ++sequence_;
    }

    void pop() {
        const EventKey key = *sorted_.begin();
        REQUIRE(queue_.top() == key);
        REQUIRE(heap_.top() == key);
        queue_.pop();
        heap_.pop();
        sorted_.erase(sorted_.begin());
        now_ = ns(key);
        if (dice_(8) == 0) put(key.at(Time{Duration{later(now_, 1 + dice_(1'000))}}));
        check();
    }

    /// Keeps one key in `n`, or all but one in `n`.
    void filter(std::uint64_t n, bool few) {
        const auto keep = [=](EventKey key) { return (key.sequence() % n == 0) == few; };
        queue_.filter(keep);
        heap_.filter(keep);
        std::erase_if(sorted_, [&](EventKey key) { return !keep(key); });
        check();
    }

    /// Fills it up to `most` keys and serves it down to none, mixed, `rounds` times.
    void drive(std::size_t most, int rounds) {
        for (int round = 0; round < rounds; ++round) {
            while (size() < most) step(7);
            filter(3, round % 2 == 0);
            for (std::size_t i = 0; i < most; ++i) step(5);
            while (size() > most / 10) step(3);
            filter(2, true);
            while (size() > 0) pop();
        }
    }

    std::size_t size() const { return sorted_.size(); }

  private:
    static std::int64_t ns(EventKey key) { return key.time().time_since_epoch().count(); }
    std::uint32_t slot() { return static_cast<std::uint32_t>(dice_(1 << 24)); }

    void step(std::int64_t pushes_of_ten) {
        if (size() == 0 || dice_(10) < pushes_of_ten) {
            push();
        } else {
            pop();
        }
    }

    void put(EventKey key) {
        queue_.push(key);
        heap_.push(key);
        sorted_.insert(key);
        check();
    }

    void check() const {
        REQUIRE(queue_.size() == sorted_.size());
        REQUIRE(queue_.empty() == sorted_.empty());
        REQUIRE(queue_.top() == (sorted_.empty() ? EventKey{} : *sorted_.begin()));
    }

    Named distribution_;
    Dice dice_;
    std::int64_t now_;
    std::uint64_t sequence_ = 0;
    EventQueue queue_;
    EventHeap heap_;
    std::set<EventKey> sorted_;
};

EventKey key_at(std::int64_t ns, std::uint64_t sequence, Priority priority = Priority::timer) {
    return {Time{Duration{ns}}, priority, sequence, 0};
}

/// Pops all, and says whether that was in order and complete.
bool serves(EventQueue& queue, std::vector<EventKey> keys) {
    std::sort(keys.begin(), keys.end());
    for (const EventKey key : keys) {
        if (!(queue.top() == key)) return false;
        queue.pop();
    }
    return queue.empty() && queue.top() == EventKey{};
}

}  // namespace

TEST_CASE(
    "event queue: events are served in the same order as by a heap and a sorted set, for any "
    "times") {
    for (const Named& distribution : distributions()) {
        CAPTURE(distribution.name);
        Trio(distribution, 1).drive(30, 20);
        Trio(distribution, 2).drive(1500, 3);
        Trio(distribution, 3).drive(8000, 2);
    }
}

TEST_CASE(
    "event queue: 200 000 events of equal time are served by priority, then by insertion order") {
    EventQueue queue;
    std::vector<EventKey> keys;
    for (std::uint64_t i = 0; i < 200'000; ++i) {
        keys.push_back(key_at(5, i, static_cast<Priority>(3 - i % 4)));
        queue.push(keys.back());
    }
    CHECK(serves(queue, keys));
}

TEST_CASE(
    "event queue: if events are added without end at the current time, they are served in order") {
    EventQueue queue;
    std::uint64_t pushed = 0;
    for (; pushed < 5000; ++pushed) queue.push(key_at(5, pushed));
    for (std::uint64_t popped = 0; popped < 100'000; ++popped) {
        REQUIRE(queue.top() == key_at(5, popped));
        queue.pop();
        queue.push(key_at(5, pushed++));
    }
    CHECK(queue.size() == 5000);
}

TEST_CASE("event queue: after top() returned the next event, many earlier events may be added") {
    constexpr std::int64_t far = 1'000'000'000'000;
    Dice dice(1);
    EventQueue queue;
    std::vector<EventKey> keys;
    const auto push = [&](std::int64_t t) {
        keys.push_back(key_at(t, keys.size()));
        queue.push(keys.back());
    };
    for (int i = 0; i < 20'000; ++i) push(far + dice(far));
    for (std::int64_t end = far; end > 1'000; end /= 10) {  // each time 2000 before all others
        CHECK(queue.top() == *std::min_element(keys.begin(), keys.end()));
        for (int i = 0; i < 2'000; ++i) push(end - 1 - dice(end / 2));
    }
    for (std::int64_t i = 50'000; i > 0; --i) push(-i);
    for (std::int64_t i = 100'000; i < 150'000; ++i) push(-i);
    CHECK(serves(queue, keys));
}

TEST_CASE("event queue: events added before and after a single early event are served in order") {
    constexpr std::int64_t lone = std::int64_t{1} << 40;
    constexpr std::int64_t crowd = lone + (1 << 20);
    EventQueue queue;
    std::vector<EventKey> keys{key_at(lone, 0)};
    for (std::uint64_t i = 1; i <= 3'000; ++i) keys.push_back(key_at(crowd + std::int64_t(i), i));
    queue.push(key_at(0, 9'000));
    for (const EventKey key : keys) queue.push(key);
    queue.pop();
    CHECK(queue.top() == keys.front());
    for (const std::int64_t t : {lone - 5, lone + 5, crowd, lone - 9, crowd + 9'999}) {
        keys.push_back(key_at(t, keys.size()));
        queue.push(keys.back());
        CHECK(queue.top() == *std::min_element(keys.begin(), keys.end()));
    }
    CHECK(serves(queue, keys));
}

TEST_CASE(
    "event queue: a filter may remove all events, all but the latest, or all but the earliest") {
    const auto filled = [] {
        EventQueue queue;
        for (std::uint64_t i = 0; i < 10'000; ++i) queue.push(key_at(std::int64_t(i) * 1000, i));
        queue.pop();
        return queue;
    };
    EventQueue none = filled();
    none.filter([](EventKey) { return false; });
    CHECK(none.empty());
    CHECK(none.size() == 0);
    none.push(key_at(3, 1));
    none.push(key_at(2, 2));
    CHECK(serves(none, {key_at(2, 2), key_at(3, 1)}));

    EventQueue far = filled();
    far.filter([](EventKey key) { return key.sequence() >= 9'998; });
    CHECK(serves(far, {key_at(9'998'000, 9'998), key_at(9'999'000, 9'999)}));

    EventQueue near = filled();
    near.filter([](EventKey key) { return key.sequence() <= 2; });
    near.push(key_at(9'000'000, 20'000));
    CHECK(serves(near, {key_at(1000, 1), key_at(2000, 2), key_at(9'000'000, 20'000)}));
}

TEST_CASE("event queue: a copy of a queue is independent of the original") {
    EventQueue queue;
    std::vector<EventKey> keys;
    for (std::uint64_t i = 0; i < 5'000; ++i) {
        keys.push_back(key_at(std::int64_t(i * 7919 % 5'000), i));
        queue.push(keys.back());
    }
    EventQueue copy = queue;
    CHECK(serves(queue, keys));
    CHECK(serves(copy, keys));
}

TEST_CASE(
    "event line: events in nearly ascending order are served in order; other events are refused") {
    Dice dice(9);
    EventLine line;
    std::set<EventKey> taken;
    std::uint64_t sequence = 0, refused = 0, before_the_last = 0;
    EventKey last = key_at(-1, 0);  // popped
    for (int step = 0; step < 50'000; ++step) {
        REQUIRE(line.empty() == taken.empty());
        REQUIRE(line.size() == taken.size());
        REQUIRE(line.front() == (taken.empty() ? EventKey{} : *taken.begin()));
        if (!taken.empty() && dice(100) < (step / 500 % 2 == 0 ? 40 : 55)) {
            last = *taken.begin();
            taken.erase(taken.begin());
            line.pop_if(false);
            line.pop_if(true);
            continue;
        }
        const EventKey key = key_at(step + dice(step % 7 == 0 ? 200 : 10), sequence++);
        const auto later = std::distance(taken.upper_bound(key), taken.end());
        const bool took = line.push(key);
        REQUIRE(took == (later <= 8));
        refused += !took;
        before_the_last += took && key < last;
        if (took) taken.insert(key);
        if (dice(5000) == 0) {
            const auto keep = [](EventKey k) { return k.sequence() % 3 != 0; };
            line.filter(keep);
            std::erase_if(taken, [&](EventKey k) { return !keep(k); });
        }
    }
    CHECK(refused > 100);
    CHECK(before_the_last > 100);
}

TEST_CASE("event line: events that are appended in unsorted groups are served in order") {
    Dice dice(10);
    EventLine line;
    std::uint64_t sequence = 0;
    for (const int bits : {0, 1, 3, 8, 25, 26, 27, 40, 60}) {
        for (int round = 0; round < 300; ++round) {
            std::set<EventKey> expected;
            for (std::int64_t first = -(std::int64_t{1} << bits), group = 0; group < 3; ++group) {
                const auto room =
                    static_cast<std::int64_t>(EventLine::most_at_once - expected.size());
                std::vector<EventKey> keys;
                for (auto n = dice(room + 1); n > 0; --n) {
                    const auto priority = static_cast<Priority>(dice(4));
                    keys.push_back(
                        key_at(first + dice(std::int64_t{1} << bits), sequence++, priority));
                }
                if (dice(2) == 0) std::reverse(keys.begin(), keys.end());
                line.append(keys, Time{Duration{first}}, bits);
                expected.insert(keys.begin(), keys.end());
                first += std::int64_t{1} << bits;
            }
            if (round % 4 == 0) {
                const auto keep = [](EventKey key) { return key.sequence() % 3 != 0; };
                line.filter(keep);
                std::erase_if(expected, [&](EventKey key) { return !keep(key); });
            }
            for (; !expected.empty(); expected.erase(expected.begin())) {
                REQUIRE(line.size() == expected.size());
                REQUIRE(line.front() == *expected.begin());
                line.pop_if(false);
                line.pop_if(true);
            }
            REQUIRE(line.empty());
            REQUIRE(line.front() == EventKey{});
        }
    }
}

}  // namespace event_queue_test
