// SPDX-License-Identifier: MIT
#include "models/phy/error_rate.hpp"
#include "models/phy/wifi.hpp"
#include "models/reception/sinr_receiver.hpp"
#include "sim/math.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <vector>

namespace sinr_test {
using namespace rovernet;

namespace {

constexpr NodeId here{0};
constexpr Time at(std::int64_t us) { return start_of_run + Duration{1000 * us}; }

/// One node, and frames of 11 Mb/s whose levels are given.
struct Receiver {
    Sinr model{};
    SinrReceiver receiver{model};
    std::vector<Arrival> frames{};
    std::deque<Lock> locks{};
    double draw = 0.5;

    /// Returns the frame's number.
    std::size_t hear(NodeId from, Time begin, Time end, double level, bool decodable = true) {
        frames.push_back({.begin = begin,
                          .end = end,
                          .level_dbm = level,
                          .squared_distance = 1,
                          .from = from,
                          .own = from == here,
                          .lock = decodable ? &locks.emplace_back(Lock::open) : nullptr});
        return frames.size() - 1;
    }
    Fate judge(std::size_t judged) {
        static const Phy phy{Wifi{}};
        const SinrFrame frame{.phy = &phy,
                              .coding = *phy.coding({11e6}),
                              .rate = 11e6,
                              .payload = Duration{100'000},
                              .noise = Dbm{-94}};
        return receiver.judge(
            frames[judged], frames, frame, [](const Arrival& a) { return a.level_dbm; },
            [&] { return draw; });
    }
};

}  // namespace

TEST_CASE("sinr: the receiver locks onto the first frame, however strong a later one is") {
    Receiver r;
    const auto weak = r.hear(NodeId{1}, at(0), at(100), -80);
    const auto strong = r.hear(NodeId{2}, at(10), at(110), -40);
    CHECK(r.judge(weak) == Fate::collided);
    CHECK(r.judge(strong) == Fate::collided);
}

TEST_CASE(
    "sinr: the receiver locks onto the strongest of the frames that begin together, in any order") {
    for (const bool strong_first : {true, false}) {
        Receiver r;
        const double first = strong_first ? -40 : -80;
        const auto a = r.hear(NodeId{1}, at(0), at(100), first);
        const auto b = r.hear(NodeId{2}, at(0), at(100), -120 - first);
        CHECK(r.judge(a) == (strong_first ? Fate::waiting : Fate::collided));
        CHECK(r.judge(b) == (strong_first ? Fate::collided : Fate::waiting));
    }
}

TEST_CASE("sinr: if every preamble is detected, the order of simultaneous frames has no effect") {
    Receiver r{.model = {.preamble_threshold = Db{-1000}}};
    const auto weak = r.hear(NodeId{1}, at(0), at(100), -80);
    const auto strong = r.hear(NodeId{2}, at(0), at(100), -40);
    CHECK(r.judge(weak) == Fate::collided);
    CHECK(r.judge(strong) == Fate::waiting);
}

TEST_CASE("sinr: a preamble is detected if its SINR exceeds the threshold 4 us after it begins") {
    for (const double above : {3.9, 4.1}) {
        Receiver r;
        r.hear(NodeId{1}, at(0), at(20), -60, false);  // is over before the payload begins
        const auto frame = r.hear(NodeId{2}, at(10), at(210), -60 + above);
        CHECK(r.judge(frame) == (above > 4 ? Fate::waiting : Fate::collided));
    }
    // Noise counts: 5.5 dB above the other, 3.6 dB above both.
    Receiver noisy;
    noisy.hear(NodeId{1}, at(0), at(20), -91.5, false);
    const auto faint = noisy.hear(NodeId{2}, at(10), at(210), -86);
    CHECK(noisy.judge(faint) == Fate::collided);
    noisy.draw = 1e-300;  // its bits would be right
    const auto alone = noisy.hear(NodeId{2}, at(500), at(700), -90.1);
    CHECK(noisy.judge(alone) == Fate::garbled);
    // What comes just then counts; what comes later does not, nor what was over before.
    Receiver just;
    const auto hit = just.hear(NodeId{2}, at(10), at(210), -60);
    just.hear(NodeId{1}, at(14), at(24), -60, false);
    CHECK(just.judge(hit) == Fate::collided);
    const auto brief = just.hear(NodeId{2}, at(500), at(502), -60);
    just.hear(NodeId{1}, at(503), at(523), -60, false);
    CHECK(just.judge(brief) == Fate::waiting);
    for (const bool late : {true, false}) {
        Receiver r;
        if (!late) r.hear(NodeId{1}, at(0), at(13), -60, false);
        const auto frame = r.hear(NodeId{2}, at(10), at(210), -60);
        if (late) r.hear(NodeId{1}, at(15), at(25), -60, false);
        CHECK(r.judge(frame) == Fate::waiting);
    }
}

TEST_CASE("sinr: after a preamble that is not detected, the receiver is free for the next frame") {
    Receiver r;
    const auto first = r.hear(NodeId{1}, at(0), at(100), -80);
    const auto second = r.hear(NodeId{2}, at(2), at(202), -60);
    CHECK(r.judge(first) == Fate::collided);
    CHECK(r.judge(second) == Fate::waiting);
}

TEST_CASE("sinr: a frame too weak to decode interferes, and does not lock the receiver") {
    Receiver r;
    r.hear(NodeId{1}, at(0), at(100), -90, false);
    const auto good = r.hear(NodeId{2}, at(10), at(110), -50);
    CHECK(r.judge(good) == Fate::waiting);
    const auto drowned = r.hear(NodeId{3}, at(300), at(400), -50);
    r.hear(NodeId{1}, at(310), at(410), -50, false);
    CHECK(r.judge(drowned) == Fate::collided);
}

TEST_CASE(
    "sinr: a transmitting node receives nothing, and gives up the frame that it was receiving") {
    Receiver r;
    const auto before = r.hear(NodeId{1}, at(0), at(100), -50);
    constexpr double own = std::numeric_limits<double>::infinity();  // as own_frame() has it
    r.hear(here, at(50), at(60), own, false);
    const auto after = r.hear(NodeId{2}, at(70), at(170), -50);
    CHECK(r.judge(before) == Fate::busy);
    CHECK(r.judge(after) == Fate::collided);  // the rest of the first is interference
    const auto cut_off = r.hear(NodeId{2}, at(300), at(400), -50);
    r.hear(here, at(302), at(303), own, false);  // while its preamble is looked for
    const auto next = r.hear(NodeId{1}, at(304), at(404), -30);
    CHECK(r.judge(cut_off) == Fate::busy);
    CHECK(r.judge(next) == Fate::waiting);
}

TEST_CASE(
    "sinr: a later transmission of the receiver does not release its lock on an earlier frame") {
    Receiver r;
    r.hear(NodeId{1}, at(0), at(100), -50);
    const auto second = r.hear(NodeId{2}, at(10), at(50), -30);
    r.hear(here, at(60), at(61), std::numeric_limits<double>::infinity(), false);
    CHECK(r.judge(second) == Fate::collided);
}

TEST_CASE("sinr: a random draw decides only about frames whose bits may be wrong") {
    Receiver r;
    const double weak = -94 + certain_sinr(Modulation::cck_11).value - 8;
    for (const bool lucky : {true, false}) {
        r.draw = lucky ? 1e-300 : 1 - 1e-16;
        const Time begin = at(lucky ? 0 : 1000), end = begin + Duration{100'000};
        CHECK(r.judge(r.hear(NodeId{1}, begin, end, weak)) ==
              (lucky ? Fate::waiting : Fate::garbled));
        const Time later = begin + Duration{500'000}, until = later + Duration{100'000};
        CHECK(r.judge(r.hear(NodeId{1}, later, until, -40)) == Fate::waiting);
    }
}

TEST_CASE(
    "sinr: interference is added to the noise, so interference as strong as the noise costs 3 dB") {
    constexpr double noise = -94, above = 8.5, bits = 1100;
    const double sinr = math::exp10(above / 10) / 2;
    const double probability = math::exp(bits * log_success(Modulation::cck_11, sinr));
    REQUIRE(probability > 0.01);
    REQUIRE(probability < 0.99);
    for (const bool lucky : {true, false}) {
        Receiver r;
        r.draw = probability * (lucky ? 1 - 1e-9 : 1 + 1e-9);
        const auto frame = r.hear(NodeId{1}, at(0), at(100), noise + above);
        r.hear(NodeId{2}, at(0), at(100), noise, false);
        CHECK(r.judge(frame) == (lucky ? Fate::waiting : Fate::collided));
    }
}

TEST_CASE("sinr: a weak interferer counts after a strong one has ended (S28)") {
    // The loud one overlaps the preamble's first microseconds only. A sum to which it was added and
    // from which it was taken would have lost the faint ones: 1e-3 + 1e-19 - 1e-3 mW.
    for (const double faint : {-300.0, -96.0}) {
        Receiver r;
        r.draw = 1e-12;
        const auto frame = r.hear(NodeId{1}, at(0), at(300), -88);
        r.hear(NodeId{2}, at(-100), at(1), -20, false);
        for (unsigned i = 3; i < 9; ++i) r.hear(NodeId{i}, at(10), at(300), faint, false);
        CAPTURE(faint);
        CHECK(r.judge(frame) == (faint < -200 ? Fate::waiting : Fate::collided));
    }
}

TEST_CASE("sinr: the interference is equal to the last bit in any order of the frames (S28)") {
    // A draw at the boundary: the last bit of the sum would show.
    const auto judged = [](std::vector<unsigned> order, double draw) {
        Receiver r;
        r.draw = draw;
        const auto frame = r.hear(NodeId{1}, at(0), at(300), -88);
        for (const unsigned i : order) {
            r.hear(NodeId{i}, at(5 + i), at(290 - i), -97 - 0.37 * i, false);
        }
        return r.judge(frame);
    };
    double low = 0, high = 1;
    for (int i = 0; i < 200; ++i) {  // to the last bit of the chance of success
        const double middle = (low + high) / 2;
        (judged({2, 3, 4, 5}, middle) == Fate::waiting ? low : high) = middle;
    }
    CHECK(low > 0);
    CHECK(high < 1);
    for (const auto& order : {std::vector<unsigned>{5, 4, 3, 2}, {3, 5, 2, 4}, {4, 2, 5, 3}}) {
        CHECK(judged(order, low) == Fate::waiting);
        CHECK(judged(order, high) != Fate::waiting);
    }
}

TEST_CASE("sinr: a frame with practically no signal is lost, without a division 0 / 0 (S29)") {
    Receiver r;
    const auto nothing = r.hear(NodeId{1}, at(0), at(100), -10000);
    CHECK(r.judge(nothing) == Fate::garbled);
}

}  // namespace sinr_test
