// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace rovernet {

/// The sinks of a network: each gets the kinds of records that it asks for.
class Recorder {
  public:
    /// @return a number to remove it by
    std::uint32_t add(Sink sink) {
        wanted_ |= sink.kinds() & ~given_up_;
        sinks_.push_back({std::move(sink), next_});
        return next_++;
    }
    /// The sink gets no more records.
    void remove(std::uint32_t number) {
        std::erase_if(sinks_, [&](const Numbered& each) { return each.number == number; });
        wanted_ = 0;
        for (const Numbered& each : sinks_) wanted_ |= each.sink.kinds() & ~given_up_;
    }

    /// Some sink wants one of these kinds.
    bool wants(KindMask kinds) const { return (wanted_ & kinds) != 0; }
    template <class R>
    bool wants() const {
        return wants(kind_of<R>());
    }
    /// From now on nobody gets these kinds.
    void give_up(KindMask kinds) {
        given_up_ |= kinds;
        wanted_ &= ~kinds;
    }

    /// The run begins, before the first record.
    void begin(const RunInfo& run) {
        for (const Numbered& each : sinks_) each.sink.begin(run);
    }
    template <class R>
    void emit(const R& record, const RecordContext& context) {
        if (!wants<R>()) return;
        const Record for_all = record;
        for (const Numbered& each : sinks_) {
            if (each.sink.kinds() & kind_of<R>()) each.sink.on(for_all, context);
        }
    }
    /// The run is over, after the last record.
    void finish() {
        for (const Numbered& each : sinks_) each.sink.finish();
    }

  private:
    struct Numbered {
        Sink sink;
        std::uint32_t number;
    };
    std::vector<Numbered> sinks_;
    KindMask wanted_ = 0, given_up_ = 0;
    std::uint32_t next_ = 0;
};

}  // namespace rovernet
