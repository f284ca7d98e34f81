// SPDX-License-Identifier: MIT
// Suppression of a flood: the rules by receptions that are made up, and what they reach and save on
// random graphs without collisions.
#include "routing/flood.hpp"
#include "routing/suppression/suppression_router.hpp"
#include "test/routing/fake_link_layer.hpp"
#include "test/routing/unit_disc.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace suppression_test {
using namespace rovernet;
using namespace std::chrono_literals;
using Scheme = SuppressionScheme;
using test::Graph;
using test::UnitDisc;

namespace {

/// Node 1, which hears copies of one message of node 0, each from a sender at a place of its own.
struct Hearer {
    SuppressionRouter router;
    test::FakeLinkLayer link{2};
    MessageId message = link.message_from({0});

    explicit Hearer(const Suppression& suppression) : router(suppression) {}
    Reception hear(Vec3 sender_at = {100, 0, 0}, Hops ttl = 9) {
        link.on.push_back(true);
        link.positions.push_back(sender_at);
        const NodeId from{static_cast<std::uint32_t>(link.size() - 1)};
        return link.arrive(router, {.message = message, .sender = from, .ttl = ttl, .hops = 1},
                           {1})[0];
    }
    /// Whether node 1 will forward the message.
    bool will_send() const {
        return !link.sent.empty() && link.sent.back().stage == test::FakeLinkLayer::Stage::waiting;
    }
};

}  // namespace

TEST_CASE(
    "suppression, counter: a robot that hears C copies before its send time does not forward") {
    for (const int c : {2, 3, 4}) {
        Hearer node({.threshold = c});
        for (int copies = 1; copies < c; ++copies) {
            CHECK(node.hear().fate == (copies == 1 ? Fate::waiting : Fate::duplicate));
            CHECK(node.will_send());
        }
        CHECK(node.hear().fate == Fate::duplicate);
        CHECK(!node.will_send());
        node.hear();
        CHECK(node.link.sent.size() == 1);
        CHECK(node.link.drops.empty());
    }
}

TEST_CASE("suppression, counter: with C = 1 no copy is forwarded, but the message is delivered") {
    Hearer node({.threshold = 1});
    const Reception first = node.hear();
    CHECK(first.fate == Fate::arrived);
    CHECK(first.delivered);
    CHECK(node.link.sent.empty());
}

TEST_CASE(
    "suppression: copies heard after the robot's own send time have no effect, and are not "
    "delivered again") {
    for (const Scheme scheme : {Scheme::counter, Scheme::distance, Scheme::location}) {
        Hearer node({.scheme = scheme, .range = Meters{100}});
        CHECK(node.hear().delivered);
        const Frame forwarded = node.link.go();
        CHECK(forwarded.sender == NodeId{1});
        CHECK(forwarded.ttl == 8);
        CHECK(forwarded.hops == 2);
        for (int i = 0; i < 5; ++i) {
            const Reception later = node.hear({1, 0, 0});
            CHECK(later.fate == Fate::duplicate);
            CHECK(!later.delivered);
        }
        REQUIRE(node.link.sent.size() == 1);
        CHECK(node.link.sent[0].stage == test::FakeLinkLayer::Stage::queued);
    }
}

TEST_CASE(
    "suppression: after a copy was sent, a duplicate does not cancel a later frame with the same "
    "handle") {
    Hearer node({.threshold = 2});
    node.hear();
    node.link.sent[0].queued.frame.sender = NodeId{7};  // sent, and the slot is another frame's
    node.hear();
    CHECK(node.link.sent[0].stage == test::FakeLinkLayer::Stage::waiting);
}

TEST_CASE("suppression: a copy waits for 1 us plus a random time, uniform from 0 to the delay") {
    for (const auto scheme : {Scheme::counter, Scheme::probability}) {
        Hearer node({.scheme = scheme, .delay = 80ms});
        node.link.drawn = 0.25;
        node.hear();
        REQUIRE(node.link.sent.size() == 1);
        CHECK(node.link.sent[0].at == start_of_run + 1us + 20ms);
    }
}

TEST_CASE(
    "suppression, probability: a random draw with probability P alone decides whether to forward") {
    for (const double drawn : {0.1, 0.299, 0.301, 0.9}) {
        Hearer node({.scheme = Scheme::probability, .threshold = 0.3});
        node.link.drawn = drawn;
        CHECK(node.hear().fate == (drawn < 0.3 ? Fate::waiting : Fate::arrived));
        for (int i = 0; i < 5; ++i) CHECK(node.hear({1, 0, 0}).fate == Fate::duplicate);
        CHECK(node.will_send() == (drawn < 0.3));
    }
}

TEST_CASE("suppression, probability: the delay does not depend on the random draw for forwarding") {
    Hearer node({.scheme = Scheme::probability, .threshold = 0.3, .delay = 80ms});
    node.link.drawn_at = {{0, 0.75}, {1, 0.1}};
    CHECK(node.hear().fate == Fate::waiting);
    CHECK(node.link.sent[0].at == start_of_run + 1us + 60ms);
}

TEST_CASE("suppression, distance: a robot that hears any sender nearer than D does not forward") {
    const Suppression within_50{.scheme = Scheme::distance, .threshold = 50};
    Hearer first(within_50);
    CHECK(first.hear({30, 39, 0}).fate == Fate::arrived);  // 49.2 m
    CHECK(first.link.sent.empty());
    Hearer later(within_50);
    CHECK(later.hear({30, 41, 0}).fate == Fate::waiting);  // 50.8 m
    later.hear({0, 51, 0});
    later.hear({0, 30, 41});  // on another storey
    CHECK(later.will_send());
    later.hear({0, 49, 0});
    CHECK(!later.will_send());
    CHECK(later.hear({90, 0, 0}).fate == Fate::duplicate);
    CHECK(later.link.sent.size() == 1);
}

TEST_CASE(
    "suppression, location: a robot forwards only if at least the share A of its disc is "
    "uncovered") {
    const auto run = [](double a) {
        Hearer node({.scheme = Scheme::location, .threshold = a, .range = Meters{100}});
        std::string sends;
        for (const double x : {100.0, -100.0}) {
            node.hear({x, 0, 0});
            sends += node.will_send() ? 'y' : 'n';
        }
        return sends;
    };
    // One disc at the distance r leaves .6090, two opposite ones 2 x .6090 - 1 = .2180.
    CHECK(run(0.217) == "yy");
    CHECK(run(0.219) == "yn");
    CHECK(run(0.608) == "yn");
    CHECK(run(0.610) == "nn");
}

TEST_CASE(
    "suppression: if the first copy has no TTL left, nothing is forwarded, not even a later copy") {
    Hearer node({});
    const Reception first = node.hear({}, 1);
    CHECK(first.fate == Fate::ttl);
    CHECK(first.delivered);
    CHECK(node.hear({}, 9).fate == Fate::duplicate);
    CHECK(node.link.sent.empty());
}

TEST_CASE("suppression: the source neither forwards nor delivers its own message") {
    test::FakeLinkLayer link(2);
    SuppressionRouter router(Suppression{.ttl = 7});
    const MessageId message = link.message_from({0});
    router.send(link, {0}, message);
    REQUIRE(link.sent.size() == 1);
    CHECK(link.sent[0].queued.frame.ttl == 7);
    CHECK(link.sent[0].at == start_of_run);
    const auto heard =
        link.arrive(router, {.message = message, .sender = {1}, .ttl = 6, .hops = 2}, {0});
    CHECK(heard[0].fate == Fate::duplicate);
    CHECK(!heard[0].delivered);
    CHECK(link.sent.size() == 1);
}

TEST_CASE("suppression: a threshold out of its scheme's range is refused, and the range is named") {
    struct Case {
        Suppression settings;
        std::string error;
    };
    const auto counter = [](double c) { return Suppression{.threshold = c}; };
    const auto of = [](Scheme scheme, double threshold) {
        return Suppression{.scheme = scheme, .threshold = threshold, .range = Meters{100}};
    };
    const std::string whole =
        "suppression: threshold must be a whole number from 1 to 1e9 for scheme \"counter\", got ";
    const std::vector<Case> cases{
        {counter(0), whole + "0"},
        {counter(2.5), whole + "2.5"},
        {counter(-1), "suppression: threshold must be >= 0, got -1"},
        {of(Scheme::probability, 1.1),
         "suppression: threshold must be from 0 to 1 for scheme \"probability\", got 1.1"},
        {of(Scheme::location, 2),
         "suppression: threshold must be from 0 to 1 for scheme \"location\", got 2"},
        {{.scheme = Scheme::location},
         "suppression: range must be given; expected a value > 0 m for scheme \"location\""},
        {{.scheme = Scheme::location, .range = Meters{0}}, "suppression: range must be > 0, got 0"},
        {{.delay = -1ns}, "suppression: delay must be from 0 to 1e9 s, got -1e-09"},
        {{.ttl = 0}, "suppression: ttl must be from 1 to 65535, got 0"}};
    for (const auto& [settings, error] : cases)
        CHECK_THROWS_WITH_AS(SuppressionRouter{settings}, error.c_str(), std::invalid_argument);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(SuppressionRouter{counter(nan)}, std::invalid_argument);
    CHECK_NOTHROW(SuppressionRouter{of(Scheme::distance, 1e6)});
}

namespace {

/// What a flood reached and saved: RE and SRB of Ni et al.
struct Outcome {
    double reach = 0, saved = 0;
    friend bool operator==(const Outcome&, const Outcome&) = default;
    friend std::ostream& operator<<(std::ostream& to, const Outcome& o) {
        return to << o.reach << '/' << o.saved;
    }
};

/// Ratio of the longest delay to a frame's time in the table below, 620 ms to 2.5 ms.
constexpr auto delay = 248 * Graph::hop_time;

/// Floods one message from the source of a connected part.
Outcome flooded(const UnitDisc& net, Router router, std::uint64_t seed) {
    Graph graph(net.at.size(), net.edges, std::move(router));
    graph.seed = seed;
    graph.positions = net.at;
    graph.send(net.source, everyone.value, start_of_run);
    graph.run(start_of_run + 1000s);
    CHECK(graph.messages_in_use() == 0);
    const auto reached = static_cast<double>(graph.delivered[0].size());
    const double forwarded = graph.frames[""] - 1;
    return {reached / static_cast<double>(net.reachable()), (reached - forwarded) / reached};
}

UnitDisc map_of(int k, std::uint64_t seed) { return {100, 500.0 * k, 500, seed}; }

/// Mean over random maps of k x k units of 500 m, without those whose source has no neighbour.
Outcome mean(int k, Suppression settings, int maps) {
    settings.delay = delay;
    Outcome sum;
    int count = 0;
    for (std::uint64_t seed = 1; count < maps; ++seed) {
        const UnitDisc net = map_of(k, seed);
        if (net.reachable() == 0) continue;
        const Outcome one = flooded(net, settings, seed);
        sum.reach += one.reach;
        sum.saved += one.saved;
        ++count;
    }
    return {sum.reach / count, sum.saved / count};
}

/// Means and standard deviations over other maps, by a program of its own.
struct Expected {
    double reach, reach_sigma, saved, saved_sigma;
};

}  // namespace

TEST_CASE("suppression on graphs: thresholds that suppress nothing give plain flooding") {
    for (const int k : {3, 5, 8}) {
        const UnitDisc net = map_of(k, 5);
        REQUIRE(net.reachable() > 5);
        const Outcome flood = flooded(net, Flood{.ttl = 255}, 1);
        CHECK(flood == Outcome{1, 0});
        const double c = static_cast<double>(net.largest_degree()) + 1;
        CHECK(flooded(net, Suppression{.threshold = c + 1}, 1) == flood);
        CHECK(flooded(net, Suppression{.scheme = Scheme::probability, .threshold = 1}, 1) == flood);
        CHECK(flooded(net, Suppression{.scheme = Scheme::distance, .threshold = 0}, 1) == flood);
        CHECK(flooded(net,
                      Suppression{.scheme = Scheme::location, .threshold = 0, .range = Meters{500}},
                      1) == flood);
    }
}

TEST_CASE(
    "suppression on graphs: with P = 0, C = 1 or A = 1 only the source's neighbours are reached") {
    const UnitDisc net = map_of(5, 5);
    const double reachable = static_cast<double>(net.reachable());
    const Outcome once{static_cast<double>(net.neighbours()[net.source].size()) / reachable, 1};
    CHECK(flooded(net, Suppression{.threshold = 1}, 1) == once);
    CHECK(flooded(net, Suppression{.scheme = Scheme::probability, .threshold = 0}, 1) == once);
    CHECK(flooded(net, Suppression{.scheme = Scheme::distance, .threshold = 501}, 1) == once);
    CHECK(flooded(net,
                  Suppression{.scheme = Scheme::location, .threshold = 1, .range = Meters{500}},
                  1) == once);
}

TEST_CASE(
    "suppression on graphs: with the probability P, a share 1 - P of the rebroadcasts is saved") {
    // 100 nodes in reach of all on each of 60 maps: sigma is sqrt(P (1 - P) / 5940) < .0065.
    constexpr double four_sigma = 0.026;
    for (const double p : {0.3, 0.5, 0.7}) {
        const Outcome o = mean(1, {.scheme = Scheme::probability, .threshold = p}, 60);
        CHECK(o.reach == 1);
        CHECK(std::abs(o.saved - (1 - p)) < four_sigma);
    }
}

TEST_CASE(
    "suppression on graphs: reach and savings equal those published by Ni et al., on maps of six "
    "sizes") {
    struct Row {
        Suppression settings;
        std::vector<Expected> on;  ///< maps of 1, 3, 5, 7, 9, 11 units
    };
    // Maps here and there. Sparse maps vary more: whether a flood crosses the few gaps decides.
    struct Maps {
        double here, there;
    };
    const std::vector<Maps> maps{{10, 100},   {20, 200},   {40, 400},
                                 {100, 1000}, {100, 1000}, {100, 1000}};
    constexpr double rare = 0.002;  // floods that stop early on no map of these, or on one of those
    const auto of = [](Scheme scheme, double t) {
        return Suppression{.scheme = scheme, .threshold = t};
    };
    const std::vector<Row> table{{of(Scheme::counter, 2),
                                  {{.9996, .003, .9819, .006},
                                   {.9893, .079, .8637, .015},
                                   {.9197, .184, .7044, .035},
                                   {.6018, .315, .5581, .099},
                                   {.674, .308, .434, .172},
                                   {.8413, .24, .3311, .211}}},
                                 {of(Scheme::counter, 3),
                                  {{1, 0, .9684, .007},
                                   {.9997, .003, .8023, .015},
                                   {.9889, .051, .5802, .023},
                                   {.8926, .204, .3564, .069},
                                   {.9029, .189, .2067, .124},
                                   {.965, .115, .1127, .129}}},
                                 {of(Scheme::counter, 4),
                                  {{1, 0, .956, .007},
                                   {1, 0, .7458, .017},
                                   {.9933, .047, .4789, .027},
                                   {.962, .124, .2306, .056},
                                   {.9738, .099, .0968, .079},
                                   {.9927, .055, .0395, .07}}},
                                 {of(Scheme::probability, .3),
                                  {{1, 0, .702, .049},
                                   {.9732, .124, .7039, .054},
                                   {.463, .279, .7408, .106},
                                   {.1794, .184, .756, .154},
                                   {.3701, .328, .7506, .23},
                                   {.5802, .331, .7474, .277}}},
                                 {of(Scheme::probability, .5),
                                  {{1, 0, .4993, .053},
                                   {.9998, .002, .4968, .049},
                                   {.8444, .232, .5188, .085},
                                   {.3344, .255, .5524, .163},
                                   {.4685, .342, .5598, .252},
                                   {.6714, .324, .5651, .309}}},
                                 {of(Scheme::probability, .7),
                                  {{1, 0, .2947, .047},
                                   {1, 0, .3011, .043},
                                   {.9707, .126, .3127, .071},
                                   {.6078, .314, .3337, .139},
                                   {.5993, .333, .3571, .235},
                                   {.7808, .292, .3628, .302}}},
                                 {of(Scheme::distance, 50),
                                  {{1, 0, .6006, .026},
                                   {1, 0, .1482, .032},
                                   {.9999, .002, .0566, .021},
                                   {.998, .035, .0326, .043},
                                   {.9984, .03, .022, .053},
                                   {1, 0, .0195, .076}}},
                                 {of(Scheme::distance, 100),
                                  {{1, 0, .852, .014},
                                   {1, 0, .4086, .036},
                                   {.9994, .006, .1979, .035},
                                   {.9907, .062, .1143, .06},
                                   {.9873, .081, .0841, .108},
                                   {.9934, .057, .0655, .13}}},
                                 {of(Scheme::distance, 200),
                                  {{1, 0, .9534, .008},
                                   {1, 0, .7254, .019},
                                   {.9952, .049, .4908, .031},
                                   {.9032, .21, .3508, .094},
                                   {.8768, .232, .2883, .186},
                                   {.9445, .154, .2377, .225}}}};
    for (const auto& row : table) {
        const auto& settings = row.settings;
        const auto& on = row.on;
        for (std::size_t i = 0; i < on.size(); ++i) {
            const int k = 1 + 2 * static_cast<int>(i);
            const Outcome o = mean(k, settings, static_cast<int>(maps[i].here));
            const double four_errors = 4 * std::sqrt(1 / maps[i].here + 1 / maps[i].there);
            INFO(name_of(settings.scheme), " ", *settings.threshold, " on ", k, ": ", o);
            CHECK(std::abs(o.reach - on[i].reach) < four_errors * on[i].reach_sigma + rare);
            CHECK(std::abs(o.saved - on[i].saved) < four_errors * on[i].saved_sigma + rare);
        }
    }
}

}  // namespace suppression_test
