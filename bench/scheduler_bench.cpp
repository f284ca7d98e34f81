// SPDX-License-Identifier: MIT
// What an event costs: the hold model (serve the next event, schedule another an exponential time
// later) with 10^2 ... 10^6 events pending. Prints CPU time [ns] per event, the least of three
// repetitions, and ratios to a std::priority_queue whose entries own a std::function.
//
//   keys    EventHeap or EventQueue alone, 16 bytes a key
//   events  with a payload of 16 bytes, or a std::function that holds as much; not looked at
//   served  the same, and each event counts one up in the 64 bytes of its node
#include "bench/least.hpp"
#include "sim/events/scheduler.hpp"
#include "sim/random.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <queue>
#include <string>
#include <utility>
#include <vector>

using namespace rovernet;

namespace {

constexpr std::size_t sizes[] = {100, 1'000, 10'000, 100'000, 1'000'000};
constexpr int events = 1'000'000;  // timed, in each repetition

/// One delay after the other, mean 1 ms; from a table, so that drawing them costs next to nothing.
class Delays {
  public:
    Duration next() { return table()[drawn_++ % size]; }

  private:
    static constexpr std::size_t size = 1 << 16;
    static const std::vector<Duration>& table() {
        static const std::vector<Duration> all = [] {
            std::vector<Duration> delays;
            for (std::size_t i = 0; i < size; ++i) {
                delays.push_back(
                    from_seconds(1e-3 * exponential({.purpose = Purpose::order, .index = i})));
            }
            return delays;
        }();
        return all;
    }
    std::size_t drawn_ = 0;
};

struct alignas(64) Node {
    std::array<std::uint64_t, 8> state{};
};

// Every queue below has push(t, i), for an event of node i, and serve(), which removes the next
// event and returns its time.

template <class Queue>
class Keys {
  public:
    explicit Keys(std::size_t) {}
    void push(Time t, std::size_t i) {
        queue_.push({t, Priority::timer, pushed_++, static_cast<std::uint32_t>(i)});
    }
    Time serve() {
        const EventKey key = queue_.top();
        queue_.pop();
        return key.time();
    }

  private:
    Queue queue_;
    std::uint64_t pushed_ = 0;
};

template <bool touch>
class Ours {
  public:
    explicit Ours(std::size_t n) : nodes_(n) {}
    void push(Time t, std::size_t i) { queue_.schedule(t, Priority::timer, {i, 0}); }
    Time serve() {
        const auto event = queue_.pop();
        if constexpr (touch) ++nodes_[event.payload.node].state[0];
        return event.key.time();
    }

  private:
    struct Payload {
        std::size_t node = 0;
        std::uint64_t what = 0;
    };
    Scheduler<Payload> queue_;
    std::vector<Node> nodes_;
};

template <bool touch>
class Standard {
  public:
    explicit Standard(std::size_t n) : nodes_(n) {}
    void push(Time t, std::size_t i) {
        queue_.push({t, pushed_++, [this, i] { ++nodes_[i].state[0]; }});
    }
    Time serve() {
        const Event event = std::move(const_cast<Event&>(queue_.top()));
        queue_.pop();
        if constexpr (touch) event.call();
        return event.t;
    }

  private:
    struct Event {
        Time t;
        std::uint64_t sequence;
        std::function<void()> call;
        bool operator<(const Event& other) const {  // the queue serves the greatest
            return t != other.t ? t > other.t : sequence > other.sequence;
        }
    };
    std::priority_queue<Event> queue_;
    std::vector<Node> nodes_;
    std::uint64_t pushed_ = 0;
};

template <class Queue>
void hold(benchmark::State& state) {
    const auto n = static_cast<std::size_t>(state.range(0));
    Queue queue(n);
    Delays delays;
    std::uint64_t drawn = 0;
    const auto next = [&] {  // of a random node: Fibonacci hashing
        const std::uint64_t node = (++drawn * 0x9e3779b97f4a7c15 >> 32) * n >> 32;
        queue.push(queue.serve() + delays.next(), node);
    };
    for (std::size_t i = 0; i < n; ++i) queue.push(start_of_run + delays.next(), i);
    for (std::size_t i = 0; i < 2 * n; ++i) next();
    for (auto _ : state) next();
}

constexpr const char* std_events = "std events";
constexpr const char* std_served = "std served";
constexpr auto columns = {"heap keys", "queue keys", "events", "served", std_events, std_served};
constexpr auto ratios = {"heap keys", "queue keys", "events", "served"};

void print_times(const bench::Least& least) {
    fmt::print("CPU ns per event\n{:>9}", "pending");
    bench::print_heads(columns, 12);
    for (const std::size_t n : sizes) {
        fmt::print("\n{:>9}", n);
        for (const char* name : columns) fmt::print("{:>12.1f}", least.ns(name, n));
    }
}

void print_ratios(const bench::Least& least) {
    fmt::print("\n\ntimes faster than std::priority_queue of std::function\n{:>9}", "pending");
    bench::print_heads(ratios, 12);
    for (const std::size_t n : sizes) {
        fmt::print("\n{:>9}", n);
        for (const std::string name : ratios) {
            const char* base = name == "served" ? std_served : std_events;
            fmt::print("{:>12.2f}", least.times(base, name, n));
        }
    }
    fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
    bench::Least least;
    for (const std::size_t n : sizes) {  // what is compared runs one after the other
        least.add("heap keys", hold<Keys<EventHeap>>, n, events);
        least.add("queue keys", hold<Keys<EventQueue>>, n, events);
        least.add("events", hold<Ours<false>>, n, events);
        least.add("served", hold<Ours<true>>, n, events);
        least.add(std_events, hold<Standard<false>>, n, events);
        least.add(std_served, hold<Standard<true>>, n, events);
    }
    if (!least.run(argc, argv)) return 2;
    print_times(least);
    print_ratios(least);
}
