// SPDX-License-Identifier: MIT
// routes, as its user meets it.
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace routes_test {
using namespace rovernet::test;

namespace {

/// Five robots in a row, each in range of its neighbours; n3 is switched off at 6 s.
const std::string row = R"([scenario]
duration = "9 s"
[propagation]
model = "disc"
range = "250 m"
[routing]
protocol = "aodv"
[[robot]]
name = "n0"
at = ["0 m", "0 m"]
[[robot]]
name = "n1, relay"
at = ["200 m", "0 m"]
[[robot]]
name = "n2"
at = ["400 m", "0 m"]
[[robot]]
name = "n3"
at = ["600 m", "0 m"]
off = ["6 s"]
[[robot]]
name = "n4"
at = ["800 m", "0 m"]
[[traffic]]
kind = "unicast"
from = "n0"
to = "n4"
size = "64 B"
start = "1 s"
every = "250 ms"
)";

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// The route of a robot in the JSON of all; null if it has none.
Json route(const Json& all, std::size_t robot, const std::string& destination) {
    for (const Json& each : all["robots"][robot]["routes"]) {
        if (each["destination"] == destination) return each;
    }
    return {};
}

}  // namespace

TEST_CASE("routes: the routing tables of robots in a row lead from one robot to the next") {
    const TemporaryFolder folder;
    const std::string file = folder.write("row.toml", row);
    const Json all = json_of(folder, {"routes", file, "--at", "5s"});
    CHECK(all["time_s"] == 5.0);
    CHECK(all["protocol"] == "aodv");
    REQUIRE(all["robots"].size() == 5);
    CHECK(all["robots"][1]["robot"] == "n1, relay");
    const Json ahead = route(all, 0, "n4");
    CHECK(ahead["next_hop"] == "n1, relay");
    CHECK(ahead["hops"] == 4);
    CHECK(ahead["state"] == "valid");
    CHECK(ahead["number"].is_number());
    CHECK(ahead["since_s"] > 1.0);
    CHECK(ahead["since_s"] < 3.0);
    CHECK(std::abs(ahead["age_s"].get<double>() - (5 - ahead["since_s"].get<double>())) < 1e-9);
    CHECK(ahead["until_s"] > 5.0);
    CHECK(route(all, 2, "n0")["next_hop"] == "n1, relay");
    CHECK(route(all, 2, "n0")["hops"] == 2);
    CHECK(route(all, 2, "n4")["next_hop"] == "n3");
    CHECK(route(all, 4, "n0")["hops"] == 4);
}

TEST_CASE("routes: a broken route is marked as broken") {
    const TemporaryFolder folder;
    const std::string file = folder.write("row.toml", row);
    const Json all = json_of(folder, {"routes", file, "--at", "7s", "--robot", "n2"});
    REQUIRE(all["robots"].size() == 1);
    CHECK(all["robots"][0]["robot"] == "n2");
    CHECK(route(all, 0, "n4")["state"] == "broken");
    CHECK(route(all, 0, "n0")["state"] == "valid");
}

TEST_CASE("routes: the CSV and the text output have a line for each route of the JSON output") {
    const TemporaryFolder folder;
    const std::string file = folder.write("row.toml", row);
    const Ended csv = command(folder, {"routes", file, "--at", "5s", "--csv"});
    const auto lines = lines_of(csv.out);
    REQUIRE(!lines.empty());
    CHECK(lines[0] == "robot,destination,next_hop,hops,number,state,since_s,age_s,until_s,path");
    std::size_t routes = 0;
    const Json all = json_of(folder, {"routes", file, "--at", "5s"});
    for (const Json& robot : all["robots"]) routes += robot["routes"].size();
    CHECK(lines.size() == 1 + routes);
    CHECK(csv.out.find("\nn0,n4,\"n1, relay\",4,") != std::string::npos);
    const Ended text = command(folder, {"routes", file, "--at", "5s"});
    CHECK(lines_of(text.out).size() == 1 + routes);
    CHECK(text.out.starts_with("robot      destination  next hop   hops  number  state"));
    const Ended begin = command(folder, {"routes", file, "--at", "0s", "--robot", "n2"});
    CHECK(begin.out == "n2 has no routes at 0 s\n");
}

TEST_CASE("routes: the error for an invalid time, robot or protocol states what is expected") {
    const TemporaryFolder folder;
    const std::string file = folder.write("row.toml", row);
    const auto refusal = [&](std::vector<std::string> more, int exit) {
        more.insert(more.begin(), {"routes", file});
        const Ended ended = command(folder, more);
        CHECK(ended.exit == exit);
        CHECK(ended.out.empty());
        return ended.err;
    };
    CHECK(refusal({"--at", "9.1s"}, 2)
              .find("--at 9.1s: expected a time within the run, which ends at "
                    "9 s") != std::string::npos);
    CHECK(command(folder, {"routes", file, "--at", "9s"}).exit == 0);
    CHECK(refusal({"--at", "5s", "--robot", "n5"}, 2).find("did you mean") != std::string::npos);
    const std::string flood = refusal({"--at", "5s", "--set", "routing.protocol=flood"}, 2);
    CHECK(flood.find("flood keeps no routes; expected a protocol with routes (") !=
          std::string::npos);
    CHECK(flood.find("aodv") != std::string::npos);
    CHECK(refusal({}, 2).find("--at") != std::string::npos);
    CHECK(refusal({"--at", "5s", "--csv", "--json"}, 2).find("excludes") != std::string::npos);
}

TEST_CASE("draw --routes, --search: the route and the last route request are drawn") {
    const TemporaryFolder folder;
    const std::string file = folder.write("row.toml", row);
    const auto draw = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"draw", file, "-o", folder.path("p.svg"), "--at"});
        return command(folder, more);
    };
    CHECK(draw({"5s", "--routes", "n0,n4", "--search"}).exit == 0);
    const std::string svg = content(folder.path("p.svg"));
    CHECK(svg.find("route from n0 to n4: n0 &gt; n1, relay &gt; n2 &gt; n3 &gt; n4, 4 hops") !=
          std::string::npos);
    CHECK(svg.find("last route request of n0: sent by ") != std::string::npos);
    const auto refusal = [&](const std::vector<std::string>& more) {
        const Ended ended = draw(more);
        CHECK(ended.exit == 2);
        return ended.err;
    };
    CHECK(refusal({"5s", "--routes", "n0"}).find("--routes n0: expected two different robots") !=
          std::string::npos);
    CHECK(refusal({"5s", "--routes", "n0,n0"}).find("two different robots") != std::string::npos);
    CHECK(refusal({"5s", "--routes", "n0,n5"}).find("did you mean") != std::string::npos);
    CHECK(refusal({"10s", "--routes", "n0,n4"}).find("which ends at 9 s") != std::string::npos);
    CHECK(refusal({"5s", "--search", "--set", "routing.protocol=flood"})
              .find("flood keeps no routes") != std::string::npos);
}

}  // namespace routes_test
