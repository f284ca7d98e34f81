// SPDX-License-Identifier: MIT
#include "models/link_changes.hpp"

#include "models/list.hpp"
#include "sim/random.hpp"
#include "test/models/vectors.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

using namespace rovernet;
using namespace std::chrono_literals;

namespace {

constexpr NodeId a{0}, b{1};

/// Two robots and the air between them.
struct Pair {
    const Scene* scene;
    Legs legs{};
    Medium medium{{.scene = scene, .seed = 5}};

    void add(const Propagation& model, Leg leg, const Radio& radio = {}) {
        medium.add(radio, legs.size() + 1, model);
        legs.add(leg);
    }
    /// All changes in (after, until].
    std::vector<Time> changes(NodeId from, NodeId to, Time after, Time until,
                              const LinkSearch& search = {}) const {
        const WallPassages walls(*scene);
        std::vector<Time> all;
        while (const auto t = next_link_change(medium, legs, walls, from, to, after, until, search))
            all.push_back(after = *t);
        return all;
    }
    bool up(NodeId from, NodeId to, Time t) const { return medium.link_up(from, to, t, legs); }
};

Leg resting(Vec3 at) { return {.from = at, .to = at}; }

Leg moving(Vec3 from, Vec3 velocity, Duration time) {
    return {.end = start_of_run + time,
            .from = from,
            .velocity = velocity,
            .to = from + seconds(time) * velocity};
}

Leg random_leg(test::Draw& draw, double side, Duration time) {
    const auto place = [&] { return Vec3{draw.uniform(-2, side + 2), draw.uniform(-2, side + 2)}; };
    const Vec3 from = place(), to = place();
    if (draw.below(5) == 0) return resting(from);
    return {.end = start_of_run + time,
            .from = from,
            .velocity = (1 / seconds(time)) * (to - from),
            .to = to};
}

/// Free space; counts how often it is asked.
struct Counted {
    static constexpr std::string_view name = "counted";
    static constexpr LossShape shape = LossShape::by_distance;
    int* looks;
    Meters reach(Db loss, Hertz f) const { return Friis{}.reach(loss, f); }
    void loss(const LinkBatch& links, Db give_up, std::span<double> out_db) const {
        ++*looks;
        Friis{}.loss(links, give_up, out_db);
    }
};

/// Up where the whole metres are even.
struct Rings {
    static constexpr std::string_view name = "rings";
    void loss(const LinkBatch& links, Db, std::span<double> out_db) const {
        for (std::size_t i = 0; i < out_db.size(); ++i)
            out_db[i] = static_cast<int>(links.distance(i)) % 2 ? 1000 : 0;
    }
};

/// A change as dense sampling sees it: between two samples.
void check_against_sampling(const Pair& pair, NodeId from, NodeId to, Duration time,
                            const LinkSearch& search, int& seen) {
    constexpr Duration step = 1ms;
    const auto found = pair.changes(from, to, start_of_run, start_of_run + time, search);
    bool up = pair.up(from, to, start_of_run);
    for (const Time t : found) {  // each is one
        REQUIRE(pair.up(from, to, t) != up);
        up = !up;
    }
    REQUIRE(pair.up(from, to, start_of_run + time) == up);
    up = pair.up(from, to, start_of_run);
    for (Time t = start_of_run + step; t <= start_of_run + time; t += step) {
        const bool now = pair.up(from, to, t);
        if (now == up) continue;
        up = now;
        ++seen;
        const auto next = std::upper_bound(found.begin(), found.end(), t - step);
        CAPTURE(t.time_since_epoch().count());
        REQUIRE(next != found.end());
        CHECK(*next <= t + search.tolerance);
    }
}

}  // namespace

TEST_CASE("range crossing: enters and leaves at the times of the vectors") {
    constexpr double tolerance = 1e-13;          // a few roundings, see the vectors' description
    constexpr double tangent_tolerance = 1e-12;  // where the discriminant nearly vanishes
    const test::Vectors vectors("range_crossing.csv");
    REQUIRE(vectors.size() == 19);
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const std::string name = vectors.text(i, "case");
        CAPTURE(name);
        const auto passage = range_crossing({vectors.number(i, "rx"), vectors.number(i, "ry")},
                                            {vectors.number(i, "vx"), vectors.number(i, "vy")},
                                            vectors.number(i, "R"));
        const bool none = vectors.text(i, "t_in_exact") == "none" ||
                          vectors.text(i, "t_in_exact") == vectors.text(i, "t_out_exact");
        REQUIRE(passage.has_value() == !none);
        if (none) continue;
        const bool grazing = name.find("grazing") != std::string::npos;
        const double within = grazing ? tangent_tolerance : tolerance;
        const double in = vectors.number(i, "t_in_exact"), out = vectors.number(i, "t_out_exact");
        CHECK(std::abs(passage->enter - in) <= within * std::abs(in));
        CHECK(std::abs(passage->leave - out) <= within * std::abs(out));
    }
}

TEST_CASE("range crossing: in three dimensions it is the flat one of the plane of the motion") {
    constexpr double tolerance = 1e-12;  // of the rotation
    test::Draw draw(7);
    for (int i = 0; i < 1000; ++i) {
        const double miss = draw.uniform(0, 12), R = 10, speed = draw.uniform(0.1, 30);
        // The plane of the motion, by two directions at a right angle.
        const double u = draw.uniform(0, 6), w = draw.uniform(-1, 1), c = std::sqrt(1 - w * w);
        const Vec3 along{c * std::cos(u), c * std::sin(u), w}, aside{-std::sin(u), std::cos(u), 0};
        const auto passage = range_crossing(-50 * along + miss * aside, speed * along, R);
        CAPTURE(miss);
        REQUIRE(passage.has_value() == (miss < R));
        if (!passage || R - miss < 1e-3) continue;
        const double chord = std::sqrt((R - miss) * (R + miss));
        CHECK(std::abs(passage->enter - (50 - chord) / speed) <= tolerance * 50 / speed);
        CHECK(std::abs(passage->leave - (50 + chord) / speed) <= tolerance * 50 / speed);
    }
}

TEST_CASE("range crossing: nothing crosses at rest, without a range, or out of the numbers") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    CHECK_FALSE(range_crossing({1, 0, 0}, {}, 10));
    CHECK_FALSE(range_crossing({1, 0, 0}, {1, 0, 0}, 0));
    CHECK_FALSE(range_crossing({1, 0, 0}, {1, 0, 0}, -1));
    CHECK_FALSE(range_crossing({1, 0, 0}, {1, 0, 0}, infinity));
    CHECK_FALSE(range_crossing({nan, 0, 0}, {1, 0, 0}, 10));
    CHECK_FALSE(range_crossing({1, 0, 0}, {1, nan, 0}, 10));
    CHECK_FALSE(range_crossing({1, 0, 0}, {infinity, 0, 0}, 10));
}

TEST_CASE("link changes: a disc's are at the first nanosecond inside and the first outside") {
    const Scene field;
    Pair pair{&field};
    pair.add(Disc{.range = 10_m}, resting({}));
    pair.add(Disc{.range = 10_m}, moving({-100, 6, 0}, {3, 0, 0}, 60s));
    const auto found = pair.changes(a, b, start_of_run, start_of_run + 60s);
    REQUIRE(found.size() == 2);  // 92 / 3 s and 108 / 3 s: a pass in between is seen
    CHECK(found[0] == start_of_run + 30'666'666'667ns);
    CHECK(found[1] == start_of_run + 36s + 1ns);  // the range itself counts
    CHECK(pair.changes(b, a, start_of_run, start_of_run + 60s) == found);
}

TEST_CASE("link changes: by distance they are exact to the nanosecond") {
    const Scene field;
    const std::vector<Propagation> models{Disc{.range = 15_m}, Friis{}, ItuIndoor{}, LogDistance{}};
    test::Draw draw(8);
    int seen = 0;
    for (int round = 0; round < 300; ++round) {
        Pair pair{&field};
        for (int i = 0; i < 2; ++i)
            pair.add(models[static_cast<std::size_t>(round % 4)], random_leg(draw, 40, 10s),
                     {.power = {draw.uniform(-25, -5)}, .sensitivity = {-75}});
        for (const Time t : pair.changes(a, b, start_of_run, start_of_run + 10s)) {
            CHECK(pair.up(a, b, t) != pair.up(a, b, t - 1ns));
            ++seen;
        }
    }
    CHECK(seen > 100);
}

TEST_CASE("link changes: a tangent is none, a nanometre further in it is two") {
    const Scene field;
    for (const double miss : {10.0, 10.0 - 1e-9}) {
        Pair pair{&field};
        pair.add(Disc{.range = Meters{std::nextafter(10.0, 0)}}, resting({}));
        pair.add(Friis{}, moving({-100, miss, 0}, {1, 0, 0}, 200s));
        const auto found = pair.changes(a, b, start_of_run, start_of_run + 200s);
        REQUIRE(found.size() == (miss < 10 ? 2 : 0));
        for (const Time t : found)  // the half chord is sqrt(2e-8) m = 141 um
            CHECK(std::abs(std::abs(seconds(t) - 100) - 1.414e-4) < 1e-6);
    }
}

TEST_CASE("link changes: fixed steps miss the share of passes of the vectors, the search none") {
    constexpr double sigmas = 5;
    constexpr std::uint64_t passes = 4000;
    const test::Vectors vectors("contact_miss_fixed_step.csv");
    const Scene field;
    for (std::size_t row = 0; row < vectors.size(); ++row) {
        const double p = vectors.number(row, "P(miss a pass, impact parameter uniform in [0,R])");
        if (p * passes < 1) continue;  // nothing to see
        const double R = vectors.number(row, "R_m"), step = vectors.number(row, "v*dt_m");
        int missed = 0, lost = 0;
        for (std::uint64_t pass = 0; pass < passes; ++pass) {
            const auto draw = [&](std::uint64_t index) {
                return uniform(
                    {.purpose = Purpose::placement, .a = row, .b = pass, .index = index});
            };
            Pair pair{&field};
            pair.add(Disc{.range = {R}}, resting({}));
            // At 1 m/s: a step is as many seconds as metres.
            const double before = R + 2 * step;
            pair.add(Friis{},
                     moving({-before, R * draw(0), 0}, {1, 0, 0}, from_seconds(2 * before)));
            const Time end = pair.legs.leg(b).end;
            if (pair.changes(a, b, start_of_run, end).size() != 2) ++lost;
            bool seen = false;
            for (double s = step * draw(1); s < seconds(end) && !seen; s += step)
                seen = pair.up(a, b, start_of_run + from_seconds(s));
            if (!seen) ++missed;
        }
        CAPTURE(R);
        CAPTURE(step);
        CHECK(lost == 0);
        CHECK(std::abs(missed - p * passes) <= sigmas * std::sqrt(p * (1 - p) * passes));
    }
}

TEST_CASE("link changes: a pair that stays out of reach is not looked at") {
    const Scene field;
    const Radio radio{.power = {-30}, .sensitivity = {-75}};
    for (const double miss : {0.0, 100.0}) {
        int looks = 0;
        Pair pair{&field};
        pair.add(Counted{&looks}, resting({}), radio);
        pair.add(Counted{&looks}, moving({-1000, miss, 0}, {10, 0, 0}, 200s), radio);
        const auto found = pair.changes(a, b, start_of_run, start_of_run + 200s);
        CHECK(found.size() == (miss == 0 ? 2 : 0));
        // One for the state, and eight or so for each change.
        CHECK(looks <= (miss == 0 ? 30 : 1));
    }
}

TEST_CASE("link changes: legs that come to rest, legs without end, and robots at rest") {
    const Scene field;
    const Propagation disc = Disc{.range = 10_m};
    Pair pair{&field};
    pair.add(disc, resting({}));
    pair.add(disc, moving({20, 0, 0}, {-1, 0, 0}, 15s));  // stays at 5 m from 15 s on
    pair.add(disc, {.from = {-20, 0, 0}, .velocity = {1, 0, 0}, .to = {}});
    const auto entry = pair.changes(a, b, start_of_run, never);
    REQUIRE(entry.size() == 1);
    CHECK(entry[0] == start_of_run + 10s);
    CHECK(pair.changes(a, b, start_of_run + 10s, never).empty());
    CHECK(pair.changes(a, b, start_of_run + 16s, start_of_run + 20s).empty());
    CHECK(pair.changes(a, b, start_of_run, start_of_run + 9s).empty());
    // `until` belongs to what is searched.
    CHECK(pair.changes(a, b, start_of_run, start_of_run + 10s).size() == 1);
    CHECK(pair.changes(a, b, start_of_run, start_of_run + 10s - 1ns).empty());
    const auto passing = pair.changes(a, NodeId{2}, start_of_run, never);
    REQUIRE(passing.size() == 2);
    CHECK(passing[1] == start_of_run + 30s + 1ns);
    // One comes to rest while the other goes on: at 5 m and 15 s, it leaves the disc at 35 s.
    const auto both = pair.changes(b, NodeId{2}, start_of_run, never);
    REQUIRE(both.size() == 2);
    CHECK(both[0] == start_of_run + 15s);
    CHECK(both[1] == start_of_run + 35s + 1ns);
    pair.medium.switch_radio(b, false);
    CHECK(pair.changes(a, b, start_of_run, never).empty());
}

TEST_CASE("link changes: steps below a nanosecond are refused") {
    const Scene field;
    Pair pair{&field};
    for (int i = 0; i < 2; ++i) pair.add(Friis{}, resting({}));
    for (const LinkSearch& search : {LinkSearch{.tolerance = 0ns}, LinkSearch{.min_dwell = -1ns}})
        CHECK_THROWS_AS(pair.changes(a, b, start_of_run, never, search), std::invalid_argument);
}

TEST_CASE("link changes: of a model of unknown shape those of the dwell time are found") {
    const Scene field;
    Pair pair{&field};
    pair.add(Rings{}, resting({}));
    pair.add(Rings{}, moving({0.5, 0, 0}, {2, 0, 0}, 10s));
    constexpr LinkSearch search{.tolerance = 1us, .min_dwell = 499ms};
    const auto found = pair.changes(a, b, start_of_run, start_of_run + 10s, search);
    REQUIRE(found.size() == 20);
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Duration late = found[i] - (start_of_run + 250ms + i * 500ms);
        CHECK(late >= -1ns);
        CHECK(late <= search.tolerance);
    }
    // Without end, and without a range: the steps grow.
    Pair endless{&field};
    endless.add(ItuIndoor{}, resting({}));
    endless.add(Rings{}, {.velocity = {1e-12, 0, 0}});
    CHECK(endless.changes(b, a, start_of_run, never).empty());
}

namespace {

/// A wall along y = 5 ... 5 + thickness with a gap of that width from x = 10 on, made of boxes.
Scene wall_with_gap(double gap, double thickness, const Material& material) {
    const auto part = [&](double left, double right) {
        return OccupancyGrid{.columns = 1,
                             .rows = 1,
                             .cell_width = right - left,
                             .cell_height = thickness,
                             .origin = {left, 5, 0},
                             .cells = {Cell::occupied}};
    };
    return Scene({part(-40, 10), part(10 + gap, 60)}, {material});
}

}  // namespace

TEST_CASE("link changes: through a door, however narrow, for as long as no corner is in the way") {
    constexpr Duration within = 3ns;  // rounding of the corner and of the times
    for (const double gap : {1.0, 0.1, 1e-5, 1e-7}) {
        CAPTURE(gap);
        const Scene scene = wall_with_gap(gap, 0.1, {.per_crossing = 200_dB});
        Pair pair{&scene};
        pair.add(Raytrace2007{}, resting({10, 10, 0}));
        pair.add(Raytrace2007{}, moving({0, 0, 0}, {5, 0, 0}, 4s));
        const auto found = pair.changes(a, b, start_of_run, start_of_run + 4s);
        // From x = 10 to where the ray grazes the right post at half way: x = 10 + 2 gap.
        REQUIRE(found.size() == 2);
        const Duration open = from_seconds(2 * gap / 5);
        CHECK(std::chrono::abs(found[0] - (start_of_run + 2s)) <= within);
        CHECK(std::chrono::abs(found[1] - (start_of_run + 2s + open)) <= within);
        CHECK(pair.changes(b, a, start_of_run, start_of_run + 4s) == found);
    }
}

TEST_CASE("link changes: over a wall of finite height the top edge decides") {
    constexpr Duration within = 3ns;
    const Scene scene(OccupancyGrid{.columns = 1,
                                    .rows = 1,
                                    .cell_width = 0.1,
                                    .cell_height = 100,
                                    .origin = {10, -50, 0},
                                    .cells = {Cell::occupied}},
                      {{.per_crossing = 200_dB, .height = 2_m}});
    const Radio low{.antenna_height = 0_m};
    Pair pair{&scene};
    pair.add(Raytrace2007{}, resting({0, 0, 3}), low);
    pair.add(Raytrace2007{}, moving({12, 0, 1}, {4, 0, 0}, 10s), low);
    pair.add(Raytrace2007{}, moving({20, 0, 0}, {0, 0, 1}, 10s), low);
    // The ray falls from 3 m to 1 m; half way it is as high as the wall, whose far face is passed.
    const auto driving = pair.changes(a, b, start_of_run, start_of_run + 10s);
    REQUIRE(driving.size() == 1);
    CHECK(std::chrono::abs(driving[0] - (start_of_run + 2'050ms)) <= within);
    // Rising at 20 m: 3 + (z - 3) 10.1 / 20 = 2.
    const auto rising = pair.changes(a, NodeId{2}, start_of_run, start_of_run + 10s);
    REQUIRE(rising.size() == 1);
    CHECK(std::chrono::abs(rising[0] - (start_of_run + from_seconds(3 - 20 / 10.1))) <= within);
}

TEST_CASE("link changes: a link for a moment between two corners, where the loss is least") {
    // Along a wall: the less slanted the ray the less wall it pays for; both ends move.
    constexpr double above = 1e-4;  // [dB] of the budget over the least loss
    const Scene scene = wall_with_gap(0, 0.5, {.per_metre = DbPerMeter{40}});
    test::Draw draw(9);
    for (int round = 0; round < 200; ++round) {
        CAPTURE(round);
        const Vec3 from{draw.uniform(-5, 0), draw.uniform(6, 12)};
        const Vec3 velocity{draw.uniform(0.5, 4), draw.uniform(-0.1, 1)};
        const Vec3 other_from{draw.uniform(10, 20), draw.uniform(-5, 3)};
        const Vec3 other_velocity{draw.uniform(-3, 0), draw.uniform(-1, 0.1)};
        const Leg legs[] = {moving(from, velocity, 10s), moving(other_from, other_velocity, 10s)};
        Db least{1e9};
        Time when{};
        Pair probe{&scene};
        for (const Leg& leg : legs) probe.add(Raytrace2007{}, leg);
        for (Time t = start_of_run; t <= start_of_run + 10s; t += 1ms)
            if (const Db loss = probe.medium.path_loss(a, b, t, probe.legs); loss < least)
                std::tie(least, when) = std::tuple(loss, t);
        if (when == start_of_run || when == start_of_run + 10s) continue;
        Pair pair{&scene};
        for (const Leg& leg : legs)
            pair.add(Raytrace2007{}, leg, {.power = {0}, .sensitivity = {-least.value - above}});
        const auto found = pair.changes(a, b, start_of_run, start_of_run + 10s);
        REQUIRE(found.size() == 2);
        CHECK(found[0] <= when + 1ms);
        CHECK(found[1] >= when);
    }
}

TEST_CASE("link changes: a link for a moment behind a wall, where the ends are nearest") {
    // Down by 37 dB at the start and at half time, by 51 dB at the end; up within 2.94 m, where
    // 30 log10(200 / d) is the wall's 55 dB.
    const Scene scene(OccupancyGrid{.columns = 1,
                                    .rows = 1,
                                    .cell_width = 2000,
                                    .cell_height = 0.2,
                                    .origin = {-1000, 0.9, 0},
                                    .cells = {Cell::occupied}},
                      {{.per_crossing = 55_dB}});
    const Radio radio{.power = {0}, .sensitivity = {-itu_indoor_db(200, 2450_MHz, 30, 0)}};
    Pair pair{&scene};
    pair.add(Raytrace2007{}, resting({0, 1.3, 0}), radio);
    pair.add(Raytrace2007{}, moving({-50, 0, 0}, {10, 0, 0}, 20s), radio);
    const auto found = pair.changes(a, b, start_of_run, start_of_run + 20s);
    REQUIRE(found.size() == 2);
    const double half =
        std::sqrt(std::pow(200 * std::pow(10, -55.0 / 30), 2) - 1.3 * 1.3) / 10;  // [s]
    for (const double late : {seconds(found[0]) - (5 - half), seconds(found[1]) - (5 + half)}) {
        CHECK(late >= -1e-9);
        CHECK(late <= 1e-3 + 1e-9);  // the tolerance of the search
    }
}

namespace {

/// Two maps that overlap, askew, of walls of several kinds; or one, plain.
Scene random_scene(test::Draw& draw, bool rich) {
    OccupancyGrid map = test::random_map(draw, 24, 24, 6);
    if (!rich) return Scene(map);
    for (std::size_t i = 0; i < map.cells.size(); ++i)
        map.cell_materials.push_back(static_cast<std::uint8_t>(draw.below(3)));
    OccupancyGrid askew = test::random_map(draw, 12, 12, 10);
    askew.origin = {4, 8, 0};
    askew.yaw = -0.6;
    return Scene({map, askew}, {{.per_crossing = 4_dB, .per_metre = DbPerMeter{3}},
                                {.per_crossing = 7_dB, .height = 2_m},
                                {.per_metre = DbPerMeter{11}, .height = 3_m}});
}

}  // namespace

TEST_CASE("link changes: what dense sampling sees is found, for every model and direction") {
    constexpr auto time = 4s;
    constexpr LinkSearch search{.tolerance = 1ms, .min_dwell = 1ms};
    const std::vector<Propagation> models{Friis{}, LogDistance{}, Raytrace2007{.wall_factor = 0.1},
                                          Raytrace2007{.coefficient = 22, .wall_factor = 0.02},
                                          Raytrace2007{.coefficient = 20}};
    for (std::size_t m = 0; m < models.size(); ++m) {
        const bool rich = m == 4;
        test::Draw draw(static_cast<std::uint32_t>(100 + m));
        int seen = 0;
        for (int round = 0; round < 40; ++round) {
            CAPTURE(m);
            CAPTURE(round);
            const Scene scene = random_scene(draw, rich);
            Pair pair{&scene};
            for (int i = 0; i < 2; ++i) {
                Leg leg = random_leg(draw, 24, time);
                if (rich && leg.velocity != Vec3{}) {
                    leg.from.z = draw.uniform(0, 4);
                    leg.to.z = draw.below(2) ? leg.from.z : draw.uniform(0, 4);
                    leg.velocity.z = (leg.to.z - leg.from.z) / seconds(time);
                }
                pair.add(models[m], leg, {.power = {draw.uniform(-25, -15)}, .sensitivity = {-80}});
            }
            check_against_sampling(pair, a, b, time, search, seen);
            check_against_sampling(pair, b, a, time, search, seen);
        }
        MESSAGE(models[m].name() << ": " << seen << " changes");
        CHECK(seen > 20);
    }
}

TEST_CASE("link changes: between equal radios both ways change at the same time") {
    // So slow that rounding moves the times of passages by many nanoseconds.
    constexpr Duration time = 5'000'000'000s;
    test::Draw draw(10);
    std::size_t seen = 0;
    for (int round = 0; round < 80; ++round) {
        const Scene scene = random_scene(draw, true);
        Pair pair{&scene};
        for (int i = 0; i < 2; ++i)
            pair.add(Raytrace2007{}, random_leg(draw, 24, time),
                     {.power = {-20}, .sensitivity = {-80}});
        const auto found = pair.changes(a, b, start_of_run, start_of_run + time);
        CHECK(pair.changes(b, a, start_of_run, start_of_run + time) == found);
        seen += found.size();
    }
    CHECK(seen > 20);
}
