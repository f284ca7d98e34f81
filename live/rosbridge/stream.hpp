// SPDX-License-Identifier: MIT
#pragma once

#include "live/rosbridge/request.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace rovernet {

/// Messages of one topic to one client, on behalf of all its subscriptions to it: in the smallest
/// of their intervals, queues and pieces, and in one encoding. What it holds back, it sends when
/// the interval is over in simulated time, so that a run is told the same every time: the newest
/// messages, 256 KiB of them at most.
class RosStream {
  public:
    using Emit = std::function<void(std::string_view message)>;

    /// Adds a subscription, or replaces that of the same id.
    void add(const std::string& id, const RosDelivery& delivery);
    void remove(const std::string& id) { deliveries_.erase(id); }
    std::size_t subscriptions() const { return deliveries_.size(); }
    /// What its subscriptions come to.
    RosDelivery delivery() const;

    /// Takes a new message: it is sent now, held back or dropped.
    void take(std::string_view message, Time now, const Emit& emit);
    /// Sends what has been held back for long enough.
    void go_on(Time now, const Emit& emit);
    /// Time of the next message that is held back; `never` if there is none.
    Time next() const { return held_.empty() ? never : free_from_; }

    std::optional<RosTopic> source = {};  ///< none: nothing is ever published there
    Time due = never;                     ///< of the next message of its topic

  private:
    std::string release();

    std::map<std::string, RosDelivery> deliveries_;  // by the subscription's id
    std::deque<std::string> held_;
    std::size_t held_bytes_ = 0;
    Time free_from_ = start_of_run;
};

}  // namespace rovernet
