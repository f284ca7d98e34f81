// SPDX-License-Identifier: MIT
// Doors that close and open during a run, against runs in scenes that never change: one with the
// door as a wall from the begin, one without it.
#include "scene/doors.hpp"

#include "mobility/straight.hpp"
#include "models/medium/medium.hpp"
#include "models/propagation/list.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace doors_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// Two rooms, and a gap of 2 m between them at x = 6, y = 3 ... 5.
OccupancyGrid rooms() {
    return test::drawn_map({"#############",  //
                            "#     #     #",  //
                            "#     #     #",  //
                            "#           #",  //
                            "#           #",  //
                            "#     #     #",  //
                            "#     #     #",  //
                            "#############"});
}

constexpr Duration closes = 2s, opens = 4s;

/// Door in the gap.
Door door() {
    return {.from = {6.5, 3, 0},
            .to = {6.5, 5, 0},
            .thickness = 0.25_m,
            .material = {.name = "steel", .per_crossing = 17_dB},
            .closes = {closes},
            .opens = {opens}};
}

/// Scene with the closed door as a wall, by a map of its own that is made by hand.
Scene with_wall() {
    OccupancyGrid wall{.columns = 1,
                       .rows = 1,
                       .cell_width = 0.25,
                       .cell_height = 2,
                       .origin = {6.375, 3, 0},
                       .cells = {Cell::occupied},
                       .material = 1};
    return Scene({rooms(), wall}, {Material{}, {.name = "steel", .per_crossing = 17_dB}});
}

enum class Kind { changes, open, closed };

NetworkSettings settings(Kind kind) {
    NetworkSettings settings;
    const auto open = std::make_shared<const Scene>(rooms());
    settings.scene = kind == Kind::closed ? std::make_shared<const Scene>(with_wall()) : open;
    if (kind == Kind::changes) settings.scene_changes = scene_changes(open, std::vector{door()});
    return settings;
}

/// Receptions by sending: who got it, when, how and at what level [dBm].
struct Log {
    using Got = std::tuple<NodeId, Time, Fate, double>;
    using Sending = std::pair<Time, NodeId>;
    std::map<Sending, std::vector<Got>> sendings = {};

    KindMask kinds() const { return kind_of<Sent>() | kind_of<Received>() | kind_levels; }
    void on(const Record& record, const RecordContext& context) {
        if (const auto* sent = std::get_if<Sent>(&record)) {
            const Message& message = context.messages[sent->message];
            sendings[{message.created, message.origin}];
            return;
        }
        const auto& received = std::get<Received>(record);
        const Message& message = context.messages[received.frame.message];
        for (std::size_t i = 0; i < received.receptions.size(); ++i) {
            const Reception& r = received.receptions[i];
            sendings[{message.created, message.origin}].emplace_back(r.node, r.time, r.fate,
                                                                     received.levels[i].value);
        }
    }
};

/// Changes of links, in their order.
struct Links {
    std::vector<std::tuple<Time, NodeId, NodeId, bool>> changes = {};

    KindMask kinds() const { return kind_of<LinkUp>() | kind_of<LinkDown>(); }
    void on(const Record& record, const RecordContext&) {
        if (const auto* up = std::get_if<LinkUp>(&record))
            changes.emplace_back(up->time, up->from, up->to, true);
        if (const auto* down = std::get_if<LinkDown>(&record))
            changes.emplace_back(down->time, down->from, down->to, false);
    }
};

/// Robots at rest in both rooms, and one that moves along the wall.
void populate(Network& network, const Radio& radio) {
    const std::vector<Vec3> places = {{2, 2, 0}, {3, 4, 0}, {5, 6, 0}, {8, 4, 0}, {10, 2, 0}};
    for (const Vec3 at : places)
        network.add({.name = {}, .at = at, .radius = 0.1_m, .radio = radio});
    network.add({.name = {},
                 .at = {8.5, 2, 0},
                 .radius = 0.1_m,
                 .radio = radio,
                 .move = Straight{.to = {8.5, 6, 0}, .speed = {0.5}}});
}

/// Times at which all send: many, and those around both changes.
std::vector<Time> times() {
    std::vector<Time> times;
    for (Duration t = 100ms; t < 6s; t += 331ms) times.push_back(start_of_run + t);
    for (const Duration t : {closes, opens}) {
        for (const Duration off : {-1ns, 0ns, 1ns}) times.push_back(start_of_run + t + off);
    }
    return times;
}

Log run(NetworkSettings settings, Radio radio = {.sensitivity = {-47}}) {
    settings.propagation_delay = true;
    Network network(std::move(settings));
    populate(network, radio);
    const auto log = std::make_shared<Log>();
    network.add_sink(Sink{log});
    for (const Time t : times()) {
        for (std::uint32_t i = 0; i < network.size(); ++i) {
            network.at(t, [&network, i] {
                network.send(NodeId{i}, everyone, "hello", {.one_hop = true});
            });
        }
    }
    network.run_until(start_of_run + 6s);
    network.finish();
    return *log;
}

bool is_closed(Time t) { return t >= start_of_run + closes && t < start_of_run + opens; }

/// Runs with the door, with it as a wall, and without, differ nowhere from the one that holds.
/// @return frames whose receptions the door changes
int compare(const std::function<void(NetworkSettings&)>& choose) {
    const auto log_of = [&](Kind kind) {
        NetworkSettings of = settings(kind);
        choose(of);
        return run(std::move(of));
    };
    const Log changes = log_of(Kind::changes), open = log_of(Kind::open),
              closed = log_of(Kind::closed);
    REQUIRE(changes.sendings.size() == open.sendings.size());
    int differ = 0;
    for (const auto& [sending, got] : changes.sendings) {
        const auto& without = open.sendings.at(sending);
        const auto& with = closed.sendings.at(sending);
        CHECK(got == (is_closed(sending.first) ? with : without));
        differ += with != without;
    }
    return differ;
}

}  // namespace

TEST_CASE("doors: receptions and levels change at the nanosecond at which a door closes or opens") {
    const auto with = [](const Propagation& model) {
        return compare([&](NetworkSettings& settings) { settings.propagation = model; });
    };
    CHECK(with(MultiWall{}) > 20);
    CHECK(with(Raytrace2007{}) > 20);
    CHECK(with(Rays{}) > 20);
    CHECK(with(Rays{.order = 1, .diffraction = RayDiffraction::utd}) > 20);
    CHECK(with(ItuSiteGeneral{}) > 20);
}

TEST_CASE("doors: a closed door has no effect on models that ignore walls") {
    const auto with = [](const Propagation& model) {
        return compare([&](NetworkSettings& settings) { settings.propagation = model; });
    };
    CHECK(with(LogDistance{}) == 0);
    CHECK(with(LogDistance{.sigma = 0_dB}) == 0);
    CHECK(with(Friis{}) == 0);
}

TEST_CASE(
    "doors: also with shadowing, with fading and in reference mode, only a closed door acts as a "
    "wall") {
    CHECK(compare([](NetworkSettings& settings) {
              settings.propagation = MultiWall{};
              settings.shadowing = {.model = ShadowingModel::link};
          }) > 20);
    CHECK(compare([](NetworkSettings& settings) {
              settings.propagation = MultiWall{};
              settings.fading = {.model = FadingModel::rayleigh};
          }) > 20);
    CHECK(compare([](NetworkSettings& settings) {
              settings.propagation = Rays{};
              settings.reference = true;
          }) > 20);
}

TEST_CASE(
    "doors: the fast and the reference mode agree on frames during which a door opens or closes") {
    for (const ReceptionModel& reception : {ReceptionModel(Collision{.capture_ratio = 3_dB}),
                                            ReceptionModel(Sinr{.interference_cut = 20_dB})}) {
        const auto log_of = [&](bool reference) {
            NetworkSettings of = settings(Kind::changes);
            of.propagation = MultiWall{};
            of.reception = reception;
            of.reference = reference;
            return run(std::move(of));
        };
        CHECK(log_of(false).sendings == log_of(true).sendings);
    }
}

TEST_CASE(
    "doors: a frame that is on air when a door closes interferes as if the door were still open") {
    // Robot 3 receives the first frame, through the open door; the second, of which only what the
    // closed door lets through arrives, begins 1 ns after the door closed.
    const auto fates = [](Kind kind, Duration first, Duration second) {
        NetworkSettings of = settings(kind);
        of.propagation = MultiWall{};
        of.reception = Collision{.capture_ratio = 10_dB};
        Network network(std::move(of));
        network.add({.name = {}, .at = {10, 4.2, 0}});
        network.add({.name = {}, .at = {8, 4, 0}});
        network.add({.name = {}, .at = {5, 4, 0}});
        const auto log = std::make_shared<Log>();
        network.add_sink(Sink{log});
        network.at(start_of_run + first,
                   [&] { network.send(NodeId{0}, everyone, "one", {.one_hop = true}); });
        network.at(start_of_run + second,
                   [&] { network.send(NodeId{2}, everyone, "two", {.one_hop = true}); });
        network.run_until(start_of_run + 3s);
        for (const auto& [sending, got] : log->sendings) {
            if (sending.second != NodeId{0}) continue;
            for (const auto& [node, time, fate, level] : got)
                if (node == NodeId{1}) return fate;
        }
        return Fate::waiting;
    };
    // Both at 2 m or so: they collide unless 17 dB of door are between.
    CHECK(fates(Kind::open, closes - 2us, closes - 1us) == Fate::collided);
    CHECK(fates(Kind::closed, closes - 2us, closes - 1us) != Fate::collided);
    CHECK(fates(Kind::changes, closes - 2us, closes - 1us) == Fate::collided);
    CHECK(fates(Kind::changes, closes - 2us, closes) != Fate::collided);
    CHECK(fates(Kind::changes, closes - 1us, closes - 1ns) == Fate::collided);
}

TEST_CASE(
    "doors: a frame that was sent before a door closed still interferes behind the closed door") {
    const auto fate_of = [](Kind kind, bool reference) {
        NetworkSettings of = settings(kind);
        of.propagation = MultiWall{};
        of.reception = Sinr{.interference_cut = 20_dB};
        of.reference = reference;
        Network network(std::move(of));
        for (const Vec3 at : {Vec3{10, 4.2, 0}, Vec3{8, 4, 0}, Vec3{5, 4, 0}})
            network.add({.name = {}, .at = at});
        const auto log = std::make_shared<Log>();
        network.add_sink(Sink{log});
        const auto send = [&](Duration t, std::uint32_t from) {
            network.at(start_of_run + t,
                       [&, from] { network.send({from}, everyone, "hello", {.one_hop = true}); });
        };
        send(closes - 2us, 0);
        send(closes - 1us, 2);
        send(closes + 1us, 2);
        network.run_until(start_of_run + 3s);
        for (const auto& [node, time, fate, level] :
             log->sendings.at({start_of_run + closes - 2us, NodeId{0}}))
            if (node == NodeId{1}) return fate;
        return Fate::waiting;
    };
    CHECK(fate_of(Kind::open, false) != fate_of(Kind::closed, false));
    CHECK(fate_of(Kind::changes, false) == fate_of(Kind::open, false));
    CHECK(fate_of(Kind::changes, true) == fate_of(Kind::open, false));
}

TEST_CASE("doors: links change at the nanosecond at which a door closes or opens") {
    for (const Propagation& model : {Propagation(MultiWall{}), Propagation(Rays{})}) {
        NetworkSettings of = settings(Kind::changes);
        of.propagation = model;
        Network network(std::move(of));
        for (const Vec3 at : {Vec3{2, 4, 0}, Vec3{5, 4, 0}, Vec3{8, 4, 0}, Vec3{11, 4, 0}})
            network.add({.name = {}, .at = at, .radio = {.sensitivity = {-45}}});
        const auto links = std::make_shared<Links>();
        network.add_sink(Sink{links});
        network.run_until(start_of_run + 6s);
        std::map<Time, int> changes;
        for (const auto& [time, from, to, up] : links->changes) {
            ++changes[time];
            if (time == start_of_run) continue;
            CHECK(up == (time == start_of_run + opens));
            CHECK((from.index() < 2) != (to.index() < 2));
        }
        REQUIRE(changes.size() == 3);
        CHECK(changes.at(start_of_run + closes) > 0);
        CHECK(changes.at(start_of_run + closes) == changes.at(start_of_run + opens));
        CHECK(network.medium().links().level(NodeId{1}, NodeId{2}, start_of_run + closes,
                                             network.legs()) <
              network.medium().links().level(NodeId{1}, NodeId{2}, start_of_run + closes - 1ns,
                                             network.legs()));
    }
}

TEST_CASE("doors: at each time, a moving robot has the links that the states of the doors allow") {
    // The door fills the gap, or a part of it: then its ends are where links change.
    for (const auto& [bottom, top] : {std::pair{3.0, 5.0}, {3.0, 4.0}, {3.75, 3.9}}) {
        Door half = door();
        half.from.y = bottom;
        half.to.y = top;
        const auto open = std::make_shared<const Scene>(rooms());
        NetworkSettings of{.scene = open, .scene_changes = scene_changes(open, std::vector{half})};
        of.propagation = MultiWall{};
        Network network(std::move(of));
        const Radio radio{.sensitivity = {-48}};
        network.add({.name = {}, .at = {5, 3.6, 0}, .radio = radio});
        network.add({.name = {},
                     .at = {8, 1.5, 0},
                     .radio = radio,
                     .move = Straight{.to = {8, 6, 0}, .speed = {1}}});
        const auto links = std::make_shared<Links>();
        network.add_sink(Sink{links});
        bool up = false;
        std::size_t told = 0;
        for (Time t = start_of_run; t <= start_of_run + 5s; t += 10ms) {
            network.run_until(t);
            for (; told < links->changes.size(); ++told)
                if (std::get<1>(links->changes[told]) == NodeId{0})
                    up = std::get<3>(links->changes[told]);
            CHECK(up == network.medium().links().is_up(NodeId{0}, NodeId{1}, t, network.legs()));
        }
        CHECK(told >= 4);
    }
}

TEST_CASE(
    "doors: a door may be closed at the start, and opening it changes the number of reachable "
    "robots") {
    Door early = door();
    early.closes = {0s};
    early.opens = {1s};
    const auto open = std::make_shared<const Scene>(rooms());
    NetworkSettings of;
    of.scene = open;
    of.scene_changes = scene_changes(open, std::vector{early});
    of.propagation = MultiWall{};
    Network network(std::move(of));
    const Radio radio{.sensitivity = {-45}};
    network.add({.name = {}, .at = {5, 4, 0}, .radio = radio});
    network.add({.name = {}, .at = {8, 4, 0}, .radio = radio});
    CHECK(network.scene().occupied({6.5, 4, 0}));
    struct Reach {
        std::vector<std::uint32_t> reachable = {};
        KindMask kinds() const { return kind_of<Sent>() | kind_reachable; }
        void on(const Record& record, const RecordContext&) {
            reachable.push_back(*std::get<Sent>(record).reachable);
        }
    };
    const auto reach = std::make_shared<Reach>();
    network.add_sink(Sink{reach});
    for (const Duration t : {0s, 1s})
        network.at(start_of_run + t,
                   [&] { network.send(NodeId{0}, everyone, "hello", {.one_hop = true}); });
    network.run_until(start_of_run + 2s);
    CHECK(reach->reachable == std::vector<std::uint32_t>{0, 1});
    CHECK_FALSE(network.scene().occupied({6.5, 4, 0}));
    CHECK(&network.scene() == open.get());
}

}  // namespace doors_test
