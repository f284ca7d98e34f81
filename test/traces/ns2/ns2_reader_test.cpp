// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_reader.hpp"

#include "sim/error.hpp"
#include "sim/legs.hpp"
#include "test/traces/ns2/trace_metrics.hpp"
#include "test/traces/record_stream.hpp"
#include "traces/ns2/ns2_trace.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <sstream>
#include <string>

namespace ns2_reader_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

const std::string old_lines =
    "M 0.00000 0 (0.00, 0.00, 0.00), (0.00, 0.00), 0.00\n"
    "M 0.00000 1 (3.00, 0.00, 1.00), (3.00, 4.00), 2.00\n"
    "s 1.000000000 _0_ AGT  --- 0 message 64 [0 0 0 0] ------- [0:0 -1:0 3 0] \n"
    "r 1.000000000 _0_ RTR  --- 0 message 64 [0 0 0 0] ------- [0:0 -1:0 3 0] \n"
    "s 1.000000000 _0_ RTR  --- 0 message 64 [0 0 0 0] ------- [0:0 -1:0 3 0] \n"
    "r 1.000520067 _1_ RTR  --- 0 message 64 [0 ffffffff 0 800] ------- [0:0 -1:0 3 0] \n"
    "r 1.000520067 _1_ AGT  --- 0 message 64 [0 ffffffff 0 800] ------- [0:0 -1:0 3 0] \n";

const std::string new_start =
    "s -t 1.000000000 -Hs 0 -Hd -2 -Ni 0 -Nx 0.00 -Ny 0.00 -Nz 0.00 -Ne -1.000000 -Nl AGT -Nw --- "
    "-Ma 0 -Md 0 -Ms 0 -Mt 0 ";
const std::string new_line = new_start + "-Is 0.0 -Id -1.0 -It message -Il 64 -If 0 -Ii 0 -Iv 3 \n";

MetricValues metrics_of(const std::string& text) {
    const TempFolder folder;
    write_file(folder / "run.tr", text);
    return trace_metrics(folder / "run.tr");
}

/// The message of the InputError that `text`, read strictly, ends in, with its place in the file;
/// "" if none does.
std::string error_of(const std::string& text) {
    const TempFolder folder;
    write_file(folder / "run.tr", text);
    try {
        trace_metrics(folder / "run.tr", Ns2Strictness::strict);
    } catch (const InputError& e) {
        const std::string what = e.what();
        return what.substr(what.rfind("run.tr"));
    }
    return "";
}

/// Keeps what comes.
struct Collected {
    struct Copy {
        Frame frame;
        Reception reception;
    };
    std::vector<Sent> sent;
    std::vector<Transmitted> transmitted;
    std::vector<Copy> received;
    std::vector<Dropped> dropped;
    std::vector<Moved> moved;
    std::vector<Message> messages;
    Legs legs;

    KindMask kinds() const { return kind_all; }
    void on(const Record& record, const RecordContext& context) {
        legs = context.legs;
        if (const auto* s = std::get_if<Sent>(&record)) {
            sent.push_back(*s);
            messages.push_back(context.messages[s->message]);
        }
        if (const auto* t = std::get_if<Transmitted>(&record)) transmitted.push_back(*t);
        if (const auto* d = std::get_if<Dropped>(&record)) dropped.push_back(*d);
        if (const auto* m = std::get_if<Moved>(&record)) moved.push_back(*m);
        if (const auto* r = std::get_if<Received>(&record)) {
            for (const auto& rx : r->receptions) received.push_back({r->frame, rx});
        }
    }
};

Collected records_of(const std::string& text) {
    const TempFolder folder;
    write_file(folder / "run.tr", text);
    const auto collected = std::make_shared<Collected>();
    read_ns2_trace(folder / "run.tr", collected);
    return *collected;
}

/// The trace of a random run, and what the run itself measured.
struct Recorded {
    std::string text;
    MetricValues values;

    Recorded(Ns2Format format, unsigned seed, int robots, int records,
             MacTrace mac = MacTrace::off) {
        const TempFolder folder;
        Stream stream;
        const auto trace = std::make_shared<Ns2Trace>(folder / "run.tr", format, mac);
        const auto metrics = std::make_shared<Metrics>();
        stream.sinks = {trace, metrics};
        RandomRecords(stream, seed).run(robots, records);
        trace->close();
        text = content(folder / "run.tr");
        values = metrics->values();
    }
};

}  // namespace

TEST_CASE(
    "ns-2 reader: metrics from a trace with MAC lines equal those of the run, to the last digit") {
    for (const auto format : {Ns2Format::old_format, Ns2Format::new_format}) {
        for (unsigned seed = 0; seed < 20; ++seed) {
            const Recorded run(format, seed, 2 + static_cast<int>(seed) * 7, 2'000, MacTrace::on);
            const auto read = metrics_of(run.text);
            REQUIRE(run.values.deliveries > 0);
            REQUIRE(run.values.drops[2].count > 0);
            CHECK(read.messages == run.values.messages);
            CHECK(read.transmissions == run.values.transmissions);
            CHECK(read.receptions == run.values.receptions);
            CHECK(read.deliveries == run.values.deliveries);
            CHECK(read.drops == run.values.drops);
            CHECK(read.delivery_ratio == run.values.delivery_ratio);
            CHECK(read.reach == run.values.reach);
            CHECK(read.saved_rebroadcasts == run.values.saved_rebroadcasts);
            CHECK(read.latency == run.values.latency);
            CHECK(read.hops == run.values.hops);
            CHECK(read == run.values);
        }
    }
}

TEST_CASE("ns-2 reader: without MAC lines everything is read except losses on air") {
    for (const auto format : {Ns2Format::old_format, Ns2Format::new_format}) {
        for (unsigned seed = 0; seed < 5; ++seed) {
            const Recorded plain(format, seed, 20, 1'000);
            const Recorded with(format, seed, 20, 1'000, MacTrace::on);
            REQUIRE(with.text.size() > plain.text.size());
            CHECK(metrics_of(with.text) == plain.values);
            const auto read = metrics_of(plain.text);
            CHECK(read.deliveries == plain.values.deliveries);
            CHECK(read.delivery_ratio == plain.values.delivery_ratio);
            CHECK(read.latency == plain.values.latency);
            const auto a = records_of(with.text), b = records_of(plain.text);
            CHECK(a.transmitted.size() == b.transmitted.size());
            CHECK(a.received.size() >= b.received.size());
        }
    }
}

TEST_CASE("ns-2 reader: a trace that is read and written again is unchanged") {
    const Recorded run(Ns2Format::old_format, 7, 30, 3'000);
    const TempFolder folder;
    write_file(folder / "run.tr", run.text);
    const auto copy = std::make_shared<Ns2Trace>(folder / "copy.tr", Ns2Format::old_format);
    read_ns2_trace(folder / "run.tr", copy);
    copy->close();
    const auto is_movement = [](const std::string& line) { return line.starts_with("M "); };
    std::istringstream lines(run.text), copied(content(folder / "copy.tr"));
    std::string line, other;
    int differences = 0;
    while (std::getline(lines, line)) {
        REQUIRE(std::getline(copied, other));
        // A speed read at 1 cm/s may round to its neighbour once it is a velocity.
        if (!is_movement(line) && line != other) ++differences;
    }
    CHECK(differences == 0);
    CHECK_FALSE(std::getline(copied, other));
}

TEST_CASE("ns-2 reader: every field of a run's records is reconstructed from the trace") {
    const auto r = records_of(
        old_lines +
        "f 1.002000000 _1_ RTR  --- 0 message 64 [0 ffffffff 0 800] ------- [0:0 -1:0 2 0] \n"
        "D 1.003000000 _0_ MAC  SLP 0 message 64 [0 ffffffff 1 800] ------- [0:0 -1:0 2 0] \n"
        "D 1.004000000 _1_ RTR  SLP 0 message 64 [0 ffffffff 0 800] ------- [0:0 -1:0 3 0] \n");
    REQUIRE(r.sent.size() == 1);
    CHECK(r.sent[0].time == at(1'000'000'000));
    CHECK(r.sent[0].ttl == 3);
    CHECK(r.sent[0].robots == 2);
    CHECK_FALSE(r.sent[0].reachable);
    CHECK(r.messages[0].origin == NodeId{0});
    CHECK(r.messages[0].size == 64);
    CHECK(r.messages[0].created == at(1'000'000'000));
    REQUIRE(r.transmitted.size() == 2);
    CHECK_FALSE(r.transmitted[0].heard_from);
    CHECK(r.transmitted[1].heard_from == NodeId{0});
    CHECK(r.transmitted[1].frame.sender == NodeId{1});
    CHECK(r.transmitted[1].frame.ttl == 2);
    CHECK(r.transmitted[1].frame.hops == 2);
    REQUIRE(r.received.size() == 2);
    CHECK(r.received[0].frame.sender == NodeId{0});
    CHECK(r.received[0].frame.hops == 1);
    CHECK(r.received[0].reception.node == NodeId{1});
    CHECK(r.received[0].reception.time == at(1'000'520'067));
    CHECK(r.received[0].reception.delivered);
    CHECK(r.received[0].reception.fate == Fate::waiting);
    CHECK(r.received[1].reception.fate == Fate::off);
    REQUIRE(r.dropped.size() == 1);
    CHECK(r.dropped[0].node == NodeId{1});
    CHECK(r.dropped[0].frame.sender == NodeId{0});
}

TEST_CASE(
    "ns-2 reader: an annotation (number of reachable robots) applies only to the message that it "
    "names") {
    const auto annotated = [](const std::string& uid) {
        return records_of("v 1 eval {set sim_annotation {reachable " + uid + " 1}}\n" + old_lines)
            .sent[0]
            .reachable;
    };
    CHECK(annotated("0") == 1);
    CHECK_FALSE(annotated("7"));
}

TEST_CASE("ns-2 reader: robots move as in the M lines (movements) of the trace") {
    const auto r = records_of(old_lines);
    REQUIRE(r.moved.size() == 2);
    CHECK(r.legs.leg(NodeId{0}).end == never);
    CHECK(r.legs.leg(NodeId{1}).end == at(2'000'000'000));  // 4 m at 2 m/s
    CHECK(r.legs.position(NodeId{1}, at(1'000'000'000)) == Vec3{3, 2, 1});
    CHECK(r.legs.position(NodeId{1}, at(9'000'000'000)) == Vec3{3, 4, 1});
}

TEST_CASE(
    "ns-2 reader: one file may contain lines of both ns-2 formats, and any kind of line ends") {
    CHECK(metrics_of(old_lines).deliveries == 1);
    CHECK(metrics_of(new_line).messages == 1);
    const std::string second = "s 2.0 _1_ AGT  --- 1 message 9 [0 0 0 0] ------- [1:0 -1:0 3 0]";
    CHECK(metrics_of(new_line + second).messages == 2);
    std::string dos = old_lines;
    for (std::size_t i = 0; (i = dos.find('\n', i)) != dos.npos; i += 2) dos.insert(i, 1, '\r');
    CHECK(metrics_of(dos) == metrics_of(old_lines));
    CHECK(metrics_of("").messages == 0);
}

TEST_CASE("ns-2 reader: lines of ns-2 that rovernet does not write are skipped") {
    const std::string foreign =
        "\n"
        "# a comment\n"
        "INITIALIZE THE LIST xListHead\n"
        "SORTING LISTS ...DONE!\n"
        "N -t 1.000535 -n 0 -e 99.999676\n"
        "Sconfig 0.00000 tap: on snoop: rts? on errs? on\n"
        "S$hit 1.0 _1_\n"
        "v 1.0015366666666667 eval {set sim_annotation {1 received {1:hello} from 0}}\n"
        "v 0.8 link-down 2 1\n"
        "+ 0.1 1 2 cbr 1000 ------- 2 1.0 3.1 0 0\n"
        "r 0.114 1 2 cbr 1000 ------- 2 1.0 3.1 0 0\n"
        "s 11.171298000 _5_ AGT  --- 0 cbr 512 [0 0 0 0] ------- [5:0 3:1 32 0] [0] 0 0\n"
        "D 3.541349000 _2_ MAC  RET 0 RTS 44 [14ee 3 2 0] \n"
        "D 1.005936333 _1_ MAC  COL 2 message 122 [0 ffffffff 0 800] ------- [0:42 -1:42 32 0] \n"
        "s 1.000535000 _0_ MAC  --- 0 message 122 [0 ffffffff 0 800] ------- [0:42 -1:42 32 0] \n"
        "s 0.005090888 _0_ RTR  --- 7 message 32 [0 0 0 0] ------- [0:255 -1:255 32 0] \n"
        "s -t 0.005090888 -Hs 0 -Hd -1 -Ni 0 -Nx 10.01 -Ny 500.12 -Nz 0.00 -Ne -1.000000 -Nl RTR "
        "-Nw --- -Ma 0 -Md 0 -Ms 0 -Mt 0 -Is 0.255 -Id -1.255 -It message -Il 32 -If 0 -Ii 0 -Iv "
        "32 \n"
        "d -t 1.0 -Hs 1 -Hd -2 -Ni 1 -Nx 1.00 -Ny 1.00 -Nz 0.00 -Ne -1.000000 -Nl MAC -Nw SLP -Ma "
        "0 -Md 1 -Ms 0 -Mt 0 \n";
    CHECK(error_of(foreign) == "");
    const auto with = metrics_of(foreign + old_lines), without = metrics_of(old_lines);
    CHECK(with.messages == without.messages + 1);  // the cbr packet's
    CHECK(with.transmissions == without.transmissions);
    CHECK(with.receptions == without.receptions);
    CHECK(with.drops == without.drops);
}

TEST_CASE("ns-2 reader: the additional columns of an energy model do not change what is read") {
    std::string text = old_lines;
    const std::string energy = "[energy 98.312702 ei 1.328 es 0.000 et 0.116 er 0.243] ";
    for (std::size_t i = 0; (i = text.find("-------", i)) != text.npos; i += energy.size() + 7) {
        text.insert(i, energy);
    }
    CHECK(metrics_of(text) == metrics_of(old_lines));
}

TEST_CASE(
    "ns-2 reader: the error for a broken line has line, column, what was found and what was "
    "expected") {
    const auto number_of_lines = "run.tr:8:";  // after the seven good ones
    const auto broken = [&](const std::string& line) { return error_of(old_lines + line + "\n"); };
    const std::string rest = " RTR  --- 0 message 64 [0 ffffffff 0 800] ------- [0:0 -1:0 3 0] ";
    CHECK(broken("q 1.0").starts_with(number_of_lines));
    CHECK(broken("r 1.x _1_" + rest) ==
          "run.tr:8:3: found \"1.x\", expected a time in seconds from 0 to 9.2e9");
    CHECK(broken("r 99999999999 _1_" + rest).starts_with("run.tr:8:3: "));
    CHECK(broken("r -1.0 _1_" + rest).starts_with("run.tr:8:3: found \"-1.0\", expected a time"));
    CHECK(broken("r 1.0 _1" + rest) ==
          "run.tr:8:7: found \"_1\", expected a robot's number between underscores");
    CHECK(broken("r 1.0 _1048576_" + rest) ==
          "run.tr:8:8: found \"1048576\", expected a robot's number below 1048576");
    CHECK(broken("r 1 -s 0 -d -1 -p cbr -k RTR") ==
          "run.tr:8:29: found the end of the line, expected \"-i\"");  // tagged
    CHECK(broken("r 1.0 _1_ RTX  ---") ==
          "run.tr:8:11: found \"RTX\", expected a layer (AGT, RTR, MAC, IFQ, PHY or TRP)");
    CHECK(broken("r 1.0 _1_ RTR  -- 0") ==
          "run.tr:8:16: found \"--\", expected a reason for a drop as in ns-2 (COL, TTL, ...), or "
          "---");
    CHECK(broken("r 1.0 _1_ RTR  --- 0 message") ==
          "run.tr:8:29: found the end of the line, expected a size in bytes");
    CHECK(broken("r 1.0 _1_ RTR  --- 0 message 64 [0 ffffffff 0 800] ------- [0:0 -1:0 x 0] ") ==
          "run.tr:8:70: found \"x\", expected a ttl");
    CHECK(broken("s 1.0 _1_ AGT  --- 0 message 64 [0 0 0 0] ------- [0:0 -1:0 3 0] ") ==
          "run.tr:8:20: a packet of type message with number 0 is sent a second time; expected a "
          "different number for each packet of a type");
    CHECK(broken("M 0.0 1 (3.00, 0.00, 1.00), (3.00, 4.00)") ==
          "run.tr:8:36: found \"4.00)\", expected a coordinate [m] as in (x, y, z), (x, y), speed");
    CHECK(broken("M 0.0 1 (nan, 0.00, 1.00), (3.00, 4.00), 2.00") ==
          "run.tr:8:10: found \"nan\", expected a coordinate [m] as in (x, y, z), (x, y), speed");
    CHECK(broken("v 1 eval {set sim_annotation {reachable 0 x}}").starts_with("run.tr:8:43: "));
    CHECK(broken(new_start) == "run.tr:8:118: found the end of the line, expected \"-Is\"");
    CHECK(broken("s -t 1.0 -Hs 0 -Nd -2")
              .starts_with("run.tr:8:16: found \"-Nd\", expected \"-Hd\""));
    CHECK(broken(std::string("\0\xff\n", 2)) ==
          "run.tr:8:1: found \"??\", expected a line of an ns-2 trace (s, r, f, D, d, M, ...)");
}

TEST_CASE("ns-2 reader: a file that is missing, or not text, is refused") {
    const TempFolder folder;
    CHECK_THROWS_AS(trace_metrics(folder / "missing.tr"), InputError);
    CHECK_THROWS_AS(trace_metrics(folder / "."), InputError);
    CHECK(error_of(old_lines + "# " + std::string(70'000, 'x')) ==
          "run.tr:8:1: found a line of more than 64 KiB, expected a line of an ns-2 trace");
    CHECK(error_of("# " + std::string(1'000'000, 'x') + "\n") ==
          "run.tr:1:1: found a line of more than 64 KiB, expected a line of an ns-2 trace");
    CHECK(error_of("# " + std::string(65'000, 'x') + "\n") == "");
}

TEST_CASE("ns-2 reader: lines that cross the blocks in which the file is read are read correctly") {
    std::string text = old_lines;
    std::uint64_t messages = 1;
    for (; text.size() < 2'000'000; ++messages) {
        text += "s 2.0 _1_ AGT  --- " + std::to_string(messages) +
                " message 9 [0 0 0 0] ------- [1:0 -1:0 3 0] \n";
    }
    CHECK(metrics_of(text).messages == messages);
}

TEST_CASE("ns-2 reader: a damaged trace is read or refused, without a crash") {
    std::mt19937 draw(5);
    const auto below = [&](std::size_t n) { return draw() % n; };
    int refused = 0;
    for (int i = 0; i < 400; ++i) {
        const auto format = i % 2 ? Ns2Format::old_format : Ns2Format::new_format;
        static const std::string texts[] = {Recorded(Ns2Format::new_format, 1, 9, 60).text,
                                            Recorded(Ns2Format::old_format, 1, 9, 60).text};
        std::string text = texts[format == Ns2Format::old_format];
        for (std::size_t n = 1 + below(4); n > 0; --n) {
            const std::size_t at_byte = below(text.size());
            switch (below(4)) {
                case 0: text[at_byte] = static_cast<char>(below(256)); break;
                case 1: text.erase(at_byte, 1 + below(40)); break;
                case 2: text.insert(at_byte, text.substr(below(text.size()), below(200))); break;
                default: text[at_byte] = "0123456789 .-_[]:"[below(17)]; break;
            }
        }
        refused += error_of(text) != "";
    }
    CHECK(refused > 100);
    CHECK(refused < 400);
}

TEST_CASE("ns-2 reader: a file without any line of an ns-2 trace is refused") {
    const TempFolder folder;
    write_file(folder / "run.tr", "# by hand\n[scenario]\nname = \"A\"\n");
    try {
        trace_metrics(folder / "run.tr");
        FAIL("it was read");
    } catch (const InputError& e) {
        CHECK(e.where().line == 2);
        CHECK(std::string(e.what()).find("no line of this file is a line of an ns-2 trace") !=
              std::string::npos);
    }
    // A run in which nobody says anything leaves a trace as well.
    const std::string moves = "M 0.00000 0 (1.00, 2.00, 0.00), (1.00, 2.00), 0.00\n";
    CHECK(metrics_of(moves + "\n# by hand\n").messages == 0);
    CHECK(metrics_of("").messages == 0);
}

}  // namespace ns2_reader_test
