// SPDX-License-Identifier: MIT
#include "scenario/tables/traffic_table.hpp"

#include "scenario/tables/flow_names.hpp"
#include "scenario/tables/reader.hpp"

#include <fmt/format.h>

namespace rovernet {
namespace {

void read_start(const Value* start, TrafficTable& traffic, TableReader& table) {
    traffic.start = Duration{0};
    if (start) traffic.start_where = start->where;
    if (start && start->string() && *start->string() == TrafficTable::at_arrival) {
        traffic.start.reset();
    } else {
        table.read("start", traffic.start, non_negative);
    }
}

void check_receiver(const TrafficTable& traffic) {
    if (!traffic.to || *traffic.to != traffic.from) return;
    throw InputError(
        traffic.to_where,
        fmt::format("to: found \"{}\", which is the sender; expected another robot", *traffic.to));
}

/// Notes the place of the payload, which has to fit into a packet if no size is given.
void read_payload_place(TrafficTable& traffic, TableReader& table) {
    traffic.payload_where = table.take("payload")->where;
    if (traffic.size || traffic.payload.size() <= longest_message) return;
    throw InputError(traffic.payload_where,
                     fmt::format("payload: found a text of {} bytes; expected at most {}, which "
                                 "fit into a UDP packet",
                                 traffic.payload.size(), longest_message));
}

/// Checks that traffic does not stop before it starts.
void check_stop(const TrafficTable& traffic, TableReader& table) {
    if (!traffic.stop || !traffic.start || *traffic.stop > *traffic.start) return;
    throw InputError(
        table.take("stop")->where,
        fmt::format(
            "stop: found {} s, but start is {} s, so nothing would be sent; expected a later time",
            seconds(*traffic.stop), seconds(*traffic.start)));
}

}  // namespace

TrafficTable read_traffic(const Value& value) {
    TableReader table(value, "[[traffic]]");
    table.expect<TrafficTable>({"start"});
    TrafficTable traffic;
    table.read_fields(traffic);
    read_start(table.take("start"), traffic, table);
    const auto given = [&](std::string_view key) { return table.table().find(key); };
    if (given("name") && !is_flow_name(traffic.name)) {
        throw InputError(
            given("name")->where,
            fmt::format("name: found \"{}\"; expected a name without blanks and commas, because "
                        "the names of metrics contain the name of the flow",
                        traffic.name));
    }
    if (!given("from")) table.missing("from", "from = \"A\"");
    traffic.from_where = given("from")->where;
    if (traffic.to) traffic.to_where = given("to")->where;
    const bool to_one = traffic.kind == TrafficKind::unicast;
    if (!to_one && traffic.to) {
        throw InputError(
            traffic.to_where,
            "to: a broadcast has no destination; expected kind = \"unicast\", or no key \"to\"");
    }
    if (traffic.hops) traffic.hops_where = given("hops")->where;
    if (given("payload")) read_payload_place(traffic, table);
    if (!given("payload") && !traffic.size) {
        table.missing("payload", "payload = \"F\", or size = \"64 B\"");
    }
    if (to_one && !traffic.to) table.missing("to", "to = \"B\" (the receiver of the unicast)");
    check_receiver(traffic);
    check_stop(traffic, table);
    if (traffic.saturate && traffic.every) {
        throw InputError(
            table.take("every")->where,
            "every: saturated traffic always has a message to send; expected no key \"every\"");
    }
    if (!traffic.every && (traffic.stop || traffic.count)) {
        table.missing("every",
                      "every = \"3 s\"; the keys \"stop\" and \"count\" need the key \"every\"");
    }
    return traffic;
}

}  // namespace rovernet
