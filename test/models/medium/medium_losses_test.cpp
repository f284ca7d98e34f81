// SPDX-License-Identifier: MIT
#include "models/medium/medium.hpp"
#include "models/medium/recent_losses.hpp"
#include "models/propagation/raytrace_2007.hpp"
#include "models/propagation/two_ray.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace medium_losses_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// Raytrace2007 behind walls that counts what it is asked for.
struct CountedRays {
    static constexpr std::string_view name = "counted_rays";
    Raytrace2007 model = {};
    std::shared_ptr<std::size_t> rays = std::make_shared<std::size_t>(0);

    Meters reach(Db loss, Hertz f) const { return model.reach(loss, f); }
    void loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const {
        *rays += links.size();
        model.loss(links, cutoff, out_db);
    }
};

Radio random_radio(test::Draw& draw) {
    const Dbm sensitivity{draw.uniform(-85, -45)};
    return {.power = {draw.uniform(0, 25)},
            .sensitivity = sensitivity,
            .carrier_sense_threshold = sensitivity - 6_dB,
            .frequency = {draw.uniform(1800e6, 2700e6)},
            .antenna_height = {draw.uniform(0, 2)},
            .gate = Gate::none};
}

/// The same robots on two media, one of which keeps the losses of pairs at rest.
struct Twins {
    test::Draw draw;
    Scene scene{test::random_map(draw, 40, 40, 10)};
    Medium keeping{settings(true)}, plain{settings(false)};
    Legs legs{};
    Time now = start_of_run;
    std::size_t links = 0, sensors = 0;  // that were found

    explicit Twins(std::uint32_t seed) : draw(seed) {}
    Medium::Settings settings(bool keep) const {
        return {.scene = &scene,
                .keep_losses = keep,
                .interference_cut = Db{20},
                .seed = 11,
                .replication = 2};
    }

    Vec3 place() { return {draw.uniform(-5, 45), draw.uniform(-5, 45), draw.uniform(0, 4)}; }
    NodeId anyone() {
        return {static_cast<std::uint32_t>(draw.below(static_cast<int>(legs.size())))};
    }
    static Leg rest(Vec3 at, Time from) { return {.start = from, .from = at, .to = at}; }
    void add(const Propagation& propagation, const Radio& radio) {
        legs.add(rest(place(), now));
        keeping.add(radio, legs.size(), propagation);
        plain.add(radio, legs.size(), propagation);
    }
    void put(NodeId node, const Leg& leg) {
        legs.replace(node, leg);
        keeping.moved(node, legs);
        plain.moved(node, legs);
    }
    Leg trip(NodeId node) {
        const Vec3 here = legs.position(node, now), there = place();
        return {.start = now,
                .end = now + 5s,
                .from = here,
                .velocity = 0.2 * (there - here),
                .to = there};
    }
    /// A robot starts, stops, jumps, turns, or is switched; or only time passes.
    void change() {
        now += 1ms * draw.below(1000);
        const NodeId node = anyone();
        const Vec3 here = legs.position(node, now), there = place();
        switch (draw.below(8)) {
            case 0: return put(node, trip(node));
            case 1: return put(node, rest(here, now));
            case 2: return put(node, rest(there, now));
            case 3: return put(node, {.start = now, .end = now + 2s, .from = here, .to = there});
            case 4: {
                const bool on = !keeping.stations().is_on(node);
                keeping.switch_radio(node, on);
                return plain.switch_radio(node, on);
            }
        }
    }
    void compare(const Medium::Receivers& kept, const Medium::Receivers& computed) {
        REQUIRE(kept.all().size() == computed.all().size());
        for (std::size_t i = 0; i < kept.all().size(); ++i) {
            CHECK(kept.all()[i].node == computed.all()[i].node);
            CHECK(kept.all()[i].time == computed.all()[i].time);
        }
        links += kept.all().size();
    }
    void compare_receivers(NodeId from) {
        Medium::Receivers kept, computed;
        keeping.find_receivers(from, Coding{}, now, now, legs, kept);
        plain.find_receivers(from, Coding{}, now, now, legs, computed);
        compare(kept, computed);
    }
    void compare_sensors(NodeId from) {
        Medium::Receivers kept, computed;
        const auto kept_sensors = keeping.find_sensors(from, Coding{}, now, now, legs, kept);
        const auto computed_sensors = plain.find_sensors(from, Coding{}, now, now, legs, computed);
        compare(kept, computed);
        REQUIRE(kept_sensors.size() == computed_sensors.size());
        for (std::size_t i = 0; i < kept_sensors.size(); ++i) {
            CHECK(kept_sensors[i].node == computed_sensors[i].node);
        }
        sensors += kept_sensors.size();
    }
};

}  // namespace

TEST_CASE(
    "medium: results are the same with cached losses, while robots move, jump or switch radios on "
    "and off") {
    const CountedRays counted;
    const std::vector<Propagation> walls{counted}, mixed{counted, TwoRay{}, Raytrace2007{}};
    for (std::uint32_t seed = 1; seed <= 30; ++seed) {
        CAPTURE(seed);
        Twins twins(seed);
        const auto& models = seed % 2 ? walls : mixed;
        for (std::size_t i = 0; i < 30; ++i) {
            twins.add(models[i % models.size()], random_radio(twins.draw));
        }
        for (int step = 0; step < 300; ++step) {
            twins.change();
            const NodeId from = twins.anyone();
            if (seed % 3 != 0) twins.compare_receivers(from);
            if (seed % 3 != 1) twins.compare_sensors(from);
        }
        CHECK(twins.links > 200);
        if (seed % 3 != 1) CHECK(twins.sensors > 0);
    }
}

TEST_CASE(
    "medium: rays between resting robots are traced once, rays between moving robots each time") {
    for (const bool moving : {false, true}) {
        const CountedRays counted;
        Twins twins(5);
        const Propagation propagation = counted;
        constexpr std::size_t robots = 12, rounds = 5;
        for (std::size_t i = 0; i < robots; ++i) {
            twins.add(propagation, Radio{});
            const NodeId node{static_cast<std::uint32_t>(i)};
            if (moving) twins.put(node, twins.trip(node));
        }
        Medium::Receivers heard;
        for (std::size_t round = 0; round < rounds; ++round) {
            twins.now += 100ms;
            for (std::uint32_t i = 0; i < robots; ++i) {
                twins.keeping.find_receivers(NodeId{i}, Coding{}, twins.now, twins.now, twins.legs,
                                             heard);
            }
        }
        CHECK(*counted.rays == robots * (robots - 1) * (moving ? rounds : 1));
    }
}

TEST_CASE("medium: losses computed in the search for receivers are reused for the receptions") {
    const CountedRays counted;
    Twins twins(6);
    for (std::uint32_t i = 0; i < 20; ++i) {
        twins.add(counted, Radio{});
        twins.put(NodeId{i}, twins.trip(NodeId{i}));
    }
    twins.now += 100ms;
    Medium::Receivers heard;
    twins.keeping.find_receivers(NodeId{0}, Coding{}, twins.now, twins.now + 1ms, twins.legs,
                                 heard);
    const Emission frame{.begin = twins.now,
                         .end = twins.now + 1ms,
                         .origin = heard.origin,
                         .from = NodeId{0},
                         .squared_reach = twins.keeping.arrivals().squared_reach(NodeId{0})};
    REQUIRE(heard.all().size() > 3);
    for (const Reception& reception : heard.all()) {
        const Vec3 there = twins.legs.position(reception.node, frame.begin);
        const std::size_t before = *counted.rays;
        const auto kept = twins.keeping.arrivals().of(frame, reception.node, there);
        CHECK(*counted.rays == before);
        const auto computed = twins.plain.arrivals().of(frame, reception.node, there);
        REQUIRE((kept && computed));
        CHECK(kept->level_dbm == computed->level_dbm);
        twins.keeping.arrivals().of(frame, reception.node, there + Vec3{0.01, 0, 0});
        CHECK(*counted.rays == before + 2);
    }
}

TEST_CASE(
    "recent losses: if a loss is only known to exceed a cut-off, it is not reused for a larger "
    "cut-off") {
    RecentLosses losses;
    const RecentLosses::Link link{NodeId{1}, NodeId{2}, {0, 0, 1}, {5, 0, 1}};
    CHECK(!losses.find(link, 90_dB));
    losses.keep(link, 90_dB, 95);
    CHECK(losses.find(link, 90_dB) == 95);
    CHECK(!losses.find(link, 91_dB));
    losses.keep(link, 90_dB, 85);
    CHECK(losses.find(link, 200_dB) == 85);
    CHECK(!losses.find({NodeId{2}, NodeId{1}, link.here, link.there}, 90_dB));
    CHECK(!losses.find({link.from, link.to, link.here, {5, 0, 1.5}}, 90_dB));
}

}  // namespace medium_losses_test
