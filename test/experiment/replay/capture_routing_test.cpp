// SPDX-License-Identifier: MIT
// Packets of ARP and of routing protocols in captures: tshark, which has read the RFCs by itself,
// is to print what the recorded trace says.
#include "routing/aodv/aodv_packets.hpp"
#include "routing/dsr/dsr_packets.hpp"
#include "test/experiment/replay/captured_run.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace capture_routing_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

/// Robots n0 to n3 in a line, and a longer way from n1 to n3 over n4, n5 and n6, which n2 does not
/// hear. n2 is switched off.
const std::string two_ways = R"(
[scenario]
duration = "3 s"
[propagation]
model = "disc"
range = "250 m"
[access]
model = "csma"
[[robot]]
name = "n0"
at = ["0 m", "0 m"]
[[robot]]
name = "n1"
at = ["200 m", "0 m"]
[[robot]]
name = "n2"
at = ["400 m", "0 m"]
off = ["2 s"]
[[robot]]
name = "n3"
at = ["600 m", "0 m"]
[[robot]]
name = "n4"
at = ["240 m", "220 m"]
[[robot]]
name = "n5"
at = ["440 m", "300 m"]
[[robot]]
name = "n6"
at = ["600 m", "200 m"]
[[traffic]]
kind = "unicast"
from = "n0"
to = "n3"
size = "64 B"
start = "1 s"
every = "250 ms"
)";

std::string ip(NodeId node) {
    return node == everyone ? "255.255.255.255" : fmt::format("10.0.0.{}", node.value + 1);
}
std::string mac(NodeId node) {
    return node == everyone ? "ff:ff:ff:ff:ff:ff"
                            : fmt::format("02:00:00:00:00:{:02}", node.value + 1);
}
std::string ips(std::span<const NodeId> nodes) {
    std::vector<std::string> all;
    for (const NodeId node : nodes) all.push_back(ip(node));
    return fmt::format("{}", fmt::join(all, ","));
}

/// Frame that was sent, with its message and what else its record has.
struct SentFrame {
    const AirSent& sent;
    const Message& message;
    const FrameHeader* header;
};

/// Lines that `line_of` makes of the data frames of a trace, in their order; empty ones are left
/// out.
template <class LineOf>
std::string lines_of(const std::string& trace, const LineOf& line_of) {
    std::string lines;
    RecordedReader reader(trace);
    while (const Record* record = reader.next()) {
        const auto* sent = std::get_if<AirSent>(record);
        if (!sent || sent->air.control) continue;
        const RecordContext context = reader.context();
        const std::string line =
            line_of(SentFrame{*sent, context.messages[sent->air.frame.message], context.header});
        if (!line.empty()) lines += line + '\n';
    }
    return lines;
}

/// Frames that tshark finds at their senders by a filter, as lines of these fields.
std::string printed(const CapturedRun& run, const std::string& filter, const std::string& fields) {
    return run.tshark("-Y '" + filter + " and frame.packet_flags_direction == 2' -T fields " +
                      fields);
}

/// Fields of tshark: those of `names`, each behind `prefix`.
std::string fields(std::string_view prefix, std::span<const std::string_view> names) {
    std::string all;
    for (const std::string_view name : names) all += fmt::format("-e {}{} ", prefix, name);
    return all;
}

// Fields of AODV, behind IP source, destination and TTL.
constexpr std::string_view aodv_fields[] = {"type",
                                            "hopcount",
                                            "flags.rreq_join",
                                            "flags.rreq_repair",
                                            "flags.rreq_gratuitous",
                                            "flags.rreq_destinationonly",
                                            "flags.rreq_unknown",
                                            "rreq_id",
                                            "dest_ip",
                                            "dest_seqno",
                                            "orig_ip",
                                            "orig_seqno",
                                            "flags.rrep_repair",
                                            "flags.rrep_ack",
                                            "prefix_sz",
                                            "lifetime",
                                            "flags.rerr_nodelete",
                                            "destcount",
                                            "unreach_dest_ip"};

std::string aodv_line(const SentFrame& of) {
    const Frame& frame = of.sent.air.frame;
    if (of.message.protocol() != "AODV") return {};
    const NodeId to = of.message.to;
    const std::string ends = fmt::format(
        "{}\t{}\t{}\t", ip(to == everyone ? frame.sender : of.message.origin), ip(to), frame.ttl);
    const auto packet = aodv::packet_of(of.message.payload);
    if (const auto* r = std::get_if<aodv::Request>(&packet)) {
        return ends + fmt::format("1\t{}\t0\t0\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t\t\t\t\t\t\t",
                                  frame.hops - 1, r->gratuitous ? 1 : 0,
                                  r->destination_only ? 1 : 0, r->number ? 0 : 1, r->id,
                                  ip(r->destination), r->number.value_or(0), ip(r->originator),
                                  r->originator_number);
    }
    if (const auto* r = std::get_if<aodv::Reply>(&packet)) {
        return ends + fmt::format("2\t{}\t\t\t\t\t\t\t{}\t{}\t{}\t\t0\t0\t0\t{}\t\t\t",
                                  r->hops + frame.hops - 1, ip(r->destination), r->number,
                                  ip(r->originator), r->lifetime / std::chrono::milliseconds{1});
    }
    const auto& error = std::get<aodv::Error>(packet);
    std::vector<NodeId> lost;
    std::vector<std::uint32_t> numbers;
    for (const auto& each : error.lost) {
        lost.push_back(each.destination);
        numbers.push_back(each.number);
    }
    return ends + fmt::format("3\t\t\t\t\t\t\t\t\t{}\t\t\t\t\t\t\t{}\t{}\t{}",
                              fmt::join(numbers, ","), error.is_repaired ? 1 : 0, lost.size(),
                              ips(lost));
}

/// Number of lines in which a field, from 0, has this value.
int count(const std::string& lines, std::size_t field, std::string_view value) {
    int found = 0;
    for (std::size_t at = 0; at < lines.size(); at = lines.find('\n', at) + 1) {
        std::size_t begin = at;
        for (std::size_t i = 0; i < field; ++i) begin = lines.find('\t', begin) + 1;
        const std::size_t end = lines.find_first_of("\t\n", begin);
        found += std::string_view(lines).substr(begin, end - begin) == value ? 1 : 0;
    }
    return found;
}

// Fields of DSR, behind the receiver of the frame, IP source, destination and TTL.
constexpr std::string_view dsr_fields[] = {"nexthdr",
                                           "flowstate",
                                           "len",
                                           "option.type",
                                           "option.len",
                                           "option.rreq.id",
                                           "option.rreq.targetaddress",
                                           "option.rreq.address",
                                           "option.rrep.lasthopex",
                                           "option.rrep.address",
                                           "option.err.type",
                                           "option.err.salvage",
                                           "option.err.src",
                                           "option.err.dest",
                                           "option.err.unreachablenode",
                                           "option.srcrt.firsthopext",
                                           "option.srcrt.lasthopext",
                                           "option.srcrt.salvage",
                                           "option.srcrt.segsleft",
                                           "option.ack.address"};

/// Source Route option of a packet (RFC 4728, 6.7).
struct SourceRoute {
    std::vector<NodeId> nodes;
    unsigned salvage = 0, segments_left = 0;

    std::string text() const {
        return fmt::format("0\t0\t{:#04x}\t{}\t{}", salvage, segments_left, ips(nodes));
    }
    /// Receiver of the frame: the next of the nodes that are left, or the destination.
    NodeId next(NodeId destination) const {
        return segments_left == 0 ? destination : nodes.at(nodes.size() - segments_left);
    }
};

/// Route in the header of a message, read by the layout of RFC 4728, 6.7, and by nothing else.
SourceRoute route_in(std::string_view bytes) {
    const auto number = [&](std::size_t at, std::size_t size) {
        std::uint32_t value = 0;
        for (const char c : bytes.substr(at, size)) {
            value = value << 8 | static_cast<std::uint8_t>(c);
        }
        return value;
    };
    CHECK(number(0, 1) == 17);  // UDP follows
    CHECK(number(2, 2) == bytes.size() - 4);
    CHECK(number(4, 1) == 96);
    CHECK(number(5, 1) == bytes.size() - 6);
    SourceRoute route{
        .nodes = {}, .salvage = number(6, 2) >> 6 & 15, .segments_left = number(7, 1) & 63};
    for (std::size_t at = 8; at < bytes.size(); at += 4) route.nodes.push_back({number(at, 4)});
    return route;
}

/// What tshark has to print of a message with a source route.
std::string dsr_message_line(const SentFrame& of) {
    const SourceRoute route = route_in(of.header->bytes);
    const std::size_t option = 2 + 4 * route.nodes.size();
    return fmt::format("{}\t{}\t{}\t{}\t0x11\t0\t{}\t96\t{}\t\t\t\t\t\t\t\t\t\t\t{}\t{}",
                       mac(route.next(of.message.to)), ip(of.message.origin), ip(of.message.to),
                       of.sent.air.frame.ttl, option + 2, option, route.text(),
                       8 + 32 + of.message.size);
}

/// What tshark has to print of a packet or a message of DSR.
std::string dsr_line(const SentFrame& of) {
    const Frame& frame = of.sent.air.frame;
    if (of.header) return dsr_message_line(of);
    if (of.message.protocol() != "DSR") return {};
    const auto& [request, reply, error, path] = dsr::packet_of(of.message);
    std::vector<int> types;
    std::vector<std::size_t> sizes;
    const auto add = [&](int type, std::size_t size) {
        types.push_back(type);
        sizes.push_back(size);
    };
    const auto behind_first = [](const dsr::Path& all) {
        return std::span(all.begin() + 1, all.end());
    };
    std::string texts = "\t\t\t", receiver = mac(frame.next_hop), source = "\t\t\t\t";
    if (request) {
        add(1, 6 + 4 * request->path.hops());
        texts = fmt::format("{:#06x}\t{}\t{}\t", request->id, ip(request->target),
                            ips(behind_first(request->path)));
    }
    if (reply) add(2, 1 + 4 * reply->path.hops());
    texts += reply ? "0\t" + ips(behind_first(reply->path)) + '\t' : "\t\t";
    if (error) add(3, 14);
    texts += error ? fmt::format("1\t{:#04x}\t{}\t{}\t{}\t", error->salvage, ip(error->from),
                                 ip(error->to), ip(error->unreachable))
                   : "\t\t\t\t\t";
    if (path) {
        SourceRoute route{.nodes = {path->begin() + 1, path->end() - 1}};
        route.segments_left = static_cast<unsigned>(route.nodes.size() + 1 - frame.hops);
        receiver = mac(route.next(path->back()));
        source = route.text();
        add(96, 2 + 4 * route.nodes.size());
    }
    std::size_t size = 2 * sizes.size();
    for (const std::size_t each : sizes) size += each;
    return fmt::format("{}\t{}\t{}\t{}\t0x3b\t0\t{}\t{}\t{}\t{}{}\t", receiver,
                       ip(of.message.origin), ip(request ? everyone : of.message.to), frame.ttl,
                       size, fmt::join(types, ","), fmt::join(sizes, ","), texts, source);
}

/// What tshark has to print of an ARP packet: length of the frame, its receiver and sender, then
/// the fields.
std::string arp_line(const SentFrame& of) {
    if (!of.message.is_link_packet()) return {};
    const NodeId from = of.message.origin, to = of.message.to;
    const bool is_request = of.message.kind == "ARP REQUEST";
    return fmt::format("{}\t{}\t{}\t1\t0x0800\t6\t4\t{}\t{}\t{}\t{}\t{}", 16 + 24 + 8 + 28 + 4,
                       mac(of.sent.air.frame.next_hop), mac(from), is_request ? 1 : 2, mac(from),
                       ip(from), is_request ? "00:00:00:00:00:00" : mac(to), ip(to));
}

}  // namespace

TEST_CASE(
    "tshark reads AODV packets: all fields of RREQ, RREP, RERR and HELLO equal those in the "
    "trace") {
    if (!has_tshark()) return;
    // Place of a field in the lines, its value, and the run in which a packet has it.
    struct Case {
        std::size_t field;
        std::string_view value;
        std::vector<std::string> set;
    };
    const Case cases[] = {
        {3, "1", {}},
        {3, "2", {}},
        {3, "3", {}},
        {7, "1", {"routing.gratuitous=true"}},
        {8, "1", {"routing.destination_only=true"}},
        {9, "1", {}},
        {10, "2", {}},
        {3, "2", {"routing.hello=\"0.5 s\""}},
        {19, "1", {"routing.local_repair=true"}},
    };
    for (const Case& each : cases) {
        std::vector<std::string> set = each.set;
        set.emplace_back("routing.protocol=aodv");
        const CapturedRun run(two_ways, set);
        capture_recorded(run.trace, run.capture);
        const std::string lines = lines_of(run.trace, aodv_line);
        CHECK(printed(run, "aodv",
                      "-e ip.src -e ip.dst -e ip.ttl " + fields("aodv.", aodv_fields)) == lines);
        CAPTURE(each.field);
        CHECK(count(lines, each.field, each.value) > 0);
        CHECK(run.tshark("-Y _ws.malformed").empty());
        const bool has_hellos = lines.find("\t255.255.255.255\t1\t2\t") != lines.npos;
        CHECK(has_hellos == (each.set == std::vector<std::string>{"routing.hello=\"0.5 s\""}));
    }
}

TEST_CASE(
    "tshark reads DSR packets: requests, replies, errors and source routes equal those in the "
    "trace") {
    if (!has_tshark()) return;
    const CapturedRun run(two_ways, {"routing.protocol=dsr"});
    capture_recorded(run.trace, run.capture);
    const std::string lines = lines_of(run.trace, dsr_line);
    CHECK(printed(run, "dsr",
                  "-e wlan.ra -e ip.src -e ip.dst -e ip.ttl " + fields("dsr.", dsr_fields) +
                      "-e udp.length") == lines);
    for (const char* types : {"1", "2,96", "3,96", "96"}) {
        CAPTURE(types);
        CHECK(count(lines, 7, types) > 0);
    }
    CHECK(run.tshark("-Y _ws.malformed").empty());
    CHECK(run.tshark("-o ip.check_checksum:TRUE -Y 'ip and not ip.checksum.status == 1'").empty());
    CHECK(run.tshark("-Y 'udp.port == 49600 and not dsr'").empty());
}

TEST_CASE(
    "dsr 6.7, 8.3.6: the field `Segments Left` counts down along a route, also along a salvaged "
    "route") {
    const CapturedRun run(two_ways, {"routing.protocol=dsr"});
    std::map<std::string, int> found;
    lines_of(run.trace, [&](const SentFrame& of) -> std::string {
        if (of.header) ++found[route_in(of.header->bytes).text()];
        return {};
    });
    for (const int left : {2, 1, 0}) {
        CHECK(found[fmt::format("0\t0\t0x00\t{}\t10.0.0.2,10.0.0.3", left)] > 0);
    }
    CHECK(found["0\t0\t0x00\t3\t10.0.0.2,10.0.0.3"] == 0);
    // n1 salvages, and is the first address.
    for (const int left : {3, 2, 1, 0}) {
        CHECK(found[fmt::format("0\t0\t0x01\t{}\t10.0.0.2,10.0.0.5,10.0.0.6,10.0.0.7", left)] > 0);
    }
    CHECK(found["0\t0\t0x01\t4\t10.0.0.2,10.0.0.5,10.0.0.6,10.0.0.7"] == 0);
}

TEST_CASE("tshark reads ARP: packets have 28 bytes, and operation and addresses as in the trace") {
    if (!has_tshark()) return;
    const CapturedRun run(two_ways, {"routing.protocol=aodv", "access.arp=true"});
    capture_recorded(run.trace, run.capture);
    const std::string lines = lines_of(run.trace, arp_line);
    CHECK(printed(run, "arp",
                  "-e frame.len -e wlan.ra -e wlan.ta -e arp.hw.type -e arp.proto.type "
                  "-e arp.hw.size -e arp.proto.size -e arp.opcode -e arp.src.hw_mac "
                  "-e arp.src.proto_ipv4 -e arp.dst.hw_mac -e arp.dst.proto_ipv4") == lines);
    CHECK(count(lines, 7, "1") > 0);
    CHECK(count(lines, 7, "2") > 0);
    CHECK(run.tshark("-Y 'arp and (_ws.malformed or _ws.expert)'").empty());
}

}  // namespace capture_routing_test
