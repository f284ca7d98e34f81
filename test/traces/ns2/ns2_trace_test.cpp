// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_trace.hpp"

#include "models/access/wifi_frames.hpp"
#include "sim/error.hpp"
#include "sim/legs.hpp"
#include "test/files/no_room.hpp"
#include "test/traces/record_stream.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string>

namespace ns2_trace_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

constexpr NodeId a{0}, b{1}, c{11};

/// Every line that a trace can hold: twelve robots 10 m apart, of which three talk.
void play(Stream& s) {
    for (int i = 0; i < 11; ++i) s.place(Vec3{10.0 * i, 1.005, 0.5});
    s.place({.start = at(250'000'000),
             .end = at(5'250'000'000),
             .from = {3, -4, 1},
             .velocity = {0.6, 0.8, 0},
             .to = {6, 0, 1}});
    const auto m = s.send(at(10'000'000'000), a, 3, 64, 2);
    s.transmit(at(10'000'000'000), frame(m, a, 3, 1));
    s.receive(frame(m, a, 3, 1), {{at(10'000'520'067), b, Fate::waiting, true},
                                  {at(10'000'520'100), c, Fate::off, false}});
    s.transmit(at(10'002'000'001), frame(m, b, 2, 2), a);
    s.receive(frame(m, b, 2, 2), {{at(10'002'520'068), a, Fate::duplicate, false},
                                  {at(10'002'520'101), c, Fate::waiting, true}});
    s.transmit(at(10'003'000'000), frame(m, a, 1, 3), b);
    s.receive(frame(m, c, 1, 3), {{at(10'003'520'067), b, Fate::ttl, false}});
    s.emit(Dropped{at(10'004'000'000), c, frame(m, b, 2, 2), DropReason::off});
}

std::string trace_of(Ns2Format format, void (*records)(Stream&), MacTrace mac = MacTrace::off) {
    const TempFolder folder;
    Stream stream;
    const auto trace = std::make_shared<Ns2Trace>(folder / "run.tr", format, mac);
    stream.sinks = {trace};
    records(stream);
    trace->close();
    return content(folder / "run.tr");
}

std::string without_first_lines(std::string text, int n) {
    for (; n > 0; --n) text.erase(0, text.find('\n') + 1);
    return text;
}

}  // namespace

TEST_CASE("ns-2 trace: the lines of movements are equal in the old and the new format") {
    const auto old_text = trace_of(Ns2Format::old_format, play);
    CHECK(
        old_text.starts_with("M 0.00000 0 (0.00, 1.00, 0.50), (0.00, 1.00), 0.00\n"
                             "M 0.00000 1 (10.00, 1.00, 0.50), (10.00, 1.00), 0.00\n"));
    const auto last = "M 0.25000 11 (3.00, -4.00, 1.00), (6.00, 0.00), 1.00\n";
    CHECK(without_first_lines(old_text, 11).starts_with(last));
    CHECK(without_first_lines(trace_of(Ns2Format::new_format, play), 11).starts_with(last));
}

TEST_CASE("ns-2 trace: the MAC drops a unicast that arrives a second time, with reason DUP") {
    const auto repeat = [](Stream& s) {
        s.place(Vec3{});
        s.place(Vec3{10, 0, 0});
        const auto m = s.send(at(1'000'000'000), a, 1, 64, 2);
        Frame again = frame(m, a, 1, 1);
        again.next_hop = b;
        s.receive(again, {{at(1'500'000'000), b, Fate::duplicate, false}});
    };
    const std::string last =
        "D 1.500000000 _1_ MAC  DUP 0 message 64 [0 1 0 800] ------- [0:0 -1:0 1 0] \n";
    const auto with_mac = trace_of(Ns2Format::old_format, repeat, MacTrace::on);
    CHECK(with_mac.ends_with(last));
    CHECK(with_mac.find("r 1.5") == std::string::npos);
    CHECK(trace_of(Ns2Format::old_format, repeat).find(" 1.5") == std::string::npos);
}

TEST_CASE(
    "ns-2 trace: a frame lost on air has a line, with its size on air, only if MAC lines are on") {
    const auto lose = [](Stream& s) {
        s.place(Vec3{});
        s.place(Vec3{10, 0, 0});
        const auto m = s.send(at(1'000'000'000), a, 1, 500, 2);
        const std::vector<Reception> lost = {{at(1'500'000'000), b, Fate::collided}};
        s.emit(Received{frame(m, a, 1, 1), lost, {}, 28});
        s.emit(Dropped{at(1'600'000'000), a, frame(m, a, 1, 1), DropReason::retries});
    };
    CHECK(
        trace_of(Ns2Format::old_format, lose, MacTrace::on)
            .ends_with("D 1.500000000 _1_ MAC  COL 0 message 552 [0 ffffffff 0 800] ------- [0:0 "
                       "-1:0 1 0] \n"
                       "D 1.600000000 _0_ MAC  RET 0 message 500 [0 0 0 0] ------- [0:0 -1:0 1 0] "
                       "\n"));
    CHECK(trace_of(Ns2Format::old_format, lose).find("MAC") == std::string::npos);
}

TEST_CASE("ns-2 trace: lines in the old format are exactly as ns-2 writes them") {
    CHECK(without_first_lines(trace_of(Ns2Format::old_format, play), 12) ==
          "v 10 eval {set sim_annotation {reachable 0 2}}\n"
          "s 10.000000000 _0_ AGT  --- 0 message 64 [0 0 0 0] ------- [0:0 -1:0 3 0] \n"
          "r 10.000000000 _0_ RTR  --- 0 message 64 [0 0 0 0] ------- [0:0 -1:0 3 0] \n"
          "s 10.000000000 _0_ RTR  --- 0 message 64 [0 0 0 0] ------- [0:0 -1:0 3 0] \n"
          "r 10.000520067 _1_ RTR  --- 0 message 64 [0 ffffffff 0 800] ------- [0:0 -1:0 3 0] \n"
          "r 10.000520067 _1_ AGT  --- 0 message 64 [0 ffffffff 0 800] ------- [0:0 -1:0 3 0] \n"
          "f 10.002000001 _1_ RTR  --- 0 message 64 [0 ffffffff 0 800] ------- [0:0 -1:0 2 0] \n"
          "r 10.002520068 _0_ RTR  --- 0 message 64 [0 ffffffff 1 800] ------- [0:0 -1:0 2 0] \n"
          "D 10.002520068 _0_ RTR  DUP 0 message 64 [0 ffffffff 1 800] ------- [0:0 -1:0 2 0] \n"
          "r 10.002520101 _11_ RTR  --- 0 message 64 [0 ffffffff 1 800] ------- [0:0 -1:0 2 0] \n"
          "r 10.002520101 _11_ AGT  --- 0 message 64 [0 ffffffff 1 800] ------- [0:0 -1:0 2 0] \n"
          "s 10.003000000 _0_ RTR  --- 0 message 64 [0 ffffffff 1 800] ------- [0:0 -1:0 1 0] \n"
          "r 10.003520067 _1_ RTR  --- 0 message 64 [0 ffffffff b 800] ------- [0:0 -1:0 1 0] \n"
          "D 10.003520067 _1_ RTR  TTL 0 message 64 [0 ffffffff b 800] ------- [0:0 -1:0 1 0] \n"
          "D 10.004000000 _11_ RTR  SLP 0 message 64 [0 ffffffff 1 800] ------- [0:0 -1:0 2 0] \n");
}

TEST_CASE("ns-2 trace: lines in the new format are exactly as ns-2 writes them") {
    const auto text = without_first_lines(trace_of(Ns2Format::new_format, play), 12);
    CHECK(text.starts_with(
        "v 10 eval {set sim_annotation {reachable 0 2}}\n"
        "s -t 10.000000000 -Hs 0 -Hd -2 -Ni 0 -Nx 0.00 -Ny 1.00 -Nz 0.50 -Ne -1.000000 -Nl AGT "
        "-Nw --- -Ma 0 -Md 0 -Ms 0 -Mt 0 -Is 0.0 -Id -1.0 -It message -Il 64 -If 0 -Ii 0 -Iv 3 \n"
        "r -t 10.000000000 -Hs 0 -Hd -2 -Ni 0 -Nx 0.00 -Ny 1.00 -Nz 0.50 -Ne -1.000000 -Nl RTR "
        "-Nw --- -Ma 0 -Md 0 -Ms 0 -Mt 0 -Is 0.0 -Id -1.0 -It message -Il 64 -If 0 -Ii 0 -Iv 3 \n"
        "s -t 10.000000000 -Hs 0 -Hd -2 -Ni 0 -Nx 0.00 -Ny 1.00 -Nz 0.50 -Ne -1.000000 -Nl RTR "
        "-Nw --- -Ma 0 -Md 0 -Ms 0 -Mt 0 -Is 0.0 -Id -1.0 -It message -Il 64 -If 0 -Ii 0 -Iv 3 \n"
        "r -t 10.000520067 -Hs 1 -Hd -2 -Ni 1 -Nx 10.00 -Ny 1.00 -Nz 0.50 -Ne -1.000000 -Nl RTR "
        "-Nw --- -Ma 0 -Md ffffffff -Ms 0 -Mt 800 -Is 0.0 -Id -1.0 -It message -Il 64 -If 0 -Ii 0 "
        "-Iv 3 \n"
        "r -t 10.000520067 -Hs 1 -Hd -2 -Ni 1 -Nx 10.00 -Ny 1.00 -Nz 0.50 -Ne -1.000000 -Nl AGT "
        "-Nw --- -Ma 0 -Md ffffffff -Ms 0 -Mt 800 -Is 0.0 -Id -1.0 -It message -Il 64 -If 0 -Ii 0 "
        "-Iv 3 \n"
        "f -t 10.002000001 -Hs 1 -Hd -2 -Ni 1 -Nx 10.00 -Ny 1.00 -Nz 0.50 -Ne -1.000000 -Nl RTR "
        "-Nw --- -Ma 0 -Md ffffffff -Ms 0 -Mt 800 -Is 0.0 -Id -1.0 -It message -Il 64 -If 0 -Ii 0 "
        "-Iv 2 \n"));
    CHECK(text.ends_with(
        "d -t 10.003520067 -Hs 1 -Hd -2 -Ni 1 -Nx 10.00 -Ny 1.00 -Nz 0.50 -Ne -1.000000 -Nl RTR "
        "-Nw TTL -Ma 0 -Md ffffffff -Ms b -Mt 800 -Is 0.0 -Id -1.0 -It message -Il 64 -If 0 -Ii 0 "
        "-Iv 1 \n"
        "d -t 10.004000000 -Hs 11 -Hd -2 -Ni 11 -Nx 6.00 -Ny 0.00 -Nz 1.00 -Ne -1.000000 -Nl RTR "
        "-Nw SLP -Ma 0 -Md ffffffff -Ms 1 -Mt 800 -Is 0.0 -Id -1.0 -It message -Il 64 -If 0 -Ii 0 "
        "-Iv 2 \n"));
}

TEST_CASE("ns-2 trace: a line in the new format has the robot's position at the time of the line") {
    const auto text = trace_of(Ns2Format::new_format, [](Stream& s) {
        s.place({.start = at(0),
                 .end = at(10'000'000'000),
                 .from = {},
                 .velocity = {1, 0.5, 0.25},
                 .to = {10, 5, 2.5}});
        s.send(at(2'500'000'000), a, 1);
    });
    CHECK(text.find("-Nx 2.50 -Ny 1.25 -Nz 0.62 ") != text.npos);
}

TEST_CASE("ns-2 trace: if the number of reachable robots is unknown, no annotation is written") {
    const auto text = trace_of(Ns2Format::old_format, [](Stream& s) {
        s.place(Vec3{});
        s.send(at(0), a, 1);
    });
    CHECK(text.find("v ") == text.npos);
}

TEST_CASE("ns-2 trace: the drop line of a message lost at its own sender has no previous sender") {
    const auto text = trace_of(Ns2Format::old_format, [](Stream& s) {
        s.place(Vec3{});
        const auto m = s.send(at(0), a, 1);
        s.emit(Dropped{at(0), a, frame(m, a, 1, 1), DropReason::off});
    });
    CHECK(text.ends_with(
        "D 0.000000000 _0_ RTR  SLP 0 message 64 [0 0 0 0] ------- [0:0 -1:0 1 0] \n"));
}

namespace {

AirFrame control(const ControlFrame& kind, NodeId from, NodeId to, Duration reserved) {
    AirFrame air{.control = &kind, .reserved = reserved};
    air.frame.sender = from;
    air.frame.next_hop = to;
    return air;
}

/// A message of 64 bytes from `a` to `c`, which asks first; headers take 28 bytes.
void play_exchange(Stream& s) {
    for (int i = 0; i < 12; ++i) s.place(Vec3{});
    const auto m = s.send(at(0), a, 1);
    const auto rts = control(wifi_rts, a, c, Duration{4'000'499});
    const auto cts = control(wifi_cts, c, a, Duration{3'000'500});
    AirFrame data{.frame = frame(m, a, 1, 1), .reserved = 314us};
    data.frame.next_hop = c;
    s.emit(AirSent{at(1), rts, 20});
    s.emit(ControlReceived{rts, {at(2), c}, 20});
    s.emit(AirSent{at(3), cts, 14});
    s.emit(ControlReceived{cts, {at(4), a, Fate::garbled}, 14});
    s.emit(AirSent{at(5), data, 92, 28});
    s.emit(Received{data.frame, std::vector{Reception{at(6), c, Fate::arrived, true}}, 314us});
}

}  // namespace

TEST_CASE("ns-2 trace: MAC lines in the old format have durations to the nearest microsecond") {
    const auto text = trace_of(Ns2Format::old_format, play_exchange, MacTrace::on);
    CHECK(without_first_lines(text, 14) ==
          "s 0.000000001 _0_ MAC  --- 0 RTS 44 [fa0 b 0 0] \n"
          "r 0.000000002 _11_ MAC  --- 0 RTS 44 [fa0 b 0 0] \n"
          "s 0.000000003 _11_ MAC  --- 0 CTS 38 [bb9 0 0 0] \n"
          "D 0.000000004 _0_ MAC  ERR 0 CTS 38 [bb9 0 0 0] \n"
          "s 0.000000005 _0_ MAC  --- 0 message 116 [13a b 0 800] ------- [0:0 -1:0 1 0] \n"
          "r 0.000000006 _11_ MAC  --- 0 message 64 [13a b 0 800] ------- [0:0 -1:0 1 0] \n"
          "r 0.000000006 _11_ RTR  --- 0 message 64 [13a b 0 800] ------- [0:0 -1:0 1 0] \n"
          "r 0.000000006 _11_ AGT  --- 0 message 64 [13a b 0 800] ------- [0:0 -1:0 1 0] \n");
}

TEST_CASE(
    "ns-2 trace: in the new format, MAC lines of control frames do not have the frame's kind") {
    const auto text = trace_of(Ns2Format::new_format, play_exchange, MacTrace::on);
    const std::string place = " -Nx 0.00 -Ny 0.00 -Nz 0.00 -Ne -1.000000 -Nl MAC -Nw ";
    CHECK(without_first_lines(text, 14).starts_with(
        "s -t 0.000000001 -Hs 0 -Hd -2 -Ni 0" + place + "--- -Ma fa0 -Md b -Ms 0 -Mt 0 \n" +
        "r -t 0.000000002 -Hs 11 -Hd -2 -Ni 11" + place + "--- -Ma fa0 -Md b -Ms 0 -Mt 0 \n" +
        "s -t 0.000000003 -Hs 11 -Hd -2 -Ni 11" + place + "--- -Ma bb9 -Md 0 -Ms 0 -Mt 0 \n" +
        "d -t 0.000000004 -Hs 0 -Hd -2 -Ni 0" + place + "ERR -Ma bb9 -Md 0 -Ms 0 -Mt 0 \n" +
        "s -t 0.000000005 -Hs 0 -Hd -2 -Ni 0" + place +
        "--- -Ma 13a -Md b -Ms 0 -Mt 800 -Is 0.0 -Id -1.0 -It message -Il 116 -If 0 -Ii 0 -Iv 1 "
        "\n"));
}

TEST_CASE(
    "ns-2 trace: if MAC lines are off, the trace does not request the records of MAC frames") {
    const TempFolder folder;
    const KindMask of_mac = kind_of<AirSent>() | kind_of<ControlReceived>();
    CHECK((Ns2Trace(folder / "a.tr").kinds() & of_mac) == 0);
    CHECK((Ns2Trace(folder / "b.tr", Ns2Format::old_format, MacTrace::on).kinds() & of_mac) ==
          of_mac);
    const auto text = trace_of(Ns2Format::old_format, play_exchange);
    CHECK(text.find("MAC") == text.npos);
}

TEST_CASE("ns-2 trace: a trace that is longer than the buffer is written completely") {
    const auto text = trace_of(Ns2Format::new_format, [](Stream& s) {
        s.place(Vec3{});
        for (int i = 0; i < 1000; ++i) s.send(at(i), a, 1);
    });
    CHECK(std::count(text.begin(), text.end(), '\n') == 2001);
    CHECK(text.find("-Ii 999 -Iv 1 \n") != text.npos);
}

TEST_CASE("ns-2 trace: the file gets its name only when it is complete") {
    const TempFolder folder;
    Ns2Trace trace(folder / "run.tr");
    CHECK_FALSE(folder.has("run.tr"));
    trace.close();
    CHECK(folder.has("run.tr"));
    trace.close();
    CHECK(folder.has("run.tr"));
}

TEST_CASE("ns-2 trace: an interrupted run leaves the old file unchanged, and no partial file") {
    const TempFolder folder;
    write_file(folder / "run.tr", "yesterday's\n");
    const auto interrupted = [&] {
        Stream stream;
        stream.sinks = {Ns2Trace(folder / "run.tr")};
        play(stream);
        throw std::runtime_error("interrupted");
    };
    CHECK_THROWS_AS(interrupted(), std::runtime_error);
    CHECK(content(folder / "run.tr") == "yesterday's\n");
    CHECK(folder.names() == std::vector<std::string>{"run.tr"});
}

TEST_CASE("ns-2 trace: a run that ends normally without close() leaves its trace") {
    const TempFolder folder;
    {
        Stream stream;
        stream.sinks = {Ns2Trace(folder / "run.tr")};
        play(stream);
    }
    CHECK(folder.has("run.tr"));
    CHECK(folder.names() == std::vector<std::string>{"run.tr"});
}

TEST_CASE("ns-2 trace: a full disk is reported as an error") {
    const TempFolder folder;
    Ns2Trace trace(folder / "run.tr");
    Stream stream;
    stream.place(Vec3{});
    trace.on(Moved{at(0), a, stream.legs.leg(a)}, {stream.legs, stream.messages});
    const test::NoRoom none;
    CHECK_THROWS_WITH_AS(trace.close(),
                         (folder / "run.tr: cannot be written: File too large").c_str(), RunError);
    CHECK_THROWS_AS(trace.close(), RunError);
    CHECK(folder.names().empty());
}

}  // namespace ns2_trace_test
