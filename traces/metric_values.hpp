// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fate.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace rovernet {

/// Number of copies that were lost for one reason.
struct DropCount {
    std::string_view reason;  ///< code as in an ns-2 trace
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

/// Codes of all reasons for which a copy goes no further, each once: the order of
/// MetricValues::drops. DUP comes first, then the others in the order of their table
/// (sim/fate.hpp).
inline constexpr auto loss_codes = [] {
    struct Codes {
        std::array<std::string_view, 16> of{};
        std::size_t count = 0;
        constexpr std::size_t place(std::string_view code) const {
            std::size_t i = 0;
            while (i < count && of[i] != code) ++i;
            return i;
        }
        constexpr void add(std::string_view code) {
            if (!code.empty() && place(code) == count) of[count++] = code;
        }
    } codes;
    codes.add(reason_of(Fate::duplicate).code);
    for_each_reason([&](auto reason) { codes.add(reason_of(reason).code); });
    return codes;
}();

/// Values of a part of the traffic: the messages of one flow, or those for one robot.
struct PartValues {
    std::uint64_t messages = 0;    ///< sent: of the flow, or for the robot
    std::uint64_t expected = 0;    ///< deliveries, if every message reached whom it was for
    std::uint64_t deliveries = 0;  ///< first copies
    std::uint64_t bytes = 0;       ///< [bytes] of the messages delivered
    std::uint64_t delay_ns = 0;    ///< [ns] sum of their latencies
    std::optional<double> delivery_ratio() const;  ///< [-]; nothing if none is expected
    std::optional<double> latency_mean() const;    ///< [s]; nothing without deliveries
    friend bool operator==(const PartValues&, const PartValues&) = default;
};

/// Parts that Metrics measure beside the totals.
struct MetricParts {
    /// Costs a search of the network for every message; nothing: only while that is cheap.
    std::optional<bool> reach = {};
    bool flows = false;   ///< messages by their flow, see Message
    bool robots = false;  ///< messages by whom they are for
};

/// Values of a run, or of a trace read back. The values are computed from integers, so that they
/// are the same to the last digit in whatever portions the records arrive.
struct MetricValues {
    std::uint64_t messages = 0;       ///< sent by applications
    std::uint64_t transmissions = 0;  ///< frames put on air
    std::uint64_t receptions = 0;     ///< decoded copies, duplicates included
    std::uint64_t deliveries = 0;     ///< first copies, handed to an application

    /// Messages of which no frame had ended when the run did: nobody could have them yet. They
    /// count in `messages` and in drops.END, and are left out of delivery_ratio and reach.
    std::uint64_t cut_off = 0;

    /// Copies not forwarded, by the codes of the reasons in sim/fate.hpp.
    std::array<DropCount, loss_codes.count> drops = [] {
        std::array<DropCount, loss_codes.count> none;
        for (std::size_t i = 0; i < none.size(); ++i) none[i].reason = loss_codes.of[i];
        return none;
    }();

    /// deliveries / sum over messages of (robots when it was sent - 1; of a unicast 1) [-], the
    /// packet delivery ratio with every other robot as a destination and without duplicates;
    /// nothing if that sum is 0. Messages that were cut off are left out. Source: for unicast, J.
    /// Broch et al., MobiCom 1998.
    std::optional<double> delivery_ratio;

    /// RE = r / e [-]: r the deliveries, e the sum over messages of the robots that a chain of
    /// links joined to the sender when it was sent; of a unicast only its destination counts.
    /// Robots that move or relay late may be reached beyond those: it can exceed 1. Nothing if e is
    /// 0 or a message did not carry its part of it. Source: S.-Y. Ni et al., The broadcast storm
    /// problem, MobiCom 1999.
    std::optional<double> reach;
    bool reach_known = true;  ///< every message carried its part of reach

    /// SRB = (r - t) / r [-]: r the deliveries, t the distinct (message, robot) pairs in which the
    /// robot, not being the message's origin, put it on air. Nothing without deliveries.
    /// Source: S.-Y. Ni et al., as above.
    std::optional<double> saved_rebroadcasts;

    std::optional<LatencyValues> latency;  ///< latency of the deliveries; nothing without any

    std::optional<double> mean_hops;  ///< hops of a delivery [-]; nothing without any
    std::uint32_t max_hops = 0;       ///< most hops of a delivery [-]
    std::vector<std::uint64_t> hops;  ///< deliveries that crossed h hops, h = 0 ... max_hops

    std::vector<PartValues> flows;   ///< values by flow - 1, if they are counted
    std::vector<PartValues> robots;  ///< values by robot, if they are counted

    friend bool operator==(const MetricValues&, const MetricValues&) = default;
};

}  // namespace rovernet
