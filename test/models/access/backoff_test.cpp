// SPDX-License-Identifier: MIT
#include "models/access/backoff.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cstdint>
#include <utility>

namespace backoff_test {
using namespace rovernet;

namespace {

using namespace std::chrono_literals;

constexpr Time at(std::int64_t us) { return start_of_run + std::chrono::microseconds{us}; }

/// Slot 4, SIFS 6, DIFS one slot longer, EIFS 10 + SIFS longer than DIFS, all in microseconds, and
/// energy that is sensed at once: the setting of ns-3.37's tests of its channel access, whose
/// expected times are facts of IEEE 802.11.
constexpr WifiTiming instant{.slot = 4us,
                             .sifs = 6us,
                             .difs = 10us,
                             .cca_time = 0us,
                             .turnaround = 0us,
                             .rx_start_delay = 0us,
                             .cw_min = 31,
                             .cw_max = 1023,
                             .lowest_rate = {1e6}};
constexpr Duration eifs = 26us;

/// A station that listens.
struct Station {
    WifiTiming timing = instant;
    Backoff backoff{timing};

    void good_frame(std::int64_t begin, std::int64_t end) {
        backoff.energy(at(begin), at(end));
        backoff.frame_decoded();
    }
    void bad_frame(std::int64_t begin, std::int64_t end) {
        backoff.energy(at(begin), at(end));
        backoff.frame_lost(at(end), eifs);
    }
    /// A frame to send comes at `t` and finds the medium busy.
    void ask_while_busy(std::int64_t t, int slots) { backoff.begin(slots, at(t)); }
    /// ... or idle: it may go out once the medium was idle for a DIFS.
    void ask_while_idle(std::int64_t t) { backoff.begin(0, at(t) + timing.difs); }
};

}  // namespace

TEST_CASE("backoff: a slot in which the medium becomes busy does not count") {
    Station s;
    s.backoff.energy(at(20), at(60));
    s.ask_while_busy(30, 4);
    s.backoff.frame_decoded();
    s.good_frame(80, 100);
    CHECK(s.backoff.grant() == at(118));
}

TEST_CASE(
    "backoff: with a backoff of 0 slots, a station may send one DIFS after the last frame heard") {
    Station s;
    s.good_frame(20, 60);
    s.ask_while_busy(30, 0);
    CHECK(s.backoff.grant() == at(70));
    s.good_frame(60, 100);
    CHECK(s.backoff.grant() == at(110));
}

TEST_CASE(
    "backoff: if the medium is idle at the request, a station may send one DIFS after the "
    "request") {
    Station s;
    s.good_frame(20, 60);
    s.ask_while_idle(62);
    CHECK(s.backoff.grant() == at(72));
    Station later;
    later.good_frame(20, 60);
    later.ask_while_idle(70);
    CHECK(later.backoff.grant() == at(80));
}

TEST_CASE("backoff: a frame with errors requires an EIFS, unless an error-free frame follows") {
    Station s;
    s.backoff.energy(at(20), at(60));
    s.ask_while_busy(30, 4);
    s.backoff.frame_lost(at(60), eifs);
    CHECK(s.backoff.grant() == at(102));
    s.backoff.energy(at(69), at(75));
    s.backoff.frame_decoded();
    CHECK(s.backoff.grant() == at(101));

    Station idle;
    idle.bad_frame(20, 60);
    idle.ask_while_idle(70);
    CHECK(idle.backoff.grant() == at(86));
}

TEST_CASE("backoff: the medium stays busy to the end of a frame that the receiver has given up") {
    Station s;
    s.backoff.energy(at(20), at(60));
    s.backoff.frame_lost(at(40), eifs);
    CHECK(s.backoff.is_busy(at(41)));
    CHECK(s.backoff.is_busy(at(59)));
    CHECK(!s.backoff.is_busy(at(61)));
}

TEST_CASE(
    "backoff: the medium is busy to the end of a reservation, even if a shorter frame follows") {
    Station s;
    s.backoff.energy(at(20), at(60));
    s.ask_while_busy(30, 2);
    s.backoff.energy(at(60), at(75));  // the reservation
    s.good_frame(66, 71);
    s.backoff.energy(at(71), at(71));
    CHECK(s.backoff.grant() == at(93));
}

TEST_CASE("backoff: with a longer DIFS, the slots of the backoff begin later") {
    Station s;
    s.timing.difs = 14us;
    s.good_frame(20, 60);
    s.ask_while_idle(80);
    CHECK(s.backoff.grant() == at(94));

    Station busy;
    busy.timing.difs = 14us;
    busy.backoff.energy(at(20), at(60));
    busy.ask_while_busy(30, 3);
    busy.good_frame(78, 86);
    CHECK(busy.backoff.grant() == at(108));
}

TEST_CASE("backoff: idle slots that are counted between several frames add up") {
    Station s;
    s.good_frame(20, 60);
    s.ask_while_busy(60, 6);
    s.good_frame(75, 100);   // one slot from 70 on
    s.good_frame(119, 140);  // two from 110 on
    CHECK(s.backoff.grant() == at(150 + 3 * 4));
}

TEST_CASE(
    "backoff: if frames overlap, the earliest stops the countdown, whichever is reported first") {
    for (const bool swapped : {false, true}) {
        Station s;
        s.good_frame(20, 60);
        s.ask_while_busy(60, 6);
        const std::int64_t begins[] = {79, 77};
        for (const std::int64_t begin : {begins[swapped], begins[!swapped]}) {
            s.good_frame(begin, begin + 20);
        }
        CHECK(s.backoff.grant() == at(109 + 5 * 4));
    }
}

TEST_CASE("backoff: energy that arrives late in a slot is sensed in the next slot") {
    const WifiTiming timing = timing_of(WifiStandard::b);
    for (const auto& [into, counted] : {std::pair{1, 2}, std::pair{3, 3}}) {
        Backoff backoff(timing);
        backoff.energy(at(0), at(100));
        backoff.begin(5, at(50));
        // Two slots have passed; this is in the third, 2 us of which are before the last sensing.
        const Time begin = at(150 + 2 * 20 + into);
        backoff.energy(begin, begin + 300us);
        CHECK(backoff.grant() == begin + 300us + 50us + (5 - counted) * 20us);
    }
}

TEST_CASE("backoff: with slots of 1 us, access is granted at the exact end of the last slot") {
    Station s;
    s.timing.slot = 1us, s.timing.sifs = 3us, s.timing.difs = 4us;
    s.ask_while_idle(1);
    CHECK(s.backoff.grant() == at(5));
    s.backoff.energy(at(5), at(6));
    s.ask_while_idle(8);
    CHECK(s.backoff.grant() == at(12));
}

TEST_CASE(
    "backoff: a station's own frame, the answer to it and the wait for the answer count as busy") {
    Station answered;
    answered.timing.difs = 14us;
    answered.ask_while_idle(20);
    CHECK(answered.backoff.grant() == at(34));
    answered.backoff.energy(at(34), at(54));
    answered.good_frame(60, 62);
    answered.ask_while_busy(61, 1);
    CHECK(answered.backoff.grant() == at(80));

    Station ignored;
    ignored.timing.difs = 6us;
    ignored.backoff.energy(at(34), at(54));
    ignored.backoff.energy(at(54), at(74));  // it waits
    ignored.ask_while_busy(64, 0);
    CHECK(ignored.backoff.grant() == at(80));
}

TEST_CASE(
    "backoff: two stations with equal backoffs both send if the propagation delay is below 2 us") {
    WifiTiming timing = timing_of(WifiStandard::b);
    for (const Duration delay : {Duration{0}, Duration{1000}, Duration{1999}}) {
        Backoff first(timing), second(timing);
        for (Backoff* each : {&first, &second}) {
            each->energy(at(0), at(100));
            each->begin(3, at(50));
        }
        const Time sends = first.grant();
        second.energy(sends + delay, sends + 300us);
        CHECK(!second.was_busy());
        CHECK(second.grant() == sends);

        Backoff third(timing);
        third.energy(at(0), at(100));
        third.begin(4, at(50));
        third.energy(sends + delay, sends + 300us);
        CHECK(third.was_busy());
        CHECK(third.grant() == sends + 300us + timing.difs + timing.slot);
    }
}

}  // namespace backoff_test
