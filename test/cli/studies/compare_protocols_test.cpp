// SPDX-License-Identifier: MIT
// compare --protocols, as its user meets it.
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace compare_protocols_test {
using namespace rovernet::test;

namespace {

/// A and C, which only B joins; and B, which A reaches at once.
const std::string three = R"([scenario]
duration = "6 s"
[propagation]
model = "disc"
range = "250 m"
[routing]
hello = "1 s"
duplicates = "forward"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["200 m", "0 m"]
[[robot]]
name = "C"
at = ["400 m", "0 m"]
[[traffic]]
kind = "unicast"
from = "A"
to = "C"
size = "64 B"
start = "1 s"
every = "500 ms"
stop = "5 s"
[[traffic]]
kind = "unicast"
from = "A"
to = "B"
size = "64 B"
start = "1.1 s"
every = "500 ms"
stop = "5 s"
)";

std::vector<std::string> protocols(const std::string& file, const std::string& names) {
    return {"compare", file, "--protocols", names, "--replications", "3", "--workers", "2"};
}

/// The row of a protocol in the comparison of a metric.
Json row(const Json& all, const std::string& metric, const std::string& protocol) {
    for (const Json& each : all["comparisons"]) {
        if (each["metric"] != metric) continue;
        for (const Json& row : each["rows"]) {
            if (row["protocol"] == protocol) return row;
        }
    }
    return {};
}

}  // namespace

TEST_CASE(
    "compare --protocols: prints deliveries, delays, loads, airtimes and paired differences") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", three);
    const Json all = json_of(folder, protocols(file, "flood,aodv"));
    REQUIRE(all["comparisons"].size() == 4);
    CHECK(all["comparisons"][0]["baseline"] == "flood");
    // A flood routes no messages to one robot: those to C go over one hop, to nobody.
    CHECK(row(all, "delivery_ratio", "flood")["mean"] == 0.5);
    CHECK(row(all, "delivery_ratio", "aodv")["mean"] == 1.0);
    CHECK(row(all, "delivery_ratio", "aodv")["difference"] == 0.5);
    CHECK(row(all, "delivery_ratio", "flood")["difference"].is_null());
    CHECK(row(all, "routing_load", "flood")["undefined"] == 3);
    CHECK(row(all, "routing_load", "aodv")["mean"] > 0);
    CHECK(row(all, "latency_mean_s", "aodv")["difference"] > 0);
    CHECK(row(all, "airtime_per_byte_us", "aodv")["mean"] > 0);
}

TEST_CASE("compare --protocols: the airtime equals the sum of the airtimes of all frames") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", three);
    const Json all = json_of(folder, protocols(file, "flood,aodv"));
    const Json run = json_of(folder, {"run", file, "--out", folder.path("run"), "--set",
                                      "radio.rate=2 Mb/s", "--set", "radio.preamble=192 us"});
    // Without acknowledgements: 16 frames of 64 B, of which half arrive.
    const double frame_us = 192 + 8 * 64 / 2.0;
    CHECK(run["transmissions"] == 16);
    CHECK(std::abs(run["airtime_s"].get<double>() - 16e-6 * frame_us) < 1e-12);
    CHECK(std::abs(run["airtime_per_byte_us"].get<double>() - 2 * frame_us / 64) < 1e-9);
    CHECK(row(all, "airtime_per_byte_us", "flood")["n"] == 3);
}

TEST_CASE(
    "compare --protocols: writes a table, CSV or a picture; a notice lists messages that go over "
    "only one hop") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", three);
    auto words = protocols(file, "aodv,flood");
    words.insert(words.end(), {"--metric", "delivery_ratio,hops_mean", "-o", folder.path("p.svg")});
    const Ended text = command(folder, words);
    CHECK(text.exit == 0);
    CHECK(text.err.find("go over one hop") != std::string::npos);
    CHECK(text.out.starts_with("protocol  delivery_ratio"));
    CHECK(text.out.find("\nprotocol  hops_mean") != std::string::npos);
    CHECK(text.out.find("flood is 0.5 below aodv in each of 3 replications") != std::string::npos);
    CHECK(text.out.find("\nover one hop only: unicasts under flood\n") != std::string::npos);
    const std::string svg = content(folder.path("p.svg"));
    CHECK(svg.find("airtime for each byte delivered [us]") != std::string::npos);
    CHECK(svg.find("width=\"1000\"") != std::string::npos);
    CHECK(svg.find("over one hop only") != std::string::npos);

    words = protocols(file, "aodv,flood");
    words.push_back("--csv");
    const Ended csv = command(folder, words);
    CHECK(csv.out.starts_with(
        "metric,protocol,mean,low,high,n,failed,missing,undefined,difference,"));
    CHECK(std::ranges::count(csv.out, '\n') == 1 + 4 * 2);
    CHECK(csv.out.find("\nrouting_load,flood,,,,0,0,0,3,,") != std::string::npos);
}

TEST_CASE(
    "compare --protocols: a printed scenario with `aodv` and hello = 0 s is read without an "
    "error") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", three);
    const Ended printed = command(folder, {"run", file, "--set", "routing.protocol=aodv", "--set",
                                           "routing.hello=0 s", "--print-scenario"});
    REQUIRE(printed.exit == 0);
    const Ended ended =
        command(folder, protocols(folder.write("p.toml", printed.out), "aodv,flood"));
    CHECK(ended.exit == 0);
    CHECK(ended.err.find("hello") == std::string::npos);
}

TEST_CASE("compare --protocols: a notice says if protocols count unfinished unicasts differently") {
    const TemporaryFolder folder;
    const std::string notice =
        "some unicasts are still on their way when a run ends. The delivery_ratio of flood leaves "
        "out these unicasts (3 in all runs); the delivery_ratio of aodv counts them as not "
        "delivered";
    const auto errors = [&](const std::string& stop, const std::string& names) {
        return command(folder, protocols(folder.write("s.toml", three + stop), names)).err;
    };
    const std::string to_end =  // sends at the end of the run, too
        "[[traffic]]\nkind = \"unicast\"\nfrom = \"B\"\nto = \"A\"\nsize = \"64 B\"\n"
        "every = \"1 s\"\n";
    CHECK(errors(to_end, "flood,aodv").find(notice) != std::string::npos);
    CHECK(errors(to_end, "aodv,dsr").find("on their way") == std::string::npos);
    CHECK(errors("", "flood,aodv").find("on their way") == std::string::npos);
}

TEST_CASE("compare --protocols: unknown names, or fewer than two protocols, are refused") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", three);
    const auto refusal = [&](const std::vector<std::string>& words) {
        const Ended ended = command(folder, words);
        CHECK(ended.exit == 2);
        CHECK(ended.out.empty());
        return ended.err;
    };
    CHECK(refusal(protocols(file, "flood,adov")).find("did you mean \"aodv\"?") !=
          std::string::npos);
    CHECK(refusal(protocols(file, "aodv")).find("at least two protocols") != std::string::npos);
    auto words = protocols(file, "flood,aodv");
    words.insert(words.end(), {"--baseline", "dsdv"});
    CHECK(refusal(words).find("expected one of flood, aodv") != std::string::npos);
    words = protocols(file, "flood,aodv");
    words.insert(words.end(), {"--metric", "delivery_ratio,load"});
    CHECK(refusal(words).find("there is no metric \"load\"") != std::string::npos);
    words = protocols(file, "flood,aodv");
    words.insert(words.end(), {"--models", "friis,disc"});
    CHECK(refusal(words).find("excludes") != std::string::npos);
}

TEST_CASE("compare: if the study varies the protocol, the option --protocols is not needed") {
    const TemporaryFolder folder;
    const std::string file = folder.write(
        "s.toml",
        three + "[study]\nreplications = 2\nvary.routing.protocol = [\"flood\", \"aodv\"]\n");
    const Json all = json_of(folder, {"compare", file, "--metric", "delivery_ratio"});
    CHECK(all["metric"] == "delivery_ratio");
    CHECK(all["baseline"] == "flood");
    CHECK(all["rows"][1]["protocol"] == "aodv");
    CHECK(all["rows"][1]["mean"] == 1.0);
}

}  // namespace compare_protocols_test
