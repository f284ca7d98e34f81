// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_convert.hpp"

#include "test/traces/record_stream.hpp"
#include "traces/ns2/ns2_diff.hpp"
#include "traces/ns2/ns2_follow.hpp"
#include "traces/ns2/ns2_stats.hpp"
#include "traces/ns2/ns2_text.hpp"
#include "traces/ns2/ns2_trace.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <sstream>
#include <string>

namespace ns2_convert_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

/// A random run, written in a format.
std::string written(Ns2Format format, MacTrace mac = MacTrace::off, unsigned seed = 5) {
    const TempFolder folder;
    Stream stream;
    const auto trace = std::make_shared<Ns2Trace>(folder / "run.tr", format, mac);
    stream.sinks = {trace};
    RandomRecords(stream, seed).run(12, 1'500);
    trace->close();
    return content(folder / "run.tr");
}

struct Made {
    std::string text;
    Converted converted;
};

Made converted(const std::string& text, TraceForm form) {
    const TempFolder folder;
    write_file(folder / "in.tr", text);
    const Converted made = convert_ns2(folder / "in.tr", folder / "out", form);
    return {content(folder / "out"), made};
}

Made cut(const std::string& text, const TraceCut& piece) {
    const TempFolder folder;
    write_file(folder / "in.tr", text);
    const Converted made = cut_ns2(folder / "in.tr", folder / "out", piece);
    return {content(folder / "out"), made};
}

TraceDifference difference(const std::string& a, const std::string& b, Duration tolerance = {},
                           DiffExtent extent = DiffExtent::whole) {
    const TempFolder folder;
    write_file(folder / "a.tr", a);
    write_file(folder / "b.tr", b);
    return diff_ns2(folder / "a.tr", folder / "b.tr", tolerance, Ns2Strictness::tolerant, extent);
}

const std::string moves =
    "M 0.00000 0 (0.00, 0.00, 0.00), (0.00, 0.00), 0.00\n"
    "M 0.00000 1 (3.00, 0.00, 1.00), (3.00, 4.00), 2.00\n";
const std::string sent_0 =
    "s 1.000000000 _0_ AGT  --- 0 message 64 [0 0 0 0] ------- [0:0 -1:0 3 0] \n"
    "r 1.000000000 _0_ RTR  --- 0 message 64 [0 0 0 0] ------- [0:0 -1:0 3 0] \n"
    "s 1.000000000 _0_ RTR  --- 0 message 64 [0 0 0 0] ------- [0:0 -1:0 3 0] \n";
const std::string got_1 =
    "r 1.500000000 _1_ RTR  --- 0 message 64 [0 ffffffff 0 800] ------- [0:0 -1:0 3 0] \n"
    "r 1.500000000 _1_ AGT  --- 0 message 64 [0 ffffffff 0 800] ------- [0:0 -1:0 3 0] \n";
const std::string on_to_2 =
    "f 1.600000000 _1_ RTR  --- 0 message 64 [0 ffffffff 0 800] ------- [0:0 -1:0 2 0] \n"
    "r 1.700000000 _2_ RTR  --- 0 message 64 [0 ffffffff 1 800] ------- [0:0 -1:0 2 0] \n"
    "r 1.700000000 _2_ AGT  --- 0 message 64 [0 ffffffff 1 800] ------- [0:0 -1:0 2 0] \n"
    "r 1.700000000 _0_ RTR  --- 0 message 64 [0 ffffffff 1 800] ------- [0:0 -1:0 2 0] \n"
    "D 1.700000000 _0_ RTR  DUP 0 message 64 [0 ffffffff 1 800] ------- [0:0 -1:0 2 0] \n"
    "D 1.700000000 _3_ MAC  COL 0 message 64 [0 ffffffff 1 800] ------- [0:0 -1:0 2 0] \n";

}  // namespace

TEST_CASE(
    "trace convert: a trace of rovernet converted to the new format and back has the same bytes") {
    for (unsigned seed = 0; seed < 5; ++seed) {
        const std::string text = written(Ns2Format::old_format, MacTrace::off, seed);
        const Made in_new = converted(text, TraceForm::ns2_new);
        CHECK(in_new.converted.left_out.empty());
        CHECK(in_new.converted.counts.refused == 0);
        CHECK(converted(in_new.text, TraceForm::ns2_old).text == text);
    }
}

TEST_CASE(
    "trace convert: a trace in ns-2's new format becomes the trace that the run writes in the old "
    "format") {
    const Made made = converted(written(Ns2Format::new_format), TraceForm::ns2_old);
    CHECK(made.text == written(Ns2Format::old_format));
}

TEST_CASE(
    "trace convert: a trace in ns-2's old format becomes the run's trace in the new format, except "
    "for positions") {
    const std::string expected = written(Ns2Format::new_format);
    const std::string made = converted(written(Ns2Format::old_format), TraceForm::ns2_new).text;
    std::istringstream a(expected), b(made);
    std::string left, right;
    const auto without_places = [](std::string line) {
        const std::size_t from = line.find(" -Nx "), to = line.find(" -Ne ");
        return from == line.npos ? line : line.erase(from, to - from);
    };
    while (std::getline(a, left)) {
        REQUIRE(std::getline(b, right));
        REQUIRE(without_places(left) == without_places(right));
    }
    CHECK_FALSE(std::getline(b, right));
    const std::string at_1 = converted(moves + got_1, TraceForm::ns2_new).text;
    CHECK(at_1.find("-Nx 3.00 -Ny 3.00 -Nz 1.00") != at_1.npos);  // 1.5 s at 2 m/s
}

TEST_CASE("trace convert: control frames of the MAC are omitted with a notice") {
    const std::string text = written(Ns2Format::old_format, MacTrace::on);
    std::istringstream lines(text);
    std::string line, expected;
    std::uint64_t control = 0;
    while (std::getline(lines, line)) {
        const bool is_control =
            line.find("-------") == line.npos && line[0] != 'M' && line[0] != 'v';
        control += is_control ? 1 : 0;
        if (!is_control) expected += line + "\n";
    }
    REQUIRE(control > 0);
    const Made made = converted(text, TraceForm::ns2_new);
    REQUIRE(made.converted.left_out.size() == 1);
    CHECK(made.converted.left_out.begin()->second == control);
    CHECK(made.converted.left_out.begin()->first.find("RTS, CTS, ACK") != std::string::npos);
    CHECK(converted(made.text, TraceForm::ns2_old).text == expected);
}

TEST_CASE(
    "trace convert: fields of CBR and TCP packets are converted between the old and new format") {
    const std::string place = "M 0.00000 5 (1.00, 2.00, 0.00), (1.00, 2.00), 0.00\n";
    const std::string cbr =
        "r 1.000000000 _5_ RTR  --- 3 cbr 532 [13a a 5 800] ------- [5:0 3:1 30 6] [3] 1 0\n";
    const std::string tcp =
        "s 1.000000000 _5_ AGT  --- 4 tcp 1040 [0 0 0 0] ------- [5:0 3:1 32 0] [7 0] 0 0\n";
    const Made made = converted(place + cbr + tcp, TraceForm::ns2_new);
    CHECK(made.text ==
          place +
              "r -t 1.000000000 -Hs 5 -Hd 6 -Ni 5 -Nx 1.00 -Ny 2.00 -Nz 0.00 -Ne -1.000000 -Nl RTR "
              "-Nw --- -Ma 13a -Md a -Ms 5 -Mt 800 -Is 5.0 -Id 3.1 -It cbr -Il 532 -If 0 -Ii 3 "
              "-Iv 30 -Pn cbr -Pi 3 -Pf 1 -Po 0 \n"
              "s -t 1.000000000 -Hs 5 -Hd -2 -Ni 5 -Nx 1.00 -Ny 2.00 -Nz 0.00 -Ne -1.000000 -Nl "
              "AGT -Nw --- -Ma 0 -Md 0 -Ms 0 -Mt 0 -Is 5.0 -Id 3.1 -It tcp -Il 1040 -If 0 -Ii 4 "
              "-Iv 32 -Pn tcp -Ps 7 -Pa 0 -Pf 0 -Po 0 \n");
    CHECK(converted(made.text, TraceForm::ns2_old).text == place + cbr + tcp);
    const Made routing = converted(
        place + "s 1.0 _5_ RTR  --- 0 AODV 48 [0 0 0 0] ------- [5:255 -1:255 30 0] [0x2 1] \n",
        TraceForm::ns2_new);
    CHECK(routing.text == place);
    CHECK(routing.converted.left_out.size() == 1);
    const Made unplaced = converted(cbr, TraceForm::ns2_new);
    CHECK(unplaced.text.empty());
    CHECK(unplaced.converted.left_out.begin()->first.find("without an earlier M line") !=
          std::string::npos);
}

TEST_CASE("trace convert: a CSV has a row for each event, with as many cells as its header") {
    const std::string text =
        moves + "N -t 0.500000 -n 1 -e 99.5\n" + "v 1 eval {set sim_annotation {reachable 0 1}}\n" +
        sent_0 + got_1 + "D 3.541349000 _2_ MAC  RET 0 RTS 44 [14ee 3 2 0] \n" + "# a comment\n" +
        "s 1.0 _2_ AGT  --- 9 a,\"b 5 [0 0 0 0] ------- "
        "[2:0 3:0 3 0] \n";
    const Made made = converted(text, TraceForm::csv);
    std::istringstream lines(made.text);
    std::string line;
    std::vector<std::string> rows;
    while (std::getline(lines, line)) rows.push_back(line);
    REQUIRE(rows.size() == 1 + 2 + 2 + 3 + 2 + 1 + 1);
    CHECK(rows[0] == ns2_csv_head);
    const auto commas = [](const std::string& row) {
        return std::count(row.begin(), row.end(), ',');
    };
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) CHECK(commas(rows[i]) == commas(rows[0]));
    CHECK(rows[2] == "M,0.000000000,1,,,,,,,,,,,,,,,3,0,1,,3,4,2,");
    CHECK(rows[3] == "N,0.500000000,1,,,,,,,,,,,,,,,,,,99.5,,,,");
    CHECK(rows[4] == "v,1.000000000,,,,0,,,,,,,,,,,,,,,,,,,1");
    CHECK(rows[9] == "r,1.500000000,1,AGT,,0,message,64,0,4294967295,0,2048,0,0,-1,0,3,,,,,,,,");
    CHECK(rows[10] == "D,3.541349000,2,MAC,RET,0,RTS,44,5358,3,2,0,,,,,,,,,,,,,");
    CHECK(rows[11].find("\"a,\"\"b\"") != std::string::npos);
}

TEST_CASE("trace cut: lines are selected by time, robot and message") {
    const std::string other =
        "s 2.000000000 _1_ AGT  --- 1 message 64 [0 0 0 0] ------- [1:0 -1:0 3 0] \n";
    const std::string all = moves + sent_0 + got_1 + other;
    CHECK(cut(all, {}).text == all);
    CHECK(cut(all, {.from = at(1'500'000'000)}).text == moves + got_1 + other);
    CHECK(cut(all, {.to = at(1'500'000'000)}).text == moves + sent_0);
    CHECK(cut(all, {.message = 1}).text == moves + other);
    CHECK(cut(all, {.robot = NodeId{0}}).text == moves.substr(0, moves.find('\n') + 1) + sent_0);
    CHECK(cut(all, {.message = 9}).converted.written == 2);
    std::string dos = all;
    for (std::size_t i = 0; (i = dos.find('\n', i)) != dos.npos; i += 2) dos.insert(i, 1, '\r');
    CHECK(cut("# by hand\n" + dos, {}).text == all);
}

TEST_CASE("trace cut: a trace cut to one message has all deliveries of the message") {
    const TempFolder folder;
    write_file(folder / "in.tr", written(Ns2Format::old_format));
    const auto whole = ns2_stats(folder / "in.tr");
    std::uint64_t deliveries = 0;
    for (std::uint64_t uid = 0; uid < whole.metrics.messages; ++uid) {
        cut_ns2(folder / "in.tr", folder / "out.tr", {.message = uid});
        const auto piece = ns2_stats(folder / "out.tr");
        CHECK(piece.metrics.messages == 1);
        deliveries += piece.metrics.deliveries;
    }
    CHECK(deliveries == whole.metrics.deliveries);
}

TEST_CASE("trace diff: traces of a run in both ns-2 formats are equal, also with added comments") {
    const std::string old_text = written(Ns2Format::old_format, MacTrace::on);
    const std::string new_text = written(Ns2Format::new_format, MacTrace::on);
    CHECK(difference(old_text, new_text).is_equal);
    CHECK(difference("# by hand\n\n" + old_text, new_text).is_equal);
    const auto other = difference(old_text, written(Ns2Format::old_format, MacTrace::on, 6));
    CHECK_FALSE(other.is_equal);
}

TEST_CASE("trace diff: the first different field, the lines around it and all counts are shown") {
    const std::string a = moves + sent_0 + got_1 + on_to_2;
    std::string b = a;
    b.replace(b.find("r 1.500000000"), 13, "r 1.500000001");
    const auto d = difference(a, b);
    CHECK_FALSE(d.is_equal);
    CHECK(d.field == "time");
    REQUIRE(d.place == 2);
    REQUIRE(d.a.size() == 5);
    CHECK(d.a[2].line == 6);
    CHECK(d.b[2].text.starts_with("r 1.500000001"));
    CHECK(d.kinds.at("r AGT") == std::pair<std::uint64_t, std::uint64_t>{2, 2});
    CHECK(d.kinds.at("D MAC COL") == std::pair<std::uint64_t, std::uint64_t>{1, 1});
    CHECK(difference(a, b, Duration{1}).is_equal);
    const auto shorter = difference(a, moves + sent_0 + got_1);
    CHECK(shorter.field == "B ends before A");
    CHECK(shorter.b.size() == 2);
    CHECK(shorter.kinds.at("D MAC COL") == std::pair<std::uint64_t, std::uint64_t>{1, 0});
    CHECK(difference(moves, moves + sent_0).field == "A ends before B");
    const auto changed = [&](const std::string& what, const std::string& by) {
        std::string c = a;
        c.replace(c.find(what), what.size(), by);
        return difference(a, c).field;
    };
    CHECK(changed(" 64 [0", " 65 [0") == "size");
    CHECK(changed("-1:0 3 0]", "-1:0 4 0]") == "ttl");
    CHECK(changed("[0 ffffffff 0 800]", "[0 ffffffff 2 800]") == "MAC header");
    CHECK(changed("COL", "ERR") == "reason");
    CHECK(changed("(3.00, 4.00)", "(3.00, 5.00)") == "goal");
    CHECK(changed("message", "cbr") == "type");
    CHECK(changed("M 0.00000 1", "M 0.00000 2") == "robot");
}

TEST_CASE("trace diff: reading only up to the first difference finds the same difference") {
    const std::string a = moves + sent_0 + got_1 + on_to_2;
    std::string b = a;
    b.replace(b.find("r 1.500000000"), 13, "r 1.500000001");
    for (const std::string& other : {b, moves + sent_0, std::string(a)}) {
        const auto whole = difference(a, other);
        const auto first = difference(a, other, {}, DiffExtent::first_difference);
        CHECK(first.is_equal == whole.is_equal);
        CHECK(first.field == whole.field);
        CHECK(first.place == whole.place);
        if (whole.is_equal) continue;
        REQUIRE(first.a.size() == first.place + 1);
        CHECK(first.a[first.place].line == whole.a[whole.place].line);
        CHECK((first.b.size() > first.place) == (whole.b.size() > whole.place));
    }
}

TEST_CASE("trace diff: traces of one run of ns-2 in both formats are equal") {
    const char* folder = std::getenv("ROVERNET_TRACES");
    if (!folder) {
        MESSAGE("skipped: ROVERNET_TRACES is not set");
        return;
    }
    const std::string in = std::string(folder) + "/";
    const auto d = diff_ns2(in + "old_aodv_mac.tr", in + "new_aodv_mac.tr", Duration{0});
    CHECK(d.field == "");
    CHECK_FALSE(diff_ns2(in + "old_aodv_mac.tr", in + "old_dsr.tr", Duration{0}).is_equal);
}

TEST_CASE(
    "trace follow: the relay tree of a message, its losses and the robots without a copy are "
    "found") {
    const TempFolder folder;
    write_file(folder / "run.tr", moves + "M 0.0 4 (0.00, 0.00, 0.00), (0.00, 0.00), 0.00\n" +
                                      sent_0 + got_1 + on_to_2);
    const auto way = follow_ns2(folder / "run.tr", 0);
    CHECK(way.type == "message");
    CHECK(way.origin == NodeId{0});
    CHECK(way.size == 64);
    REQUIRE(way.robots.size() == 3);
    CHECK(way.robots[0].depth == 0);
    CHECK(way.robots[0].on_air == std::vector<Time>{at(1'000'000'000)});
    CHECK(way.robots[1].robot == NodeId{1});
    CHECK(way.robots[1].from == NodeId{0});
    CHECK(way.robots[1].is_delivered);
    CHECK(way.robots[1].copies == 1);
    CHECK(way.robots[1].on_air == std::vector<Time>{at(1'600'000'000)});
    CHECK(way.robots[2].robot == NodeId{2});
    CHECK(way.robots[2].from == NodeId{1});
    CHECK(way.robots[2].depth == 2);
    CHECK(way.robots[2].hops == 2);
    REQUIRE(way.lost.size() == 2);
    CHECK(way.lost[0].reason == "DUP");
    CHECK(way.lost[1].robot == NodeId{3});
    CHECK(way.lost[1].from == NodeId{1});
    CHECK(way.without == std::vector<NodeId>{{3}, {4}});
    try {
        follow_ns2(folder / "run.tr", 7);
        FAIL("there is no message 7");
    } catch (const InputError& e) {
        CHECK(e.message() ==
              "found no message with the id 7; expected the id of a message, from 0 to 0");
    }
}

TEST_CASE(
    "trace follow: the number of hops of a copy is computed from its TTL, also if its sender "
    "forwarded the message twice") {
    const TempFolder folder;
    const std::string again =
        "f 1.620000000 _1_ RTR  --- 0 message 64 [0 ffffffff 0 800] ------- [0:0 -1:0 1 0] \n"
        "r 1.720000000 _4_ RTR  --- 0 message 64 [0 ffffffff 1 800] ------- [0:0 -1:0 1 0] \n";
    write_file(folder / "run.tr", moves + sent_0 + got_1 + on_to_2 + again);
    const auto way = follow_ns2(folder / "run.tr", 0);
    REQUIRE(way.robots.size() == 4);
    CHECK(way.robots[3].robot == NodeId{4});
    CHECK(way.robots[3].depth == 2);
    CHECK(way.robots[3].hops == 3);
}

TEST_CASE(
    "trace follow: deliveries and drops, added up over all messages, are those of the trace") {
    const TempFolder folder;
    write_file(folder / "run.tr", written(Ns2Format::new_format, MacTrace::on));
    const auto stats = ns2_stats(folder / "run.tr");
    std::uint64_t delivered = 0, lost = 0, expected = 0;
    for (std::uint64_t uid = 0; uid < stats.metrics.messages; ++uid) {
        const auto way = follow_ns2(folder / "run.tr", uid);
        for (const auto& robot : way.robots) delivered += robot.is_delivered ? 1 : 0;
        lost += way.lost.size();
    }
    for (const auto& drop : stats.drops) expected += drop.second;
    CHECK(delivered == stats.metrics.deliveries);
    CHECK(lost == expected);
}

}  // namespace ns2_convert_test
