// SPDX-License-Identifier: MIT
#include "scenario/traffic_file.hpp"

#include "experiment/run.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario_file.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace traffic_file_test {
using namespace rovernet;
using test::TemporaryFolder;

namespace {

/// A flow as ns-2's cbrgen.tcl writes it, the i-th of a file.
std::string flow(int i, int from, int to, const std::string& start) {
    const std::string n = "(" + std::to_string(i) + ")";
    const auto node = [](int k) { return "$node_(" + std::to_string(k) + ")"; };
    return "#\n# " + std::to_string(from) + " connecting to " + std::to_string(to) + " at time " +
           start + "\n#\nset udp_" + n + " [new Agent/UDP]\n$ns_ attach-agent " + node(from) +
           " $udp_" + n + "\nset null_" + n + " [new Agent/Null]\n$ns_ attach-agent " + node(to) +
           " $null_" + n + "\nset cbr_" + n + " [new Application/Traffic/CBR]\n$cbr_" + n +
           " set packetSize_ 512\n$cbr_" + n + " set interval_ 0.25\n$cbr_" + n +
           " set random_ 1\n$cbr_" + n + " set maxpkts_ 10000\n$cbr_" + n + " attach-agent $udp_" +
           n + "\n$ns_ connect $udp_" + n + " $null_" + n + "\n$ns_ at " + start + " \"$cbr_" + n +
           " start\"\n$ns_ at 30.0 \"$cbr_" + n + " stop\"\n";
}

std::string error_of(const std::string& text) {
    const TemporaryFolder folder;
    try {
        read_traffic_file(folder.write("cbr.tcl", text));
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

std::string with(std::string text, const std::string& old, const std::string& now) {
    return text.replace(text.find(old), old.size(), now);
}

}  // namespace

TEST_CASE("traffic file: maxpkts_ below 1 sends one packet, as in ns-2.35") {
    const TemporaryFolder folder;
    for (const auto& [most, packets] : {std::pair{"-1", 1}, {"0", 1}, {"1", 1}, {"2", 2}}) {
        CAPTURE(most);
        const std::string text =
            with(flow(0, 3, 0, "15.2"), "maxpkts_ 10000", std::string("maxpkts_ ") + most);
        const TrafficFile file = read_traffic_file(folder.write("cbr.tcl", text));
        REQUIRE(file.flows.size() == 1);
        CHECK(file.flows[0].count == packets);
    }
}

TEST_CASE(
    "traffic file: flows from ns-2's generator cbrgen are read as unicasts with size, interval and "
    "times") {
    const TemporaryFolder folder;
    const std::string text = "#\n# nodes: 4, max conn: 2, send rate: 0.25, seed: 2\n#\n" +
                             flow(0, 3, 0, "15.213169") + flow(1, 0, 2, "19.130138") +
                             "#\n#Total sources/connections: 2/2\n#\n";
    const TrafficFile file = read_traffic_file(folder.write("cbr.tcl", text));
    REQUIRE(file.flows.size() == 2);
    const TrafficTable& first = file.flows[0];
    CHECK(first.kind == TrafficKind::unicast);
    CHECK(first.from == "n3");
    CHECK(first.to == "n0");
    CHECK(first.size == Bytes{512});
    CHECK(first.start == from_seconds(15.213169));
    CHECK(first.every == from_seconds(0.25));
    CHECK(first.stop == from_seconds(30));
    CHECK(first.count == 10000);
    CHECK(file.flows[1].from == "n0");
    CHECK(file.flows[1].to == "n2");
    REQUIRE(file.notices.size() == 1);
    CHECK(file.notices[0].find("random_ of 2 flows is ignored") != std::string::npos);
}

TEST_CASE(
    "traffic file: the interval of messages follows from the rate, and the defaults are those of "
    "ns-2") {
    const TemporaryFolder folder;
    const auto every = [&](const std::string& key) {
        const std::string text = with(flow(0, 1, 2, "1.0"), "$cbr_(0) set interval_ 0.25\n", key);
        return read_traffic_file(folder.write("cbr.tcl", text)).flows.at(0).every.value();
    };
    CHECK(every("$cbr_(0) set rate_ 64k\n") == from_seconds(512 * 8 / 64e3));
    CHECK(every("$cbr_(0) set rate_ 0.5Mb\n") == from_seconds(512 * 8 / 0.5e6));
    CHECK(every("$cbr_(0) set rate_ 20kB\n") == from_seconds(512 * 8 / 160e3));
    CHECK(every("$cbr_(0) set rate_ 0.001Gb\n") == from_seconds(512 * 8 / 1e6));
    CHECK(every("$cbr_(0) set rate_ 64kbps\n") == from_seconds(512 * 8 / 64e3));
    CHECK(every("$cbr_(0) set interval_ 250ms\n") == from_seconds(0.25));
    // ns-2.35: a size that follows the interval keeps the rate.
    CHECK(every("$cbr_(0) set interval_ 0.25\n$cbr_(0) set packetSize_ 1024\n") ==
          from_seconds(0.5));
    CHECK(every("") == from_seconds(512 * 8 / 448e3));
}

TEST_CASE(
    "traffic file: messages larger than the agent's packet size are sent as several packets") {
    const TemporaryFolder folder;
    std::vector<std::string> notices;
    const auto sizes = [&](const std::string& size, const std::string& agent) {
        std::string text = with(flow(0, 1, 2, "1.0"), "packetSize_ 512", "packetSize_ " + size);
        text = with(text, "set null_(0)", agent + "set null_(0)");
        const TrafficFile file = read_traffic_file(folder.write("cbr.tcl", text));
        notices = file.notices;
        std::vector<std::uint32_t> all;
        for (const TrafficTable& each : file.flows) {
            CHECK(each.start == from_seconds(1));
            CHECK(each.every == from_seconds(0.25));
            CHECK(each.count == 10000);
            all.push_back(each.size->value);
        }
        return all;
    };
    using Sizes = std::vector<std::uint32_t>;
    // The packets that ns-2.35 sends at 1 s.
    CHECK(sizes("2000", "") == Sizes{1000, 1000});
    CHECK(sizes("2500", "") == Sizes{1000, 1000, 500});
    CHECK(sizes("1000", "") == Sizes{1000});
    CHECK(sizes("1500", "$udp_(0) set packetSize_ 600\n") == Sizes{600, 600, 300});
    CHECK(sizes("2000", "$udp_(0) set packetSize_ 2000\n$udp_(0) set fid_ 2\n") == Sizes{2000});
    CHECK(notices.size() == 1);  // random_
    CHECK(sizes("512", "$udp_(0) set ttl_ 3\n$udp_(0) set ttl_ 4\n") == Sizes{512});
    REQUIRE(notices.size() == 2);
    CHECK(notices[1].find("cbr.tcl:6:1: this line about an agent is left out, and 1 more") !=
          std::string::npos);
    CHECK_THROWS_WITH_AS(sizes("512", "$udp_(0) set packetSize_ 0\n"),
                         doctest::Contains("a size in bytes from 1 to 65507"), InputError);
}

TEST_CASE("traffic file: content other than CBR over UDP is refused, with line and column") {
    const std::string good = flow(0, 1, 2, "1.0");
    CHECK(error_of(good) == "");
    CHECK(
        error_of(with(good, "Agent/UDP", "Agent/TCP")).find("cbr.tcl:4:18: found \"Agent/TCP\"") !=
        std::string::npos);
    CHECK(error_of("set tcp_(0) [$ns_ create-connection TCP $node_(1) TCPSink $node_(2) 0]\n")
              .find("cbr.tcl:1:14: found \"$ns_\", expected [new ...]; TCP is not supported") !=
          std::string::npos);
    CHECK(
        error_of(with(good, "$ns_ connect $udp_(0) $null_(0)\n", "")).find("has no destination") !=
        std::string::npos);
    CHECK(error_of(with(good, "$node_(2)", "$node_(1)")).find("its own node") != std::string::npos);
    CHECK(error_of(with(good, "512", "a lot")).find("a size in bytes") != std::string::npos);
    CHECK(error_of(with(good, "0.25", "20Xs")).find("found \"20Xs\"") != std::string::npos);
    CHECK(error_of(good + "$ns_ at 40.0 \"$cbr_(0) start\"\n")
              .find("found a second start of this application") != std::string::npos);
    CHECK(error_of(with(good, "at 30.0", "at 0.5")).find("stops before it starts") !=
          std::string::npos);
    CHECK(
        error_of(with(good, "$cbr_(0) start", "$cbr_(7) start")).find("an earlier line creates") !=
        std::string::npos);
}

TEST_CASE("traffic file: a file named in [traffic] or [[traffic]] adds its flows to the scenario") {
    const TemporaryFolder folder;
    folder.write("cbr.tcl", flow(0, 1, 2, "1.0"));
    folder.write("scen.tcl", "$node_(1) set X_ 1.0\n$node_(2) set X_ 9.0\n");
    const std::string base = "[scenario]\nduration = \"2 s\"\n[movement]\nfile = \"scen.tcl\"\n";
    const auto run = [&](const std::string& traffic) {
        const Scenario s = load_scenario(folder.write("s.toml", base + traffic), {});
        return run_scenario(s, {.folder = folder.path("out"), .speed = {}}).metrics;
    };
    CHECK(run("[traffic]\nfile = \"cbr.tcl\"\n").messages == 5);  // at 1, 1.25, ... 2 s
    const auto both =
        run("[[traffic]]\nfile = \"cbr.tcl\"\n[[traffic]]\nfrom = \"n2\"\npayload = \"x\"\n");
    CHECK(both.messages == 6);
    // What it wrote runs by itself, without the traffic file.
    const Scenario written = load_scenario(folder.path("out/scenario.toml"), {});
    CHECK(written.traffic.size() == 2);
    CHECK_THROWS_AS(run("[traffic]\nfile = \"none.tcl\"\n"), InputError);
    CHECK_THROWS_AS(run("[traffic]\nfile = \"cbr.tcl\"\nsize = \"3 B\"\n"), InputError);
}

}  // namespace traffic_file_test
