// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "sim/sink.hpp"
#include "traces/metric_values.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rovernet {

/// Sink that computes metrics from the records of a run, or of read_ns2_trace().
///
/// Messages sent before `begin` are not counted, and neither are their copies.
///
/// Memory: one bit per robot for each broadcast that is still in use and was forwarded; 8 bytes per
/// delivery, for the percentiles of latency; 40 bytes per measured flow, and per measured robot.
class Metrics {
  public:
    explicit Metrics(Time begin = start_of_run, MetricParts parts = {})
        : begin_(begin), parts_(parts) {}

    KindMask kinds() const {
        const KindMask reach = !parts_.reach   ? kind_cheap_reachable
                               : *parts_.reach ? kind_reachable
                                               : 0;
        return kind_of<Sent>() | kind_of<Transmitted>() | kind_of<Received>() | kind_of<Dropped>() |
               kind_of<Routed>() | reach | (parts_.path_stretch ? kind_shortest : 0);
    }
    void on(const Record& record, const RecordContext& context);

    /// Metrics of the records so far. The call sorts all latencies, and is meant for the end of a
    /// run.
    MetricValues values() const;

  private:
    /// State of the message in a slot of the message table. The state is reset with every new
    /// message, including control packets of a routing protocol, which have no Sent record.
    struct MessageState {
        std::uint64_t uid = ~std::uint64_t{0};
        std::vector<std::uint64_t> forwarders;   ///< bit n: robot n has forwarded the broadcast
        std::uint32_t others = 0;                ///< number of the message's destinations
        std::optional<std::uint32_t> reachable;  ///< Sent::reachable of the message
        std::optional<std::uint32_t> shortest;   ///< Sent::shortest of the message
        Time since = start_of_run;  ///< arrival time of a routed unicast at its last robot so far
        Duration waited{0};         ///< time of the message in routers so far [ns]
    };
    /// Number of occurrences of each fate or drop reason.
    template <class Reason, Reason last>
    struct Counts {
        std::array<std::uint64_t, static_cast<std::size_t>(last) + 1> of{};
        std::uint64_t& operator[](Reason r) { return of[static_cast<std::size_t>(r)]; }
        std::uint64_t operator[](Reason r) const { return of[static_cast<std::size_t>(r)]; }
    };

    /// Number of broadcasts, from which the number for each robot follows.
    struct BroadcastCounts {
        /// Number of broadcasts sent while n robots existed, at index n; each is for the first n
        /// robots except its sender.
        std::vector<std::uint64_t> by_size;
        std::vector<std::uint64_t> by_sender;  ///< number of broadcasts by each robot
        void add(NodeId sender, std::size_t existing);
        /// Number of robots that exist or sent, according to the broadcasts.
        std::size_t robots() const;
        /// Number of broadcasts for each of the first `count` robots, by their ids.
        std::vector<std::uint64_t> for_robots(std::size_t count) const;
    };

    void count(const Sent&, const RecordContext&);
    void count(const Transmitted&, const RecordContext&);
    void count(const Received&, const RecordContext&);
    void deliver(const Reception&, const Frame&, const RecordContext&);
    void count(const Dropped&, const RecordContext&);
    void count_packet(const Frame&, const Message&, Time);
    void count(const Routed&, const RecordContext&);
    void count_way(const Reception&, const Frame&, const RecordContext&);
    void count_drop(LossReason, const Message&);
    void count_sent(const Message&, std::uint64_t others);
    void count_cut_off(const Message&, std::uint64_t others);
    bool counts(const Frame& frame, const RecordContext& context) const {
        const Message& message = context.messages[frame.message];
        return message.created >= begin_ && message.kind.empty();
    }
    MessageState& state_of(MessageId id, const RecordContext& context) {
        const std::uint64_t uid = context.messages[id].uid;
        const bool is_known = id.index() < states_.size() && states_[id.index()].uid == uid;
        return is_known ? states_[id.index()] : begin_state(id, uid);
    }
    MessageState& begin_state(MessageId id, std::uint64_t uid);
    PartValues& flow(const Message&);
    PartValues& robot(NodeId);
    /// Values of each robot, by its id. Robots that joined after all messages may be missing.
    std::vector<PartValues> robots() const;

    Time begin_;
    MetricParts parts_;
    MetricValues totals_;  ///< totals of the run; only the counters are used
    Counts<Fate, last_fate> fates_;
    Counts<DropReason, last_drop_reason> drops_;
    std::uint64_t others_ = 0;     ///< sum over messages of the number of destinations
    std::uint64_t reachable_ = 0;  ///< sum over messages of Sent::reachable
    std::uint64_t reached_ = 0;    ///< deliveries of messages with a known Sent::reachable
    std::uint64_t broadcast_deliveries_ = 0;  ///< deliveries of broadcasts
    /// Number of pairs of a broadcast and a robot that forwarded it.
    std::uint64_t forwarders_ = 0;
    RoutingValues routing_;               ///< counts of the routing protocol
    RoutedSums routed_;                   ///< sums over routed unicasts
    std::uint64_t bytes_ = 0;             ///< size of the messages delivered [bytes]
    std::vector<Duration> delays_;        ///< latencies of the deliveries, unsorted
    std::vector<std::uint64_t> hops_;     // deliveries by number of hops
    std::vector<MessageState> states_;    ///< states of the messages, by index of the MessageId
    std::vector<PartValues> flows_;       ///< values of each flow, at index flow - 1
    std::vector<PartValues> robots_;      ///< values of each robot, by its id, without broadcasts
    BroadcastCounts broadcasts_;          ///< broadcasts that were sent
    BroadcastCounts cut_off_broadcasts_;  ///< broadcasts that the end of the run cut off
};

}  // namespace rovernet
