// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

// Delivery of records. Sinks see them in the order in which they were added; a record is made once,
// whoever wants it.

namespace rovernet {

/// Sinks of a network: each gets the kinds of records that it asks for, in the order of the run.
///
/// World::emit() calls it, with what a sink may look up. A kind that no sink wants costs the test
/// of a bit, and a caller asks wants() before it makes something costly. Sinks come and go while
/// the run goes on; Network::add_sink() says what a late one gets.
class Recorder {
  public:
    /// Adds a sink, which gets the records from now on.
    /// @return number to remove it by; no number is given twice
    std::uint32_t add(Sink sink) {
        wanted_ |= sink.kinds() & ~given_up_;
        sinks_.push_back({std::move(sink), next_});
        return next_++;
    }
    /// Removes a sink: it gets no more records, and is not finished. Not from within a sink, whose
    /// list is being gone through. Kinds that only it wanted are no longer made.
    void remove(std::uint32_t number) {
        std::erase_if(sinks_, [&](const Numbered& each) { return each.number == number; });
        wanted_ = 0;
        for (const Numbered& each : sinks_) wanted_ |= each.sink.kinds() & ~given_up_;
    }

    /// Whether some sink wants one of these kinds. Requests count as kinds here: kind_reachable,
    /// say.
    bool wants(KindMask kinds) const { return (wanted_ & kinds) != 0; }
    /// Whether some sink wants this record.
    template <class R>
    bool wants() const {
        return wants(kind_of<R>());
    }
    /// Gives up these kinds: from now on nobody gets them, later sinks neither. Applications give
    /// up kind_cheap_reachable once it is no longer cheap, and the metric `reach` is null for the
    /// run then.
    void give_up(KindMask kinds) {
        given_up_ |= kinds;
        wanted_ &= ~kinds;
    }

    /// Tells all sinks that the run begins, before the first record.
    void begin(const RunInfo& run) {
        for (const Numbered& each : sinks_) each.sink.begin(run);
    }
    /// Gives a record to all sinks that want its kind, in the order in which they were added.
    /// @param context  what they may look up
    template <class R>
    void emit(const R& record, const RecordContext& context) {
        if (!wants<R>()) return;
        const Record for_all = record;
        for (const Numbered& each : sinks_) {
            if (each.sink.kinds() & kind_of<R>()) each.sink.on(for_all, context);
        }
    }
    /// Tells all sinks that the run is over, after the last record.
    void finish() {
        for (const Numbered& each : sinks_) each.sink.finish();
    }

  private:
    // Sink with the number that removes it.
    struct Numbered {
        Sink sink;
        std::uint32_t number;
    };
    // Sinks in the order in which they were added.
    std::vector<Numbered> sinks_;
    // Kinds that some sink wants, and kinds that were given up.
    KindMask wanted_ = 0, given_up_ = 0;
    // Number of the next sink.
    std::uint32_t next_ = 0;
};

}  // namespace rovernet
