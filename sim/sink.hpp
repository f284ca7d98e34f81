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

// Interface for observers of a run: traces, metrics, fingerprints, pictures. A sink is a plain
// struct that satisfies RecordSink; the handle Sink shares it. Example: examples/own_sink.cpp.
//
//     struct Losses {
//         std::uint64_t count = 0;
//         KindMask kinds() const { return kind_of<Dropped>(); }
//         void on(const Record&, const RecordContext&) { ++count; }
//     };
//     const auto losses = std::make_shared<Losses>();
//     network.add_sink(Sink{losses});

namespace rovernet {

/// Facts about a run, for sinks that need them before the first record, such as the header of a
/// file.
struct RunInfo {
    /// Scenario as TOML, with every default. Empty if the network was built by a C++ program,
    /// without a scenario file.
    std::function<std::string()> scenario;
    /// Number of robots at the start; more may be added.
    std::size_t robots;
    /// Name of a robot, valid until the next robot is added. @throws std::out_of_range if there is
    /// no such robot
    std::function<std::string_view(NodeId)> name;
    /// Seed of the run's random draws.
    std::uint64_t seed;
    /// Number of the run's independent repetition (replication).
    std::uint32_t replication;
};

/// Observer of records. kinds() is called once, when the sink is added, and returns the kinds of
/// records that the sink wants. on() then gets each record of these kinds, in the order of the run.
/// `context` gives access to the state of the network.
///
/// A sink only observes: it must not change the network, nor add or remove sinks. Metrics,
/// Fingerprint, Ns2Trace, Timeline and Trails are sinks.
template <class T>
concept RecordSink = requires(T sink, const Record& record, const RecordContext& context) {
    { std::as_const(sink).kinds() } -> std::convertible_to<KindMask>;
    {sink.on(record, context)};
};
/// Sink with begin(), which is called when the run begins, before the first record; or when the
/// sink is added, if that is later.
template <class T>
concept BeginsWithRun = requires(T sink, const RunInfo& run) {
    {sink.begin(run)};
};
/// Sink with finish(), which Network::finish() calls after the last record; the sink then names its
/// files and completes its sums.
template <class T>
concept FinishesWithRun = requires(T sink) {
    {sink.finish()};
};

/// Handle of a sink of any type, shared: the caller may keep a pointer to the sink and read its
/// result after the run. Copies of a handle share the sink.
/// Example: examples/own_sink.cpp.
class Sink {
  public:
    /// @param sink  sink, not null; its kinds() is called now
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
    /// Moves the sink into the handle, for sinks whose result is not read. The type of the sink
    /// needs no base class and no registration:
    ///
    ///   network.add_sink(Sink{Losses{}});
    template <RecordSink T>
    Sink(T sink) : Sink(std::make_shared<T>(std::move(sink))) {}

    /// Kinds of records that the sink wants, as a mask of bits.
    KindMask kinds() const { return kinds_; }
    /// Calls of the sink's functions; begin() and finish() do nothing if the sink does not have
    /// them.
    void begin(const RunInfo& run) const { begin_(self_.get(), run); }
    void on(const Record& record, const RecordContext& context) const {
        on_(self_.get(), record, context);
    }
    /// Notifies the sink of the end of the run.
    void finish() const { finish_(self_.get()); }

  private:
    // Functions of the sink's type, and the sink itself: a call is one jump, and a sink needs no
    // base class.
    KindMask kinds_;
    void (*on_)(void*, const Record&, const RecordContext&);
    void (*begin_)(void*, const RunInfo&);
    void (*finish_)(void*);
    std::shared_ptr<void> self_;
};

}  // namespace rovernet
