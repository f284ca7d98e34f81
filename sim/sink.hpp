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

// The port of those who observe a run. A sink is a plain struct that satisfies RecordSink; the
// handle Sink shares it.

namespace rovernet {

/// What a sink may want to know of a run before its first record.
struct RunInfo {
    std::function<std::string()> scenario;  ///< as TOML, every default filled in; may be empty
    std::size_t robots;                     ///< so far
    std::function<std::string_view(NodeId)> name;  ///< of a robot, good until the next is added
    std::uint64_t seed;
    std::uint32_t replication;
};

/// An observer of records: says once which kinds it wants, then gets each of them in order.
template <class T>
concept RecordSink = requires(T sink, const Record& record, const RecordContext& context) {
    { std::as_const(sink).kinds() } -> std::convertible_to<KindMask>;
    {sink.on(record, context)};
};
/// One that is told when the run begins, before the first record; or when it is added, if that is
/// later.
template <class T>
concept BeginsWithRun = requires(T sink, const RunInfo& run) {
    {sink.begin(run)};
};
/// One that is told when the run is over, after the last record.
template <class T>
concept FinishesWithRun = requires(T sink) {
    {sink.finish()};
};

/// Any sink, shared: the caller may keep a handle to ask it for its result.
class Sink {
  public:
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
    template <RecordSink T>
    Sink(T sink) : Sink(std::make_shared<T>(std::move(sink))) {}

    KindMask kinds() const { return kinds_; }
    void begin(const RunInfo& run) const { begin_(self_.get(), run); }
    void on(const Record& record, const RecordContext& context) const {
        on_(self_.get(), record, context);
    }
    void finish() const { finish_(self_.get()); }

  private:
    KindMask kinds_;
    void (*on_)(void*, const Record&, const RecordContext&);
    void (*begin_)(void*, const RunInfo&);
    void (*finish_)(void*);
    std::shared_ptr<void> self_;
};

}  // namespace rovernet
