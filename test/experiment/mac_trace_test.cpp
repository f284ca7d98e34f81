// SPDX-License-Identifier: MIT
#include "experiment/run.hpp"
#include "mobility/waypoints.hpp"
#include "models/access/list.hpp"
#include "models/propagation/disc.hpp"
#include "models/propagation/log_distance.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"
#include "routing/flood.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario.hpp"
#include "sim/random.hpp"
#include "test/traces/ns2/trace_metrics.hpp"
#include "test/traces/record_stream.hpp"
#include "traces/fingerprint.hpp"
#include "traces/ns2/ns2_trace.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace mac_trace_test {
using namespace rovernet;
using rovernet::testing::content;
using rovernet::testing::TempFolder;
using rovernet::testing::trace_metrics;

namespace {

using namespace std::chrono_literals;

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// Where two texts part; "" if they are the same to the byte.
std::string difference(const std::string& one, const std::string& other) {
    if (one == other) return "";
    const auto a = lines_of(one), b = lines_of(other);
    const auto [x, y] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    return "\"" + (x == a.end() ? "" : *x) + "\" and \"" + (y == b.end() ? "" : *y) + "\"";
}

/// Lines that only MacTrace::on writes.
bool is_of_mac(const std::string& line) { return line.find(" MAC ") != line.npos; }

std::string without_mac(const std::string& text) {
    std::string rest;
    for (const std::string& line : lines_of(text)) {
        if (!is_of_mac(line)) rest += line + "\n";
    }
    return rest;
}

std::size_t count(const std::string& text, const std::string& pattern) {
    const std::regex searched(pattern);
    const auto lines = lines_of(text);
    return static_cast<std::size_t>(
        std::count_if(lines.begin(), lines.end(),
                      [&](const std::string& line) { return std::regex_search(line, searched); }));
}

struct Setting {
    ReceptionModel reception = Threshold{};
    AccessModel access = NoAccess{};
    Db shadowing{0};
    bool reference = false;
    MacTrace mac = MacTrace::on;
    Ns2Format format = Ns2Format::old_format;
};

struct Traced {
    std::string text;
    MetricValues metrics, read;
    std::string fingerprint;
};

/// Floods and unicasts among 60 robots on the move, ten of which are off for a while.
Traced traced(const Setting& setting) {
    const TempFolder folder;
    Network net({.seed = 9,
                 .propagation = LogDistance{.exponent = 3.5, .sigma = setting.shadowing},
                 .reception = setting.reception,
                 .access = setting.access,
                 .reference = setting.reference});
    const auto fingerprint = std::make_shared<Fingerprint>();
    const auto trace = std::make_shared<Ns2Trace>(folder / "run.tr", setting.format, setting.mac);
    net.add_sink(fingerprint);
    net.add_sink(trace);
    net.route(Flood{.ttl = 6, .jitter = 2ms});
    for (std::uint64_t i = 0; i < 60; ++i) {
        const auto draw = [&](std::uint64_t k) {
            return 250 * uniform({.seed = 3, .purpose = Purpose::placement, .a = i, .index = k});
        };
        net.add({.name = "",
                 .at = {draw(0), draw(1), 0},
                 .radio = {.rate = {11e6}},
                 .move = Waypoints{.path = {{draw(2), draw(3), 0}}, .speed = {9}}});
    }
    for (std::uint32_t k = 0; k < 10; ++k) {
        net.at(start_of_run + k * 1s, [&net, k] {
            net.send(NodeId{k}, everyone, "hello");
            for (std::uint32_t i = 0; i < 60; i += 3) net.send({i}, {i + k % 2 + 1}, "you");
        });
        net.at(start_of_run + k * 1s + 3ms, [&net, k] { net.switch_off(NodeId{20 + k}); });
        net.at(start_of_run + k * 1s + 500ms, [&net, k] { net.switch_on(NodeId{20 + k}); });
    }
    net.run_for(12s);
    trace->close();
    return {content(folder / "run.tr"), net.metrics(), trace_metrics(folder / "run.tr"),
            fingerprint->text()};
}

const ReceptionModel receptions[] = {Threshold{}, Collision{}, Sinr{}};
const Csma asking{.rts_threshold = 0};
const AccessModel accesses[] = {NoAccess{}, Aloha{}, asking};

}  // namespace

TEST_CASE("MAC trace: the trace is the same if receptions are processed together or one by one") {
    for (const ReceptionModel& reception : receptions) {
        for (const AccessModel& access : accesses) {
            for (const Db shadowing : {Db{0}, Db{4}}) {
                CAPTURE(reception.name());
                CAPTURE(access.name());
                CAPTURE(shadowing.value);
                Setting setting{.reception = reception, .access = access, .shadowing = shadowing};
                const std::string together = traced(setting).text;
                setting.reference = true;
                CHECK(difference(together, traced(setting).text) == "");
                CHECK(count(together, "^s .* MAC ") > 100);
                CHECK(count(together, "^r .* MAC ") > 100);
            }
        }
    }
}

TEST_CASE(
    "MAC trace: with MAC lines all other lines stay the same, and metrics read from the trace "
    "equal those of the run") {
    for (const Ns2Format format : {Ns2Format::old_format, Ns2Format::new_format}) {
        for (const AccessModel& access : accesses) {
            CAPTURE(access.name());
            Setting setting{.reception = Collision{}, .access = access, .format = format};
            const Traced with = traced(setting);
            setting.mac = MacTrace::off;
            const Traced plain = traced(setting);
            CHECK(count(plain.text, "MAC|RTS|CTS|ACK") == 0);
            CHECK(difference(without_mac(with.text), plain.text) == "");
            CHECK(with.fingerprint == plain.fingerprint);
            CHECK(with.metrics.drops[4].count > 0);  // COL
            CHECK(with.metrics == plain.metrics);
            CHECK(with.read == with.metrics);
            // What was lost on air is the MAC's to tell; nothing else is.
            CHECK(plain.read.drops[4].count == 0);
            CHECK(plain.read.deliveries == with.read.deliveries);
            CHECK(plain.read.delivery_ratio == with.read.delivery_ratio);
            CHECK(plain.read.transmissions == with.read.transmissions);
            CHECK(plain.read.latency == with.read.latency);
        }
    }
}

TEST_CASE("MAC trace: every frame on air and every message at a MAC has one line") {
    const Traced run = traced({.reception = Collision{}, .access = asking});
    CHECK(count(run.text, "^s .* MAC .* message ") == run.metrics.transmissions);
    CHECK(count(run.text, "^r .* MAC .* message ") +
              count(run.text, "^D .* MAC  DUP .* message ") ==
          run.metrics.receptions);
    // An answer goes out for what was received; a CTS not while others have reserved the medium.
    CHECK(count(run.text, "^s .* CTS ") > 0);
    CHECK(count(run.text, "^s .* CTS ") <= count(run.text, "^r .* RTS "));
    const std::string unicast = "^r .* MAC .* message [0-9]+ \\[[0-9a-f]+ [0-9a-f]{1,2} ";
    CHECK(count(run.text, "^s .* ACK ") > 0);
    CHECK(count(run.text, "^s .* ACK ") <= count(run.text, unicast));
    CHECK(count(run.text, "^D .* MAC  COL 0 RTS ") > 0);
    for (const char* type : {"RTS", "CTS", "ACK"}) {
        CAPTURE(type);
        const std::string kind = std::string(" .* MAC .* ") + type + " ";
        CHECK(count(run.text, "^[rD]" + kind) <= count(run.text, "^s" + kind));
    }
}

namespace {

/// A row of robots that hear 250 m, 200 m apart, as in test/peers/exchange.tcl.
std::string row(const AccessModel& access, const std::function<void(Network&)>& act, int robots = 3,
                Ns2Format format = Ns2Format::old_format) {
    const TempFolder folder;
    Network net({.propagation = Disc{.range = {250}},
                 .reception = Collision{},
                 .access = access,
                 .propagation_delay = false});
    const auto trace = std::make_shared<Ns2Trace>(folder / "run.tr", format, MacTrace::on);
    net.add_sink(trace);
    for (int i = 0; i < robots; ++i) {
        net.add({.name = "", .at = {200.0 * i, 0}, .radio = {.rate = {1e6}}});
    }
    net.at(start_of_run + 1s, [&] { act(net); });
    net.run_for(2s);
    trace->close();
    std::string packets;
    for (const std::string& line : lines_of(content(folder / "run.tr"))) {
        if (!line.starts_with("M ") && !line.starts_with("v ")) packets += line + "\n";
    }
    return packets;
}

/// ns-2.35 adds 34 bytes to a message, and has every unicast ask.
const Csma as_ns2{.rts_threshold = 0, .header = 34};

}  // namespace

TEST_CASE(
    "MAC trace: sizes and times of RTS, CTS, data and ACK frames equal the output of ns-2.35") {
    const auto unicast = [](Network& net) { net.send({1}, {2}, "", {.size = 500}); };
    CHECK(row(as_ns2, unicast) ==
          "s 1.000000000 _1_ AGT  --- 0 message 500 [0 0 0 0] ------- [1:0 2:0 1 0] \n"
          "r 1.000000000 _1_ RTR  --- 0 message 500 [0 0 0 0] ------- [1:0 2:0 1 0] \n"
          "s 1.000050000 _1_ MAC  --- 0 RTS 44 [13ee 2 1 0] \n"
          "r 1.000402000 _2_ MAC  --- 0 RTS 44 [13ee 2 1 0] \n"
          "s 1.000412000 _2_ MAC  --- 0 CTS 38 [12b4 1 0 0] \n"
          "r 1.000716000 _1_ MAC  --- 0 CTS 38 [12b4 1 0 0] \n"
          "s 1.000726000 _1_ RTR  --- 0 message 500 [0 0 0 0] ------- [1:0 2:0 1 0] \n"
          "s 1.000726000 _1_ MAC  --- 0 message 558 [13a 2 1 800] ------- [1:0 2:0 1 0] \n"
          "r 1.005190000 _2_ MAC  --- 0 message 500 [13a 2 1 800] ------- [1:0 2:0 1 0] \n"
          "r 1.005190000 _2_ RTR  --- 0 message 500 [13a 2 1 800] ------- [1:0 2:0 1 0] \n"
          "r 1.005190000 _2_ AGT  --- 0 message 500 [13a 2 1 800] ------- [1:0 2:0 1 0] \n"
          "s 1.005200000 _2_ MAC  --- 0 ACK 38 [0 1 0 0] \n"
          "r 1.005504000 _1_ MAC  --- 0 ACK 38 [0 1 0 0] \n");
    const std::string text = row(as_ns2, unicast, 3, Ns2Format::new_format);
    CHECK(text.find("s -t 1.000050000 -Hs 1 -Hd -2 -Ni 1 -Nx 200.00 -Ny 0.00 -Nz 0.00 -Ne "
                    "-1.000000 -Nl MAC -Nw --- -Ma 13ee -Md 2 -Ms 1 -Mt 0 \n"
                    "r -t 1.000402000 -Hs 2 -Hd -2 -Ni 2 ") != text.npos);
    CHECK(text.find("-Ma 12b4 -Md 1 -Ms 0 -Mt 0 \n") != text.npos);
    CHECK(text.find("-Ma 13a -Md 2 -Ms 1 -Mt 800 -Is 1.0 -Id 2.0 -It message -Il 558 ") !=
          text.npos);
}

TEST_CASE("MAC trace: a broadcast has a line at its sender and at each robot that decodes it") {
    const auto broadcast = [](Network& net) {
        net.send({1}, everyone, "", {.size = 64, .one_hop = true});
    };
    const std::string text = row(as_ns2, broadcast);
    CHECK(count(text, "^s .*_1_ MAC  --- 0 message 122 \\[0 ffffffff 1 800\\]") == 1);
    for (const char* node : {"_0_", "_2_"}) {
        CHECK(count(text, std::string("^r .*") + node +
                              " MAC  --- 0 message 64 \\[0 ffffffff 1 800\\]") == 1);
    }
    CHECK(count(text, " MAC ") == 3);
}

TEST_CASE(
    "MAC trace: with an access model that adds no header, a frame is as large as its message") {
    const auto unicast = [](Network& net) { net.send({1}, {2}, "", {.size = 64}); };
    for (const AccessModel& access : {AccessModel{NoAccess{}}, AccessModel{Aloha{}}}) {
        const std::string text = row(access, unicast);
        CHECK(count(text, "^s .*_1_ MAC  --- 0 message 64 \\[0 2 1 800\\]") == 1);
        CHECK(count(text, "^r .*_2_ MAC  --- 0 message 64 \\[0 2 1 800\\]") == 1);
        CHECK(count(text, " MAC ") == 2);
    }
}

TEST_CASE(
    "MAC trace: each retransmission has a line at its sender, and none at robots that overhear "
    "it") {
    const auto to_nobody = [](Network& net) { net.send({1}, {3}, "", {.size = 64}); };
    const std::string text = row(as_ns2, to_nobody, 4);
    CHECK(count(text, "^s .*_1_ MAC  --- 0 RTS 44 \\[[0-9a-f]+ 3 1 0\\] $") == 7);
    CHECK(count(text, " MAC ") == 8);  // and the one that says that it was given up
    CHECK(count(text, "^D .*_1_ MAC  RET ") == 1);
}

TEST_CASE("MAC trace: a robot that was switched off has no lines for the RTS frames sent to it") {
    const auto fails = [](Network& net) {
        net.send({1}, {2}, "", {.size = 64});
        net.at(net.now() + 100us, [&net] { net.switch_off({2}); });
    };
    const std::string text = row(as_ns2, fails);
    CHECK(count(text, "^s .*_1_ MAC  --- 0 RTS 44 ") == 7);
    CHECK(count(text, "_2_ MAC ") == 0);
}

TEST_CASE("MAC trace: an RTS that collides is dropped at its destination") {
    const auto hidden = [](Network& net) {
        net.send({0}, {1}, "", {.size = 64});
        net.send({2}, {1}, "", {.size = 64});
    };
    for (const Ns2Format format : {Ns2Format::old_format, Ns2Format::new_format}) {
        const std::string text = row(as_ns2, hidden, 3, format);
        const auto lines = lines_of(text);
        const auto first = std::find_if(lines.begin(), lines.end(), [](const std::string& line) {
            return line.starts_with("D ") || line.starts_with("d ");
        });
        REQUIRE(lines.end() - first >= 2);
        if (format == Ns2Format::old_format) {
            // 3 SIFS, CTS and ACK of 304 us, and 192 + 8 (64 + 34) us of data: 1614 us.
            CHECK(first[0] == "D 1.000402000 _1_ MAC  COL 0 RTS 44 [64e 1 0 0] ");
            CHECK(first[1] == "D 1.000402000 _1_ MAC  COL 0 RTS 44 [64e 1 2 0] ");
        } else {
            CHECK(first[1].starts_with("d -t 1.000402000 -Hs 1 "));
            CHECK(first[1].ends_with(" -Nl MAC -Nw COL -Ma 64e -Md 1 -Ms 2 -Mt 0 "));
        }
    }
}

TEST_CASE("MAC trace: MAC lines are written only if the scenario sets `mac = true`") {
    const std::string text =
        "[scenario]\nduration = \"1 s\"\n"
        "[propagation]\nmodel = \"disc\"\nrange = \"9 m\"\n"
        "[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\n"
        "[[robot]]\nname = \"B\"\nat = [\"5 m\", \"0 m\"]\n"
        "[[traffic]]\nfrom = \"A\"\npayload = \"F\"\n"
        "[trace]\nns2 = \"old\"\n";
    const TempFolder folder;
    const auto mac_lines = [&](const std::string& key) {
        const auto scenario = read_scenario(parse_toml(text + key, "s.toml"), "s.toml");
        const auto run = run_scenario(scenario, {.folder = folder / "out", .speed = {}});
        return count(content(*run.trace), " MAC ");
    };
    CHECK(mac_lines("") == 0);
    CHECK(mac_lines("mac = false\n") == 0);
    // A's message, and B's forwarding of it.
    CHECK(mac_lines("mac = true\n") == 4);
    const auto printed = content(folder / "out/scenario.toml");
    CHECK(read_scenario(parse_toml(printed, "s.toml"), "s.toml").trace.mac);
}

}  // namespace mac_trace_test
