// SPDX-License-Identifier: MIT
// Sinks that begin, finish and leave; callbacks that are ended.
#include "mobility/waypoints.hpp"
#include "models/propagation/friis.hpp"
#include "network/network.hpp"
#include "routing/flood.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace sinks_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// What a sink is told, as words.
struct Told {
    std::vector<std::string> lines{};
    KindMask kinds() const { return kind_of<Sent>() | kind_of<Dropped>(); }
    void begin(const RunInfo& run) {
        std::string names;
        for (std::uint32_t i = 0; i < run.robots; ++i) names += " " + std::string(run.name({i}));
        lines.push_back("begin " + std::to_string(run.seed) + "/" +
                        std::to_string(run.replication) + names +
                        (run.scenario ? " " + run.scenario() : ""));
    }
    void on(const Record& record, const RecordContext&) {
        lines.push_back(std::holds_alternative<Sent>(record) ? "sent" : "dropped");
    }
    void finish() { lines.push_back("finish"); }
};

struct Pair {
    Network net{{.seed = 7, .replication = 3, .scenario = [] { return std::string("text"); }}};
    NodeId a = net.add({.name = "a", .at = {}}), b = net.add({.name = "b", .at = {10, 0}});
    Pair() { net.route(Flood{}); }
};

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("sinks: begin() is called before the first record, and finish() after the last") {
    Pair pair;
    const auto told = std::make_shared<Told>();
    pair.net.add_sink(told);
    CHECK(told->lines.empty());
    pair.net.at(start_of_run, [&] { pair.net.send(pair.a, everyone, "x"); });
    pair.net.run_for(1s);
    pair.net.run_for(1s);
    CHECK(told->lines == Lines{"begin 7/3 a b text", "sent"});
    pair.net.send(pair.a, everyone, "cut off");
    pair.net.finish();
    CHECK(told->lines == Lines{"begin 7/3 a b text", "sent", "sent", "dropped", "finish"});
}

TEST_CASE(
    "sinks: begin() of a sink added during the run is called at once; a removed sink gets no more "
    "records") {
    Pair pair;
    pair.net.run_for(1s);
    const auto first = std::make_shared<Told>(), second = std::make_shared<Told>();
    const SinkId id = pair.net.add_sink(first);
    pair.net.add_sink(second);
    pair.net.send(pair.a, everyone, "x");
    pair.net.remove_sink(id);
    pair.net.send(pair.a, everyone, "y");
    pair.net.finish();
    CHECK(first->lines == Lines{"begin 7/3 a b text", "sent"});
    CHECK(second->lines.size() == 6);  // two sent, two cut off
}

TEST_CASE("sinks: records of receptions contain the received power only if a sink requests it") {
    struct Levels {
        KindMask more;
        std::vector<double> levels{};
        std::size_t receptions = 0;
        KindMask kinds() const { return kind_of<Received>() | more; }
        void on(const Record& record, const RecordContext&) {
            const auto& received = std::get<Received>(record);
            receptions += received.receptions.size();
            for (const Dbm level : received.levels) levels.push_back(level.value);
        }
    };
    for (const bool asked : {false, true}) {
        Network net({.propagation = Friis{}});
        const Radio radio{.power = Dbm{10}, .frequency = Hertz{2.45e9}};
        for (const double x : {0.0, 10.0, 25.0})
            net.add({.name = {}, .at = {x, 0}, .radio = radio});
        net.route(Flood{.ttl = 1});
        const auto sink = std::make_shared<Levels>(Levels{.more = asked ? kind_levels : 0});
        net.add_sink(sink);
        net.send({0}, everyone, "x");
        net.run_for(1s);
        CHECK(sink->receptions == 2);
        REQUIRE(sink->levels.size() == (asked ? 2 : 0));
        if (!asked) continue;
        const auto friis = [](double d) {
            return 10 - 20 * std::log10(4 * 3.14159265358979323846 * d * 2.45e9 / 299792458);
        };
        CHECK(std::abs(sink->levels[0] - friis(10)) < 1e-9);
        CHECK(std::abs(sink->levels[1] - friis(25)) < 1e-9);
    }
}

TEST_CASE("callbacks: a cancelled callback is not called again, even if it was already scheduled") {
    Pair pair;
    Network& net = pair.net;
    int heard = 0, ticks = 0, later = 0, arrived = 0;
    Subscription hears = net.on_receive(pair.b, [&](const Message&) { ++heard; });
    Subscription also = net.on_receive(pair.b, [&](const Message&) { heard += 10; });
    Subscription tick = net.every(1s, [&] {
        if (++ticks == 3) tick.end();  // while it runs
    });
    Subscription once = net.at(start_of_run + 5s, [&] { ++later; });
    Subscription arrives = net.on_arrival(pair.b, [&] { ++arrived; });
    const auto go = [&](double x) { net.move(pair.b, Waypoints{.path = {{x, 0, 0}}}); };
    go(11);
    net.at(start_of_run + 2s, [&] { net.send(pair.a, everyone, "x"); });
    net.at(start_of_run + 3s, [&] { hears.end(), once.end(), arrives.end(); });
    net.at(start_of_run + 4s, [&] {
        net.send(pair.a, everyone, "y");
        go(12);
    });
    net.run_for(10s);
    CHECK(heard == 21);
    CHECK(ticks == 3);
    CHECK(later == 0);
    CHECK(arrived == 1);
    const std::uint64_t events = net.events();
    net.run_for(10s);
    CHECK(net.events() == events);  // nothing waits for an ended callback
    hears.end();                    // again: nothing happens
    Subscription().end();
}

}  // namespace sinks_test
