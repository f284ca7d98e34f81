// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"

#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

// The port of those who observe a run: traces, metrics, fingerprints, pictures. A sink is a plain
// struct that satisfies RecordSink; the handle Sink shares it. examples/own_sink.cpp has one.
//
//     struct Losses {
//         std::uint64_t count = 0;
//         KindMask kinds() const { return kind_of<Dropped>(); }
//         void on(const Record&, const RecordContext&) { ++count; }
//     };
//     const auto losses = std::make_shared<Losses>();
//     network.add_sink(Sink{losses});

namespace rovernet {

/// Facts about a run that a sink may want before its first record: for the head of a file, say.
struct RunInfo {
    /// Scenario as TOML, every default filled in. The function may be empty: a network that was
    /// made in code.
    std::function<std::string()> scenario;
    /// Number of robots so far; more may be added.
    std::size_t robots;
    /// Name of a robot, good until the next one is added. @throws std::out_of_range
    std::function<std::string_view(NodeId)> name;
    /// Seed of the random draws.
    std::uint64_t seed;
    /// Number of the independent repetition.
    std::uint32_t replication;
};

/// Observer of records. kinds() says once, when it is added, which kinds it wants; on() then gets
/// each of them, in the order of the run. What it may look up meanwhile is in the context.
///
/// A sink only watches: it must not change the network, nor add or remove sinks. Metrics,
/// Fingerprint, Ns2Trace, Timeline and Trails are sinks.
template <class T>
concept RecordSink = requires(T sink, const Record& record, const RecordContext& context) {
    { std::as_const(sink).kinds() } -> std::convertible_to<KindMask>;
    {sink.on(record, context)};
};
/// Sink that is told when the run begins, before the first record; or when it is added, if that is
/// later.
template <class T>
concept BeginsWithRun = requires(T sink, const RunInfo& run) {
    {sink.begin(run)};
};
/// Sink that is told when the run is over, after the last record: Network::finish() says so. Files
/// get their names then, sums are closed.
template <class T>
concept FinishesWithRun = requires(T sink) {
    {sink.finish()};
};

/// Handle of any sink, shared: the caller may keep a pointer to the sink and ask it for its result
/// after the run. Copies of a handle are one sink.
class Sink {
  public:
    /// @param sink  not null; it is asked for its kinds now
    template <RecordSink T>
    Sink(std::shared_ptr<T> sink)
        : kinds_(sink->kinds()),
          on_([](void* p, const Record& r, const RecordContext& c) {
              static_cast<T*>(p)->on(r, c);
          }),
          begin_([]([[maybe_unused]] void* p, [[maybe_unused]] const RunInfo& run) {
              if constexpr (BeginsWithRun<T>) static_cast<T*>(p)->begin(run);
          }),
          finish_([]([[maybe_unused]] void* p) {
              if constexpr (FinishesWithRun<T>) static_cast<T*>(p)->finish();
          }),
          self_(std::move(sink)) {}
    /// Moves the sink into the handle, for sinks that nobody asks for a result. Its type needs no
    /// base class and no registration:
    ///
    ///   network.add_sink(Sink{Losses{}});
    template <RecordSink T>
    Sink(T sink) : Sink(std::make_shared<T>(std::move(sink))) {}

    /// Kinds of records that it wants.
    KindMask kinds() const { return kinds_; }
    /// Calls of the sink; begin() and finish() do nothing if it has none.
    void begin(const RunInfo& run) const { begin_(self_.get(), run); }
    void on(const Record& record, const RecordContext& context) const {
        on_(self_.get(), record, context);
    }
    /// Tells the sink that the run is over.
    void finish() const { finish_(self_.get()); }

  private:
    // Functions of the sink, by its type, and the sink itself: a call is one jump, and a sink needs
    // no base class.
    KindMask kinds_;
    void (*on_)(void*, const Record&, const RecordContext&);
    void (*begin_)(void*, const RunInfo&);
    void (*finish_)(void*);
    std::shared_ptr<void> self_;
};

}  // namespace rovernet
