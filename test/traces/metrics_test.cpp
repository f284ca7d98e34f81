// SPDX-License-Identifier: MIT
#include "traces/metrics.hpp"

#include "test/traces/record_stream.hpp"

#include <doctest/doctest.h>

#include <memory>

namespace metrics_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

struct Measured : Stream {
    std::shared_ptr<Metrics> metrics = std::make_shared<Metrics>();
    Measured() { sinks = {metrics}; }
    MetricValues values() const { return metrics->values(); }
};

constexpr NodeId a{0}, b{1}, c{2}, d{3};

/// A line a - b - c - d, ttl 2 with suppression: a sends, b relays; d is beyond the ttl.
struct LineOfFour : Measured {
    LineOfFour() {
        for (int i = 0; i < 4; ++i) place(Vec3{10.0 * i, 0, 0});
        const auto m = send(at(1'000), a, 2, 64, 3);
        transmit(at(1'000), frame(m, a, 2, 1));
        receive(frame(m, a, 2, 1), {{at(1'500), b, Fate::waiting, true}});
        transmit(at(2'500), frame(m, b, 1, 2), a);
        receive(frame(m, b, 1, 2),
                {{at(3'000), a, Fate::duplicate, false}, {at(3'100), c, Fate::ttl, true}});
    }
};

}  // namespace

TEST_CASE("metrics: without messages, metrics that would divide by 0 have no value") {
    const auto v = Metrics{}.values();
    CHECK(v.messages == 0);
    CHECK_FALSE(v.delivery_ratio);
    CHECK_FALSE(v.reach);
    CHECK_FALSE(v.saved_rebroadcasts);
    CHECK_FALSE(v.latency);
    CHECK_FALSE(v.mean_hops);
    CHECK(v.hops.empty());
}

TEST_CASE(
    "metrics: for a flood with TTL 2 along a line of four robots, the metrics equal a count by "
    "hand") {
    const auto v = LineOfFour{}.values();
    CHECK(v.messages == 1);
    CHECK(v.transmissions == 2);
    CHECK(v.receptions == 3);
    CHECK(v.deliveries == 2);
    CHECK(v.drops[0] == DropCount{"DUP", 1});
    CHECK(v.drops[1] == DropCount{"TTL", 1});
    CHECK(v.drops[2] == DropCount{"SLP", 0});
    CHECK(v.delivery_ratio == 2.0 / 3);      // of three other robots
    CHECK(v.reach == 2.0 / 3);               // all three were linked to the sender
    CHECK(v.saved_rebroadcasts == 1.0 / 2);  // of b and c, only b relayed
    CHECK(v.latency == LatencyValues{1.3e-6, 0.5e-6, 2.1e-6, 2.1e-6});
    CHECK(v.mean_hops == 1.5);
    CHECK(v.max_hops == 2);
    CHECK(v.hops == std::vector<std::uint64_t>{0, 1, 1});
}

TEST_CASE(
    "metrics: only a robot's first transmission of another robot's message lowers "
    "saved_rebroadcasts") {
    LineOfFour run;  // the thesis's rule: everybody forwards every copy
    const MessageId m{0};
    run.transmit(at(4'000), frame(m, a, 0, 3), b);
    run.transmit(at(5'000), frame(m, b, 0, 3), a);
    CHECK(run.values().transmissions == 4);
    CHECK(run.values().saved_rebroadcasts == 1.0 / 2);
    run.transmit(at(6'000), frame(m, c, 0, 3), b);
    CHECK(run.values().saved_rebroadcasts == 0.0);
}

TEST_CASE(
    "metrics: unicasts do not count in saved_rebroadcasts, which has no value without broadcasts") {
    Measured run;
    for (int i = 0; i < 3; ++i) run.place(Vec3{10.0 * i, 0, 0});
    const auto unicast = run.messages.add(
        {.origin = a, .uid = 9, .to = c, .created = at(0), .payload = {}, .is_routed = true});
    run.transmit(at(1), frame(unicast, a, 2, 1));
    run.transmit(at(2), frame(unicast, b, 1, 2), a);
    run.receive(frame(unicast, b, 1, 2), {{at(3), c, Fate::arrived, true}});
    CHECK(run.values().deliveries == 1);
    CHECK_FALSE(run.values().saved_rebroadcasts);
    const auto broadcast =
        run.messages.add({.origin = a, .uid = 10, .created = at(9), .payload = {}});
    run.receive(frame(broadcast, a, 2, 1), {{at(10), b, Fate::arrived, true}});
    CHECK(run.values().saved_rebroadcasts == 1.0);
}

TEST_CASE(
    "metrics: relays of an old message do not count for a new message in the same table entry") {
    LineOfFour run;
    REQUIRE(run.messages.release(MessageId{0}));
    const auto m = run.send(at(9'000), a, 2);
    REQUIRE(m == MessageId{0});
    run.receive(frame(m, a, 2, 1), {{at(9'500), b, Fate::waiting, true}});
    run.transmit(at(9'900), frame(m, b, 1, 2), a);
    const auto v = run.values();
    CHECK(v.saved_rebroadcasts == 1.0 / 3);  // (3 - 2) / 3
    CHECK_FALSE(v.reach);                    // the second message did not say how many it could
    CHECK(v.delivery_ratio == 3.0 / 6);
}

TEST_CASE(
    "metrics: frames that arrive at a radio that is off, or wait to be sent by it, are drops of "
    "reason SLP") {
    LineOfFour run;
    const MessageId m{0};
    run.receive(frame(m, b, 1, 2), {{at(4'000), d, Fate::off, false}});
    run.emit(Dropped{at(5'000), c, frame(m, b, 1, 2), DropReason::off});
    const auto v = run.values();
    CHECK(v.receptions == 3);
    CHECK(v.drops[2] == DropCount{"SLP", 2});
}

TEST_CASE("metrics: robots count as destinations only of messages sent after they joined") {
    LineOfFour run;
    run.place(Vec3{});
    run.send(at(9'000), a, 2);
    CHECK(run.values().delivery_ratio == 2.0 / (3 + 4));
}

TEST_CASE(
    "metrics: messages of a single robot have no destination, so there is no delivery ratio") {
    Measured run;
    run.place(Vec3{});
    run.send(at(0), a, 2, 64, 0);
    CHECK(run.values().messages == 1);
    CHECK_FALSE(run.values().delivery_ratio);
    CHECK_FALSE(run.values().reach);
}

TEST_CASE("metrics: percentiles are found by the nearest-rank method, in any order of values") {
    Measured run;
    for (int i = 0; i < 21; ++i) run.place(Vec3{});
    const auto m = run.send(at(0), a, 1);
    for (std::uint32_t i = 1; i <= 20; ++i) {
        run.receive(frame(m, a, 1, 1), {{at((i * 8) % 21), {i}, Fate::ttl, true}});
    }
    const auto latency = *run.values().latency;
    CHECK(latency.p50 == 10e-9);
    CHECK(latency.p95 == 19e-9);
    CHECK(latency.max == 20e-9);
    CHECK(latency.mean == 10.5e-9);
}

TEST_CASE(
    "metrics: the number of reachable robots is requested from the network only if a metric needs "
    "it") {
    constexpr KindMask both = kind_reachable | kind_cheap_reachable;
    const auto asks = [](std::optional<bool> reach) {
        return Metrics(start_of_run, {.reach = reach}).kinds() & both;
    };
    CHECK(asks({}) == kind_cheap_reachable);
    CHECK(asks(true) == kind_reachable);
    CHECK(asks(false) == 0);
}

TEST_CASE("metrics: the same receptions in one record or in several give the same metrics") {
    struct Cut {
        Sink target;
        KindMask kinds() const { return target.kinds(); }
        void on(const Record& record, const RecordContext& context) {
            const auto* received = std::get_if<Received>(&record);
            if (!received) return target.on(record, context);
            for (std::size_t i = 0; i < received->receptions.size(); ++i) {
                target.on(Received{received->frame, received->receptions.subspan(i, 1)}, context);
            }
        }
    };
    Measured run;
    const auto cut = std::make_shared<Metrics>();
    run.sinks.push_back(Sink(Cut{cut}));
    RandomRecords(run, 3).run(20, 5'000);
    CHECK(run.values() == cut->values());
}

TEST_CASE("metrics: every reason of a drop is counted under its own code") {
    for_each_reason([](auto reason) {
        Measured run;
        run.place(Vec3{});
        run.place(Vec3{10, 0, 0});
        const auto m = run.send(at(0), a, 1);
        if constexpr (std::is_same_v<decltype(reason), DropReason>) {
            run.emit(Dropped{at(10), a, frame(m, a, 1, 1), reason});
        } else {
            run.receive(frame(m, a, 1, 1), {{at(10), b, reason, false}});
        }
        for (const DropCount& drop : run.values().drops) {
            CAPTURE(drop.reason);
            CHECK(drop.count == (drop.reason == reason_of(reason).code ? 1 : 0));
        }
    });
}

TEST_CASE(
    "metrics: the counts of a message are not used for a control packet in the same table entry") {
    Measured run;
    for (int i = 0; i < 3; ++i) run.place(Vec3{10.0 * i, 0, 0});
    const auto m = run.send(at(0), a, 2, 64, 2);
    run.transmit(at(1), frame(m, b, 1, 2), a);
    run.messages.release(m);
    const auto own = run.messages.add({.origin = a, .uid = 77, .created = at(10), .payload = {}});
    REQUIRE(own == m);  // it has the message's place
    run.transmit(at(11), frame(own, b, 1, 2), a);
    run.receive(frame(own, b, 1, 2), {{at(12), c, Fate::arrived, true}});
    const auto v = run.values();
    CHECK(v.reach == 0.0);                // the delivery is of no message that was sent
    CHECK(v.saved_rebroadcasts == -1.0);  // b relayed both
}

TEST_CASE("metrics: a robot's number of messages includes messages to it that did not reach it") {
    Stream run;
    const auto metrics =
        std::make_shared<Metrics>(start_of_run, MetricParts{.flows = true, .robots = true});
    run.sinks = {metrics};
    for (int i = 0; i < 3; ++i) run.place(Vec3{10.0 * i, 0, 0});
    const auto first = run.send(at(0), a, 1);
    run.receive(frame(first, a, 1, 1), {{at(10), b, Fate::ttl, true}});
    CHECK(metrics->values().robots.size() == 3);
    CHECK(metrics->values().robots[2].messages == 1);
    CHECK(metrics->values().robots[2].delivery_ratio() == 0.0);
    run.place(Vec3{30, 0, 0});  // d joins: the first message was not for it
    run.send(at(100), b, 1);
    const auto last = run.send(at(200), a, 1);
    run.emit(Dropped{at(201), a, frame(last, a, 1, 1), DropReason::cut_off});
    const MetricValues v = metrics->values();
    REQUIRE(v.robots.size() == 4);
    CHECK(v.robots[0].messages == 1);
    CHECK(v.robots[1].delivery_ratio() == 1.0);
    CHECK(v.robots[2].messages == 3);  // with the last one, which the end cut off
    CHECK(v.robots[2].expected == 2);
    CHECK(v.robots[3].messages == 2);
    CHECK(v.robots[3].expected == 1);
    CHECK(v.robots[3].delivery_ratio() == 0.0);
    std::uint64_t expected = 0;
    for (const PartValues& robot : v.robots) expected += robot.expected;
    CHECK(v.delivery_ratio == 1.0 / static_cast<double>(expected));
}

TEST_CASE(
    "metrics: a message that the end of the run cuts off still counts in the messages of its flow "
    "and of its destination") {
    Stream run;
    const auto metrics =
        std::make_shared<Metrics>(start_of_run, MetricParts{.flows = true, .robots = true});
    run.sinks = {metrics};
    for (int i = 0; i < 2; ++i) run.place(Vec3{10.0 * i, 0, 0});
    for (int i = 0; i < 2; ++i) {
        const auto id = run.messages.add({.origin = a, .to = b, .payload = {}, .flow = 1});
        run.emit(Sent{at(i), a, id, 1, 2, {}});
        const Frame sent{.message = id, .sender = a, .ttl = 1, .hops = 1, .next_hop = b};
        if (i == 0) run.receive(sent, {{at(9), b, Fate::arrived, true}});
        if (i == 1) run.emit(Dropped{at(10), a, sent, DropReason::cut_off});
    }
    const MetricValues v = metrics->values();
    CHECK(v.cut_off == 1);
    CHECK(v.messages == 2);
    for (const PartValues& part : {v.flows.at(0), v.robots.at(b.index())}) {
        CHECK(part.messages == 2);
        CHECK(part.delivery_ratio() == 1.0);
    }
}

TEST_CASE("metrics: failed attempts to send a routed unicast over a link do not count as losses") {
    for (const bool is_routed : {false, true}) {
        CAPTURE(is_routed);
        Stream run;
        const auto metrics = std::make_shared<Metrics>(start_of_run, MetricParts{.flows = true});
        run.sinks = {metrics};
        for (int i = 0; i < 2; ++i) run.place(Vec3{10.0 * i, 0, 0});
        const auto id = run.messages.add(
            {.origin = a, .to = b, .payload = {}, .flow = 1, .is_routed = is_routed});
        run.emit(Sent{at(0), a, id, 9, 2, {}});
        const Frame sent{.message = id, .sender = a, .ttl = 9, .hops = 1, .next_hop = b};
        const Fate failures[] = {Fate::off, Fate::garbled, Fate::collided, Fate::busy};
        for (const Fate fate : failures) run.receive(sent, {{at(1), b, fate, false}});
        run.receive(sent, {{at(2), b, Fate::arrived, true}});
        run.receive(sent, {{at(3), b, Fate::duplicate, false}});  // its acknowledgement was lost
        const MetricValues v = metrics->values();
        std::uint64_t lost = 0;
        for (const DropCount& drop : v.drops) lost += drop.count;
        CHECK(lost == (is_routed ? 1 : 5));
        CHECK(v.drops[loss_codes.place("DUP")].count == 1);
        if (is_routed) CHECK(v.flows[0].drops[loss_codes.place("DUP")] == 1);
        if (is_routed) CHECK(v.flows[0].drops[loss_codes.place("COL")] == 0);
    }
}

}  // namespace metrics_test
