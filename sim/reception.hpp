// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fate.hpp"
#include "sim/ids.hpp"
#include "sim/record_field.hpp"
#include "sim/time.hpp"

namespace rovernet {

/// Reception of one transmission at one receiver that could decode it without interference.
/// Medium::find_receivers sets node and time when the frame starts, whatever moves later; reception
/// model and routing protocol set the other fields when the frame ends.
struct Reception {
    /// Time at which the frame ends at this receiver.
    Time time;
    NodeId node;
    /// Fate of the copy at this receiver.
    Fate fate = Fate::waiting;
    /// True if the application gets the message: it is the node's first copy, and the node is a
    /// destination.
    bool delivered = false;
    /// True if the receiver locked onto the frame. For a lost frame `sinr` sets whether it did.
    bool locked = true;

    /// Order in which the receptions of a transmission are served: by time, then by node.
    friend bool operator<(const Reception& a, const Reception& b) {
        return a.time != b.time ? a.time < b.time : a.node < b.node;
    }

    static constexpr auto fields() {
        return describe(field("node", &Reception::node), field("time", &Reception::time),
                        field("fate", &Reception::fate), field("delivered", &Reception::delivered),
                        field<not_visited>("locked", &Reception::locked));
    }
};

}  // namespace rovernet
