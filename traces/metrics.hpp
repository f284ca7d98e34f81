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

/// Counts records. Fed by a run, or by read_ns2_trace().
///
/// Messages sent before its begin are left out, with all that becomes of them.
///
/// Memory: one bit per (message still in the table, robot), once it has been forwarded, and 8
/// bytes per delivery, for the percentiles; 40 per flow and robot that is counted.
class Metrics {
  public:
    explicit Metrics(Time begin = start_of_run, MetricParts parts = {})
        : begin_(begin), parts_(parts) {}

    KindMask kinds() const {
        const KindMask reach = !parts_.reach   ? kind_cheap_reachable
                               : *parts_.reach ? kind_reachable
                                               : 0;
        return kind_of<Sent>() | kind_of<Transmitted>() | kind_of<Received>() | kind_of<Dropped>() |
               reach;
    }
    void on(const Record& record, const RecordContext& context);

    /// The values so far. Sorts the delays: for the end of a run, not for every record.
    MetricValues values() const;

  private:
    /// State of a message in the table. A slot begins anew with every message, also with one
    /// that has no Sent, such as a router's own.
    struct Flood {
        std::uint64_t uid = ~std::uint64_t{0};
        std::vector<std::uint64_t> forwarders;   ///< bit n: robot n has put it on air
        std::uint32_t others = 0;                ///< robots that it is for
        std::optional<std::uint32_t> reachable;  ///< see Sent
    };
    /// Number of times that each fate and each reason of a drop was seen.
    template <class Reason, Reason last>
    struct Counts {
        std::array<std::uint64_t, static_cast<std::size_t>(last) + 1> of{};
        std::uint64_t& operator[](Reason r) { return of[static_cast<std::size_t>(r)]; }
        std::uint64_t operator[](Reason r) const { return of[static_cast<std::size_t>(r)]; }
    };

    void count(const Sent&, const RecordContext&);
    void count(const Transmitted&, const RecordContext&);
    void count(const Received&, const RecordContext&);
    void deliver(const Reception&, const Frame&, const RecordContext&);
    void count(const Dropped&, const RecordContext&);
    void count_parts(const Message&, std::uint64_t others, bool is_cut_off);
    bool counts(const Frame& frame, const RecordContext& context) const {
        const Message& message = context.messages[frame.message];
        return message.created >= begin_ && message.kind.empty();
    }
    Flood& flood(MessageId id, const RecordContext& context) {
        const std::uint64_t uid = context.messages[id].uid;
        const bool is_known = id.index() < floods_.size() && floods_[id.index()].uid == uid;
        return is_known ? floods_[id.index()] : begin_flood(id, uid);
    }
    Flood& begin_flood(MessageId id, std::uint64_t uid);
    PartValues& flow(const Message&);
    PartValues& robot(NodeId);
    std::vector<PartValues> robots() const;

    Time begin_;
    MetricParts parts_;
    MetricValues totals_;  ///< only its counts
    Counts<Fate, last_fate> fates_;
    Counts<DropReason, last_drop_reason> drops_;
    std::uint64_t others_ = 0;         ///< sum of (robots - 1)
    std::uint64_t reachable_ = 0;      ///< sum of Flood::reachable
    std::uint64_t reached_ = 0;        ///< deliveries of messages with a Flood::reachable
    std::uint64_t forwarders_ = 0;     ///< distinct (message, robot other than the origin)
    std::vector<Duration> delays_;     ///< delays of the deliveries, in no order
    std::vector<std::uint64_t> hops_;  // deliveries by their hops
    std::vector<Flood> floods_;        ///< floods by MessageId
    std::vector<PartValues> flows_;    ///< values by flow - 1
    std::vector<PartValues> robots_;   ///< values by robot, without the broadcasts
    std::uint64_t broadcasts_ = 0;     ///< broadcasts of all robots, which are for everybody else
    std::vector<std::uint64_t> own_broadcasts_;  ///< broadcasts by each robot itself
};

}  // namespace rovernet
