// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ports.hpp"
#include "sim/record.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace rovernet {

/// How many copies were lost for one reason.
struct DropCount {
    std::string_view reason;  ///< as in an ns-2 trace
    std::uint64_t count = 0;
    friend bool operator==(const DropCount&, const DropCount&) = default;
};

/// The delays of the deliveries: from the sending of the message to its first copy at a robot [s].
/// Percentiles by nearest rank: the p-th is the ceil(p n / 100)-th smallest of the n delays.
struct LatencyValues {
    double mean = 0;  ///< [s]
    double p50 = 0;   ///< [s]
    double p95 = 0;   ///< [s]
    double max = 0;   ///< [s]
    friend bool operator==(const LatencyValues&, const LatencyValues&) = default;
};

/// What a run, or a trace read back, amounts to. The values are computed from integers, so that
/// they are the same to the last digit in whatever portions the records arrive.
struct MetricValues {
    std::uint64_t messages = 0;       ///< sent by applications
    std::uint64_t transmissions = 0;  ///< frames put on air
    std::uint64_t receptions = 0;     ///< decoded copies, duplicates included
    std::uint64_t deliveries = 0;     ///< first copies, handed to an application

    /// Copies not forwarded, by reason: DUP suppressed as duplicates, TTL crossed their last hop
    /// (a delivered copy can be one), SLP found the radio off; ERR bit errors, COL collisions, BSY
    /// the receiver sending itself; IFQ a full queue, RET unicasts that were
    /// given up; END frames queued when the radio was switched off.
    std::array<DropCount, 9> drops{
        {{"DUP"}, {"TTL"}, {"SLP"}, {"ERR"}, {"COL"}, {"BSY"}, {"IFQ"}, {"RET"}, {"END"}}};

    /// deliveries / sum over messages of (robots when it was sent - 1) [-], the packet delivery
    /// ratio with every other robot as a destination and without duplicates; nothing if that sum
    /// is 0. Source: for unicast, J. Broch et al., MobiCom 1998.
    std::optional<double> delivery_ratio;

    /// RE = r / e [-]: r the deliveries, e the sum over messages of the robots that a chain of
    /// links joined to the sender when it was sent. Robots that move or relay late may be reached
    /// beyond those: it can exceed 1. Nothing if e is 0 or no message carried its part of it.
    /// Source: S.-Y. Ni et al., The broadcast storm problem, MobiCom 1999.
    std::optional<double> reach;

    /// SRB = (r - t) / r [-]: r the deliveries, t the distinct (message, robot) pairs in which the
    /// robot, not being the message's origin, put it on air. Nothing without deliveries.
    /// Source: S.-Y. Ni et al., as above.
    std::optional<double> saved_rebroadcasts;

    std::optional<LatencyValues> latency;  ///< of the deliveries; nothing without them

    std::optional<double> mean_hops;  ///< of the deliveries [-]; nothing without them
    std::uint32_t max_hops = 0;       ///< of the deliveries [-]
    std::vector<std::uint64_t> hops;  ///< deliveries that crossed h hops, h = 0 ... max_hops

    friend bool operator==(const MetricValues&, const MetricValues&) = default;
};

/// Counts records. Fed by a run, or by read_ns2_trace().
///
/// Messages sent before its begin are left out, with all that becomes of them.
///
/// Memory: one bit per (message still in the table, robot), once it has been forwarded, and 8
/// bytes per delivery, for the percentiles.
class Metrics {
  public:
    explicit Metrics(Time begin = start_of_run) : begin_(begin) {}

    KindMask kinds() const {
        return kind_of<Sent>() | kind_of<Transmitted>() | kind_of<Received>() | kind_of<Dropped>() |
               kind_reachable | kind_any_order;
    }
    void on(const Record& record, const RecordContext& context);

    /// The values so far. Sorts the delays: for the end of a run, not for every record.
    MetricValues values() const;

  private:
    /// A message in the table, by its slot; a new message in the slot begins anew.
    struct Flood {
        std::vector<std::uint64_t> forwarders;  ///< bit n: robot n has put it on air
        bool reachable_known = false;
    };

    void count(const Sent&);
    void count(const Transmitted&, const RecordContext&);
    void count(const Received&, const RecordContext&);
    void deliver(const Reception&, const Frame&, const RecordContext&);
    void count(const Dropped&, const RecordContext&);
    bool counts(const Frame& frame, const RecordContext& context) const {
        return context.messages[frame.message].created >= begin_;
    }
    Flood& flood(MessageId);

    Time begin_;
    MetricValues totals_;              ///< only its counts
    std::uint64_t others_ = 0;         ///< sum of (robots - 1)
    std::uint64_t reachable_ = 0;      ///< sum of reachable, where known ...
    std::uint64_t reached_ = 0;        ///< ... and the deliveries of those messages
    std::uint64_t forwarders_ = 0;     ///< distinct (message, robot other than the origin)
    std::vector<Duration> delays_;     ///< of the deliveries, in no order
    std::vector<std::uint64_t> hops_;  // deliveries by their hops
    std::vector<Flood> floods_;        ///< by MessageId
};

}  // namespace rovernet
