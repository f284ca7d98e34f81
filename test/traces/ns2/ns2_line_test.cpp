// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_line.hpp"

#include <doctest/doctest.h>

#include <string>
#include <string_view>

namespace ns2_line_test {
using namespace rovernet;

namespace {

Ns2Packet packet_of(std::string_view line) {
    const Ns2Line parsed = parse_ns2_line(line);
    CAPTURE(line);
    if (const auto* refused = std::get_if<Ns2Refused>(&parsed)) {
        CAPTURE(refused->column);
        CAPTURE(refused->expected);
        FAIL("refused");
    }
    REQUIRE(std::holds_alternative<Ns2Packet>(parsed));
    return std::get<Ns2Packet>(parsed);
}

bool is_skipped(std::string_view line, Ns2Other kind) {
    const Ns2Line parsed = parse_ns2_line(line);
    const auto* other = std::get_if<Ns2Other>(&parsed);
    return other && *other == kind;
}

bool is_refused(std::string_view line) {
    return std::holds_alternative<Ns2Refused>(parse_ns2_line(line));
}

std::int64_t ns(Time t) { return t.time_since_epoch().count(); }

}  // namespace

TEST_CASE("ns-2 line: all fields of the old format are read") {
    const auto p = packet_of(
        "f 11.620993771 _6_ RTR  --- 3 cbr 532 [13a 6 5 800] ------- [5:0 3:1 29 4] [3] 1 0");
    CHECK(p.dialect == Ns2Dialect::old_format);
    CHECK(p.op == 'f');
    CHECK(ns(p.time) == 11'620'993'771);
    CHECK(p.node == NodeId{6});
    CHECK(p.layer == "RTR");
    CHECK(p.reason == "---");
    CHECK(p.uid == 3);
    CHECK(p.type == "cbr");
    CHECK(p.size == 532);
    CHECK(p.mac == Ns2Mac{0x13a, 6, 5, 0x800});
    CHECK(p.ip == Ns2Ip{5, 0, 3, 1, 29, 4});
    CHECK(p.payload == "[3] 1 0");
    CHECK_FALSE(p.position);
    CHECK_FALSE(p.energy);
}

TEST_CASE("ns-2 line: all fields of a line in the new format are read, also those of a drop") {
    const auto p = packet_of(
        "d -t 1.500000000 -Hs 2 -Hd -2 -Ni 2 -Nx 10.25 -Ny 20.50 -Nz 0.00 -Ne 99.500000 -Nl IFQ "
        "-Nw ARP -Ma 13a -Md a -Ms b -Mt 800 -Is 5.0 -Id 3.1 -It tcp -Il 1040 -If 2 -Ii 7 -Iv 29 "
        "-Pn tcp -Ps 4 -Pa 0 -Pf 1 -Po 0 ");
    CHECK(p.dialect == Ns2Dialect::new_format);
    CHECK(p.op == 'D');
    CHECK(ns(p.time) == 1'500'000'000);
    CHECK(p.node == NodeId{2});
    CHECK(p.layer == "IFQ");
    CHECK(p.reason == "ARP");
    CHECK(p.uid == 7);
    CHECK(p.type == "tcp");
    CHECK(p.size == 1040);
    CHECK(p.mac == Ns2Mac{0x13a, 10, 11, 0x800});  // hexadecimal, without 0x
    CHECK(p.ip == Ns2Ip{5, 0, 3, 1, 29, 0});
    CHECK(p.flow == 2);
    CHECK(p.position == Vec3{10.25, 20.5, 0});
    CHECK(p.energy == 99.5);
    CHECK(p.payload == "-Pn tcp -Ps 4 -Pa 0 -Pf 1 -Po 0");
}

TEST_CASE(
    "ns-2 line: in the tagged format, + is a send, h is a forward, and MAC addresses are swapped") {
    const std::string rest =
        " 1.0012345678 -s 2 -d 3 -p AODV -k MAC -i 9 -N:loc {500.00 400.00 1.00} -N:en -1.000000 "
        "-M:dur 13a -M:s ffffffff -M:d 2 -M:t 800 -IP:s 0 -IP:sp 255 -IP:d -1 -IP:dp 255 -p AODV "
        "-e 106 -c 0 -i 9 -IP:ttl 30 -aodv:t 2 -aodv:c REQUEST ";
    const std::string line = "+" + rest, forward = "h" + rest;
    const auto p = packet_of(line);
    CHECK(p.dialect == Ns2Dialect::tagged);
    CHECK(p.op == 's');
    CHECK(ns(p.time) == 1'001'234'568);
    CHECK(p.node == NodeId{2});
    CHECK(p.layer == "MAC");
    CHECK(p.type == "AODV");
    CHECK(p.uid == 9);
    CHECK(p.size == 106);
    CHECK(p.mac == Ns2Mac{0x13a, 0xffffffff, 2, 0x800});
    CHECK(p.ip == Ns2Ip{0, 255, -1, 255, 30, 3});
    CHECK(p.position == Vec3{500, 400, 1});
    CHECK_FALSE(p.energy);
    CHECK(packet_of(forward).op == 'f');
    CHECK(packet_of("d" + rest).op == 'D');
    CHECK(packet_of("r" + rest).op == 'r');
    const auto rts = packet_of(
        "+ 1 -s 2 -d -1 -p MAC -k MAC -i 0 -N:loc {5.00 4.00 1.00} -N:en -1.000000 -M:dur 13a "
        "-M:s 3 -M:d 2 -M:t 0 ");
    CHECK(rts.type.empty());
    CHECK_FALSE(rts.size);
    CHECK_FALSE(rts.ip);
}

TEST_CASE(
    "ns-2 line: lines of the MAC's control frames have no IP header; any line may have the robot's "
    "energy") {
    for (const std::string energy : {"", "[energy 98.3 ei 1.3 es 0.0 et 0.1 er 0.2] "}) {
        const std::string line = "D 3.541349000 _2_ MAC  RET 0 RTS 44 [14ee 3 2 0] " + energy;
        const auto p = packet_of(line);
        CHECK(p.type == "RTS");
        CHECK(p.reason == "RET");
        CHECK(p.mac == Ns2Mac{0x14ee, 3, 2, 0});
        CHECK_FALSE(p.ip);
        CHECK(p.energy.has_value() == !energy.empty());
    }
    const auto p = packet_of(
        "s 1.0 _0_ MAC  --- 0 message 122 [0 ffffffff 0 800] [energy 98.25 ei 1.3 es 0.0 et 0.1 er "
        "0.2] ------- [0:42 -1:42 32 0] ");
    CHECK(p.energy == 98.25);
    CHECK(p.ip == Ns2Ip{0, 42, -1, 42, 32, 0});
    const auto in_new = packet_of(
        "r -t 1.0 -Hs 1 -Hd -2 -Ni 1 -Nx 1.00 -Ny 1.00 -Nz 0.00 -Ne -1.000000 -Nl MAC -Nw --- -Ma "
        "0 -Md 1 -Ms 0 -Mt 0 ");
    CHECK(in_new.type.empty());
    CHECK_FALSE(in_new.size);
    CHECK_FALSE(in_new.ip);
}

TEST_CASE("ns-2 line: the line of an ARP packet has no IP header, in any format") {
    const auto old_arp = packet_of(
        "r 11.184857138 _0_ MAC  --- 0 ARP 28 [0 ffffffff 3 806] ------- [REQUEST 3/3 "
        "0/0]");
    CHECK(old_arp.type == "ARP");
    CHECK_FALSE(old_arp.ip);
    CHECK(old_arp.payload == "[REQUEST 3/3 0/0]");
    const auto new_arp = packet_of(
        "r -t 11.2 -Hs 6 -Hd -2 -Ni 6 -Nx 7.55 -Ny 3.19 -Nz 0.00 -Ne -1.000000 -Nl MAC -Nw --- "
        "-Ma 0 -Md ffffffff -Ms 0 -Mt 806 -P arp -Po REQUEST -Pms 0 -Ps 0 -Pmd 0 -Pd 2 ");
    CHECK(new_arp.type == "ARP");
    CHECK_FALSE(new_arp.ip);
}

TEST_CASE(
    "ns-2 line: a line of the physical layer has no MAC part; the MAC part of S-MAC may have "
    "decimals") {
    CHECK_FALSE(packet_of("D 1.0 _2_ PHY  --- 4 cbr 512 ").mac);
    const auto smac = packet_of("s 1.0 _2_ MAC  --- 4 cbr 512 [0.25 3 2] ------- [2:0 3:0 32 3] ");
    CHECK(smac.mac == Ns2Mac{0, 3, 2, 0});
    CHECK(smac.ip->ttl == 32);
}

TEST_CASE("ns-2 line: the unusual MAC addresses of Mac/Simple are read unchanged") {
    const auto p = packet_of(
        "s -t 1.0 -Hs 0 -Hd 1 -Ni 0 -Nx 1.00 -Ny 1.00 -Nz 0.00 -Ne -1.000000 -Nl MAC -Nw --- -Ma "
        "0 -Md 1000000 -Ms ffff0008 -Mt 0 -Is 0.0 -Id 1.0 -It cbr -Il 512 -If 0 -Ii 0 -Iv 32 ");
    CHECK(p.mac == Ns2Mac{0, 0x1000000, 0xffff0008, 0});
}

TEST_CASE("ns-2 line: M (movement), N (energy) and v (annotation) lines are read") {
    const Ns2Line m = parse_ns2_line("M 2.00000 3 (6.59, 418.73, 1.00), (67.99, 108.50), 14.52");
    REQUIRE(std::holds_alternative<Ns2Move>(m));
    CHECK(std::get<Ns2Move>(m).from == Vec3{6.59, 418.73, 1});
    CHECK(std::get<Ns2Move>(m).to == Vec3{67.99, 108.5, 1});
    CHECK(std::get<Ns2Move>(m).speed == 14.52);
    for (const char* line : {"N -t 11.171413 -n 6 -e 99.441175", "N -t 11.171413 -n 6 -e 0 "}) {
        const Ns2Line n = parse_ns2_line(line);
        REQUIRE(std::holds_alternative<Ns2Energy>(n));
        CHECK(std::get<Ns2Energy>(n).node == NodeId{6});
        CHECK(ns(std::get<Ns2Energy>(n).time) == 11'171'413'000);
    }
    const Ns2Line v = parse_ns2_line("v 1.5 eval {set sim_annotation {reachable 7 4}}");
    REQUIRE(std::holds_alternative<Ns2Reachable>(v));
    CHECK(std::get<Ns2Reachable>(v).uid == 7);
    CHECK(std::get<Ns2Reachable>(v).robots == 4);
    CHECK(is_skipped("v 1.0015366666666667 eval {set sim_annotation {1 received {1:hello} from 0}}",
                     Ns2Other::annotation));
    CHECK(is_skipped("v 0.8 link-down 2 1", Ns2Other::annotation));
}

TEST_CASE("ns-2 line: a line that begins with S is a statistic of DSR, not a send") {
    for (const char* line :
         {"Sconfig 0.00000 tap: on snoop: rts? on errs? on",
          "SFESTs 11.274295496 _5_ 0 [5 -> 3] 1(1) to 6 [5 |6 0 8 3 ]",
          "Ssalv 27.31490 _6_ adding to SB --- 156 5 -> 3 [0]", "S$hit 1.0 _1_", "SIFQ 1.0"}) {
        CAPTURE(line);
        CHECK(is_skipped(line, Ns2Other::dsr));
    }
    CHECK(is_refused("S 1.0 _1_ AGT  --- 0 cbr 512"));
}

TEST_CASE("ns-2 line: lines of wired links, of nam and of ns itself are recognised and skipped") {
    for (const char* line :
         {"+ 0.1 1 2 cbr 1000 ------- 2 1.0 3.1 0 0", "- 0.108 1 2 cbr 1000 ------- 2 1.0 3.1 1 1",
          "r 0.80000000000000004 1 2 tcp 40 ------- 2 1.0 3.1 0 0",
          "d 0.114 1 2 ack 40 ------- 2 1.0.3 3.0.1 0 0"}) {
        CAPTURE(line);
        CHECK(is_skipped(line, Ns2Other::wired));
    }
    for (const char* line :
         {"V -t * -v 1.0a5 -a 0", "n -t * -s 0  -x 100 -y 500 -Z 0 -z 20",
          "+ -t 0.1 -s 1 -d 2 -p cbr -e 1000 -c 2 -i 0 -a 2", "r -t 0.114 -s 1 -d 2 -p cbr -e 1000",
          "h -t 0.1 -s 1 -d 2", "v -t 1.0 -e sim_annotation 1.0 1 hello"}) {
        CAPTURE(line);
        CHECK(is_skipped(line, Ns2Other::nam));
    }
    CHECK(is_skipped("INITIALIZE THE LIST xListHead", Ns2Other::message));
    CHECK(is_skipped("SORTING LISTS ...DONE!", Ns2Other::message));
    CHECK(is_skipped("", Ns2Other::blank));
    CHECK(is_skipped(" \t ", Ns2Other::blank));
    CHECK(is_skipped("# nodes: 3", Ns2Other::comment));
}

TEST_CASE("ns-2 line: times may have any number of digits, and invalid times are refused") {
    const auto time_of = [](const std::string& time) {
        const Ns2Line line = parse_ns2_line("N -t " + time + " -n 6 -e 1");
        REQUIRE(std::holds_alternative<Ns2Energy>(line));
        return ns(std::get<Ns2Energy>(line).time);
    };
    CHECK(time_of("1") == 1'000'000'000);
    CHECK(time_of("0.80000000000000004") == 800'000'000);
    CHECK(time_of("1.00138366666667") == 1'001'383'667);
    CHECK(time_of("0.9999999996") == 1'000'000'000);
    CHECK(time_of("2.5e-05") == 25'000);
    for (const char* time : {"-1", "nan", "1.5.2", "9300000000", "1.x", "", "inf", "1e99"}) {
        CAPTURE(time);
        CHECK(is_refused("N -t " + std::string(time) + " -n 6 -e 1"));
    }
}

TEST_CASE("ns-2 line: a line of none of the known kinds is refused") {
    for (const char* line :
         {"t 0.02105 /NodeList/0/DeviceList/0 DsssRate1Mbps",
          "r 0.0219142 DsssRate1Mbps /NodeList/1/DeviceList/0", "[scenario]", "name = \"A\"",
          "s 1.0 _-1_ AGT  --- 0 cbr 512 [0 0 0 0] ------- [5:0 3:1 32 0] [0] 0 0",
          "s 1.0 _1048576_ AGT  --- 0 cbr 512 [0 0 0 0] ------- [5:0 3:1 32 0] [0] 0 0",
          "s 1.0 _1_ AGT  --- 0 cbr -512 [0 0 0 0] ------- [5:0 3:1 32 0] [0] 0 0",
          "s 1.0 _1_ AGT  --- 0 cbr 512 [0 0 0 0] ------- [5:0 3:1 32 0", "s", "r 1.0",
          "D 1.0 _1_ RTR  WHY 0 cbr 512 [0 0 0 0] ------- [5:0 3:1 32 0] [0] 0 0"}) {
        CAPTURE(line);
        CHECK(is_refused(line));
    }
}

}  // namespace ns2_line_test
