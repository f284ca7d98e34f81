// SPDX-License-Identifier: MIT
// What becomes of a protocol's packets: results without acknowledgements, packets taken back, drops
// and their order, headers of copies, what is held at the end.
#include "models/access/list.hpp"
#include "models/propagation/disc.hpp"
#include "models/propagation/friis.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"
#include "test/counted_allocations.hpp"
#include "traces/ns2/ns2_trace.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace router_results_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// What a test wants a protocol to do; by default it sends to the destination over one hop.
struct Script {
    std::function<void(LinkLayer&, NodeId, MessageId)> send = [](LinkLayer& link, NodeId node,
                                                                 MessageId m) {
        link.send(
            {.message = m, .sender = node, .ttl = 3, .hops = 1, .next_hop = link.message(m).to}, {},
            link.now());
    };
    std::function<void(LinkLayer&, const Frame&, Reception&)> receive = [](auto&, auto&,
                                                                           Reception& r) {
        r.fate = Fate::arrived;
        r.delivered = true;
    };
    std::function<void(LinkLayer&, const QueuedFrame&, SendResult)> sent =
        [](LinkLayer& link, const QueuedFrame& f, SendResult result) {
            const bool failed = result != SendResult::sent && result != SendResult::acked;
            if (failed) link.drop(f.frame.sender, f.frame, DropReason::broken);
        };
    std::function<void(LinkLayer&, NodeId, std::uint64_t)> timer = [](auto&, NodeId,
                                                                      std::uint64_t) {};
    std::function<void(std::uint32_t)> forget_header = [](std::uint32_t) {};
    bool keeps = false;
    std::vector<SendResult> results{};
    std::vector<Time> times{};  ///< of the results
};

struct Scripted {
    static constexpr bool routes_unicasts = true;
    static constexpr bool wants_levels = true;
    std::shared_ptr<Script> script;

    Hops initial_ttl() const { return 3; }
    void send(LinkLayer& link, NodeId node, MessageId m) { script->send(link, node, m); }
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions) {
        for (Reception& r : receptions) script->receive(link, frame, r);
    }
    void on_sent(LinkLayer& link, const QueuedFrame& frame, SendResult result) {
        script->results.push_back(result);
        script->times.push_back(link.now());
        script->sent(link, frame, result);
    }
    void on_timer(LinkLayer& link, NodeId node, std::uint64_t tag) {
        script->timer(link, node, tag);
    }
    void forget_header(std::uint32_t header) { script->forget_header(header); }
    bool keeps(MessageId) const { return script->keeps; }
    void describe(const Message& message, const Frame& frame, PacketStyle,
                  std::string& text) const {
        text += "[0x2 " + std::to_string(message.payload.size()) + " " +
                std::to_string(frame.hops) + "] (REQUEST)";
    }
};

/// Sink that writes down the records of packets, and checks that they do not go back in time.
struct Log {
    std::vector<std::string> lines{};
    Time last = start_of_run;
    bool ordered = true;

    KindMask kinds() const {
        return kind_of<Received>() | kind_of<Dropped>() | kind_of<Routed>() | kind_of<AirSent>();
    }
    void on(const Record& record, const RecordContext& context) {
        if (const auto* r = std::get_if<Received>(&record)) {
            for (const Reception& each : r->receptions) {
                note(each.time, "r" + std::to_string(each.node.value));
            }
        } else if (const auto* d = std::get_if<Dropped>(&record)) {
            note(d->time, "D" + std::to_string(d->node.value) + " " + std::string(d->loss().code) +
                              (d->protocol_decides ? "?" : ""));
        } else if (const auto* f = std::get_if<Routed>(&record)) {
            const bool begins = context.messages[f->frame.message].origin == f->frame.sender;
            note(f->time, (begins ? "s" : "f") + std::to_string(f->frame.sender.value));
        } else if (const auto* a = std::get_if<AirSent>(&record)) {
            note(a->time, "air " + std::to_string(a->bytes));
        }
    }

  private:
    void note(Time t, std::string line) {
        ordered = ordered && t >= last;
        last = std::max(last, t);
        lines.push_back(std::move(line));
    }
};
using Lines = std::vector<std::string>;

/// Robots in a row, 80 m apart, that hear 100 m.
struct Row {
    std::shared_ptr<Script> script = std::make_shared<Script>();
    std::shared_ptr<Log> log = std::make_shared<Log>();
    Network net;

    explicit Row(AccessModel access = NoAccess{}, int robots = 3)
        : net({.propagation = Disc{.range = {100}}, .access = std::move(access)}) {
        for (int i = 0; i < robots; ++i) {
            net.add({.name = {}, .at = {80.0 * i, 0, 0}, .radio = {.rate = {1e6}}});
        }
        net.route(Scripted{.script = script});
        net.add_sink(log);
    }
    /// Lines of the log that begin with one of these letters.
    Lines lines(std::string_view letters) const {
        Lines all = log->lines;
        std::erase_if(all, [&](const std::string& line) {
            return letters.find(line[0]) == std::string_view::npos;
        });
        return all;
    }
};

}  // namespace

TEST_CASE("results: without csma, a frame is acknowledged exactly if its next hop receives it") {
    for (const AccessModel& access : {AccessModel{NoAccess{}}, AccessModel{Aloha{}}}) {
        CAPTURE(access.name());
        Row row(access);
        row.net.send({0}, {1}, "", {.size = 100});
        row.net.at(start_of_run + 50ms, [&] {
            row.net.send({0}, {2}, "", {.size = 100});  // out of range
        });
        row.net.at(start_of_run + 100ms, [&] { row.net.switch_off({1}); });
        row.net.at(start_of_run + 200ms, [&] { row.net.send({0}, {1}, "", {.size = 100}); });
        row.net.run_for(1s);
        CHECK(row.script->results ==
              std::vector{SendResult::acked, SendResult::retries, SendResult::retries});
        const Duration airtime = 192us + 800us;
        for (const Time t : row.script->times) {
            CHECK((t.time_since_epoch() % Duration{50ms}) >= airtime);  // not when it starts
        }
        CHECK(row.lines("D") == Lines{"D0 OOR?", "D0 CBK", "D0 OOR?", "D0 CBK"});
        CHECK(row.log->ordered);
    }
}

TEST_CASE(
    "results: without csma, a frame that collides at its next hop ends with the result `retries`") {
    Network net({.propagation = Disc{.range = {100}}, .reception = Collision{}});
    for (int i = 0; i < 3; ++i) net.add({.name = {}, .at = {80.0 * i, 0, 0}});
    const auto script = std::make_shared<Script>();
    net.route(Scripted{.script = script});
    net.send({0}, {1}, "a", {.size = 100});
    net.send({2}, {1}, "b", {.size = 100});
    net.run_for(1s);
    CHECK(script->results == std::vector{SendResult::retries, SendResult::retries});
}

namespace {

/// Protocol that routes unicasts over one hop, and is not told of results.
struct Deaf {
    static constexpr bool routes_unicasts = true;

    Hops initial_ttl() const { return 3; }
    void send(LinkLayer& link, NodeId node, MessageId m) { Script{}.send(link, node, m); }
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions) {
        for (Reception& r : receptions) Script{}.receive(link, frame, r);
    }
};

/// Drops of two unicasts that collide at their destination, by reason.
template <class Protocol>
std::string drops_of_collision(Protocol protocol) {
    Network net({.propagation = Disc{.range = {100}}, .reception = Collision{}});
    for (int i = 0; i < 3; ++i) net.add({.name = {}, .at = {80.0 * i, 0, 0}});
    net.route(std::move(protocol));
    for (const NodeId from : {NodeId{0}, NodeId{2}}) net.send(from, {1}, "a", {.size = 100});
    net.run_for(1s);
    std::string drops;
    for (const DropCount& drop : net.metrics().drops) {
        if (drop.count > 0) drops += std::string(drop.reason) + std::to_string(drop.count) + " ";
    }
    return drops;
}

}  // namespace

TEST_CASE(
    "results: a lost routed unicast has exactly one drop reason, also if the protocol ignores "
    "results") {
    CHECK(drops_of_collision(Scripted{.script = std::make_shared<Script>()}) == "CBK2 ");
    CHECK(drops_of_collision(Deaf{}) == "COL2 ");
}

TEST_CASE(
    "results: if a sender is switched off while its frame is on air, the frame is still "
    "delivered") {
    Row row(Csma{});
    for (int i = 0; i < 3; ++i) row.net.send({0}, {1}, "x", {.size = 1000});
    row.net.at(start_of_run + 3ms, [&] { row.net.switch_off({0}); });  // a frame takes 8 ms
    row.net.run_for(1s);
    row.net.finish();
    CHECK(row.script->results == std::vector{SendResult::off, SendResult::off, SendResult::sent});
    const MetricValues m = row.net.metrics();
    CHECK(m.messages == 3);
    CHECK(m.deliveries == 1);
    std::uint64_t dropped = 0;
    for (const DropCount& each : m.drops) dropped += each.count;
    CHECK(dropped == 2);
}

TEST_CASE(
    "results: a sender that is switched off drops the frame that its next hop did not receive") {
    for (const bool is_in_range : {true, false}) {
        for (const bool one_hop : {true, false}) {
            CAPTURE(is_in_range);
            CAPTURE(one_hop);
            Row row(Csma{});
            if (!is_in_range) row.net.switch_off({1});
            row.net.send({0}, {1}, "x", {.size = 1000, .one_hop = one_hop});
            row.net.at(start_of_run + 8ms, [&] { row.net.switch_off({0}); });  // it is on air
            row.net.run_for(1s);
            row.net.finish();
            const MetricValues m = row.net.metrics();
            CHECK(m.deliveries == (is_in_range ? 1 : 0));
            std::uint64_t dropped = 0;
            for (const DropCount& each : m.drops) dropped += each.count;
            CHECK(dropped == (is_in_range ? 0 : 1));
        }
    }
}

TEST_CASE(
    "salvage: a packet that the routing protocol sends again after a failure does not count as "
    "lost") {
    Row row(Csma{}, 4);
    row.net.switch_off({1});
    row.script->sent = [](LinkLayer& link, const QueuedFrame& f, SendResult result) {
        CHECK_FALSE(f.heard_from);
        if (result != SendResult::retries) return;
        Frame again = f.frame;
        again.next_hop = NodeId{1};
        link.send(again, f.heard_from, link.now() + 1s);
    };
    row.net.at(start_of_run + 500ms, [&] { row.net.switch_on({1}); });
    row.net.send({0}, {1}, "x");
    row.net.run_for(3s);
    row.net.finish();
    CHECK(row.script->results == std::vector{SendResult::retries, SendResult::acked});
    const MetricValues m = row.net.metrics();
    CHECK(m.deliveries == 1);
    for (const DropCount& each : m.drops) CHECK(each.count == 0);
    CHECK(row.lines("D") == Lines{"D0 RET?"});  // one attempt at a link
    CHECK(row.lines("sf") == Lines{"s0", "s0"});
}

TEST_CASE("take_queued: after a failed frame, all queued frames for its next hop are returned") {
    for (const std::uint32_t rts : {2347U, 0U}) {
        CAPTURE(rts);
        Row row(Csma{.rts_threshold = rts});
        row.net.switch_off({1});
        std::size_t taken = 0;
        Time at{};
        row.script->sent = [&](LinkLayer& link, const QueuedFrame& f, SendResult result) {
            if (result != SendResult::retries) return;
            at = link.now();
            for (const QueuedFrame& each : link.take_queued(f.frame.sender, f.frame.next_hop)) {
                ++taken;
                link.release(each.frame);
            }
        };
        for (int i = 0; i < 3; ++i) row.net.send({0}, {1}, "x");
        Time last_on_air{};
        struct Air {
            Time* last;
            KindMask kinds() const { return kind_of<AirSent>(); }
            void on(const Record& r, const RecordContext&) { *last = std::get<AirSent>(r).time; }
        };
        row.net.add_sink(std::make_shared<Air>(Air{&last_on_air}));
        row.net.run_for(1s);
        CHECK(row.script->results == std::vector{SendResult::retries});
        CHECK(taken == 2);
        CHECK(last_on_air < at);  // no frame and no RTS after it
    }
}

TEST_CASE(
    "take_queued: one-hop messages stay in the queue, and each gets seven attempts of its own") {
    Row row(Csma{});
    row.net.switch_off({1});
    std::size_t taken = 0;
    row.script->sent = [&](LinkLayer& link, const QueuedFrame& f, SendResult) {
        for (const QueuedFrame& each : link.take_queued(f.frame.sender, f.frame.next_hop)) {
            ++taken;
            CHECK(link.message(each.frame.message).payload == "routed");
            link.release(each.frame);
        }
    };
    for (const char* what : {"routed", "one hop", "routed", "one hop"}) {
        const bool one_hop = std::string_view(what) == "one hop";
        row.net.send({0}, {1}, what, {.one_hop = one_hop});
    }
    row.net.run_for(10s);
    CHECK(taken == 1);
    CHECK(row.lines("D") == Lines{"D0 RET?", "D0 RET", "D0 RET"});
    CHECK(row.lines("a").size() == 3 * 7);
}

TEST_CASE("take_queued: a station whose queue was emptied can send later frames") {
    Row row(Csma{});
    row.net.switch_off({1});
    row.script->sent = [&](LinkLayer& link, const QueuedFrame& f, SendResult result) {
        if (result != SendResult::retries) return;
        for (const QueuedFrame& each : link.take_queued(f.frame.sender, f.frame.next_hop))
            link.release(each.frame);
    };
    for (int i = 0; i < 3; ++i) row.net.send({0}, {1}, "x");
    row.net.at(start_of_run + 1s, [&] {
        row.net.switch_on({1});
        row.net.send({0}, {1}, "y");
    });
    row.net.run_for(2s);
    CHECK(row.script->results == std::vector{SendResult::retries, SendResult::acked});
}

TEST_CASE(
    "drops: a drop inside on_receive is recorded after the node's reception, at the same time") {
    Row row(NoAccess{}, 4);
    row.net.add({.name = {}, .at = {80, 20, 0}, .radio = {.rate = {1e6}}});
    row.script->send = [](LinkLayer& link, NodeId node, MessageId m) {
        link.send({.message = m, .sender = node, .ttl = 1, .hops = 1}, {}, link.now());
    };
    row.script->receive = [](LinkLayer& link, const Frame& frame, Reception& r) {
        r.fate = Fate::arrived;
        link.drop(r.node, frame, r.node == NodeId{4} ? DropReason::own : DropReason::no_route,
                  r.node == NodeId{4} ? "XYZ" : "");
    };
    row.net.send({1}, everyone, "x");
    row.net.run_for(1s);
    // Node 4 is 20 m away, 0 and 2 are 80 m away; equal times are in the order of ids.
    CHECK(row.lines("rD") == Lines{"r4", "D4 XYZ", "r0", "D0 NRTE", "r2", "D2 NRTE"});
    CHECK(row.log->ordered);
    std::uint64_t own = 0, no_route = 0;
    const MetricValues m = row.net.metrics();
    for (const DropCount& each : m.drops) {
        if (each.reason == "OWN") own = each.count;
        if (each.reason == "NRTE") no_route = each.count;
    }
    CHECK(own == 1);
    CHECK(no_route == 2);
}

TEST_CASE(
    "end of the run: a message that the routing protocol still holds counts as sent and not "
    "delivered") {
    Row row;
    row.script->keeps = true;
    row.script->send = [](LinkLayer& link, NodeId, MessageId m) { link.hold(m); };
    row.net.send({0}, {1}, "x");
    row.script->send = Script{}.send;
    row.net.send({0}, {1}, "y");
    row.net.run_for(1s);
    row.net.finish();
    CHECK(row.net.metrics().delivery_ratio == 0.5);
    CHECK(row.lines("D") == Lines{"D0 END"});
}

TEST_CASE("size: a frame may have a different size at each hop") {
    Row row;
    row.script->send = [](LinkLayer& link, NodeId node, MessageId m) {
        link.send({.message = m,
                   .sender = node,
                   .ttl = 2,
                   .hops = 1,
                   .next_hop = {1},
                   .bytes = link.message(m).size + 8},
                  {}, link.now());
    };
    row.script->receive = [](LinkLayer& link, const Frame& frame, Reception& r) {
        r.delivered = r.node == link.message(frame.message).to;
        r.fate = r.delivered ? Fate::arrived : Fate::waiting;
        if (r.delivered) return;
        Frame next = frame;
        next.sender = r.node, next.next_hop = {2}, ++next.hops, --next.ttl, next.bytes += 4;
        link.send(next, frame.sender, r.time + 1us);
    };
    row.net.send({0}, {2}, "", {.size = 100});
    row.net.run_for(1s);
    CHECK(row.lines("a") == Lines{"air 108", "air 112"});
    CHECK(row.net.metrics().deliveries == 1);
}

TEST_CASE("headers: a header is freed after its last frame, and new headers need no new memory") {
    Row row;
    std::vector<std::uint32_t> forgotten;
    row.script->send = [](LinkLayer& link, NodeId node, MessageId m) {
        for (const std::uint32_t to : {0U, 2U}) {
            link.send(
                {.message = m, .sender = node, .ttl = 1, .hops = 1, .next_hop = {to}, .header = 5},
                {}, link.now());
        }
    };
    int seen = 0;
    row.script->receive = [&](LinkLayer&, const Frame& frame, Reception& r) {
        CHECK(forgotten.empty());
        seen += frame.header == 5;
        r.fate = Fate::arrived;
    };
    row.script->forget_header = [&](std::uint32_t header) { forgotten.push_back(header); };
    row.net.send({1}, everyone, "x");
    row.net.run_for(1s);
    CHECK(seen == 2);
    CHECK(forgotten == std::vector<std::uint32_t>{5});

    // One message whose header changes at every hop, again and again: no allocation once warm.
    Network ring({.propagation = Disc{.range = {100}}, .metrics = false});
    for (int i = 0; i < 2; ++i) {
        ring.add({.name = {}, .at = {80.0 * i, 0, 0}, .radio = {.rate = {1e9}}});
    }
    const auto script = std::make_shared<Script>();
    script->receive = [](LinkLayer& link, const Frame& frame, Reception& r) {
        r.fate = Fate::waiting;
        Frame next = frame;
        next.sender = r.node, next.next_hop = frame.sender, ++next.header;
        next.header %= 64;
        next.header += next.header == 0;
        link.send(next, frame.sender, r.time + 1us);
    };
    script->sent = [](LinkLayer&, const QueuedFrame&, SendResult) {};
    ring.route(Scripted{.script = script});
    ring.send({0}, {1}, "x", {.size = 10});
    script->results.reserve(1'000'000), script->times.reserve(1'000'000);
    ring.run_for(500ms);
    const std::uint64_t before = test::allocations();
    const std::size_t results = script->results.size();
    ring.run_for(10ms);
    CHECK(script->results.size() > results + 40);
    CHECK(test::allocations() == before);
}

TEST_CASE(
    "priority: control packets overtake queued messages, but not the frame already in contention") {
    for (const bool priority : {false, true}) {
        CAPTURE(priority);
        Row row(Csma{.priority = priority});
        row.script->send = [](LinkLayer& link, NodeId node, MessageId m) {
            const auto put = [&](MessageId id) {
                link.send({.message = id, .sender = node, .ttl = 1, .hops = 1, .next_hop = {1}}, {},
                          link.now());
            };
            put(m);
            put(m);
            const MessageId hello = link.originate(node, everyone, "hello", 20, {});
            put(hello);
            link.release(hello);
        };
        row.net.send({0}, {1}, "", {.size = 200});
        row.net.run_for(1s);
        Lines data = row.lines("a");
        std::erase(data, "air 14");  // ACK
        CHECK(data == (priority ? Lines{"air 228", "air 48", "air 228"}
                                : Lines{"air 228", "air 228", "air 48"}));
    }
}

TEST_CASE("priority: a control packet displaces the last message of a full queue") {
    Row row(Csma{.queue = 2, .priority = true});
    row.script->send = [](LinkLayer& link, NodeId node, MessageId m) {
        const MessageId hello = link.originate(node, everyone, "hello", 20, {});
        for (const MessageId id : {m, m, hello}) {
            link.send({.message = id, .sender = node, .ttl = 1, .hops = 1, .next_hop = {1}}, {},
                      link.now());
        }
        link.release(hello);
    };
    row.net.send({0}, {1}, "", {.size = 200});
    row.net.run_for(1s);
    CHECK(row.script->results ==
          std::vector{SendResult::queue_full, SendResult::acked, SendResult::acked});
    CHECK(row.lines("D") == Lines{"D0 IFQ?", "D0 CBK"});
}

TEST_CASE(
    "traces: the routing protocol's description of a packet is written only for control packets") {
    Row row;
    std::string lines;
    const auto trace = std::make_shared<Ns2Trace>([&](std::string_view text) { lines += text; });
    row.net.add_sink(trace);
    row.script->send = [](LinkLayer& link, NodeId node, MessageId m) {
        const MessageId packet = link.originate(node, everyone, "AODV", 48, "abc");
        link.send({.message = packet, .sender = node, .ttl = 1, .hops = 1}, {}, link.now());
        link.release(packet);
        link.send({.message = m, .sender = node, .ttl = 1, .hops = 1, .next_hop = {1}}, {},
                  link.now());
    };
    row.net.send({0}, {1}, "hello");
    row.net.run_for(1s);
    trace->close();
    std::istringstream each(lines);
    int described = 0, packets = 0;
    for (std::string line; std::getline(each, line);) {
        if (line[0] != 's' && line[0] != 'r') continue;
        const bool is_control = line.find(" AODV ") != std::string::npos;
        CHECK(line.ends_with(" [0x2 3 1] (REQUEST)") == is_control);
        (is_control ? described : packets) += 1;
    }
    CHECK(described == 2);  // s RTR and r RTR
    CHECK(packets == 4);    // s AGT, r RTR, s RTR, r AGT
}

TEST_CASE("snr: a reception's SNR in dB is its level minus the receiver's noise floor") {
    Network net({.propagation = Friis{}});
    for (const double x : {0.0, 30.0}) {
        net.add({.name = {}, .at = {x, 0, 0}, .radio = {.noise_figure = Db{9}}});
    }
    const auto script = std::make_shared<Script>();
    std::vector<double> snr;
    script->receive = [&](LinkLayer& link, const Frame&, Reception& r) {
        r.fate = Fate::arrived;
        snr.push_back(link.snr(r).value);
    };
    net.route(Scripted{.script = script});
    net.send({0}, {1}, "x");
    net.run_for(1s);
    const Radio radio;
    const double loss =
        20 * std::log10(4 * 3.14159265358979323846 * 30 * radio.frequency.value / 299792458);
    const double noise = 10 * std::log10(1.380649e-23 * 290 * 22e6 * 1000) + 9;
    REQUIRE(snr.size() == 1);
    CHECK(std::abs(snr[0] - (radio.power.value - loss - noise)) < 1e-6);
}

#ifndef NDEBUG
TEST_CASE("references: a debug build reports a message that is released too often, or never") {
    SUBCASE("a message that the routing protocol released too often is reported") {
        Row row;
        row.script->send = [](LinkLayer& link, NodeId, MessageId m) { link.release(m); };
        CHECK_THROWS_WITH(row.net.send({0}, {1}, "x"),
                          "the routing protocol released message 0 (of an application), to which "
                          "this protocol holds no reference");
    }
    SUBCASE("a message that the routing protocol never released is reported") {
        Row row;
        row.script->send = [](LinkLayer& link, NodeId, MessageId m) { link.hold(m); };
        row.net.send({0}, {1}, "x");
        row.net.run_for(1s);
        CHECK_THROWS_WITH(
            row.net.finish(),
            "the routing protocol still holds 1 reference(s) to message 0 (of an application), but "
            "keeps() of this protocol returns false for this message");
    }
}
#endif

}  // namespace router_results_test
