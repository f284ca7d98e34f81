// SPDX-License-Identifier: MIT
// Sanity under load: crowds, distances and storms at which a simulator hangs or grows without end.
// What is bounded is counted: receptions, events, bytes; never a time.
#include "mobility/waypoints.hpp"
#include "models/access/list.hpp"
#include "models/propagation/disc.hpp"
#include "models/propagation/log_distance.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"
#include "routing/flood.hpp"
#include "sim/error.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <malloc.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace load_test {
using namespace rovernet;

namespace {

using namespace std::chrono_literals;

/// One copy of a frame at one robot.
struct Copy {
    NodeId from, to;
    std::uint64_t path;
    Time time;
    Fate fate;
    bool delivered;
    friend bool operator==(const Copy&, const Copy&) = default;
};

/// Keeps every copy, in the order of the records.
struct Copies {
    std::uint64_t transmissions = 0;
    std::vector<Copy> all{};

    KindMask kinds() const { return kind_of<Transmitted>() | kind_of<Received>(); }
    void on(const Record& record, const RecordContext&) {
        const auto* received = std::get_if<Received>(&record);
        if (!received) {
            ++transmissions;
            return;
        }
        const Frame& frame = received->frame;
        for (const Reception& r : received->receptions) {
            all.push_back({frame.sender, r.node, frame.path, r.time, r.fate, r.delivered});
        }
    }
    std::int64_t count(Fate fate) const {
        return std::count_if(all.begin(), all.end(), [&](const Copy& c) { return c.fate == fate; });
    }
    std::int64_t delivered() const {
        return std::count_if(all.begin(), all.end(), [](const Copy& c) { return c.delivered; });
    }
};

/// A network whose copies are kept.
struct Watched {
    Network net;
    std::shared_ptr<Copies> copies = std::make_shared<Copies>();

    explicit Watched(NetworkSettings settings, const Flood& flood = {.ttl = 1}) : net(settings) {
        net.add_sink(copies);
        net.route(flood);
    }
    void add(const std::vector<double>& places) {
        for (const double x : places) net.add({.name = {}, .at = {x, 0, 0}});
    }
    void add_crowd(int robots) {
        for (int i = 0; i < robots; ++i) net.add({.name = {}, .at = {}});
    }
    /// `node` sends at `t`.
    void send(std::uint32_t node, Duration t) {
        net.at(start_of_run + t,
               [this, node] { net.send(NodeId{node}, everyone, "F", {.size = 64}); });
    }
};

/// Counts changes of links.
struct Links {
    int up = 0, down = 0;
    KindMask kinds() const { return kind_links; }
    void on(const Record& record, const RecordContext&) {
        ++(std::holds_alternative<LinkUp>(record) ? up : down);
    }
};

NetworkSettings disc(double range, ReceptionModel reception = Threshold{},
                     AccessModel access = NoAccess{}) {
    return {.propagation = Disc{.range = {range}},
            .reception = reception,
            .access = access,
            .metrics = false};
}

/// Bytes that this process has allocated and not freed.
std::size_t allocated() {
    const auto now = mallinfo2();
    return now.uordblks + now.hblkhd;
}

/// Which robot has which one's frame, in the order of the records.
std::vector<std::pair<NodeId, NodeId>> order(const Copies& copies) {
    std::vector<std::pair<NodeId, NodeId>> order;
    for (const Copy& copy : copies.all) order.emplace_back(copy.from, copy.to);
    return order;
}

constexpr Duration airtime_64_bytes{238'545};  // at 11 Mb/s behind 192 us of preamble

}  // namespace

TEST_CASE("load: a transmission to 10,000 robots in one place is one event, and all receive it") {
    constexpr int robots = 10'000, messages = 10;
    Watched crowd(disc(1));
    crowd.add_crowd(robots);
    for (std::uint32_t k = 0; k < messages; ++k) crowd.send(k, 1ms);
    crowd.net.run_for(1s);
    CHECK(crowd.copies->transmissions == messages);
    CHECK(crowd.copies->all.size() == messages * (robots - 1));
    CHECK(crowd.copies->delivered() == messages * (robots - 1));
    CHECK(crowd.net.events() == 2 * messages);  // an action and a frame
}

TEST_CASE("load: if 30 of 1,000 robots in one place send at once, nobody receives anything") {
    constexpr int robots = 1000, senders = 30;
    for (const ReceptionModel& model : {ReceptionModel{Collision{}}, ReceptionModel{Sinr{}}}) {
        CAPTURE(model.name());
        Watched crowd(disc(1, model));
        crowd.add_crowd(robots);
        for (std::uint32_t k = 0; k < senders; ++k) crowd.send(k, 1ms);
        crowd.send(7, 2ms);
        crowd.net.run_until(start_of_run + 1900us);
        const auto busy = crowd.copies->count(Fate::busy);
        // Senders lose what they hear to each other; sinr says that they were busy.
        CHECK(busy == (model.name() == "collision" ? 0 : senders * (senders - 1)));
        CHECK(crowd.copies->count(Fate::collided) == senders * (robots - 1) - busy);
        CHECK(crowd.copies->all.size() == senders * (robots - 1));
        crowd.net.run_for(1s);
        CHECK(crowd.copies->delivered() == robots - 1);  // what was on air is no more
        CHECK(crowd.net.events() == 2 * (senders + 1));
    }
}

TEST_CASE(
    "load: in a flood of 300 robots in one place with `sinr` and `csma`, each robot sends one "
    "frame") {
    constexpr int robots = 300;
    Watched crowd(disc(1, Sinr{}, Csma{}), {.ttl = 5});
    crowd.add_crowd(robots);
    crowd.send(0, 1ms);
    crowd.net.run_for(10s);
    const Copies& copies = *crowd.copies;
    CHECK(copies.transmissions == robots);
    CHECK(copies.all.size() == robots * (robots - 1));
    CHECK(copies.delivered() == robots - 1);
    CHECK(copies.count(Fate::waiting) == robots - 1);
    CHECK(copies.count(Fate::duplicate) + copies.count(Fate::collided) + copies.count(Fate::busy) ==
          (robots - 1) * (robots - 1));
    // A frame puts off whoever waits to send: an event at most for each that hears it.
    CHECK(crowd.net.events() < static_cast<std::uint64_t>(robots * (robots - 1)));
}

TEST_CASE("load: a crowd of robots that keeps sending does not take more and more memory") {
    for (const AccessModel& access : {AccessModel{NoAccess{}}, AccessModel{Csma{}}}) {
        for (const ReceptionModel& model :
             {ReceptionModel{Threshold{}}, ReceptionModel{Collision{}}}) {
            CAPTURE(model.name());
            CAPTURE(access.name());
            Network net(disc(1, model, access));
            net.route(Flood{.ttl = 2});
            constexpr std::uint32_t robots = 30;
            for (std::uint32_t i = 0; i < robots; ++i) net.add({.name = {}, .at = {}});
            std::uint32_t sent = 0;
            net.every(50ms, [&] { net.send({sent++ % robots}, everyone, "F", {.size = 64}); });
            net.run_for(1s);
            const std::size_t before = allocated();
            net.run_for(4s);
            // Five times as many frames; lists that grow to a new peak may double.
            constexpr std::size_t some_lists = 32'768;
            CHECK(allocated() < before + some_lists);
        }
    }
}

TEST_CASE("load: a flood along a line of 100,000 robots reaches all of them, hop by hop") {
    for (const auto& [robots, ttl] : {std::pair{1000U, 300U}, std::pair{100'000U, 50'000U}}) {
        const std::uint32_t middle = robots / 2;
        Watched line(disc(10), {.ttl = static_cast<int>(ttl), .jitter = Duration{0}});
        line.net.reserve(robots);
        for (std::uint32_t i = 0; i < robots; ++i) {
            line.net.add({.name = {}, .at = {10.0 * i, 0, 0}});
        }
        line.net.send({middle}, everyone, "F", {.size = 64});
        line.net.run_for(1h);
        // Left of the middle are `middle` robots, right of it one fewer. All send that are reached
        // but in the last hop, and are heard by both neighbours; the rightmost has only one.
        const bool all = ttl == middle;
        const std::uint64_t right = all ? ttl - 1 : ttl;
        const std::uint64_t sent = 1 + (ttl - 1) + (all ? right : right - 1);
        const Copies& copies = *line.copies;
        CHECK(static_cast<std::uint64_t>(copies.delivered()) == ttl + right);
        CHECK(copies.transmissions == sent);
        REQUIRE(copies.all.size() == 2 * sent - (all ? 1 : 0));
        CHECK(line.net.events() == 2 * sent - 1);  // a timer and a frame, the first but one
        // 10 m are 33 ns; who forwards does so 1 us later.
        CHECK(copies.all.back().time ==
              start_of_run + ttl * (airtime_64_bytes + 33ns) + (ttl - 1) * 1us);
    }
}

TEST_CASE("load: robots at 1e9 and 1e12 m behave like robots at the origin") {
    Watched world(disc(120));
    // Of the far ones, single precision puts those that are 100 m apart 128 and 65,536 m apart.
    for (const double home : {0.0, 1e9, -1'000'000'028'722.0}) {
        world.net.add(
            {.name = {}, .at = {home, 0, 0}, .move = ToGoal{.to = {home, 1e4, 0}, .speed = {10}}});
        world.net.add({.name = {}, .at = {home + 100, 0, 0}});
    }
    std::vector<double> lost(6);
    for (std::uint32_t i = 1; i < 6; i += 2) {
        world.net.on_link_lost({i}, [&, i](NodeId from) {
            CHECK(from == NodeId{i - 1});
            lost[i] = seconds(world.net.now());
        });
    }
    for (std::uint32_t i = 0; i < 6; ++i) {
        world.send(i, i * 1ms);
        world.send(i, 20s);
    }
    world.net.run_for(30s);
    REQUIRE(world.copies->all.size() == 6);  // none of those sent at 20 s
    for (std::uint32_t i = 0; i < 6; ++i) {
        const Copy& copy = world.copies->all[i];
        CHECK(copy.from == NodeId{i});
        CHECK(copy.to == NodeId{i ^ 1});
        CHECK(copy.time == start_of_run + i * 1ms + airtime_64_bytes + 334ns);  // 100 m
    }
    const double leaves = std::sqrt(120.0 * 120 - 100.0 * 100) / 10;  // [s]
    constexpr double reaction = 1e-6, tolerance = 1e-6;               // [s]
    for (std::uint32_t i = 1; i < 6; i += 2) {
        CHECK(std::abs(lost[i] - leaves - reaction) <= tolerance);
    }
    for (std::uint32_t i = 0; i < 6; i += 2) {
        const double home = world.net.position({i + 1}).x - 100;
        CHECK(world.net.position({i}).x == home);
        constexpr double rounding = 1e-9;  // [m]
        CHECK(std::abs(world.net.position({i}).y - 300) <= rounding);
    }
}

TEST_CASE("load: when a robot returns from 1e9 m away, its links are found") {
    Watched world(disc(1000));
    world.add({0, 500});
    const NodeId far = world.net.add(
        {.name = "far", .at = {1e9, 0, 0}, .move = ToGoal{.to = {250, 0, 0}, .speed = {1e7}}});
    for (const int t : {1, 99, 101}) world.send(far.value, std::chrono::seconds{t});
    world.net.run_for(200s);
    CHECK(world.copies->delivered() == 2);
    CHECK(world.net.position(far) == Vec3{250, 0, 0});
    CHECK(world.net.events() < 12);
}

TEST_CASE("load: with range 0 only robots in one place hear each other") {
    for (const ReceptionModel& model : {ReceptionModel{Threshold{}}, ReceptionModel{Collision{}}}) {
        Watched world(disc(0, model));
        world.add({0, 0, 1e-9, 5, 1e9});
        for (std::uint32_t i = 0; i < 5; ++i) world.send(i, i * 1ms);
        world.net.run_for(1s);
        REQUIRE(world.copies->all.size() == 2);
        for (std::uint32_t i = 0; i < 2; ++i) {
            const Copy& copy = world.copies->all[i];
            CHECK(copy.from == NodeId{i});
            CHECK(copy.to == NodeId{1 - i});
            CHECK(copy.time == start_of_run + i * 1ms + airtime_64_bytes);
        }
    }
}

TEST_CASE("load: with range 0, robots that pass through each other lose every link that they get") {
    Network net(disc(0));
    const auto links = std::make_shared<Links>();
    net.add_sink(links);
    net.add({.name = {}, .at = {-5, 0, 0}, .move = ToGoal{.to = {5, 0, 0}}});
    net.add({.name = {}, .at = {5, 0, 0}, .move = ToGoal{.to = {-5, 0, 0}}});
    net.run_for(1h);
    CHECK(links->up == links->down);
    CHECK(links->up <= 2);
    CHECK(net.events() < 20);
}

TEST_CASE(
    "load: with the reception model `threshold`, simultaneous frames arrive in the order of the "
    "send calls") {
    for (const std::uint32_t first : {0U, 1U}) {
        Watched world(disc(15));
        world.add({0, 20, 10, 10});
        for (const std::uint32_t node : {first, 1 - first}) world.send(node, 1ms);
        world.net.run_for(1s);
        const NodeId a{first}, b{1 - first}, c{2}, d{3};
        CHECK(order(*world.copies) ==
              std::vector<std::pair<NodeId, NodeId>>{{a, c}, {a, d}, {b, c}, {b, d}});
        CHECK(world.copies->all.front().time == world.copies->all.back().time);
        CHECK(world.copies->delivered() == 4);
    }
}

TEST_CASE("load: two frames in the same nanosecond with equal levels are both lost") {
    for (const ReceptionModel& model : {ReceptionModel{Collision{}}, ReceptionModel{Sinr{}}}) {
        CAPTURE(model.name());
        Watched hidden(disc(15, model));
        hidden.add({0, 20, 10, 10});
        for (const std::uint32_t node : {0U, 1U}) hidden.send(node, 1ms);
        hidden.net.run_for(1s);
        CHECK(hidden.copies->count(Fate::collided) == 4);
        CHECK(hidden.copies->all.size() == 4);

        Watched near(disc(15, model));
        near.add({0, 10, 5});
        for (const std::uint32_t node : {0U, 1U}) near.send(node, 1ms);
        near.net.run_for(1s);
        CHECK(near.copies->count(Fate::collided) == 2);
        CHECK(near.copies->count(Fate::busy) == 2);
        CHECK(near.copies->all.size() == 4);
    }
}

TEST_CASE(
    "load: a frame stronger by the capture ratio survives another frame of the same nanosecond") {
    for (const std::uint32_t stronger : {0U, 1U}) {
        NetworkSettings settings = disc(0, Collision{});
        settings.propagation = LogDistance{.exponent = 2, .sigma = Db{0}};
        settings.propagation_delay = false;
        Watched world(settings);
        world.add(stronger == 0 ? std::vector{0.0, 51.0, 1.0} : std::vector{51.0, 0.0, 1.0});
        for (const std::uint32_t node : {0U, 1U}) world.send(node, 1ms);
        world.net.run_for(1s);
        // 1 m and 50 m are 34 dB apart.
        CHECK(world.copies->all.size() == 4);
        CHECK(world.copies->delivered() == 1);
        for (const Copy& copy : world.copies->all) {
            if (copy.to != NodeId{2}) continue;
            CHECK(copy.fate == (copy.from == NodeId{stronger} ? Fate::ttl : Fate::collided));
        }
    }
}

TEST_CASE(
    "load: with csma, two frames collide if the second is due at most 18 us after the first") {
    // 802.11b decides a turnaround of 5 us before it sends, by what arrived 13 us before that.
    for (const Duration later : {Duration{0}, Duration{18us}, Duration{18'001}}) {
        CAPTURE(later.count());
        NetworkSettings settings = disc(1, Collision{}, Csma{});
        settings.propagation_delay = false;
        Watched world(settings);
        world.add({0, 0, 0});
        world.send(0, 1ms);
        world.send(1, 1ms + later);
        world.net.run_for(1s);
        CHECK(world.copies->transmissions == 2);
        const bool committed = later <= Duration{18us};
        CHECK(world.copies->delivered() == (committed ? 0 : 4));
        CHECK(world.copies->count(Fate::busy) == (committed ? 2 : 0));
        CHECK(world.copies->count(Fate::collided) == (committed ? 2 : 0));
    }
}

namespace {

/// Robots in one place that forward whatever they hear.
struct Storm {
    Watched world;
    std::string said;

    explicit Storm(std::uint64_t event_limit, const AccessModel& access = NoAccess{})
        : world(settings(event_limit, access), {.ttl = 65535, .duplicates = Duplicates::forward}) {
        world.add_crowd(10);
        world.send(0, 1ms);
    }
    void run() {
        try {
            world.net.run_for(1h);
        } catch (const RunError& error) {
            said = error.what();
        }
    }

  private:
    static NetworkSettings settings(std::uint64_t event_limit, const AccessModel& access) {
        NetworkSettings settings = disc(1, Threshold{}, access);
        settings.event_limit = event_limit;
        settings.metrics = true;
        return settings;
    }
};

}  // namespace

TEST_CASE("load: a message storm ends at the event limit, with an explanation and advice") {
    for (const AccessModel& access : {AccessModel{NoAccess{}}, AccessModel{Csma{}}}) {
        CAPTURE(access.name());
        Storm storm(10'000, access);
        storm.run();
        CHECK(storm.said.starts_with("the event limit of 10000 is reached at 0."));
        CHECK(
            storm.said.ends_with(" s; raise [scenario] event_limit, or lower the load: a shorter "
                                 "duration, fewer messages, a smaller ttl"));
        const std::uint64_t served = storm.world.net.events();
        CHECK(served <= 10'000);
        CHECK_THROWS_AS(storm.world.net.run_for(1h), RunError);  // and not one event more
        CHECK(storm.world.net.events() == served);
    }
}

TEST_CASE("load: exactly as many events are served as the limit allows") {
    Network net({.event_limit = 100});
    const std::function<void()> again = [&] { net.at(net.now() + 1s, again); };
    again();
    CHECK_THROWS_AS(net.run_for(1h), RunError);
    CHECK(net.events() == 100);
}

TEST_CASE("load: receptions before the end of a message storm are recorded and counted") {
    Storm shorter(5'000), longer(10'000);
    shorter.run();
    longer.run();
    const std::vector<Copy>& before = shorter.world.copies->all;
    const std::vector<Copy>& all = longer.world.copies->all;
    CHECK(before.size() > 4'000);  // most events are timers, one for each copy
    REQUIRE(all.size() > before.size());
    CHECK(std::equal(before.begin(), before.end(), all.begin()));
    const MetricValues metrics = shorter.world.net.metrics();
    CHECK(metrics.receptions == before.size());
    CHECK(metrics.transmissions == shorter.world.copies->transmissions);
    CHECK(metrics.deliveries == 9);
}

TEST_CASE("load: robots that move all the time without traffic do not take more and more memory") {
    Watched watched(disc(10, Collision{}));
    watched.add({0, 1});
    watched.send(0, 1ms);
    watched.net.run_until(start_of_run + 10ms);
    const std::size_t before = allocated();
    for (int i = 0; i < 100'000; ++i) {
        watched.net.place(NodeId{1}, {static_cast<double>(i % 7), 0, 0});
        watched.net.run_for(1ms);
    }
    CHECK(allocated() < before + 100'000);
}

}  // namespace load_test
