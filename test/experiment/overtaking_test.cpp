// SPDX-License-Identifier: MIT
// Where nobody looks at the order, receptions overtake events that do not concern them, and nothing
// else may come of that.
#include "experiment/network.hpp"
#include "mobility/random_waypoint.hpp"
#include "routing/flood.hpp"
#include "test/experiment/reception_log.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

using namespace rovernet;
using namespace rovernet::test;

namespace {

using namespace std::chrono_literals;

/// A flood whose timers tell how much their node had received by then.
struct CountingFlood {
    static constexpr bool takes_any_order = true;

    FloodRouter flood{Flood{.jitter = 20us}};
    std::shared_ptr<std::vector<std::tuple<Time, NodeId, std::size_t>>> seen;
    std::map<NodeId, std::size_t> received{};

    Hops initial_ttl() const { return flood.initial_ttl(); }
    void send(LinkLayer& link, NodeId node, MessageId m) { flood.send(link, node, m); }
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions) {
        for (const Reception& r : receptions) ++received[r.node];
        flood.on_receive(link, frame, receptions);
    }
    void on_timer(LinkLayer& link, NodeId node, std::uint64_t tag) {
        seen->emplace_back(link.now(), node, received[node]);
        flood.on_timer(link, node, tag);
    }
    void forget(MessageId message) { flood.forget(message); }
};

/// Robots spread far and wide, some in a grid with many equal distances, which all flood at about
/// one time: most receptions come while others do, few at the same robots. With odd seeds robots
/// are switched off and on meanwhile, and jump.
struct Crowd {
    static constexpr int robots = 1200;
    Network net;
    std::shared_ptr<ReceptionLog> log;

    Crowd(const Setting& setting, std::uint32_t seed) : Crowd(setting, seed, setting.flood) {}
    Crowd(const Setting& setting, std::uint32_t seed, Router router)
        : net({.seed = seed,
               .propagation = setting.propagation,
               .reception = setting.reception,
               .access = setting.access,
               .reference = setting.reference,
               .metrics = false}),
          log(std::make_shared<ReceptionLog>(ReceptionLog{any_order})) {
        test::Draw draw(seed);
        for (int i = 0; i < robots; ++i) {
            Vec3 at{draw.uniform(0, 3400), draw.uniform(0, 3400), 0};
            const int place = i / 2 * 7 % 600;
            if (i % 2 == 0) at = {136.0 * (place % 25), 136.0 * (place / 25), 0};
            Movement move = Fixed{};
            if (i % 5 == 1) {
                move = RandomWaypoint{
                    .area = {{0, 0, 0}, {3400, 3400, 0}}, .min_speed = {1}, .max_speed = {300}};
            }
            Radio radio = setting.radio;
            if (i % 7 == 0) radio.success_rate = 0.8;
            net.add({.name = {}, .at = at, .radio = radio, .move = move});
        }
        net.add_sink(Sink{log});
        net.route(std::move(router));
        for (std::uint32_t i = 0; i < robots; i += 20) {
            net.at(start_of_run + i * 7ns, [this, i] { net.broadcast({i}, "hello"); });
            if (seed % 2 == 0) continue;
            const NodeId other{i + 7};
            const Vec3 there{draw.uniform(0, 3400), draw.uniform(0, 3400), 0};
            net.at(start_of_run + 200us + i * 401ns, [this, other] { net.switch_off(other); });
            net.at(start_of_run + 300us + i * 401ns, [this, other] { net.switch_on(other); });
            net.at(start_of_run + 310us + i * 203ns, [=, this] { net.place(other, there); });
        }
    }
};

}  // namespace

TEST_CASE("overtaking: receptions overtake what does not concern them, and nothing else changes") {
    for (Setting setting : settings()) {
        setting.flood.jitter = setting.flood.jitter / 5;
        for (std::uint32_t seed = 1; seed <= 4; ++seed) {
            CAPTURE(seed);
            setting.reference = true;
            Crowd expected(setting, seed);
            expected.net.run_for(1s);
            setting.reference = false;
            Crowd crowd(setting, seed);
            crowd.net.run_for(1s);
            REQUIRE(expected.log->receptions.size() > 1000);
            REQUIRE(crowd.log->sorted() == expected.log->sorted());
            REQUIRE(crowd.log->sendings == expected.log->sendings);
            CHECK(expected.log->overtaken == 0);
            if (std::holds_alternative<Csma>(setting.access)) continue;
            if (setting.radio.preamble == 0ns) continue;              // no timer may be overtaken
            CHECK(crowd.log->overtaken > (seed % 2 == 0 ? 100 : 0));  // or this tests nothing
        }
    }
}

TEST_CASE("overtaking: a timer finds what its node had received, and an action what all had") {
    using Seen = std::vector<std::tuple<Time, NodeId, std::size_t>>;
    const auto seen = [](bool reference) {
        const auto all = std::make_shared<Seen>();
        const Setting setting{.reference = reference};
        Crowd crowd(setting, 2, CountingFlood{.seen = all});
        crowd.net.every(1'777ns, [&] {
            all->emplace_back(crowd.net.now(), everyone, crowd.log->receptions.size());
        });
        crowd.net.run_for(500us);
        CHECK((crowd.log->overtaken == 0) == reference);
        return *all;
    };
    const Seen all = seen(false);
    CHECK(all.size() > 1000);
    CHECK(all == seen(true));
}

TEST_CASE("overtaking: nothing is overtaken in a run by steps: the clock shows what was served") {
    Crowd crowd({}, 2);
    Time before = crowd.net.now();
    while (!crowd.net.advance(start_of_run + 500us, 1)) {
        REQUIRE(crowd.net.now() >= before);
        REQUIRE(crowd.log->latest <= crowd.net.now());
        before = crowd.net.now();
    }
    CHECK(crowd.log->receptions.size() > 1000);
}

TEST_CASE("overtaking: reactions come in the order of receptions") {
    using Reacted = std::vector<std::pair<Time, NodeId>>;
    const auto reactions = [](bool reference) {
        Crowd crowd({.reference = reference}, 1);
        Reacted all;
        for (std::uint32_t i = 0; i < Crowd::robots; ++i) {
            crowd.net.on_receive(
                {i}, [&, i](const Message&) { all.emplace_back(crowd.net.now(), NodeId{i}); });
        }
        crowd.net.run_for(1s);
        return all;
    };
    const Reacted all = reactions(false);
    CHECK(all.size() > 1000);
    CHECK(all == reactions(true));
}
