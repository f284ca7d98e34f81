// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/read_value.hpp"
#include "sim/error.hpp"
#include "sim/fields.hpp"
#include "sim/time.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace rovernet {

/// What traffic is made of.
enum class TrafficKind { broadcast, unicast };
template <>
struct EnumNames<TrafficKind> {
    static constexpr std::array<std::string_view, 2> values = {"broadcast", "unicast"};
};

/// [[traffic]]
struct TrafficTable {
    TrafficKind kind = TrafficKind::broadcast;
    std::string name = {};          ///< of the flow; unique, without blanks and commas
    std::string from;               ///< "random" if there is no such robot: another one each time
    std::optional<std::string> to;  ///< of a unicast
    bool saturate = false;          ///< there is always a message to send
    std::string payload;
    std::optional<Bytes> size;
    std::optional<Duration> start;  ///< none: when `from` arrives at the end of its movement
    std::optional<Duration> every;
    std::optional<Duration> stop;
    std::optional<int> count;
    Location from_where = {}, to_where = {}, payload_where = {};
};

}  // namespace rovernet
