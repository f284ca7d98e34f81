// SPDX-License-Identifier: MIT
#include "models/reception/on_air.hpp"

#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <vector>

namespace on_air_test {
using namespace rovernet;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Time at(std::int64_t us) { return start_of_run + Duration{1000 * us}; }

Leg rest(Vec3 p) { return {.from = p, .to = p}; }

std::set<std::uint64_t> near(OnAir& on_air, const Emission& frame, Time now,
                             Time since = start_of_run - Duration{1}, Time until = never) {
    std::set<std::uint64_t> serials;
    for (const Emission* e : on_air.near(frame, since, until, now)) {
        CHECK(serials.insert(e->serial).second);  // each once
    }
    return serials;
}

}  // namespace

TEST_CASE(
    "frames on air: for a given frame, all other frames that reach any of its receivers are "
    "found") {
    std::size_t found = 0, passed_over = 0;
    for (std::uint32_t seed = 1; seed <= 100; ++seed) {
        CAPTURE(seed);
        test::Draw draw(seed);
        OnAir on_air;
        const double size = std::pow(10, draw.uniform(0, 9));
        const auto place = [&] {
            return Vec3{draw.uniform(-size, size), draw.uniform(-size, size), draw.uniform(0, 3)};
        };
        on_air.goes(rest({-size, -size, 0}), Meters{3});
        on_air.goes(rest({size, size, 3}), Meters{3});
        const double longest_reach = size * std::pow(10, draw.uniform(-3, 0.5));
        std::vector<Emission> frames;
        for (int i = 0; i < 150; ++i) {
            const bool unbounded = draw.below(100) == 0;
            const double reach = unbounded ? infinity : longest_reach * draw.uniform(0, 1);
            Emission frame{.begin = at(i),
                           .end = at(i + 30),
                           .origin = place(),
                           .from = NodeId{0},
                           .heard_within = std::min(reach, size) * draw.uniform(0, 1),
                           .squared_reach = reach * reach,
                           .flight = 0};
            frame.serial = on_air.add(frame);
            CHECK(frame.serial == frames.size());
            frames.push_back(frame);
            const Emission& judged = frames[static_cast<std::size_t>(draw.below(i + 1))];
            const auto nearby = near(on_air, judged, frame.begin);
            for (const Emission& e : frames) {
                const double apart = distance(e.origin, judged.origin) - judged.heard_within;
                const bool reaches = apart <= 0 || apart * apart <= e.squared_reach;
                const bool other = e.serial != judged.serial;
                if (reaches) REQUIRE(nearby.count(e.serial) == other);
                found += reaches && other;
                passed_over += !nearby.count(e.serial);
            }
        }
    }
    CHECK(found > 10'000);
    CHECK(passed_over > 10'000);
}

TEST_CASE(
    "frames on air: the search is extended by the distance that the fastest node may have moved") {
    OnAir on_air;
    on_air.goes(rest({-1e6, 0, 0}), Meters{0});
    on_air.goes(rest({1e6, 0, 0}), Meters{0});
    const auto send = [&](Time t, double x) {
        Emission frame{.begin = t,
                       .end = t + Duration{100'000},
                       .origin = {x, 0, 0},
                       .from = NodeId{0},
                       .heard_within = 10,
                       .squared_reach = 100,
                       .flight = 0};
        frame.serial = on_air.add(frame);
        return frame;
    };
    const Emission far = send(at(0), 900), here = send(at(1000), 0);
    CHECK_FALSE(near(on_air, here, at(1000)).count(far.serial));
    Leg fast = rest({});
    fast.velocity = {0, 9e5, 0};  // 900 m in 1 ms
    on_air.goes(fast, Meters{0});
    CHECK(near(on_air, here, at(1000)).count(far.serial));
}

TEST_CASE("frames on air: frames that have ended are removed, the oldest first") {
    OnAir on_air;
    on_air.goes(rest({}), Meters{0});
    std::vector<std::uint32_t> forgotten;
    const auto forget = [&](Time t) {
        on_air.forget(t, [&](const Emission& e) { forgotten.push_back(e.flight); });
    };
    std::uint32_t flight = 10;
    for (const std::uint32_t lasts : {5U, 100U, 2U, 3U}) {
        on_air.add({.begin = at(flight),
                    .end = at(flight + lasts),
                    .origin = {},
                    .from = NodeId{0},
                    .heard_within = 1,
                    .squared_reach = 1,
                    .flight = flight});
        ++flight;
    }
    CHECK(on_air.longest() == Duration{100'000});
    forget(at(14));
    CHECK(forgotten.empty());
    forget(at(15));
    CHECK(forgotten == std::vector<std::uint32_t>{10});
    forget(at(100));
    CHECK(forgotten.size() == 1);  // the second is on air
    CHECK(on_air[2].flight == 12);
    CHECK(near(on_air, on_air[1], at(100)) == std::set<std::uint64_t>{2, 3});
    CHECK(near(on_air, on_air[1], at(100), at(16)).empty());
    CHECK(near(on_air, on_air[1], at(100), at(14)) == std::set<std::uint64_t>{3});
    CHECK(near(on_air, on_air[1], at(100), at(0), at(13)) == std::set<std::uint64_t>{2});
    CHECK(near(on_air, on_air[3], at(100), at(0), at(13)) == std::set<std::uint64_t>{1, 2});
    forget(at(111));
    CHECK(forgotten == std::vector<std::uint32_t>{10, 11, 12, 13});
    CHECK(on_air.frames().empty());
}

TEST_CASE("frames on air: a frame is still found for a given time after its end, as a past frame") {
    for (const int kept : {0, 1, 7, 40}) {
        CAPTURE(kept);
        test::Draw draw(static_cast<std::uint32_t>(kept));
        OnAir on_air;
        on_air.goes(rest({-300, -300, 0}), Meters{0});
        on_air.goes(rest({300, 300, 0}), Meters{0});
        std::vector<Emission> all;
        std::size_t past = 0;
        for (int us = 0; us < 300; ++us) {
            Emission frame{.begin = at(us),
                           .end = at(us + 5),
                           .origin = {draw.uniform(-300, 300), draw.uniform(-300, 300), 0},
                           .from = NodeId{0},
                           .heard_within = 40,
                           .squared_reach = us < 150 ? 1600.0 : 3600.0};
            on_air.forget(
                at(us), [](const Emission&) {}, Duration{1000 * kept});
            frame.serial = on_air.add(frame);
            all.push_back(frame);
            const auto nearby = on_air.near(frame, at(us - 30), never, at(us));
            const std::vector<const Emission*> copy(nearby.begin(), nearby.end());
            std::set<std::uint64_t> found;
            for (const Emission* e : on_air.past(frame, at(us - 30), never, at(us))) {
                CHECK(found.insert(e->serial).second);
            }
            CHECK(std::equal(nearby.begin(), nearby.end(), copy.begin()));
            for (const Emission& e : all) {
                const bool is_recent = e.end > at(us);
                const bool is_kept = e.end > std::max(at(us - 30), at(us - kept));
                const bool near =
                    distance(e.origin, frame.origin) <= 80 && e.serial != frame.serial;
                CHECK((on_air.frames().front().serial <= e.serial) == is_recent);
                if (near) REQUIRE(found.count(e.serial) == is_kept);
                past += near && is_kept && !is_recent;
            }
        }
        CHECK((past > 0) == (kept > 0));
    }
}

TEST_CASE(
    "frames on air: a node's state at the beginning of a frame is kept as long as the frame") {
    constexpr int nodes = 5;
    std::size_t unchanged = 0, changed = 0;
    for (std::uint32_t seed = 1; seed <= 50; ++seed) {
        CAPTURE(seed);
        test::Draw draw(seed);
        OnAir on_air;
        std::vector<double> now(nodes, 0);
        std::vector<bool> on(nodes, true);
        std::map<std::uint64_t, std::vector<double>> places;  // by serial, then by node
        std::map<std::uint64_t, std::vector<bool>> states;
        std::int64_t us = 0, first = 0;
        for (int step = 0; step < 300; ++step) {
            us += draw.below(3);
            if (draw.below(2)) {
                const std::uint64_t serial = on_air.add({.begin = at(us),
                                                         .end = at(us + 5),
                                                         .origin = {},
                                                         .from = NodeId{0},
                                                         .heard_within = 1,
                                                         .squared_reach = 1,
                                                         .flight = 0});
                places[serial] = now;
                states[serial] = on;
            } else {
                const auto i = static_cast<std::size_t>(draw.below(nodes));
                on_air.changes(NodeId{static_cast<std::uint32_t>(i)}, rest({now[i], 0, 0}), on[i]);
                if (draw.below(3)) {
                    now[i] = draw.uniform(0, 1);
                } else {
                    on[i] = !on[i];
                }
            }
            const Duration kept{seed % 2 ? 0 : 9000};
            on_air.forget(
                at(us - 10), [&](const Emission&) { ++first; }, kept);
            std::vector<Emission> stored(on_air.past_frames().begin(), on_air.past_frames().end());
            stored.insert(stored.end(), on_air.frames().begin(), on_air.frames().end());
            for (const Emission& frame : stored) {
                const bool is_recent = frame.serial >= static_cast<std::uint64_t>(first);
                CHECK((is_recent || kept.count() > 0));
                for (std::uint32_t i = 0; i < nodes; ++i) {
                    const OnAir::Before* before = on_air.before(NodeId{i}, frame);
                    if (before) REQUIRE(on_air.has_stored_change(NodeId{i}));
                    if (before && is_recent) REQUIRE(on_air.has_changed(NodeId{i}));
                    REQUIRE((before ? before->leg.from.x : now[i]) == places[frame.serial][i]);
                    REQUIRE((before ? before->on : on[i]) == states[frame.serial][i]);
                    ++(before ? changed : unchanged);
                }
            }
        }
    }
    CHECK(changed > 1000);
    CHECK(unchanged > 1000);
}

TEST_CASE(
    "frames on air: reach() is the interference range, at most the diagonal of the box around all "
    "antennas") {
    OnAir on_air;
    on_air.goes(rest({0, 0, 0}), Meters{0});
    on_air.goes(rest({3, 0, 0}), Meters{4});
    const auto send = [&](double reach) {
        on_air.add({.begin = at(0),
                    .end = at(1),
                    .origin = {},
                    .from = NodeId{0},
                    .heard_within = 1,
                    .squared_reach = reach * reach,
                    .flight = 0});
    };
    send(2);
    CHECK(on_air.reach() == 2);
    send(infinity);
    CHECK(on_air.reach() == 5);
    Leg trip = rest({});
    trip.to = {0, -12, 0};
    on_air.goes(trip, Meters{0});
    CHECK(on_air.reach() == 13);
    Leg leaving = rest({});
    leaving.velocity = {0, 1, 0};
    on_air.goes(leaving, Meters{0});  // for ever
    CHECK(on_air.reach() > 1e12);
}

}  // namespace on_air_test
