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

/// Messages of one topic to one ROS client, for all subscriptions of the client to the topic. The
/// smallest interval and queue length of the subscriptions apply; the encoding is CBOR if any
/// subscription requests it. Messages that come too early are queued, at most the newest 256 KiB,
/// and sent when the interval has passed in simulated time. So every replay sends the same
/// messages.
class RosStream {
  public:
    using Emit = std::function<void(std::string_view message)>;

    /// Adds a subscription of the client, or replaces its subscription with the same id.
    void add(const std::string& id, const RosDelivery& delivery);
    void remove(const std::string& id) { deliveries_.erase(id); }
    std::size_t subscriptions() const { return deliveries_.size(); }
    /// Delivery options combined from all subscriptions of the client to the topic.
    RosDelivery delivery() const;

    /// Takes a new message of the topic, and sends, queues or drops it.
    void take(std::string_view message, Time now, const Emit& emit);
    /// Sends queued messages of the topic that are due.
    void go_on(Time now, const Emit& emit);
    /// Sending time of the next queued message; `never` if no message is queued.
    Time next() const { return held_.empty() ? never : free_from_; }

    /// Topic of the messages; none: no topic has the name, so that no message is ever sent.
    std::optional<RosTopic> source = {};
    Time due = never;  ///< simulated time of the topic's next message; `never`: no next message

  private:
    std::string release();

    std::map<std::string, RosDelivery> deliveries_;  // delivery options by subscription id
    std::deque<std::string> held_;
    std::size_t held_bytes_ = 0;
    Time free_from_ = start_of_run;
};

}  // namespace rovernet
