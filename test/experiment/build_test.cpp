// SPDX-License-Identifier: MIT
#include "experiment/build.hpp"

#include "scenario/document/toml.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <set>
#include <span>
#include <string>
#include <utility>

namespace build_test {
using namespace rovernet;

namespace {

struct Built {
    explicit Built(const std::string& text)
        : scenario(read_scenario(parse_toml(text, "s.toml"), "s.toml")),
          network(network_settings(scenario)) {
        populate(network, scenario);
    }
    Vec3 at(const std::string& name) { return network.position(*network.find(name)); }

    Scenario scenario;
    Network network;
};

const std::string three =
    "[[robot]]\nname = \"r\"\ncount = 3\n"
    "place = { area = [[\"10 m\", \"20 m\"], [\"30 m\", \"25 m\"]] }\n";

}  // namespace

TEST_CASE(
    "build: a random_waypoint movement that does not start in its steady state gives a notice") {
    const std::string model =
        "move = { model = \"random_waypoint\", min_speed = \"1 m/s\", max_speed "
        "= \"20 m/s\", area = [[\"0 m\", \"0 m\"], [\"9 m\", \"9 m\"]]";
    const std::string r = "[[robot]]\nname = \"r\"\n";
    CHECK(Built(r + model + " }\n").scenario.notices.empty());
    const Built classic(r + model + ", start = \"uniform\" }\n");
    REQUIRE(classic.scenario.notices.size() == 1);
    CHECK(classic.scenario.notices[0].find("falls from 10.5 to 6.34 m/s") != std::string::npos);
}

TEST_CASE("build: the notice about a falling mean speed takes account of the robot's top_speed") {
    const auto notices = [](const std::string& top_speed) {
        return Built("[[robot]]\nname = \"r\"\nat = [\"1 m\", \"1 m\"]\ntop_speed = \"" +
                     top_speed +
                     "\"\nmove = { model = \"random_waypoint\", min_speed = \"1 m/s\", max_speed "
                     "= \"20 m/s\", area = [[\"0 m\", \"0 m\"], [\"9 m\", \"9 m\"]] }\n")
            .scenario.notices;
    };
    REQUIRE(notices("3 m/s").size() == 1);
    CHECK(notices("3 m/s")[0].find("falls from 2 to 1.82 m/s") != std::string::npos);
    CHECK(notices("1 m/s").empty());
}

TEST_CASE(
    "build: the key `count` creates robots name0, name1, ... at random positions in the area") {
    Built built(three);
    CHECK_FALSE(built.network.find("r"));
    CHECK_FALSE(built.network.find("r3"));
    std::set<std::pair<double, double>> places;
    for (const char* name : {"r0", "r1", "r2"}) {
        const Vec3 p = built.at(name);
        CHECK((p.x >= 10 && p.x < 30 && p.y >= 20 && p.y < 25));
        places.insert({p.x, p.y});
    }
    CHECK(places.size() == 3);
}

TEST_CASE("build: a robot added to a scenario does not change the random positions of the others") {
    Built built(three), more("[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\n" + three);
    for (const char* name : {"r0", "r1", "r2"}) CHECK(built.at(name) == more.at(name));
}

TEST_CASE("build: a different replication draws different positions") {
    Built built(three), other("[scenario]\nreplication = 1\n" + three);
    CHECK(built.at("r0") != other.at("r0"));
}

TEST_CASE("build: the placement model `choice` puts a robot at one of the listed points") {
    Built built(
        "[[robot]]\nname = \"A\"\nplace = { model = \"choice\", points = [[\"1 m\", "
        "\"2 m\"], [\"3 m\", \"4 m\"]] }\n");
    CHECK((built.at("A") == Vec3{1, 2, 0} || built.at("A") == Vec3{3, 4, 0}));
}

namespace {

/// Counts what it is asked to send, and sends it to its destination.
struct Counting {
    static constexpr bool routes_unicasts = true;
    int* asked;

    Hops initial_ttl() const { return 1; }
    void send(LinkLayer& link, NodeId node, MessageId message) {
        ++*asked;
        link.send({.message = message,
                   .sender = node,
                   .ttl = 1,
                   .hops = 1,
                   .next_hop = link.message(message).to},
                  {}, link.now());
    }
    void on_receive(LinkLayer&, const Frame&, std::span<Reception> receptions) {
        for (Reception& r : receptions) {
            r.fate = Fate::arrived;
            r.delivered = true;
        }
    }
};

}  // namespace

TEST_CASE("build: a routing protocol of the user routes all messages, except those with hops = 1") {
    const std::string two =
        "[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\n"
        "on_receive = { payload = \"ask\", send = \"answer\", to = \"sender\" }\n"
        "[[robot]]\nname = \"B\"\nat = [\"5 m\", \"0 m\"]\n"
        "[[traffic]]\nkind = \"unicast\"\nfrom = \"B\"\nto = \"A\"\npayload = \"ask\"\n";
    for (const auto& [text, expected] :
         {std::pair{two, 2}, std::pair{two + "hops = 1\n", 1}}) {  // the answer is routed
        const Scenario scenario = read_scenario(parse_toml(text, "s.toml"), "s.toml");
        Network network(network_settings(scenario));
        int asked = 0;
        populate(network, scenario, Counting{&asked});
        network.run_for(std::chrono::seconds(1));
        CHECK(asked == expected);
        CHECK(network.metrics().deliveries == 2);
    }
}

TEST_CASE("build: a robot reacts to the payload of saturated traffic") {
    const std::string two =
        "[access]\nmodel = \"csma\"\n"
        "[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\n"
        "on_receive = { payload = \"go\", send = \"coming\" }\n"
        "[[robot]]\nname = \"B\"\nat = [\"5 m\", \"0 m\"]\n"
        "[[traffic]]\nfrom = \"B\"\npayload = \"go\"\nsaturate = true\n";
    for (const std::string key : {"", "size = \"500 B\"\n"}) {
        const unsigned size = key.empty() ? 2 : 500;
        Built built(two + key);
        Network& network = built.network;
        int answers = 0, others = 0;
        network.on_receive(*network.find("A"), [&](const Message& message) {
            others += message.payload != "go" || message.size != size;
        });
        network.on_receive(*network.find("B"),
                           [&](const Message& message) { answers += message.payload == "coming"; });
        network.run_for(std::chrono::milliseconds(100));
        CHECK(answers == 1);
        CHECK(others == 0);
    }
}

}  // namespace build_test
