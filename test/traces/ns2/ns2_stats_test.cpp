// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_stats.hpp"

#include "test/traces/record_stream.hpp"
#include "traces/ns2/ns2_reader.hpp"
#include "traces/ns2/ns2_trace.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>
#include <string>

namespace ns2_stats_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

TraceStats stats_of(const std::string& text, TraceRows rows = TraceRows::none) {
    const TempFolder folder;
    write_file(folder / "run.tr", text);
    return ns2_stats(folder / "run.tr", Ns2Strictness::tolerant, rows);
}

std::string sent(const std::string& time, int uid, const std::string& type = "cbr") {
    return "s " + time + " _0_ AGT  --- " + std::to_string(uid) + " " + type +
           " 100 [0 0 0 0] ------- [0:0 1:0 32 0] \n";
}
std::string got(const std::string& time, int uid, const std::string& type = "cbr") {
    return "r " + time + " _1_ AGT  --- " + std::to_string(uid) + " " + type +
           " 120 [13a 1 0 800] ------- [0:0 1:0 32 1] \n";
}

/// What count.awk says of a file: its lines, by what they begin with.
std::map<std::string, double> counted(const std::string& path) {
    const std::string script =
        std::filesystem::path(ROVERNET_TEST_DATA).parent_path() / "traces/ns2/count.awk";
    const std::string command = "awk -f '" + script + "' '" + path + "'";
    std::FILE* pipe = popen(command.c_str(), "r");
    REQUIRE(pipe);
    std::map<std::string, double> values;
    std::array<char, 256> line{};
    while (std::fgets(line.data(), line.size(), pipe)) {
        const std::string text = line.data();
        const std::size_t space = text.rfind(' ');
        values[text.substr(0, space)] = std::stod(text.substr(space + 1));
    }
    REQUIRE(pclose(pipe) == 0);
    return values;
}

void check_against_awk(const std::string& path) {
    CAPTURE(path);
    auto expected = counted(path);
    const TraceStats s = ns2_stats(path, Ns2Strictness::strict);
    constexpr double half_digit = 6e-7;  // [s] of what awk prints, and its doubles
    REQUIRE(s.metrics.latency.has_value());
    REQUIRE(s.throughput.has_value());
    CHECK(static_cast<double>(s.metrics.messages) == expected["messages"]);
    CHECK(static_cast<double>(s.metrics.deliveries) == expected["deliveries"]);
    CHECK(static_cast<double>(s.metrics.transmissions) == expected["transmissions"]);
    CHECK(std::abs(s.metrics.latency->mean - expected["latency_mean_s"]) < half_digit);
    CHECK(static_cast<double>(s.routing_packets) == expected["routing_packets"]);
    CHECK(static_cast<double>(s.routing_bytes) == expected["routing_bytes"]);
    CHECK(std::abs(*s.throughput - expected["throughput_bps"]) < 1);
    std::size_t places = 0;
    for (const auto& [place, count] : s.drops_by_layer) {
        CHECK(static_cast<double>(count) == expected["drop " + place.first + " " + place.second]);
        ++places;
    }
    for (const auto& [key, value] : expected) places -= key.starts_with("drop ") ? 1 : 0;
    CHECK(places == 0);
}

}  // namespace

TEST_CASE(
    "trace stats: a packet is identified by type and id, and only its first delivery counts") {
    const auto s = stats_of(sent("1.0", 0) + sent("1.0", 0, "exp") + got("1.5", 0) + got("1.6", 0) +
                            got("2.5", 0, "exp") + sent("3.0", 0, "ack") + got("3.1", 0, "ack") +
                            got("3.2", 9));
    CHECK(s.metrics.messages == 2);
    CHECK(s.metrics.deliveries == 2);
    CHECK(s.metrics.delivery_ratio == 1);
    CHECK(s.metrics.latency->mean == 1);
    CHECK(s.metrics.latency->max == 1.5);
    CHECK(s.delivered_bytes == 200);
    CHECK(s.counts.refused == 0);
}

TEST_CASE("trace stats: the jitter and throughput of a flow equal values computed by hand") {
    // Latencies 0.5, 0.6, 0.4 s: differences 0.1 and 0.2 s. One of 2 s is of another flow.
    const auto s =
        stats_of(sent("1", 0) + got("1.5", 0) + sent("2", 1) + got("2.6", 1) +
                 sent("2.8", 0, "exp") + got("4.8", 0, "exp") + sent("5", 2) + got("5.4", 2));
    constexpr double rounding = 1e-12;
    CHECK(std::abs(s.jitter_mean.value() - 0.15) < rounding);
    const double first = 0.1 / 16;
    CHECK(std::abs(s.jitter_rfc3550.value() - (first + (0.2 - first) / 16)) < rounding);
    const double mean = (0.5 + 0.6 + 2 + 0.4) / 4;
    double squares = 0;
    for (const double d : {0.5, 0.6, 2.0, 0.4}) squares += (d - mean) * (d - mean);
    CHECK(std::abs(s.jitter_sd.value() - std::sqrt(squares / 3)) < rounding);
    CHECK(std::abs(s.throughput.value() - 8 * 400 / 4.4) < 1e-9);
    CHECK_FALSE(stats_of(sent("1", 0)).jitter_sd);
    CHECK_FALSE(stats_of(sent("1", 0)).throughput);
}

TEST_CASE(
    "trace stats: packets of routing protocols count as routing load, also if they are forwarded") {
    const std::string request = " --- 0 AODV 48 [0 0 0 0] ------- [0:255 -1:255 30 0] [0x2] \n";
    const auto s = stats_of(sent("1", 0) + "s 1.0 _0_ RTR " + request + "f 1.1 _1_ RTR " + request +
                            "r 1.1 _1_ RTR " + request + "s 1.1 _1_ MAC " + request +
                            "s 1.2 _0_ RTR  --- 3 message 32 [0 0 0 0] ------- [0:255 -1:255 32 "
                            "0] \n");
    CHECK(s.routing_packets == 3);
    CHECK(s.routing_bytes == 48 + 48 + 32);
    CHECK(s.metrics.transmissions == 0);
}

TEST_CASE(
    "trace stats: drops of messages are counted by reason, drops of all packets by reason and "
    "layer") {
    const auto s =
        stats_of(sent("1", 0) + "D 1.1 _0_ IFQ  ARP 0 cbr 120 [0 0 0 0] ------- [0:0 1:0 32 1] \n" +
                 "D 1.1 _0_ MAC  COL 0 RTS 44 [0 0 0 0] \n" +
                 "D 1.2 _1_ RTR  TTL 0 AODV 48 [0 ffffffff 0 800] ------- [0:255 -1:255 0 0] \n" +
                 "D 1.2 _1_ RTR  TTL 0 cbr 48 [0 1 0 800] ------- [0:0 1:0 0 0] \n");
    const std::vector<std::pair<std::string, std::uint64_t>> of_messages{{"TTL", 1}, {"ARP", 1}};
    CHECK(s.drops == of_messages);
    CHECK(s.drops_by_layer.size() == 3);
    CHECK(s.drops_by_layer.at({"RTR", "TTL"}) == 2);
    CHECK(s.drops_by_layer.at({"MAC", "COL"}) == 1);
}

TEST_CASE("trace stats: rows by robot, flow and second add up to the totals") {
    const TempFolder folder;
    Stream stream;
    const auto trace =
        std::make_shared<Ns2Trace>(folder / "run.tr", Ns2Format::old_format, MacTrace::on);
    stream.sinks = {trace};
    RandomRecords(stream, 3).run(12, 2'000);
    trace->close();
    const auto totals = ns2_stats(folder / "run.tr");
    std::uint64_t lost = 0;
    for (const auto& drop : totals.drops) lost += drop.second;
    for (const auto by : {TraceRows::robot, TraceRows::flow, TraceRows::second}) {
        TraceRow sum;
        const auto s = ns2_stats(folder / "run.tr", Ns2Strictness::strict, by);
        REQUIRE(s.rows.size() > 1);
        for (const TraceRow& row : s.rows) {
            sum.messages += row.messages;
            sum.deliveries += row.deliveries;
            sum.transmissions += row.transmissions;
            sum.receptions += row.receptions;
            sum.drops += row.drops;
            sum.bytes += row.bytes;
        }
        CHECK(sum.messages == totals.metrics.messages);
        CHECK(sum.deliveries == totals.metrics.deliveries);
        CHECK(sum.transmissions == totals.metrics.transmissions);
        CHECK(sum.receptions == totals.metrics.receptions);
        CHECK(sum.drops == lost);
        CHECK(sum.bytes == totals.delivered_bytes);
    }
    CHECK(stats_of(sent("7.5", 0), TraceRows::second).rows[0].name == "7");
    CHECK(stats_of(sent("7.5", 0), TraceRows::flow).rows[0].name == "cbr 0:0 -> 1:0");
}

TEST_CASE("trace stats: each line is counted as an event, as skipped or as refused") {
    const auto s =
        stats_of("# by hand\n\n" + sent("1", 0) + "what is this\n" +
                 "+ 0.1 1 2 cbr 1000 ------- 2 1.0 3.1 0 0\nSFf 1.0 _1_ 3\n" + sent("2", 0));
    CHECK(s.counts.lines == 7);
    CHECK(s.counts.events == 1);
    CHECK(s.counts.skipped_of(Ns2Other::comment) == 1);
    CHECK(s.counts.skipped_of(Ns2Other::blank) == 1);
    CHECK(s.counts.skipped_of(Ns2Other::wired) == 1);
    CHECK(s.counts.skipped_of(Ns2Other::dsr) == 1);
    CHECK(s.counts.format() == "old+wired");
    REQUIRE(s.counts.refused == 2);
    CHECK(s.counts.refused_lines[0].line == 4);
    CHECK(s.counts.refused_lines[0].text == "what is this");
    CHECK(s.counts.refused_lines[1].why.starts_with(
        "a packet of type cbr with number 0 is sent a second time"));
    std::string many = sent("1", 0);
    for (int i = 0; i < 25; ++i) many += "nothing\n";
    CHECK(stats_of(many).counts.refused == 25);
    CHECK(stats_of(many).counts.refused_lines.size() == 10);
}

TEST_CASE("trace stats: hops are counted from the routing agent's first transmission") {
    const auto s =
        stats_of(sent("1", 0) + "s 1.1 _0_ RTR  --- 0 cbr 120 [0 0 0 0] ------- [0:0 1:0 30 5] \n" +
                 "r 1.2 _5_ RTR  --- 0 cbr 120 [13a 5 0 800] ------- [0:0 1:0 30 5] \n" +
                 "f 1.3 _5_ RTR  --- 0 cbr 120 [13a 5 0 800] ------- [0:0 1:0 29 1] \n" +
                 "r 1.4 _1_ AGT  --- 0 cbr 120 [13a 1 5 800] ------- [0:0 1:0 29 1] \n");
    CHECK(s.metrics.max_hops == 2);
    CHECK(s.metrics.receptions == 2);
    CHECK(s.metrics.transmissions == 2);
}

TEST_CASE("trace stats: for traces written by ns-2, the results equal those of an awk script") {
    const char* folder = std::getenv("ROVERNET_TRACES");
    if (!folder) {
        MESSAGE("skipped: ROVERNET_TRACES is not set");
        return;
    }
    for (const char* name : {"old_aodv_mac.tr", "old_aodv_mac_energy.tr", "new_aodv_mac.tr",
                             "old_dsdv.tr", "old_dsr.tr", "aodv_tag.tr"}) {
        check_against_awk(std::string(folder) + "/" + name);
    }
}

TEST_CASE("trace stats: traces of one run of ns-2 in both formats give equal statistics") {
    const char* folder = std::getenv("ROVERNET_TRACES");
    if (!folder) {
        MESSAGE("skipped: ROVERNET_TRACES is not set");
        return;
    }
    const std::string in = std::string(folder) + "/";
    const auto plain = ns2_stats(in + "old_aodv_mac.tr");
    CHECK(plain.counts.format() == "old");
    CHECK(plain.counts.lines == 4381);
    for (const char* name : {"new_aodv_mac.tr", "old_aodv_mac_energy.tr"}) {
        const auto other = ns2_stats(in + name);
        CHECK(other.metrics == plain.metrics);
        CHECK(other.drops == plain.drops);
        CHECK(other.drops_by_layer == plain.drops_by_layer);
        CHECK(other.routing_packets == plain.routing_packets);
        CHECK(other.routing_bytes == plain.routing_bytes);
        CHECK(other.jitter_mean == plain.jitter_mean);
        CHECK(other.jitter_rfc3550 == plain.jitter_rfc3550);
        CHECK(other.jitter_sd == plain.jitter_sd);
        CHECK(other.throughput == plain.throughput);
    }
    CHECK(plain.metrics.max_hops > 1);
    CHECK(ns2_stats(in + "wired.tr").counts.skipped_of(Ns2Other::wired) == 4489);
    const auto nam = ns2_stats(in + "wired.nam");
    CHECK(nam.counts.skipped_of(Ns2Other::nam) == nam.counts.lines);
    CHECK_THROWS_AS(ns2_stats(in + "ns3_aodv_wifi_ascii.tr"), InputError);
}

TEST_CASE(
    "trace stats: frames of S-MAC, which have signed addresses and no ethertype, are counted") {
    const TempFolder folder;
    write_file(
        folder / "smac.tr",
        "s 1.000000000 _0_ AGT  --- 0 cbr 512 [0.00 0 0] ------- [0:0 2:0 32 0] [0] 0 0\n"
        "r 1.000000000 _0_ RTR  --- 0 cbr 512 [0.00 0 0] ------- [0:0 2:0 32 0] [0] 0 0\n"
        "s 1.000000000 _0_ RTR  --- 0 AODV 48 [0.00 0 0] ------- [0:255 -1:255 30 0] [0x2 1 "
        "1 [2 0] [0 4]] (REQUEST)\n"
        "f 1.100000000 _1_ RTR  --- 0 AODV 48 [0.00 -1 0] ------- [0:255 -1:255 29 0] [0x2 1 "
        "1 [2 0] [0 4]] (REQUEST)\n"
        "s 1.200000000 _0_ RTR  --- 0 cbr 532 [0.00 0 0] ------- [0:0 2:0 30 1] [0] 0 0\n"
        "r 1.300000000 _1_ RTR  --- 0 cbr 532 [0.01 1 0] ------- [0:0 2:0 30 1] [0] 1 0\n"
        "f 1.300000000 _1_ RTR  --- 0 cbr 532 [0.01 1 0] ------- [0:0 2:0 29 2] [0] 1 0\n"
        "r 1.400000000 _2_ AGT  --- 0 cbr 532 [0.01 2 1] ------- [0:0 2:0 29 2] [0] 2 0\n"
        "D 1.500000000 _2_ MAC  COL 0 AODV 48 [0.00 -1 1] ------- [1:255 -1:255 29 0] [0x2 2 "
        "1 [2 0] [0 4]] (REQUEST)\n");
    const TraceStats s = ns2_stats(folder / "smac.tr", Ns2Strictness::strict);
    CHECK(s.routing_packets == 2);
    CHECK(s.metrics.receptions == 2);
    CHECK(s.metrics.deliveries == 1);
    CHECK(s.metrics.mean_hops == 2.0);
    CHECK(s.drops_by_layer.at({"MAC", "COL"}) == 1);
}

TEST_CASE(
    "trace stats: M lines that list options of the simulation script are skipped; invalid M lines "
    "are refused") {
    const TempFolder folder;
    write_file(folder / "in.tr",
               "M 0.0 nn 3 x 600 y 300 rp AODV\n"
               "M 0.0 sc moves.tcl cp  seed 1.0\n"
               "M 0.0 prop Propagation/TwoRayGround ant Antenna/OmniAntenna\n"
               "M 1.00000 0 (10.00, 20.00, 0.00), (50.00, 20.00), 2.00\n"
               "M 1.00000 x1 (10.00, 20.00, 0.00), (50.00, 20.00), 2.00\n"
               "M x 0 (10.00, 20.00, 0.00), (50.00, 20.00), 2.00\n");
    const TraceStats s = ns2_stats(folder / "in.tr");
    CHECK(s.counts.skipped_of(Ns2Other::header) == 3);
    CHECK(s.counts.events == 1);
    CHECK(s.counts.refused == 2);
}

TEST_CASE("trace stats: a file without any trace line is refused, whatever it contains") {
    const TempFolder folder;
    const std::vector<std::pair<std::string, std::string>> files = {

        {"<!DOCTYPE html>\n<html></html>\n", "no line of this file"},
        {"Sorry, this page\nhas moved\nelsewhere\nfor good\n", "no line of this file"}};
    for (const auto& each : files) {
        const std::string &text = each.first, &why = each.second;
        CAPTURE(text);
        write_file(folder / "in.tr", text);
        std::string told;
        try {
            ns2_stats(folder / "in.tr");
        } catch (const InputError& error) {
            told = error.what();
        }
        CHECK(told.find(why) != told.npos);
    }
}

}  // namespace ns2_stats_test
