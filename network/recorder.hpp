// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

// Delivery of records. Sinks get each record in the order in which the sinks were added; a record
// is made once for all sinks.

namespace rovernet {

/// Sinks of a network: each sink gets the kinds of records that it wants, in the order of the run.
///
/// World::emit() passes each record to the Recorder, with the state that sinks may read. A record
/// of a kind that no sink wants costs the test of a bit; before a costly record is made, the caller
/// checks wants(). Sinks may be added and removed during the run; see Network::add_sink() for sinks
/// added late.
class Recorder {
  public:
    /// Adds a sink, which gets the records from now on.
    /// @return number of the sink, for remove(); numbers are not reused
    std::uint32_t add(Sink sink) {
        wanted_ |= sink.kinds() & ~stopped_;
        sinks_.push_back({std::move(sink), next_});
        return next_++;
    }
    /// Removes a sink: the sink gets no more records, and its finish() is not called. It is an
    /// error to call remove() inside a sink, while the list is being traversed. Kinds that only
    /// this sink wanted are no longer made.
    void remove(std::uint32_t number) {
        std::erase_if(sinks_, [&](const Numbered& each) { return each.number == number; });
        wanted_ = 0;
        for (const Numbered& each : sinks_) wanted_ |= each.sink.kinds() & ~stopped_;
    }

    /// Whether any sink wants one of these kinds. Requests, such as kind_reachable, count as kinds.
    bool wants(KindMask kinds) const { return (wanted_ & kinds) != 0; }
    /// Whether any sink wants this record.
    template <class R>
    bool wants() const {
        return wants(kind_of<R>());
    }
    /// Stops the making of records of these kinds for the rest of the run, also for sinks that are
    /// added later. Applications stop kind_cheap_reachable when it becomes expensive; the metric
    /// `reach` is then null for the run.
    void stop(KindMask kinds) {
        stopped_ |= kinds;
        wanted_ &= ~kinds;
    }

    /// Calls begin() of all sinks, before the first record.
    void begin(const RunInfo& run) {
        for (const Numbered& each : sinks_) each.sink.begin(run);
    }
    /// Passes a record to all sinks that want its kind, in the order in which they were added.
    /// @param context  state that sinks may read
    template <class R>
    void emit(const R& record, const RecordContext& context) {
        if (!wants<R>()) return;
        const Record for_all = record;
        for (const Numbered& each : sinks_) {
            if (each.sink.kinds() & kind_of<R>()) each.sink.on(for_all, context);
        }
    }
    /// Calls finish() of all sinks, after the last record.
    void finish() {
        for (const Numbered& each : sinks_) each.sink.finish();
    }

  private:
    // Sink and its number.
    struct Numbered {
        Sink sink;
        std::uint32_t number;
    };
    // Sinks in the order in which they were added.
    std::vector<Numbered> sinks_;
    // Kinds that any sink wants, and kinds that were stopped.
    KindMask wanted_ = 0, stopped_ = 0;
    // Number of the next sink.
    std::uint32_t next_ = 0;
};

}  // namespace rovernet
