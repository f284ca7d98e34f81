// SPDX-License-Identifier: MIT
#include "models/collision.hpp"

#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

using namespace rovernet;

namespace {

constexpr Time at(std::int64_t ns) { return start_of_run + Duration{ns}; }

enum class Outcome { received, collided, busy };

/// One node, and the frames that come to it in the order in which they are sent.
struct Receiver {
    Collision rung;
    OnAir on_air{};
    std::vector<Arrival> frames{};
    std::map<std::uint32_t, Outcome> outcomes{};

    static constexpr NodeId here{0};

    void hear(Time sent, Arrival arrival) {
        arrival.flight = static_cast<std::uint32_t>(frames.size());
        frames.push_back(arrival);
        if (arrival.reception != Arrival::no_reception) {
            outcomes.emplace(arrival.flight, Outcome::received);
        }
        rung.add(
            on_air, here, arrival, sent, [](const Arrival& a) { return -a.squared_distance; },
            [&](const Arrival& a) {
                outcomes[a.flight] = a.collided ? Outcome::collided : Outcome::busy;
            });
    }
    void hear(Time sent, Time begin, Time end, double level) {
        hear(sent, {.begin = begin,
                    .end = end,
                    .level_dbm = level,
                    .squared_distance = 0,
                    .from = NodeId{1},
                    .reception = 0});
    }

    /// The rule as it is stated, for every pair.
    Outcome expected(const Arrival& f) const {
        Outcome outcome = Outcome::received;
        for (const Arrival& g : frames) {
            if (g.flight == f.flight || !f.overlaps(g)) continue;
            const bool in_order = f.begin <= g.begin || rung.capture == CaptureOrder::later;
            if (in_order && f.level_dbm >= g.level_dbm + rung.capture_ratio.value) continue;
            if (g.from != here) return Outcome::collided;
            outcome = Outcome::busy;
        }
        return outcome;
    }
};

}  // namespace

TEST_CASE("collision: frames that overlap are lost, frames that touch are not") {
    Receiver r{{}};
    r.hear(at(0), at(10), at(110), -60);
    r.hear(at(50), at(60), at(160), -60);
    r.hear(at(150), at(160), at(260), -60);
    CHECK(r.outcomes[0] == Outcome::collided);
    CHECK(r.outcomes[1] == Outcome::collided);
    CHECK(r.outcomes[2] == Outcome::received);
}

TEST_CASE("collision: the first frame survives if it is stronger by the capture ratio, exactly") {
    for (const double weaker : {9.99, 10.0}) {
        Receiver r{{.capture_ratio = Db{10}}};
        r.hear(at(0), at(0), at(100), -50);
        r.hear(at(50), at(50), at(150), -50 - weaker);
        CHECK((r.outcomes[0] == Outcome::received) == (weaker >= 10));
        CHECK(r.outcomes[1] == Outcome::collided);
    }
}

TEST_CASE("collision: of two frames that begin together the stronger captures") {
    Receiver r{{}};
    r.hear(at(0), at(5), at(100), -50);
    r.hear(at(0), at(5), at(100), -70);
    CHECK(r.outcomes[0] == Outcome::received);
    CHECK(r.outcomes[1] == Outcome::collided);
}

TEST_CASE("collision: a later frame captures only where that is allowed") {
    for (const auto order : {CaptureOrder::first, CaptureOrder::later}) {
        Receiver r{{.capture = order}};
        r.hear(at(0), at(0), at(100), -80);
        r.hear(at(50), at(50), at(150), -50);
        CHECK(r.outcomes[0] == Outcome::collided);
        CHECK((r.outcomes[1] == Outcome::received) == (order == CaptureOrder::later));
    }
}

TEST_CASE("collision: a node that sends hears nothing, before, during and after") {
    Receiver r{{}};
    r.hear(at(0), at(0), at(100), -10);
    r.hear(at(90), own_frame(Receiver::here, at(90), at(200)));
    r.hear(at(150), at(150), at(250), -10);
    r.hear(at(300), at(300), at(400), -10);
    CHECK(r.outcomes[0] == Outcome::busy);
    CHECK(r.outcomes[2] == Outcome::busy);
    CHECK(r.outcomes[3] == Outcome::received);
}

TEST_CASE("collision: random crowds fare as the rule for every pair says") {
    int received = 0, collided = 0, busy = 0;
    for (std::uint32_t seed = 1; seed <= 300; ++seed) {
        test::Draw draw(seed);
        Receiver r{{.capture = seed % 2 ? CaptureOrder::first : CaptureOrder::later}};
        // Frames on air on average: few, or so many that not all of them are kept.
        const double crowd = seed % 3 ? draw.uniform(1, 60) : draw.uniform(0.1, 2);
        Time sent = start_of_run;
        for (int i = 0; i < 150; ++i) {
            const bool at_once = seed % 5 == 0 && i % 30 > 0;  // thirty of one nanosecond
            if (!at_once)
                sent += Duration{static_cast<std::int64_t>(draw.uniform(0, 2000 / crowd))};
            const Time begin = sent + Duration{static_cast<std::int64_t>(draw.uniform(0, 30))};
            const Time end = begin + Duration{static_cast<std::int64_t>(draw.uniform(1, 2000))};
            const double kind = draw.uniform(0, 1);
            if (kind < 0.05) {
                r.hear(sent, own_frame(Receiver::here, sent, end));
            } else {
                r.hear(sent, {.begin = begin,
                              .end = end,
                              .level_dbm = draw.uniform(-90, -40),
                              .squared_distance = 0,
                              .from = NodeId{1 + static_cast<std::uint32_t>(i)},
                              .reception = kind < 0.5 ? 0 : Arrival::no_reception});
            }
        }
        for (const auto& [flight, outcome] : r.outcomes) {
            REQUIRE(outcome == r.expected(r.frames[flight]));
            received += outcome == Outcome::received;
            collided += outcome == Outcome::collided;
            busy += outcome == Outcome::busy;
        }
    }
    CHECK(std::min({received, collided, busy}) > 100);
}

TEST_CASE("collision: of a crowd that sends at once, a node remembers a few") {
    constexpr int senders = 1000, few = 16;
    Receiver r{{}};
    for (int i = 0; i < senders; ++i) r.hear(at(0), at(0), at(100), -60);
    int remembered = 0;
    r.on_air.each(Receiver::here, Time::min(), [&](const Arrival&) { return ++remembered; });
    CHECK(remembered <= few);
    for (const auto& [flight, outcome] : r.outcomes) REQUIRE(outcome == Outcome::collided);
    r.hear(at(99), at(99), at(199), -40);
    r.hear(at(199), at(199), at(299), -60);
    CHECK(r.outcomes[senders] == Outcome::collided);
    CHECK(r.outcomes[senders + 1] == Outcome::received);
}

TEST_CASE("collision: a crowd outdoes a weaker frame only if it begins as soon and ends as late") {
    struct Case {
        int begin, end;    // [ns] of the weak frame, sent at 0
        int sent, starts;  // of the crowd, which is over at 200
        int late, over;    // of a strong frame, sent with the crowd
    };
    for (const Case& c : {Case{5, 100, 0, 30, 20, 90}, Case{0, 500, 0, 0, 300, 400},
                          Case{0, 100, 10, 10, 10, 90}}) {
        CAPTURE(c.late);
        for (const bool weak : {false, true}) {
            Receiver r{{}};
            if (weak) r.hear(at(0), at(c.begin), at(c.end), -80);
            for (int i = 0; i < 12; ++i) r.hear(at(c.sent), at(c.starts), at(200 - i), -70 - i);
            r.hear(at(c.sent), at(c.late), at(c.over), -50);
            CHECK(r.outcomes.rbegin()->second == (weak ? Outcome::collided : Outcome::received));
        }
    }
}
