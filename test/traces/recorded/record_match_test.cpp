// SPDX-License-Identifier: MIT
#include "traces/recorded/record_match.hpp"

#include "models/access/wifi_frames.hpp"
#include "test/traces/record_stream.hpp"
#include "traces/recorded/record_text.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <vector>

namespace record_match_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

/// Two tables of messages, whose slots differ.
struct Two {
    Legs legs;
    MessageTable a, b;
    MessageId slot_a, slot_b, other_b;
    Two() {
        b.add({.origin = NodeId{0}, .uid = 9, .payload = {}});
        slot_a = a.add({.origin = NodeId{0}, .uid = 5, .payload = {}});
        slot_b = b.add({.origin = NodeId{0}, .uid = 5, .payload = {}});
        other_b = b.add({.origin = NodeId{0}, .uid = 6, .payload = {}});
    }
    bool same(const Record& x, const Record& y) const {
        const RecordContext of_x{legs, a}, of_y{legs, b};
        std::string text_x, text_y;
        append_text(x, of_x, text_x);
        append_text(y, of_y, text_y);
        const bool is_same = are_same(x, of_x, y, of_y);
        CHECK(is_same == (text_x == text_y));
        return is_same;
    }
};

/// The frame, and each frame that differs from it in one thing.
std::vector<Frame> frames_unlike(Frame frame, MessageId other) {
    std::vector<Frame> all(5, frame);
    all[0].message = other;
    ++all[1].sender.value;
    ++all[2].ttl;
    ++all[3].hops;
    all[4].next_hop = NodeId{3};
    return all;
}

}  // namespace

TEST_CASE("records about frames match if, and only if, all recorded data of the frames is equal") {
    const Two t;
    Frame frame{.message = t.slot_a, .sender = NodeId{1}, .ttl = 3, .hops = 1};
    Frame same = frame;
    same.message = t.slot_b;
    const std::vector<Reception> got{{at(3), NodeId{2}, Fate::ttl, true}};
    CHECK(t.same(Transmitted{at(1), frame, {}}, Transmitted{at(1), same, {}}));
    CHECK(t.same(Received{frame, got}, Received{same, got}));
    CHECK(t.same(Dropped{at(1), NodeId{2}, frame, DropReason::end},
                 Dropped{at(1), NodeId{2}, same, DropReason::end}));
    CHECK(t.same(AirSent{at(1), {.frame = frame}, 7}, AirSent{at(1), {.frame = same}, 7}));
    for (const Frame& unlike : frames_unlike(same, t.other_b)) {
        CHECK_FALSE(t.same(Transmitted{at(1), frame, {}}, Transmitted{at(1), unlike, {}}));
        CHECK_FALSE(t.same(Received{frame, got}, Received{unlike, got}));
        CHECK_FALSE(t.same(Dropped{at(1), NodeId{2}, frame, DropReason::end},
                           Dropped{at(1), NodeId{2}, unlike, DropReason::end}));
        CHECK_FALSE(
            t.same(AirSent{at(1), {.frame = frame}, 7}, AirSent{at(1), {.frame = unlike}, 7}));
    }
}

TEST_CASE(
    "records about receptions or frames on air match if, and only if, all their data is equal") {
    const Two t;
    const Frame a{.message = t.slot_a, .sender = NodeId{1}},
        b{.message = t.slot_b, .sender = NodeId{1}};
    const Reception rx{at(3), NodeId{2}, Fate::ttl, true};
    std::vector<Reception> unlike(4, rx);
    unlike[0].time = at(4), unlike[1].node = NodeId{3}, unlike[2].fate = Fate::waiting;
    unlike[3].delivered = false;
    const std::vector<Reception> one{rx}, two{rx, rx};
    for (const Reception& each : unlike) {
        const std::vector<Reception> other{each};
        CHECK_FALSE(t.same(Received{a, one}, Received{b, other}));
        CHECK_FALSE(
            t.same(ControlReceived{{.frame = a}, rx, 1}, ControlReceived{{.frame = b}, each, 1}));
    }
    CHECK_FALSE(t.same(Received{a, one}, Received{b, two}));
    CHECK_FALSE(t.same(Received{a, one, Duration{1}}, Received{b, one}));
    CHECK_FALSE(t.same(Received{a, one, {}, 4}, Received{b, one}));
    const AirFrame air{.frame = b};
    std::vector<AirFrame> airs(5, air);
    airs[0].heard_from = NodeId{4}, airs[1].control = &wifi_rts, airs[2].attempt = 1;
    airs[3].number = 2, airs[4].reserved = Duration{3};
    for (const AirFrame& each : airs) {
        CHECK_FALSE(t.same(AirSent{at(1), {.frame = a}, 7}, AirSent{at(1), each, 7}));
    }
    CHECK_FALSE(t.same(AirSent{at(1), {.frame = a}, 7}, AirSent{at(1), air, 8}));
    CHECK_FALSE(t.same(AirSent{at(1), {.frame = a}, 7}, AirSent{at(2), air, 7}));
}

TEST_CASE("records about robots match if, and only if, all their recorded data is equal") {
    const Two t;
    const Sent sent{at(1), NodeId{2}, t.slot_a, 3, 4, 5};
    CHECK(t.same(sent, Sent{at(1), NodeId{2}, t.slot_b, 3, 4, 5}));
    for (const Sent& other :
         {Sent{at(2), NodeId{2}, t.slot_b, 3, 4, 5}, Sent{at(1), NodeId{3}, t.slot_b, 3, 4, 5},
          Sent{at(1), NodeId{2}, t.other_b, 3, 4, 5}, Sent{at(1), NodeId{2}, t.slot_b, 4, 4, 5},
          Sent{at(1), NodeId{2}, t.slot_b, 3, 5, 5}, Sent{at(1), NodeId{2}, t.slot_b, 3, 4, {}}}) {
        CHECK_FALSE(t.same(sent, other));
    }
    const Moved moved{at(1), NodeId{2}, Leg{.start = at(1)}};
    CHECK(t.same(moved, moved));
    std::vector<Moved> moves(8, moved);
    moves[0].leg.start = at(2), moves[1].leg.end = at(9), moves[2].leg.from.x = 1;
    moves[3].leg.velocity.y = 1, moves[4].leg.to.z = 1, moves[5].leg.heading = 1;
    moves[6].leg.turning = -0.0, moves[7].node = NodeId{1};
    for (const Moved& other : moves) CHECK_FALSE(t.same(moved, other));
    CHECK_FALSE(t.same(Switched{at(1), NodeId{1}, true}, Switched{at(1), NodeId{1}, false}));
    CHECK_FALSE(t.same(NoWay{at(1), NodeId{1}, {}}, NoWay{at(1), NodeId{1}, {1, 0, 0}}));
    CHECK_FALSE(t.same(Arrived{at(1), NodeId{1}}, Arrived{at(1), NodeId{2}}));
    CHECK_FALSE(t.same(LinkUp{at(1), NodeId{1}, NodeId{2}}, LinkUp{at(1), NodeId{1}, NodeId{3}}));
    CHECK_FALSE(t.same(LinkUp{at(1), NodeId{1}, NodeId{2}}, LinkDown{at(1), NodeId{1}, NodeId{2}}));
}

}  // namespace record_match_test
