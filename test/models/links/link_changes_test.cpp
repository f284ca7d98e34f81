// SPDX-License-Identifier: MIT
#include "models/links/link_changes.hpp"

#include "models/propagation/list.hpp"
#include "sim/random.hpp"
#include "test/models/links/moving_pair.hpp"
#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace link_changes_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::moving;
using test::MovingPair;
using test::random_leg;
using test::resting;

namespace {

constexpr NodeId a{0}, b{1};

/// Free space; counts how often it is asked.
struct Counted {
    static constexpr std::string_view name = "counted";
    int* looks;
    LossShape shape() const { return LossShape::by_distance; }
    Meters reach(Db loss, Hertz f) const { return Friis{}.reach(loss, f); }
    void loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const {
        ++*looks;
        Friis{}.loss(links, cutoff, out_db);
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

}  // namespace

TEST_CASE(
    "link changes: with the model `disc`, a link is up from the first to the last nanosecond in "
    "range") {
    const Scene field;
    MovingPair pair{&field};
    pair.add(Disc{.range = 10_m}, resting({}));
    pair.add(Disc{.range = 10_m}, moving({-100, 6, 0}, {3, 0, 0}, 60s));
    const auto found = pair.changes(a, b, start_of_run, start_of_run + 60s);
    REQUIRE(found.size() == 2);  // 92 / 3 s and 108 / 3 s: a pass in between is seen
    CHECK(found[0] == start_of_run + 30'666'666'667ns);
    CHECK(found[1] == start_of_run + 36s + 1ns);  // the range itself counts
    CHECK(pair.changes(b, a, start_of_run, start_of_run + 60s) == found);
}

TEST_CASE(
    "link changes: with models that use only the distance, times of changes are exact to 1 ns") {
    const Scene field;
    const std::vector<Propagation> models{Disc{.range = 15_m}, Friis{}, ItuIndoor{}, LogDistance{}};
    test::Draw draw(8);
    int seen = 0;
    for (int round = 0; round < 300; ++round) {
        MovingPair pair{&field};
        for (int i = 0; i < 2; ++i) {
            const Leg leg = random_leg(draw, 40, 10s);
            pair.add(models[static_cast<std::size_t>(round % 4)], leg,
                     {.power = {draw.uniform(-25, -5)}, .sensitivity = {-75}});
        }
        for (const Time t : pair.changes(a, b, start_of_run, start_of_run + 10s)) {
            CHECK(pair.up(a, b, t) != pair.up(a, b, t - 1ns));
            ++seen;
        }
    }
    CHECK(seen > 100);
}

TEST_CASE(
    "link changes: none is found if a path only touches the range, two if it is 1 nm further "
    "inside") {
    const Scene field;
    for (const double miss : {10.0, 10.0 - 1e-9}) {
        MovingPair pair{&field};
        pair.add(Disc{.range = Meters{std::nextafter(10.0, 0)}}, resting({}));
        pair.add(Friis{}, moving({-100, miss, 0}, {1, 0, 0}, 200s));
        const auto found = pair.changes(a, b, start_of_run, start_of_run + 200s);
        REQUIRE(found.size() == (miss < 10 ? 2 : 0));
        for (const Time t : found)  // the half chord is sqrt(2e-8) m = 141 um
            CHECK(std::abs(std::abs(seconds(t) - 100) - 1.414e-4) < 1e-6);
    }
}

TEST_CASE(
    "link changes: fixed time steps miss contacts as often as in the test vectors; the search "
    "misses none") {
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
            MovingPair pair{&field};
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

TEST_CASE("link changes: for a pair that stays out of range, the loss is computed at most once") {
    const Scene field;
    const Radio radio{.power = {-30}, .sensitivity = {-75}};
    for (const double miss : {0.0, 100.0}) {
        int looks = 0;
        MovingPair pair{&field};
        pair.add(Counted{&looks}, resting({}), radio);
        pair.add(Counted{&looks}, moving({-1000, miss, 0}, {10, 0, 0}, 200s), radio);
        const auto found = pair.changes(a, b, start_of_run, start_of_run + 200s);
        CHECK(found.size() == (miss == 0 ? 2 : 0));
        // One for the state, and eight or so for each change.
        CHECK(looks <= (miss == 0 ? 30 : 1));
    }
}

TEST_CASE(
    "link changes: times of changes are right for movements with and without end, and for resting "
    "robots") {
    const Scene field;
    const Propagation disc = Disc{.range = 10_m};
    MovingPair pair{&field};
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

TEST_CASE("link changes: a tolerance of 0 ns and a negative min_dwell are refused") {
    const Scene field;
    MovingPair pair{&field};
    for (int i = 0; i < 2; ++i) pair.add(Friis{}, resting({}));
    for (const LinkSearch& search : {LinkSearch{.tolerance = 0ns}, LinkSearch{.min_dwell = -1ns}})
        CHECK_THROWS_AS(pair.changes(a, b, start_of_run, never, search), std::invalid_argument);
}

TEST_CASE(
    "link changes: with the model `two_ray` and constant heights, change times are exact to 1 ns") {
    const Scene field;
    MovingPair pair{&field};
    const Leg away = moving({10, 0, 0}, {20, 0, 0}, 100s);
    pair.add(TwoRay{}, resting({}));
    pair.add(TwoRay{}, away);
    const auto found = pair.changes(a, b, start_of_run, away.end);
    REQUIRE(found.size() == 1);
    CHECK(pair.up(a, b, found[0] - 1ns));
    CHECK_FALSE(pair.up(a, b, found[0]));
}

TEST_CASE(
    "link changes: a robot on stairs gets a link when its antenna reaches the storey of the other "
    "robot") {
    const Scene field;
    MovingPair pair{.scene = &field, .floor_height = Meters{3}};
    const ItuIndoor office{.environment = Environment::office};
    // Enough for 11 m, or 4 m through a floor.
    const Radio radio{.sensitivity = -55_dBm};
    pair.add(office, resting({}), radio);
    pair.add(office, moving({-10, 5, 4.5}, {1, 0, -0.2}, 30s), radio);
    const auto found = pair.changes(a, b, start_of_run, start_of_run + 30s);
    REQUIRE(found.size() == 2);
    const Duration late = found[0] - (start_of_run + 12500ms);  // the antenna is 1 m above it
    CHECK(late >= 0s);
    CHECK(late <= LinkSearch{}.tolerance);
    CHECK(pair.up(a, b, found[0]));
}

TEST_CASE(
    "link changes: with an arbitrary loss function, all changes that last for min_dwell are "
    "found") {
    const Scene field;
    MovingPair pair{&field};
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
    MovingPair endless{&field};
    endless.add(ItuIndoor{}, resting({}));
    endless.add(Rings{}, {.velocity = {1e-12, 0, 0}});
    CHECK(endless.changes(b, a, start_of_run, never).empty());
}

TEST_CASE(
    "link changes: a search in parts finds the same changes as one search, without more samples") {
    const Scene field;
    MovingPair pair{&field};
    pair.add(Rings{}, resting({}));
    pair.add(Rings{}, moving({-7, 0.5, 0}, {0.4, 0, 0}, 40s));
    const LinkSearch search{.tolerance = 1us, .min_dwell = 70ms};
    for (const std::int64_t most : {1, 2, 16, 1000}) {
        Time after = start_of_run;
        const Time until = start_of_run + 40s;
        while (after < until) {
            const auto expected = next_link_change(pair.medium, pair.legs, WallPassages(), a, b,
                                                   after, until, search);
            LinkOutlook outlook{.change = {}, .until = after};
            int pieces = 0;
            while (!outlook.change && outlook.until < until) {
                const Time from = outlook.until;
                outlook = look_ahead(pair.medium, pair.legs, WallPassages(), a, b, from, until,
                                     search, most);
                CHECK(outlook.until > from);
                CHECK(outlook.until - from <= most * 70ms);
                ++pieces;
            }
            CHECK(outlook.change == expected);
            if (most == 1 && expected) CHECK(pieces == (*expected - after) / 70ms + 1);
            after = outlook.until;
        }
    }
}

}  // namespace link_changes_test
