// SPDX-License-Identifier: MIT
#include "network/network.hpp"

#include "mobility/waypoints.hpp"
#include "models/propagation/disc.hpp"
#include "models/propagation/log_distance.hpp"
#include "routing/flood.hpp"
#include "sim/error.hpp"
#include "test/scene/drawn_map.hpp"
#include "traces/fingerprint.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace network_test {
using namespace rovernet;

namespace {

using namespace std::chrono_literals;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr Duration airtime_64_bytes{238'545};  // at 11 Mb/s behind 192 us of preamble

std::int64_t ns(Time t) { return t.time_since_epoch().count(); }

/// Every record as a line of text, every reception as one of its own; without what counts robots.
struct Text {
    std::optional<NodeId> without = {};  // this robot's own records
    std::vector<std::string> lines{};
    std::vector<Time> times{};

    KindMask kinds() const { return kind_all; }
    void on(const Record& record, const RecordContext& context) {
        context_ = &context;
        std::visit([this](const auto& r) { tell(r); }, record);
    }

  private:
    void add(Time t, NodeId node, const std::string& text) {
        if (node == without) return;
        times.push_back(t);
        lines.push_back(fmt::format("{} {} {}", ns(t), node.value, text));
    }
    std::string text(const Frame& f) const {
        return fmt::format("{} {} {} {} {}", context_->messages[f.message].uid, f.sender.value,
                           f.path, f.ttl, f.hops);
    }
    static std::string text(Vec3 v) { return fmt::format("({} {} {})", v.x, v.y, v.z); }

    void tell(const LinkUp& r) { add(r.time, r.to, fmt::format("can hear {}", r.from.value)); }
    void tell(const LinkDown& r) { add(r.time, r.to, fmt::format("lost {}", r.from.value)); }
    void tell(const Sent& r) { add(r.time, r.node, fmt::format("sends, ttl {}", r.ttl)); }
    void tell(const Transmitted& r) {
        add(r.time, r.frame.sender,
            fmt::format("transmits {} from {}", text(r.frame),
                        r.heard_from ? static_cast<int>(r.heard_from->value) : -1));
    }
    void tell(const Received& r) {
        for (const auto& reception : r.receptions) {
            add(reception.time, reception.node,
                fmt::format("hears {} fate {} {}", text(r.frame), static_cast<int>(reception.fate),
                            reception.delivered));
        }
    }
    void tell(const Dropped& r) { add(r.time, r.node, "drops " + text(r.frame)); }
    void tell(const Moved& r) {
        add(r.time, r.node,
            fmt::format("moves {} {} {} {} {}", ns(r.leg.start), ns(r.leg.end), text(r.leg.from),
                        text(r.leg.velocity), text(r.leg.to)));
    }
    void tell(const Arrived& r) { add(r.time, r.node, "arrives"); }
    void tell(const NoWay& r) { add(r.time, r.node, "finds no way to " + text(r.goal)); }
    void tell(const Switched& r) { add(r.time, r.node, r.on ? "on" : "off"); }
    void tell(const AirSent&) {}
    void tell(const ControlReceived&) {}
    void tell(const Routed&) {}

    const RecordContext* context_ = nullptr;
};

struct Run {
    std::vector<std::string> lines;
    std::vector<Time> times;
    std::uint64_t fingerprint;
    std::uint64_t events;
    friend bool operator==(const Run&, const Run&) = default;
};

/// A network with something of everything: robots on the move, floods, robots switched off and on.
struct Busy {
    explicit Busy(std::uint64_t seed, bool with_stranger = false, std::uint32_t replication = 0)
        : net({.seed = seed,
               .replication = replication,
               .propagation = LogDistance{.exponent = 3}}) {
        if (with_stranger) text->without = NodeId{robots};
        net.add_sink(text);
        net.add_sink(fingerprint);
        test::Draw draw(99);  // the same world for every seed
        const auto place = [&] { return Vec3{draw.uniform(0, 150), draw.uniform(0, 150), 0}; };
        for (std::uint32_t i = 0; i < robots; ++i) {
            net.add({.name = fmt::format("robot {}", i),
                     .at = place(),
                     .move = Waypoints{.path = {place(), place()}, .speed = {20}}});
        }
        if (with_stranger) {
            net.add({.name = "stranger",
                     .at = {1e7, 0, 0},
                     .move = ToGoal{.to = {1e7, 10, 0}, .speed = {7}}});
        }
        net.route(Flood{.ttl = 4});
        net.every(100ms,
                  [this] { net.send({next++ % robots}, everyone, "hello, world", {.size = 64}); });
        for (std::uint32_t i = 0; i < robots; i += 4) {
            const Time t = start_of_run + 1s + draw.below(1000) * 1ms;
            net.at(t, [this, i] { net.switch_off({i}); });
            net.at(t + 700ms, [this, i] { net.switch_on({i}); });
        }
        net.on_receive({3}, [this](const Message& m) {
            if (m.origin != NodeId{3}) net.send({3}, everyone, "answer", {.size = 20});
        });
    }
    Busy(const Busy&) = delete;
    Run result() const { return {text->lines, text->times, fingerprint->value(), net.events()}; }
    Run run() {
        net.run_until(end);
        return result();
    }

    static constexpr std::uint32_t robots = 30;
    static constexpr Time end = start_of_run + 3s;
    std::shared_ptr<Text> text = std::make_shared<Text>();
    std::shared_ptr<Fingerprint> fingerprint = std::make_shared<Fingerprint>();
    std::uint32_t next = 0;
    Network net;
};

/// A protocol of the user's own: one hop, everyone who hears is handed the message.
struct OneHop {
    std::uint8_t initial_ttl() const { return 1; }
    void send(LinkLayer& link, NodeId node, MessageId message) {
        link.send({.message = message, .sender = node, .ttl = 1, .hops = 1}, std::nullopt,
                  link.now());
    }
    void on_receive(LinkLayer&, const Frame&, std::span<Reception> receptions) {
        for (auto& r : receptions) {
            r.fate = Fate::ttl;
            r.delivered = true;
        }
    }
};

/// An observer of the user's own.
struct Receptions {
    std::vector<Reception> all{};
    KindMask kinds() const { return kind_of<Received>(); }
    void on(const Record& record, const RecordContext&) {
        for (const auto& r : std::get<Received>(record).receptions) all.push_back(r);
    }
};

/// An observer that notes how many receptions each record has.
struct ReceptionCounts {
    std::vector<std::size_t> all{};
    KindMask kinds() const { return kind_of<Received>(); }
    void on(const Record& record, const RecordContext&) {
        all.push_back(std::get<Received>(record).receptions.size());
    }
};

Robot robot_at(double x) { return {.name = {}, .at = {x, 0, 0}}; }

NetworkSettings disc(double range) { return {.propagation = Disc{.range = {range}}}; }

}  // namespace

TEST_CASE("network: equal seeds give equal runs; another seed or replication gives another run") {
    const Run first = Busy(1).run();
    CHECK(first.lines.size() > 5000);
    CHECK(Busy(1).run() == first);
    CHECK(Busy(2).run().fingerprint != first.fingerprint);
    CHECK(Busy(1, false, 1).run().fingerprint != first.fingerprint);
}

TEST_CASE(
    "network: adding a robot that is out of range does not change the records of other robots") {
    const Run alone = Busy(1).run();
    const Run with_stranger = Busy(1, true).run();
    CHECK(with_stranger.lines == alone.lines);
    CHECK(with_stranger.events > alone.events);
}

TEST_CASE("network: a run that is executed in parts gives the same result as a run in one piece") {
    const Run whole = Busy(5).run();
    SUBCASE("the run is made one event at a time") {
        Busy pieces(5);
        while (!pieces.net.advance(Busy::end, 1)) {
        }
        CHECK(pieces.result() == whole);
    }
    SUBCASE("the run is made in steps that end between receptions of a frame") {
        Busy pieces(5);
        while (pieces.net.now() < Busy::end) {
            pieces.net.run_until(std::min(Busy::end, pieces.net.now() + 333'333ns));
        }
        CHECK(pieces.result().lines == whole.lines);
        CHECK(pieces.result().fingerprint == whole.fingerprint);
    }
}

TEST_CASE(
    "network: if the time limit allows, advance() serves all receptions of a frame together") {
    const auto counts_in_steps = [](Duration step, Time limit) {
        Busy busy(5);
        const auto counts = std::make_shared<ReceptionCounts>();
        busy.net.add_sink(counts);
        while (busy.net.now() < Busy::end)
            busy.net.advance(std::min(Busy::end, busy.net.now() + step), 1'000'000, limit);
        CHECK(busy.net.now() == Busy::end);
        return counts->all;
    };
    const auto whole = counts_in_steps(Busy::end - start_of_run, start_of_run);
    CHECK(counts_in_steps(33'333ns, Busy::end) == whole);
    CHECK(counts_in_steps(33'333ns, start_of_run).size() > whole.size());
}

TEST_CASE(
    "network: advance() serves at most n events, and returns whether it reached its end time") {
    Busy busy(5);
    CHECK_FALSE(busy.net.advance(Busy::end, 10));
    CHECK(busy.net.events() == 10);
    CHECK(busy.net.now() < Busy::end);
    CHECK(busy.net.advance(Busy::end, 100'000'000));
    CHECK(busy.net.now() == Busy::end);
}

TEST_CASE("network: records come in the order of their times") {
    const Run run = Busy(3).run();
    CHECK(std::is_sorted(run.times.begin(), run.times.end()));
}

TEST_CASE("network: over kilometres, with overlapping frames, records stay in order") {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        NetworkSettings settings = disc(1500);
        settings.seed = seed;
        Network net(settings);
        const auto text = std::make_shared<Text>();
        net.add_sink(text);
        test::Draw draw(static_cast<std::uint32_t>(seed));
        constexpr std::uint32_t robots = 60;
        for (std::uint32_t i = 0; i < robots; ++i) {
            net.add({.name = {}, .at = {draw.uniform(0, 3000), draw.uniform(0, 3000), 0}});
        }
        net.route(Flood{.ttl = 4, .jitter = Duration{2000}});
        for (std::uint32_t i = 0; i < robots; ++i) {
            net.at(start_of_run + i * 700ns,
                   [&net, i] { net.send({i}, everyone, "x", {.size = 8}); });
        }
        net.run_until(start_of_run + 1s);
        CHECK(text->lines.size() > 10'000);
        CHECK(std::is_sorted(text->times.begin(), text->times.end()));
    }
}

TEST_CASE("network: a near robot answers a frame before a far robot has received it") {
    Network net({.propagation = Disc{.range = 700_m}});
    for (const double x : {0.0, 1.0, 650.0}) net.add({.name = {}, .at = {x, 0}});
    net.route(Flood{.jitter = Duration{0}});
    const auto text = std::make_shared<Text>();
    net.add_sink(text);
    net.send({0}, everyone, "F", {.size = 64});
    net.run_for(1s);
    // The near robot answers 1 us after the frame, which takes 2 us more to the far one.
    CHECK(std::is_sorted(text->times.begin(), text->times.end()));
    CHECK(net.metrics().transmissions == 3);
}

TEST_CASE("network: a frame arrives after its airtime and the delay at the speed of light") {
    Network net(disc(1e6));
    for (const double x : {0.0, 300.0, 30'000.0, 0.0}) net.add(robot_at(x));
    net.route(OneHop{});
    const auto heard = std::make_shared<Receptions>();
    net.add_sink(heard);
    net.at(start_of_run + 1ms, [&] { net.send({0}, everyone, "F", {.size = 64}); });
    net.run_until(start_of_run + 1s);
    REQUIRE(heard->all.size() == 3);
    const Time end = start_of_run + 1ms + airtime_64_bytes;
    CHECK(heard->all[0].node == NodeId{3});
    CHECK(heard->all[0].time == end);
    CHECK(heard->all[1].node == NodeId{1});
    CHECK(heard->all[1].time == end + 1001ns);  // 1000.69 ns
    CHECK(heard->all[2].node == NodeId{2});
    CHECK(heard->all[2].time == end + 100'069ns);  // 100,069.23 ns
}

TEST_CASE("network: if no size is given, the size of a message on air is that of its payload") {
    Network net(disc(10));
    for (int i = 0; i < 2; ++i) net.add(robot_at(0));
    net.route(OneHop{});
    const auto heard = std::make_shared<Receptions>();
    net.add_sink(heard);
    net.send({0}, everyone, std::string(64, 'x'));
    net.run_for(1s);
    REQUIRE(heard->all.size() == 1);
    CHECK(heard->all[0].time == start_of_run + airtime_64_bytes);
}

TEST_CASE("network: a plain struct can be a routing protocol or a listener to records (sink)") {
    struct Count {
        int* received;
        KindMask kinds() const { return kind_of<Received>(); }
        void on(const Record&, const RecordContext&) { ++*received; }
    };
    int received = 0;
    Network net(disc(10));
    for (const double x : {0.0, 5.0, 50.0}) net.add(robot_at(x));
    net.route(OneHop{});
    net.add_sink(Count{&received});
    net.send({0}, everyone, "F");
    net.run_for(1s);
    CHECK(received == 1);
    CHECK(net.metrics().deliveries == 1);
    CHECK(net.metrics().transmissions == 1);
}

TEST_CASE("network: a routing protocol that sends a frame while it receives one gets an error") {
    struct Hasty : OneHop {
        void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions) {
            link.send(frame, receptions.front().node, link.now());
        }
    };
    Network net(disc(10));
    for (int i = 0; i < 2; ++i) net.add(robot_at(0));
    net.route(Hasty{});
    net.send({0}, everyone, "F");
    CHECK_THROWS_AS(net.run_for(1s), std::invalid_argument);
}

TEST_CASE("network: callbacks for a message are called once, 1 us after its reception") {
    Network net(disc(1000));
    for (const double x : {0.0, 300.0, 300.0}) net.add(robot_at(x));
    net.route(Flood{});
    std::vector<Time> times;
    net.on_receive({1}, [&](const Message& m) {
        times.push_back(net.now());
        CHECK(m.payload == "F");
        CHECK(m.origin == NodeId{0});
        CHECK(m.created == start_of_run);
    });
    net.on_receive({0}, [&](const Message&) { FAIL("the source hears itself"); });
    net.send({0}, everyone, "F", {.size = 64});
    net.run_until(start_of_run + 1s);
    REQUIRE(times.size() == 1);
    CHECK(times[0] == start_of_run + airtime_64_bytes + 1001ns + 1us);
}

TEST_CASE("network: robots can answer each other's messages from their callbacks") {
    Network net(disc(1000));
    for (int i = 0; i < 2; ++i) net.add(robot_at(0));
    net.route(Flood{.ttl = 1});
    int heard = 0;
    for (std::uint32_t i = 0; i < 2; ++i) {
        net.on_receive({i}, [&net, &heard, i](const Message&) {
            if (++heard < 10) net.send({i}, everyone, "ping", {.size = 64});
        });
    }
    net.send({0}, everyone, "ping", {.size = 64});
    net.run_for(1s);
    CHECK(heard == 10);
    CHECK(net.metrics().messages == 10);
}

TEST_CASE("network: a robot switched off during a frame does not receive it") {
    Network net(disc(1000));
    for (int i = 0; i < 3; ++i) net.add(robot_at(100.0 * i));
    net.route(OneHop{});
    const auto heard = std::make_shared<Receptions>();
    net.add_sink(heard);
    int reactions = 0;
    net.on_receive({1}, [&](const Message&) { ++reactions; });
    net.at(start_of_run + 1ms, [&] { net.send({0}, everyone, "F", {.size = 64}); });
    net.at(start_of_run + 1100us, [&] { net.switch_off({1}); });
    net.run_until(start_of_run + 1s);
    REQUIRE(heard->all.size() == 2);
    CHECK(heard->all[0].node == NodeId{1});
    CHECK(heard->all[0].fate == Fate::off);
    CHECK_FALSE(heard->all[0].delivered);
    CHECK(heard->all[1].fate == Fate::ttl);
    CHECK(heard->all[1].delivered);
    CHECK(reactions == 0);
}

TEST_CASE("network: a robot switched on during a frame does not receive this frame") {
    Network net(disc(1000));
    for (int i = 0; i < 2; ++i) net.add(robot_at(0));
    net.route(OneHop{});
    const auto heard = std::make_shared<Receptions>();
    net.add_sink(heard);
    net.switch_off({1});
    net.at(start_of_run + 1ms, [&] { net.send({0}, everyone, "F", {.size = 64}); });
    net.at(start_of_run + 1100us, [&] { net.switch_on({1}); });
    net.run_until(start_of_run + 1s);
    CHECK(heard->all.empty());
}

TEST_CASE("network: a robot that is off stands still, and continues when it is on again") {
    Network net;
    net.add({.name = {}, .at = {}, .move = ToGoal{.to = {10, 0, 0}, .speed = {1}}});
    constexpr double tolerance = 1e-9;  // [m], roundings
    const auto x_at = [&](Duration t) {
        net.run_until(start_of_run + t);
        return net.position({0}).x;
    };
    std::vector<Time> arrivals;
    net.on_arrival({0}, [&] { arrivals.push_back(net.now()); });
    net.at(start_of_run + 2s, [&] { net.switch_off({0}); });
    net.at(start_of_run + 5s, [&] { net.switch_on({0}); });
    CHECK(std::abs(x_at(2s) - 2) <= tolerance);
    CHECK(std::abs(x_at(4s) - 2) <= tolerance);
    CHECK(std::abs(x_at(6s) - 3) <= tolerance);
    CHECK(std::abs(x_at(12s) - 9) <= tolerance);
    CHECK(x_at(13s) == 10);
    CHECK(x_at(20s) == 10);
    REQUIRE(arrivals.size() == 1);
    CHECK(arrivals[0] >= start_of_run + 13s);
    CHECK(arrivals[0] <= start_of_run + 13s + 1us);
}

TEST_CASE("network: a robot that is off at the start begins to move when it is switched on") {
    Network net;
    net.add({.name = {}, .at = {}, .move = ToGoal{.to = {10, 0, 0}, .speed = {1}}});
    net.switch_off({0});
    net.at(start_of_run + 5s, [&] { net.switch_on({0}); });
    net.run_until(start_of_run + 5s);
    CHECK(net.position({0}) == Vec3{});
    net.run_until(start_of_run + 15s);
    CHECK(net.position({0}) == Vec3{10, 0, 0});
}

TEST_CASE("network: a robot that is off sends nothing") {
    Network net(disc(10));
    for (int i = 0; i < 2; ++i) net.add(robot_at(0));
    net.route(Flood{});
    net.switch_off({0});
    net.send({0}, everyone, "F");
    net.run_for(1s);
    CHECK(net.metrics().messages == 0);
    CHECK(net.metrics().transmissions == 0);
    net.switch_on({0});
    net.send({0}, everyone, "F");
    net.run_for(1s);
    CHECK(net.metrics().deliveries == 1);
}

TEST_CASE("network: a callback that is called when a robot arrives can start its next movement") {
    Network net;
    net.add({.name = {}, .at = {}, .move = ToGoal{.to = {1, 0, 0}, .speed = {1}}});
    int arrivals = 0;
    net.on_arrival({0}, [&] {
        if (++arrivals == 1) net.move({0}, ToGoal{.to = {1, 2, 0}, .speed = {1}});
    });
    net.run_until(start_of_run + 10s);
    CHECK(arrivals == 2);
    CHECK(net.position({0}) == Vec3{1, 2, 0});
}

TEST_CASE("network: a movement that was replaced has no effect any more") {
    Network net;
    net.add({.name = {}, .at = {}, .move = ToGoal{.to = {10, 0, 0}, .speed = {1}}});
    int arrivals = 0;
    net.on_arrival({0}, [&] { ++arrivals; });
    net.at(start_of_run + 5s, [&] { net.move({0}, Fixed{}); });
    net.run_until(start_of_run + 1h);
    constexpr double tolerance = 1e-9;  // [m], roundings
    CHECK(std::abs(net.position({0}).x - 5) <= tolerance);
    CHECK(arrivals == 0);
}

TEST_CASE("network: actions are called at their times, simultaneous ones in the given order") {
    Network net;
    std::string order;
    net.at(start_of_run + 2s, [&] { order += 'c'; });
    net.at(start_of_run + 1s, [&] { order += 'a'; });
    net.at(start_of_run + 1s, [&] {
        order += 'b';
        net.at(net.now(), [&] { order += '!'; });
    });
    net.run_until(start_of_run + 2s);
    CHECK(order == "ab!c");
    CHECK_THROWS_AS(net.at(start_of_run + 1s, [] {}), std::invalid_argument);
}

TEST_CASE("network: a periodic action is called every period, first after one period") {
    Network net;
    std::vector<std::int64_t> times;
    net.every(300ms, [&] { times.push_back(ns(net.now())); });
    net.run_until(start_of_run + 900ms);
    CHECK(times == std::vector<std::int64_t>{300'000'000, 600'000'000, 900'000'000});
    CHECK_THROWS_AS(net.every(0ms, [] {}), std::invalid_argument);
}

TEST_CASE("network: at the event limit a run fails, however little time passes") {
    SUBCASE("a flood in which every copy is forwarded ends at the event limit") {
        NetworkSettings settings = disc(10);
        settings.event_limit = 20'000;
        Network net(settings);
        for (int i = 0; i < 10; ++i) net.add(robot_at(0));
        net.route(Flood{.ttl = 20, .duplicates = Duplicates::forward});
        net.send({0}, everyone, "F");
        CHECK_THROWS_AS(net.run_for(1h), RunError);
        CHECK(net.events() <= 20'000);
    }
    SUBCASE("an action that schedules itself at the current time ends the run at the event limit") {
        Network net({.event_limit = 1000});
        std::function<void()> again = [&] { net.at(net.now(), again); };
        net.at(start_of_run, again);
        CHECK_THROWS_AS(net.run_for(1s), RunError);
    }
    SUBCASE("a movement with endless pieces of 1 ns in place ends the run at the event limit") {
        struct Fidget {
            Step next_leg(Mover& mover) {
                return straight_leg(mover, mover.position, mover.now + 1ns);
            }
        };
        Network net({.event_limit = 1000});
        net.add({.name = {}, .at = {}, .move = Fidget{}});
        CHECK_THROWS_AS(net.run_for(1h), RunError);
    }
}

TEST_CASE("network: two networks in one process do not influence each other") {
    const Run one = Busy(1).run();
    const Run two = Busy(2).run();
    Busy a(1), b(2);
    bool a_done = false, b_done = false;
    while (!a_done || !b_done) {
        a_done = a.net.advance(Busy::end, 7);
        b_done = b.net.advance(Busy::end, 11);
    }
    CHECK(a.result() == one);
    CHECK(b.result() == two);
}

TEST_CASE(
    "network: robots are found by name; a robot without a name is called r and its number, as r1") {
    Network net;
    net.add({.name = "ada", .at = {}});
    net.add(robot_at(1));
    CHECK(net.name({0}) == "ada");
    CHECK(net.name({1}) == "r1");
    CHECK(net.find("r1") == NodeId{1});
    CHECK_FALSE(net.find("bob"));
    CHECK(net.size() == 2);
}

TEST_CASE("network: a name in use is refused, and the network is unchanged") {
    Network net;
    net.add({.name = "ada", .at = {}});
    CHECK_THROWS_AS(net.add({.name = "ada", .at = {1, 0, 0}}), std::invalid_argument);
    CHECK(net.size() == 1);
    CHECK(net.add({.name = "bob", .at = {}}) == NodeId{1});
}

TEST_CASE("network: invalid robots and settings are refused") {
    Network net;
    const double inf = std::numeric_limits<double>::infinity();
    CHECK_THROWS_AS(net.add(robot_at(no_number)), std::invalid_argument);
    CHECK_THROWS_AS(net.add(robot_at(inf)), std::invalid_argument);
    CHECK_THROWS_AS(net.add({.name = {}, .at = {0, 0, no_number}}), std::invalid_argument);
    CHECK_THROWS_AS(net.add({.name = {}, .at = {}, .radius = {-1}}), std::invalid_argument);
    CHECK_THROWS_AS(net.add({.name = {}, .at = {}, .radio = {.rate = {0}}}), std::invalid_argument);
    CHECK(net.size() == 0);
    CHECK_THROWS_AS(Network({.floor_height = {0}}), std::invalid_argument);
    CHECK_THROWS_AS(Network({.floor_height = {no_number}}), std::invalid_argument);
}

TEST_CASE(
    "network: after an invalid robot is refused, its name and number are free for the next robot") {
    Network net(disc(10));
    net.add(robot_at(0));
    CHECK_THROWS(net.add({.name = "bad", .at = {}, .radio = {.frequency = {-1}}}));
    CHECK_FALSE(net.find("bad"));
    const NodeId next = net.add({.name = "bad", .at = {5, 0, 0}});
    CHECK(next == NodeId{1});
    net.route(Flood{});
    net.send({0}, everyone, "F");
    net.run_for(1s);
    CHECK(net.metrics().deliveries == 1);
}

TEST_CASE(
    "network: sending without a routing protocol, and adding a second protocol, are refused") {
    Network net;
    net.add(robot_at(0));
    CHECK_THROWS_AS(net.send({0}, everyone, "F"), std::invalid_argument);
    net.route(Flood{});
    CHECK_THROWS_AS(net.route(Flood{}), std::invalid_argument);
}

TEST_CASE("network: a robot that joins during the run takes part at once") {
    Network net(disc(10));
    net.add(robot_at(0));
    net.route(Flood{});
    net.at(start_of_run + 1s, [&] {
        net.add({.name = {}, .at = {1, 0, 0}, .move = ToGoal{.to = {5, 0, 0}, .speed = {1}}});
        net.send({0}, everyone, "F");
    });
    net.run_until(start_of_run + 10s);
    CHECK(net.metrics().deliveries == 1);
    CHECK(net.position({1}) == Vec3{5, 0, 0});
}

TEST_CASE("network: if metrics are off, requesting them throws an error") {
    Network net({.metrics = false});
    CHECK_THROWS_AS(net.metrics(), std::invalid_argument);
}

}  // namespace network_test
