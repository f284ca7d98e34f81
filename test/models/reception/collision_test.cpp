// SPDX-License-Identifier: MIT
#include "models/reception/collision.hpp"

#include <doctest/doctest.h>

#include <cstdint>

namespace collision_test {
using namespace rovernet;

namespace {

constexpr Time at(std::int64_t ns) { return start_of_run + Duration{ns}; }

Arrival frame(std::int64_t begin, std::int64_t end, double level) {
    return {.begin = at(begin),
            .end = at(end),
            .level_dbm = level,
            .squared_distance = 0,
            .from = NodeId{1}};
}

bool survives(const Collision& model, Arrival f, Arrival g) {
    return model.survives(f, g, [](const Arrival& a, const Arrival& b, Db by) {
        return a.level_dbm >= b.level_dbm + by.value;
    });
}

}  // namespace

TEST_CASE(
    "collision: frames that overlap are lost; frames that follow without a gap are received") {
    const Arrival first = frame(10, 110, -60), second = frame(60, 160, -60);
    const Arrival third = frame(160, 260, -60);
    CHECK_FALSE(survives({}, first, second));
    CHECK_FALSE(survives({}, second, first));
    CHECK(survives({}, second, third));
    CHECK(survives({}, third, second));
}

TEST_CASE("collision: the first frame survives if it is stronger by at least the capture ratio") {
    const Collision model{.capture_ratio = Db{10}};
    const Arrival first = frame(0, 100, -50);
    for (const double weaker : {9.99, 10.0}) {
        const Arrival second = frame(50, 150, -50 - weaker);
        CHECK(survives(model, first, second) == (weaker >= 10));
        CHECK_FALSE(survives(model, second, first));
    }
}

TEST_CASE("collision: of two frames that begin together the stronger one is received") {
    const Arrival strong = frame(5, 100, -50), weak = frame(5, 100, -70);
    CHECK(survives({}, strong, weak));
    CHECK_FALSE(survives({}, weak, strong));
}

TEST_CASE("collision: a later, stronger frame is received only with CaptureOrder::later") {
    const Arrival weak = frame(0, 100, -80), strong = frame(50, 150, -50);
    for (const auto order : {CaptureOrder::first, CaptureOrder::later}) {
        const Collision model{.capture = order};
        CHECK_FALSE(survives(model, weak, strong));
        CHECK(survives(model, strong, weak) == (order == CaptureOrder::later));
    }
}

TEST_CASE("collision: a node does not receive frames that overlap its own transmission") {
    const Arrival own = own_frame(NodeId{0}, at(90), at(200));
    for (const auto order : {CaptureOrder::first, CaptureOrder::later}) {
        const Collision model{.capture = order};
        CHECK_FALSE(survives(model, frame(0, 100, -10), own));
        CHECK_FALSE(survives(model, frame(90, 200, -10), own));
        CHECK_FALSE(survives(model, frame(150, 250, -10), own));
        CHECK(survives(model, frame(200, 300, -10), own));
    }
}

TEST_CASE(
    "collision: with CaptureOrder::first, a frame that begins during another frame finds the "
    "receiver busy") {
    const Arrival first = frame(0, 100, -50), second = frame(50, 150, -50);
    const Collision in_order, any_order{.capture = CaptureOrder::later};
    CHECK(in_order.finds_receiver_at(second, first));
    CHECK_FALSE(in_order.finds_receiver_at(first, second));
    CHECK_FALSE(in_order.finds_receiver_at(first, frame(0, 10, -20)));
    CHECK_FALSE(any_order.finds_receiver_at(second, first));
}

TEST_CASE(
    "collision: a frame is ignored if it begins during a frame that is stronger by the capture "
    "ratio") {
    const auto lets_pass = [](Arrival f, Arrival g) {
        return Collision{}.lets_pass(f, g, [](const Arrival& a, const Arrival& b, Db by) {
            return a.level_dbm >= b.level_dbm + by.value;
        });
    };
    const Arrival weak = frame(50, 500, -70);
    CHECK(lets_pass(weak, frame(0, 100, -60)));
    CHECK(lets_pass(weak, frame(50, 60, -60)));
    CHECK_FALSE(lets_pass(weak, frame(0, 100, -60.01)));
    CHECK_FALSE(lets_pass(weak, frame(0, 50, -20)));
    CHECK_FALSE(lets_pass(weak, frame(51, 100, -20)));
    CHECK_FALSE(lets_pass(weak, own_frame(NodeId{0}, at(0), at(100))));
}

TEST_CASE("collision: levels are compared only if the result of the comparison matters") {
    int asked = 0;
    const auto is_stronger = [&](const Arrival&, const Arrival&, Db by) {
        CHECK(by == Db{10});
        ++asked;
        return true;
    };
    Arrival f = frame(0, 100, -50), before = frame(-50, 50, -70), after = frame(100, 200, -70);
    Arrival during = frame(20, 30, -70), own = own_frame(NodeId{0}, at(20), at(30));
    const Collision model;
    CHECK_FALSE(model.survives(f, before, is_stronger));
    CHECK(model.survives(f, after, is_stronger));
    CHECK_FALSE(model.survives(f, own, is_stronger));
    CHECK(asked == 0);
    CHECK(model.survives(f, during, is_stronger));
    CHECK(asked == 1);
}

}  // namespace collision_test
