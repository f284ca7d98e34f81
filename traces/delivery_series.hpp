// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <cstdint>
#include <vector>

namespace rovernet {

/// Deliveries of each message of a run, in the order of sending: a time series, to separate the
/// initial transient of a run from its steady state.
class DeliverySeries {
  public:
    KindMask kinds() const { return kind_of<Sent>() | kind_of<Received>(); }
    void on(const Record& record, const RecordContext& context);

    /// Time at which each message was sent, ascending.
    const std::vector<Time>& sent() const { return sent_; }
    /// Delivery ratio of each message: deliveries / (robots when it was sent - 1) [-]; 0 if there
    /// was only one robot.
    std::vector<double> delivered() const;

  private:
    /// Message in a slot of the MessageTable, taken from the slot's last Sent record. Control
    /// packets of a routing protocol have no Sent record.
    struct Known {
        std::uint64_t uid = ~std::uint64_t{0};
        std::size_t place = 0;  // index of the message in the series
    };

    std::vector<Known> known_;  // index: MessageId
    std::vector<Time> sent_;
    std::vector<std::uint32_t> others_;      // number of possible receivers of each message
    std::vector<std::uint32_t> deliveries_;  // number of deliveries of each message
};

}  // namespace rovernet
