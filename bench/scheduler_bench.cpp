// SPDX-License-Identifier: MIT
// What an event costs: the hold model (serve the next event, schedule another an exponential time
// later) with 10^2 ... 10^6 events pending. Prints CPU time [ns] per event, the least of three
// repetitions, and ratios to a std::priority_queue whose entries own a std::function.
//
//   keys    EventHeap or EventQueue alone, 16 bytes a key
//   events  with a payload of 16 bytes, or a std::function that holds as much; not looked at
//   served  the same, and each event counts one up in the 64 bytes of its node
#include "sim/random.hpp"
#include "sim/scheduler.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <queue>
#include <string>
#include <vector>

using namespace rovernet;

namespace {

constexpr std::size_t sizes[] = {100, 1'000, 10'000, 100'000, 1'000'000};
constexpr int events = 1'000'000;  // timed, in each repetition
constexpr int repetitions = 3;

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
constexpr const char* columns[] = {"heap keys", "queue keys", "events",
                                   "served",    std_events,   std_served};

template <class Queue>
void add(const char* name, std::size_t n) {
    benchmark::RegisterBenchmark(name, hold<Queue>)
        ->Arg(static_cast<std::int64_t>(n))
        ->Iterations(events)
        ->Repetitions(repetitions)
        ->Unit(benchmark::kNanosecond);
}

/// Keeps the least CPU time of each benchmark and size.
class Least : public benchmark::BenchmarkReporter {
  public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration) continue;
            const auto least =
                ns_.try_emplace({run.run_name.function_name, run.run_name.args}, 1e300);
            least.first->second = std::min(least.first->second, run.GetAdjustedCPUTime());
        }
    }
    /// [ns]; 0 if it was not run.
    double ns(const std::string& name, std::size_t n) const {
        const auto found = ns_.find({name, std::to_string(n)});
        return found == ns_.end() ? 0 : found->second;
    }

  private:
    std::map<std::pair<std::string, std::string>, double> ns_;
};

void print_times(const Least& least) {
    fmt::print("CPU ns per event\n{:>9}", "pending");
    for (const char* name : columns) fmt::print("{:>12}", name);
    for (const std::size_t n : sizes) {
        fmt::print("\n{:>9}", n);
        for (const char* name : columns) fmt::print("{:>12.1f}", least.ns(name, n));
    }
}

void print_ratios(const Least& least) {
    fmt::print("\n\ntimes faster than std::priority_queue of std::function\n{:>9}", "pending");
    for (const char* name : {"heap keys", "queue keys", "events", "served"}) {
        fmt::print("{:>12}", name);
    }
    for (const std::size_t n : sizes) {
        const double events_ns = least.ns(std_events, n);
        fmt::print("\n{:>9}{:>12.2f}{:>12.2f}{:>12.2f}{:>12.2f}", n,
                   events_ns / least.ns("heap keys", n), events_ns / least.ns("queue keys", n),
                   events_ns / least.ns("events", n),
                   least.ns(std_served, n) / least.ns("served", n));
    }
    fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
    for (const std::size_t n : sizes) {  // what is compared runs one after the other
        add<Keys<EventHeap>>("heap keys", n);
        add<Keys<EventQueue>>("queue keys", n);
        add<Ours<false>>("events", n);
        add<Ours<true>>("served", n);
        add<Standard<false>>(std_events, n);
        add<Standard<true>>(std_served, n);
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    Least least;
    benchmark::RunSpecifiedBenchmarks(&least);
    print_times(least);
    print_ratios(least);
}
