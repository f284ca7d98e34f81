// SPDX-License-Identifier: MIT
// What a routing protocol is given and told by the network that runs it.
#include "models/access/list.hpp"
#include "models/medium/medium.hpp"
#include "models/propagation/disc.hpp"
#include "models/propagation/friis.hpp"
#include "network/network.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace router_port_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// What happened to a protocol, as words.
struct Diary {
    std::vector<std::string> lines{};
    std::function<void(LinkLayer&, NodeId, MessageId)> send{};
    std::function<void(LinkLayer&, NodeId, std::uint64_t)> timer{};
    std::function<void(LinkLayer&, const QueuedFrame&, SendResult)> result{};
    bool busy = false;  // a call to the link layer is under way
    std::vector<double> levels{};
};

/// A protocol that does what its diary says; every frame has arrived where it is received.
struct Scripted {
    static constexpr bool routes_unicasts = true;
    std::shared_ptr<Diary> diary;

    Hops initial_ttl() const { return 5; }
    void send(LinkLayer& link, NodeId node, MessageId message) {
        diary->busy = true;
        diary->send(link, node, message);
        diary->busy = false;
    }
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions) {
        for (Reception& r : receptions) {
            const auto& m = link.message(frame.message);
            diary->lines.push_back(std::to_string(r.node.value) + " hears " +
                                   (m.kind.empty() ? m.payload : std::string(m.kind)));
            r.fate = Fate::arrived;
            r.delivered = true;
        }
    }
    void on_timer(LinkLayer& link, NodeId node, std::uint64_t tag) {
        diary->timer(link, node, tag);
    }
    void on_sent(LinkLayer& link, const QueuedFrame& frame, SendResult result) {
        static const std::map<SendResult, std::string> names{{SendResult::acked, "acked"},
                                                             {SendResult::sent, "sent"},
                                                             {SendResult::retries, "retries"},
                                                             {SendResult::queue_full, "queue_full"},
                                                             {SendResult::off, "off"}};
        CHECK_FALSE(diary->busy);
        diary->lines.push_back(names.at(result));
        if (diary->result) diary->result(link, frame, result);
    }
    void on_start(LinkLayer&, NodeId node) {
        diary->lines.push_back("start " + std::to_string(node.value));
    }
    void on_switched(LinkLayer&, NodeId node, bool on) {
        diary->lines.push_back(std::to_string(node.value) + (on ? " on" : " off"));
    }
};

/// One that overhears and looks at levels.
struct Curious : Scripted {
    static constexpr bool overhears = true;
    static constexpr bool wants_levels = true;
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions) {
        Scripted::on_receive(link, frame, receptions);
        for (const Reception& r : receptions) diary->levels.push_back(link.level(r).value);
    }
};

/// Robots in a row, 80 m apart, that hear 100 m.
struct Row {
    std::shared_ptr<Diary> diary = std::make_shared<Diary>();
    Network net;

    explicit Row(AccessModel access = NoAccess{}, int robots = 3)
        : net({.propagation = Disc{.range = {100}}, .access = std::move(access)}) {
        for (int i = 0; i < robots; ++i) {
            net.add({.name = {}, .at = {80.0 * i, 0, 0}, .radio = {.rate = {1e6}}});
        }
        diary->send = [](LinkLayer& link, NodeId node, MessageId message) {
            link.send({.message = message,
                       .sender = node,
                       .ttl = 5,
                       .hops = 1,
                       .next_hop = link.message(message).to},
                      {}, link.now());
        };
    }
    /// Runs for a second, and says what happened but for the starts.
    std::vector<std::string> run() {
        net.run_for(1s);
        std::erase_if(diary->lines, [](const std::string& s) { return s.starts_with("start"); });
        return diary->lines;
    }
};

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("router port: only the next hop of a unicast passes the frame to the routing protocol") {
    Row row;
    row.net.route(Scripted{.diary = row.diary});
    row.net.send({1}, {2}, "hello");
    CHECK(row.run() == Lines{"2 hears hello", "acked"});
    const MetricValues metrics = row.net.metrics();
    CHECK(metrics.messages == 1);
    CHECK(metrics.deliveries == 1);
    CHECK(metrics.delivery_ratio == 1.0);
}

TEST_CASE(
    "router port: a unicast that the routing protocol did not send is not passed to this "
    "protocol") {
    Row row;
    row.net.route(Scripted{.diary = row.diary});
    row.net.send({1}, {2}, "hello", {.one_hop = true});
    CHECK(row.run().empty());
    CHECK(row.net.metrics().deliveries == 1);
}

TEST_CASE(
    "router port: a routing protocol that overhears gets unicasts for other nodes, with their "
    "levels") {
    Network net({.propagation = Friis{}, .access = Csma{}});
    for (const double x : {0.0, 30.0, 70.0}) {
        net.add({.name = {}, .at = {x, 0, 0}, .radio = {.rate = {1e6}}});
    }
    const auto diary = std::make_shared<Diary>(*Row().diary);
    net.route(Curious{Scripted{.diary = diary}});
    net.send({0}, {1}, "hello");
    net.run_for(1s);
    std::erase_if(diary->lines, [](const std::string& s) { return s.starts_with("start"); });
    CHECK(diary->lines == Lines{"1 hears hello", "2 hears hello", "acked"});
    CHECK(net.metrics().deliveries == 1);
    CHECK(net.metrics().receptions == 1);  // what was overheard is not told of
    // Friis: 20 log10(4 pi d f / c).
    const Radio radio;
    REQUIRE(diary->levels.size() == 2);
    for (const auto& [level, distance] :
         {std::pair{diary->levels[0], 30.0}, std::pair{diary->levels[1], 70.0}}) {
        const double loss = 20 * std::log10(4 * 3.14159265358979323846 * distance *
                                            radio.frequency.value / 299792458);
        CHECK(std::abs(level - (radio.power.value - loss)) < 1e-9);
    }
}

TEST_CASE(
    "router port: each reception has its own level, also after another receiver is switched off") {
    const auto levels_of = [](double off_at) {
        const auto diary = std::make_shared<Diary>(*Row().diary);
        Network net({.propagation = Friis{}});
        for (const double x : {0.0, 30.0, 70.0}) {
            net.add({.name = {}, .at = {x, 0, 0}, .radio = {.rate = {1e6}}});
        }
        net.route(Curious{Scripted{.diary = diary}});
        net.send({0}, everyone, std::string(500, 'x'));  // 4 ms
        net.at(start_of_run + from_seconds(off_at), [&] { net.switch_off({1}); });
        net.run_for(1s);
        return diary->levels;
    };
    const auto both = levels_of(0.5), one = levels_of(0.001);
    REQUIRE(both.size() == 2);
    REQUIRE(one.size() == 1);
    CHECK(one[0] == both[1]);
    CHECK(both[0] > both[1]);
}

TEST_CASE(
    "router port: csma reports whether a frame was acknowledged, sent, given up or never sent") {
    const Csma one_place{.queue = 1};
    SUBCASE("csma reports a frame that was acknowledged") {
        Row row(Csma{});
        row.net.route(Scripted{.diary = row.diary});
        row.net.send({0}, {1}, "hello");
        CHECK(row.run() == Lines{"1 hears hello", "acked"});
    }
    SUBCASE("csma reports a frame that was given up after all retries") {
        Row row(Csma{});
        row.net.route(Scripted{.diary = row.diary});
        row.net.send({0}, {2}, "hello");
        CHECK(row.run() == Lines{"retries"});
    }
    SUBCASE("csma reports a broadcast that was sent") {
        Row row(Csma{});
        row.net.route(Scripted{.diary = row.diary});
        row.net.send({0}, everyone, "hello");
        CHECK(row.run() == Lines{"sent", "1 hears hello"});
    }
    SUBCASE("csma reports a frame that found the queue full") {
        Row row(one_place);
        row.net.route(Scripted{.diary = row.diary});
        for (const char* word : {"a", "b"}) row.net.send({0}, {1}, word);
        CHECK(row.run() == Lines{"queue_full", "1 hears a", "acked"});
    }
    SUBCASE("csma reports a frame whose station was switched off while it waited for access") {
        Row row(Csma{});
        row.net.route(Scripted{.diary = row.diary});
        row.net.at(start_of_run, [&] {
            row.net.send({0}, {1}, "hello");
            row.net.switch_off({0});
        });
        CHECK(row.run() == Lines{"off", "0 off"});
    }
}

TEST_CASE(
    "router port: a frame's result comes after the call of send(), and may trigger a new frame") {
    Row row(Csma{.queue = 1});
    int more = 3;
    row.diary->send = [](LinkLayer& link, NodeId node, MessageId message) {
        for (int i = 0; i < 2; ++i) {  // the second finds no room
            link.send({.message = message, .sender = node, .ttl = 1, .hops = 1}, {}, link.now());
        }
    };
    row.diary->result = [&](LinkLayer& link, const QueuedFrame& sent, SendResult result) {
        if (result == SendResult::sent && more-- > 0) link.send(sent.frame, {}, link.now());
    };
    row.net.route(Scripted{.diary = row.diary});
    row.net.send({0}, everyone, "x");
    const Lines once{"sent", "1 hears x"};
    Lines expected{"queue_full"};
    for (int i = 0; i < 4; ++i) expected.insert(expected.end(), once.begin(), once.end());
    CHECK(row.run() == expected);
}

TEST_CASE("router port: control packets are not delivered to applications") {
    Row row;
    row.diary->send = [](LinkLayer& link, NodeId node, MessageId) {
        const MessageId packet = link.originate(node, everyone, "rreq", 24, "who is 7?");
        CHECK(link.message(packet).size == 24);
        CHECK(link.message(packet).payload == "who is 7?");
        link.send({.message = packet, .sender = node, .ttl = 1, .hops = 1}, {}, link.now());
        link.release(packet);
    };
    row.net.route(Scripted{.diary = row.diary});
    int heard = 0;
    row.net.on_receive({1}, [&](const Message&) { ++heard; });
    row.net.send({0}, everyone, "hello");
    CHECK(row.run() == Lines{"sent", "1 hears rreq"});
    CHECK(heard == 0);
    CHECK(row.net.metrics().messages == 1);
    CHECK(row.net.metrics().deliveries == 0);
    CHECK(row.net.metrics().transmissions == 0);
}

TEST_CASE("router port: a frame that waits for its send time may be changed or cancelled") {
    Row row;
    std::vector<SendHandle> handles;
    row.diary->send = [&](LinkLayer& link, NodeId node, MessageId message) {
        const Frame frame{.message = message, .sender = node, .ttl = 5, .hops = 1};
        for (int ms = 1; ms <= 3; ++ms) {
            handles.push_back(link.send(frame, {}, link.now() + 1ms * ms).value());
        }
        CHECK_FALSE(link.send(frame, {}, link.now()).has_value());
        link.cancel(handles[0]);
        CHECK(link.waiting(handles[0]) == nullptr);
        REQUIRE(link.waiting(handles[1]) != nullptr);
        link.waiting(handles[1])->frame.next_hop = NodeId{0};
        link.timer(node, link.now() + 5ms, 7);
    };
    row.diary->timer = [&](LinkLayer& link, NodeId node, std::uint64_t tag) {
        CHECK(node == NodeId{1});
        CHECK(tag == 7);
        for (const SendHandle each : handles) CHECK(link.waiting(each) == nullptr);
    };
    row.net.route(Scripted{.diary = row.diary});
    row.net.send({1}, everyone, "x");
    CHECK(row.run() == Lines{"sent", "0 hears x", "2 hears x", "0 hears x", "acked", "sent",
                             "0 hears x", "2 hears x"});
}

TEST_CASE("router port: if a sender is off at the send time, the protocol gets the result `off`") {
    Row row;
    row.diary->send = [](LinkLayer& link, NodeId node, MessageId message) {
        link.send({.message = message, .sender = node, .ttl = 5, .hops = 1}, {}, link.now() + 2ms);
    };
    row.net.route(Scripted{.diary = row.diary});
    row.net.send({1}, everyone, "x");
    row.net.at(start_of_run + 1ms, [&] { row.net.switch_off({1}); });
    row.net.at(start_of_run + 5ms, [&] { row.net.switch_on({1}); });
    CHECK(row.run() == Lines{"1 off", "off", "1 on"});
}

TEST_CASE("router port: take_queued returns the frames for one next hop, except a frame on air") {
    for (const AccessModel& access : {AccessModel{Csma{}}, AccessModel{Aloha{}}}) {
        CAPTURE(access.name());
        Row row(access);
        row.diary->send = [](LinkLayer& link, NodeId node, MessageId message) {
            for (const std::uint32_t to : {0U, 0U, 2U, 0U}) {
                link.send(
                    {.message = message, .sender = node, .ttl = 1, .hops = 1, .next_hop = {to}}, {},
                    link.now());
            }
            link.timer(node, link.now() + 200us, 0);  // the first is on air
        };
        row.diary->timer = [](LinkLayer& link, NodeId node, std::uint64_t) {
            const auto taken = link.take_queued(node, NodeId{0});
            CHECK(taken.size() == 2);
            for (const QueuedFrame& each : taken) {
                CHECK(each.frame.next_hop == NodeId{0});
                link.release(each.frame);
            }
        };
        row.net.route(Scripted{.diary = row.diary});
        row.net.send({1}, everyone, "x");
        const Lines lines = row.run();
        CHECK(std::count(lines.begin(), lines.end(), "0 hears x") == 1);
        CHECK(std::count(lines.begin(), lines.end(), "2 hears x") == 1);
    }
}

TEST_CASE(
    "router port: nodes start in the order of their keys (name hashes); a node added later starts "
    "at once") {
    Row row(NoAccess{}, 5);
    row.net.route(Scripted{.diary = row.diary});
    CHECK(row.diary->lines.empty());
    row.net.run_for(1s);
    std::vector<std::uint32_t> order{0, 1, 2, 3, 4};
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return row.net.medium().stations().key({a}) < row.net.medium().stations().key({b});
    });
    Lines expected;
    for (const std::uint32_t i : order) expected.push_back("start " + std::to_string(i));
    CHECK(row.diary->lines == expected);
    row.net.add({.name = "late", .at = {}});
    CHECK(row.diary->lines.back() == "start 5");
    row.net.run_for(1s);
    CHECK(row.diary->lines.size() == 6);
}

TEST_CASE("router port: if the protocol only floods, a unicast is sent directly, over one hop") {
    struct Everyone {
        int* asked;
        Hops initial_ttl() const { return 1; }
        void send(LinkLayer&, NodeId, MessageId) { ++*asked; }
        void on_receive(LinkLayer&, const Frame&, std::span<Reception>) {}
    };
    Row row;
    int asked = 0;
    row.net.route(Everyone{&asked});
    row.net.send({0}, {1}, "x");
    row.net.run_for(1s);
    CHECK(asked == 0);
    CHECK(row.net.metrics().deliveries == 1);
    row.net.send({0}, everyone, "x");
    CHECK(asked == 1);
    CHECK_THROWS_AS(row.net.send({0}, {0}, "x"), std::invalid_argument);
    CHECK_THROWS_AS(row.net.send({0}, {9}, "x"), std::invalid_argument);
}

TEST_CASE("send: send() returns the message's uid; a robot that is off sends nothing") {
    Row row;
    const auto first = row.net.send({0}, {1}, "a"), second = row.net.send({1}, {2}, "b");
    REQUIRE((first && second));
    CHECK(*first != *second);
    row.net.switch_off({0});
    CHECK_FALSE(row.net.send({0}, {1}, "c"));
    std::vector<std::uint64_t> heard;
    for (const NodeId to : {NodeId{1}, NodeId{2}}) {
        row.net.on_receive(to, [&](const Message& m) { heard.push_back(m.uid); });
    }
    row.net.run_for(1s);
    CHECK(heard == std::vector{*first, *second});
}

TEST_CASE("received messages: a callback gets port, hops and last hop, and the level on request") {
    Network net({.propagation = Friis{}});
    for (const double x : {0.0, 30.0}) net.add({.name = {}, .at = {x, 0, 0}});
    std::vector<Heard> all;
    std::vector<std::uint16_t> ports;
    const auto keep = [&](const Heard& heard) {
        ports.push_back(heard.message.port);
        all.push_back(heard);
    };
    net.on_receive({1}, keep);
    net.on_receive({1}, keep, {.level = true});
    net.send({0}, {1}, "x", {.port = 7});
    net.run_for(1s);
    REQUIRE(all.size() == 2);
    CHECK(ports == std::vector<std::uint16_t>{7, 7});
    for (const Heard& heard : all) {
        CHECK(heard.hops == 1);
        CHECK(heard.last_hop == NodeId{0});
    }
    CHECK_FALSE(all[0].level);
    const Radio radio;
    const double loss =
        20 * std::log10(4 * 3.14159265358979323846 * 30 * radio.frequency.value / 299792458);
    REQUIRE(all[1].level);
    CHECK(std::abs(all[1].level->value - (radio.power.value - loss)) < 1e-9);
}

}  // namespace router_port_test
