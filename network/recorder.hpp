// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <utility>
#include <vector>

namespace rovernet {

/// The sinks of a network: each gets the kinds of records that it asks for.
class Recorder {
  public:
    void add(Sink sink) {
        wanted_ |= sink.kinds();
        sinks_.push_back(std::move(sink));
    }

    /// Some sink wants one of these kinds.
    bool wants(KindMask kinds) const { return (wanted_ & kinds) != 0; }
    template <class R>
    bool wants() const {
        return wants(kind_of<R>());
    }
    /// From now on nobody gets these kinds.
    void give_up(KindMask kinds) { wanted_ &= ~kinds; }

    template <class R>
    void emit(const R& record, const RecordContext& context) {
        if (!wants<R>()) return;
        const Record for_all = record;
        for (Sink& sink : sinks_) {
            if (sink.kinds() & kind_of<R>()) sink.on(for_all, context);
        }
    }

  private:
    std::vector<Sink> sinks_;
    KindMask wanted_ = 0;
};

}  // namespace rovernet
