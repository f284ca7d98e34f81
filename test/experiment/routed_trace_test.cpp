// SPDX-License-Identifier: MIT
#include "experiment/replay/trace_input.hpp"
#include "experiment/run.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "test/traces/record_stream.hpp"
#include "traces/ns2/ns2_stats.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace routed_trace_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

/// Old trace of messages over a line of robots, which are 200 m apart and have a range of 250 m.
std::string trace_of(const std::string& routing, int robots, const std::string& third = "",
                     const std::string& access = "") {
    std::string text =
        "[scenario]\nduration = \"8 s\"\n[access]\nmodel = \"csma\"\n" + access +
        "[propagation]\nmodel = \"disc\"\nrange = \"250 m\"\n[routing]\nprofile = \"ns2\"\n" +
        routing +
        "[trace]\nns2 = \"old\"\nmac = true\n[[traffic]]\nkind = \"unicast\"\nfrom = \"n0\"\nto = "
        "\"n" +
        std::to_string(robots - 1) + "\"\nsize = \"64 B\"\nstart = \"1 s\"\nevery = \"250 ms\"\n";
    for (int i = 0; i < robots; ++i) {
        text += fmt::format("[[robot]]\nname = \"n{}\"\nat = [\"{} m\", \"0 m\"]\n{}", i, 200 * i,
                            i == 3 ? third : "");
    }
    const TempFolder folder;
    testing::write_file(folder / "s.toml", text);
    RunOptions to;
    to.folder = folder / ".";
    run_scenario(load_scenario(folder / "s.toml", {}), to);
    return content(folder / "trace.tr");
}

/// Lines that have the pattern.
std::vector<std::string> lines_with(const std::string& text, const std::string& pattern) {
    const std::regex searched(pattern);
    std::istringstream in(text);
    std::vector<std::string> found;
    for (std::string line; std::getline(in, line);) {
        if (std::regex_search(line, searched)) found.push_back(line);
    }
    return found;
}

/// Part of the line from the size of the packet on.
std::string from_size(const std::string& line) {
    return std::regex_replace(line, std::regex("^.* cbr "), "");
}

}  // namespace

// The lines of ns-2.35 for its DSR are "r RTR cbr 108" and "r AGT cbr 64".
TEST_CASE(
    "ns-2 trace of DSR: the destination has one line of the router (RTR), one of the agent (AGT)") {
    const std::string text = trace_of("protocol = \"dsr\"\n", 4);
    const auto router = lines_with(text, "^r .* _3_ RTR .* cbr "),
               agent = lines_with(text, "^r .* _3_ AGT ");
    REQUIRE(agent.size() > 20);
    REQUIRE(router.size() == agent.size());
    CHECK(from_size(router[9]) == "100 [d5 3 2 800] ------- [0:0 3:0 30 3] [9] 3 0");
    CHECK(from_size(agent[9]) == "64 [d5 3 2 800] ------- [0:0 3:0 30 3] [9] 3 0");
}

TEST_CASE(
    "ns-2 trace of AODV: at the destination only the agent (AGT) has a line, and the size includes "
    "the IP header") {
    const std::string text = trace_of("protocol = \"aodv\"\n", 4);
    CHECK(lines_with(text, "^r .* _3_ RTR .* cbr ").empty());
    const auto agent = lines_with(text, "^r .* _3_ AGT ");
    REQUIRE(agent.size() > 20);
    CHECK(from_size(agent[9]) == "84 [d5 3 2 800] ------- [0:0 3:0 28 3] [9] 3 0");
}

// ns-2.35 has the same fields in both lines; its duration is 13a, as it acknowledges at 1 Mbit/s.
TEST_CASE(
    "ns-2 trace: if the next hop is gone, the drop lines have the MAC header of the failed frame") {
    const std::string text = trace_of("protocol = \"aodv\"\n", 5, "off = [\"4.9 s\"]\n");
    const auto lost = lines_with(text, "^D .* _2_ (MAC  RET|RTR  CBK) .* cbr ");
    REQUIRE(lost.size() == 2);
    for (const std::string& line : lost) {
        CHECK(from_size(line) == "84 [d5 3 2 800] ------- [0:0 4:0 28 3] [16] 2 0");
    }
}

TEST_CASE(
    "ns-2 trace: the line of a forwarded reply has the MAC header with which the reply arrived") {
    for (const char* protocol : {"protocol = \"aodv\"\n", "protocol = \"dsr\"\n"}) {
        CAPTURE(protocol);
        const std::string text = trace_of(protocol, 4);
        const auto forwarded = lines_with(text, "^f .* _2_ RTR .* ------- \\[3:255 0:255 ");
        REQUIRE_FALSE(forwarded.empty());
        for (const std::string& line : forwarded) {
            CHECK(line.find(" [d5 2 3 800] ") != line.npos);
        }
    }
}

TEST_CASE(
    "ns-2 trace: the line of a message held until the run's end has the full TTL and no next hop") {
    const std::string text = trace_of("protocol = \"dsr\"\n", 5, "off = [\"4.9 s\"]\n");
    const auto held = lines_with(text, "^D .* RTR  END ");
    REQUIRE_FALSE(held.empty());
    for (const std::string& line : held) CHECK(line.find(" [0:0 4:0 32 0] ") != line.npos);
}

TEST_CASE(
    "ns-2 trace: in the old format, the line of an ARP packet ends with a closing bracket, as in "
    "ns-2") {
    const std::string text = trace_of("protocol = \"aodv\"\n", 3, "", "arp = true\n");
    const auto arp = lines_with(text, " ARP ");
    REQUIRE_FALSE(arp.empty());
    for (const std::string& line : arp) CHECK(line.back() == ']');
}

TEST_CASE(
    "ns-2 trace: if a control packet never went on air, its drop line has the TTL of this packet") {
    std::string text =
        "[scenario]\nduration = \"1 s\"\n[access]\nmodel = \"csma\"\n"
        "[trace]\nns2 = \"old\"\nrecord = true\n"
        "[[traffic]]\nkind = \"unicast\"\nfrom = \"n2\"\nto = \"n1\"\nsize = \"0 B\"\n"
        "start = \"1 s\"\n"
        "[[traffic]]\nfrom = \"n0\"\nsize = \"0 B\"\nstart = \"1 s\"\n";
    for (int i = 0; i < 3; ++i) {
        text += fmt::format("[[robot]]\nname = \"n{}\"\nat = [\"{} m\", \"0 m\"]\n", i, 10 * i);
    }
    for (const auto& [rings, ttl] : {std::pair("true", 1), std::pair("false", 35)}) {
        CAPTURE(rings);
        const TempFolder folder;
        testing::write_file(folder / "s.toml",
                            text + "[routing]\nprotocol = \"aodv\"\nrings = " + rings + "\n");
        run_scenario(load_scenario(folder / "s.toml", {}), {.folder = folder / ".", .speed = {}});
        const std::string trace = content(folder / "trace.tr");
        const auto lost = lines_with(trace, "^D .* AGT  END .* AODV ");
        REQUIRE(lost.size() == 1);
        CHECK(lost[0].find(fmt::format(" [2:255 -1:255 {} 0] ", ttl)) != std::string::npos);
        render_recorded(folder / "trace.mcap", folder / "later.tr",
                        {.format = Ns2Format::old_format, .mac = MacTrace::off});
        CHECK(content(folder / "later.tr") == trace);
    }
}

TEST_CASE("ns-2 trace: the transmissions of routed unicasts are counted as in the run") {
    std::string text =
        "[scenario]\nduration = \"8 s\"\n[access]\nmodel = \"csma\"\n"
        "[propagation]\nmodel = \"disc\"\nrange = \"250 m\"\n"
        "[trace]\nns2 = \"old\"\nmac = true\n";
    for (int i = 0; i < 3; ++i) {
        text += fmt::format("[[robot]]\nname = \"n{}\"\nat = [\"{} m\", \"0 m\"]\n", i, 200 * i);
    }
    const std::string sent = "from = \"n0\"\nsize = \"64 B\"\nstart = \"1 s\"\nevery = \"1 s\"\n";
    text += "[[traffic]]\n" + sent;
    text += "[[traffic]]\nkind = \"unicast\"\nto = \"n2\"\n" + sent;
    text += "[[traffic]]\nkind = \"unicast\"\nto = \"n1\"\nhops = 1\n" + sent;
    for (const char* protocol : {"aodv\"", "dsr\"", "suppression\"\nscheme = \"cluster\""}) {
        CAPTURE(protocol);
        const TempFolder folder;
        testing::write_file(folder / "s.toml", text + "[routing]\nprotocol = \"" + protocol + "\n");
        const RunResult run = run_scenario(load_scenario(folder / "s.toml", {}),
                                           {.folder = folder / ".", .speed = {}});
        REQUIRE(run.metrics.routed);
        const TraceStats stats = ns2_stats(folder / "trace.tr");
        CHECK(stats.routing_packets == run.metrics.routing->packets);
        CHECK(stats.data_transmissions == run.metrics.routed->data);
        CHECK(stats.metrics.transmissions > stats.data_transmissions);
    }
}

}  // namespace routed_trace_test
