// SPDX-License-Identifier: MIT
// What meets what on air, against a search over all pairs of frames that knows nothing of how the
// network keeps them.
#include "mobility/waypoints.hpp"
#include "models/link_gain.hpp"
#include "models/medium/medium.hpp"
#include "models/propagation/list.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"
#include "routing/flood.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace air_test {
using namespace rovernet;

namespace {

using namespace std::chrono_literals;

/// A loss that tells nothing of its shape, nor of its reach.
struct Slope {
    static constexpr std::string_view name = "slope";
    void loss(const LinkBatch& links, Db, std::span<double> out_db) const {
        for (std::size_t i = 0; i < out_db.size(); ++i) out_db[i] = 40 + links.distance(i) / 5;
    }
};

/// A robot as it was when a frame began.
struct Robot {
    Vec3 antenna;
    bool on;
};

struct Sending {
    NodeId from;
    Time begin, end;
    std::vector<Robot> robots;
};

/// Everything that was sent, and everything that came of it.
struct Log {
    const Network* net = nullptr;
    std::vector<Sending> sendings{};
    std::vector<std::pair<std::size_t, Reception>> receptions{};
    std::map<std::pair<NodeId, std::uint64_t>, std::size_t> by_frame{};  // sender, path: sending

    KindMask kinds() const { return kind_of<Transmitted>() | kind_of<Received>(); }
    void on(const Record& record, const RecordContext& context) {
        if (const auto* sent = std::get_if<Transmitted>(&record)) {
            const Frame& frame = sent->frame;
            const Radio& radio = net->medium().stations().radio(frame.sender);
            const Message& message = context.messages[frame.message];
            Sending sending{
                frame.sender,
                sent->time,
                sent->time + Wifi{}.transmission(radio, radio.rate, message.size).airtime(),
                {}};
            for (std::uint32_t i = 0; i < context.legs.size(); ++i) {
                sending.robots.push_back(
                    {net->medium().stations().antenna(NodeId{i}, sent->time, context.legs),
                     net->medium().stations().is_on(NodeId{i})});
            }
            by_frame[{frame.sender, combine(message.uid, frame.path)}] = sendings.size();
            sendings.push_back(sending);
            return;
        }
        const auto& received = std::get<Received>(record);
        const Frame& frame = received.frame;
        const auto uid = context.messages[frame.message].uid;
        const std::size_t sending = by_frame.at({frame.sender, combine(uid, frame.path)});
        for (const Reception& r : received.receptions) receptions.emplace_back(sending, r);
    }
};

struct Heard {
    Time begin, end;
    double level_dbm;
};

/// Robots that run about, jump, come later, and are switched off and on while frames fly.
struct Playground {
    std::uint32_t seed;
    test::Draw draw;
    Propagation propagation;
    Collision reception;
    Network net;
    std::vector<Radio> radios{};
    std::shared_ptr<Log> log = std::make_shared<Log>();
    std::vector<std::vector<std::optional<Heard>>> arrivals{};  // by sending and node
    std::vector<std::vector<bool>> locks{};                     // by node and sending

    Playground(std::uint32_t number, Propagation model, Collision collision, bool reference)
        : seed(number),
          draw(number),
          propagation(model),
          reception(collision),
          net({.seed = number,
               .propagation = model,
               .reception = collision,
               .reference = reference,
               .metrics = false}) {
        log->net = &net;
        net.add_sink(Sink{log});
        net.route(Flood{.ttl = 3, .jitter = 3ms});
    }

    Vec3 place() { return {draw.uniform(0, 400), draw.uniform(0, 400), 0}; }
    NodeId anyone() {
        return {static_cast<std::uint32_t>(draw.below(static_cast<int>(radios.size())))};
    }
    void add() {
        const double height = draw.below(2) ? 1 : 2;
        // Of few kinds, so that tables decide with shadowing.
        const Radio radio{.power = {draw.below(2) ? 0.0 : 6.0},
                          .sensitivity = {-75},
                          .carrier_sense_threshold = {{draw.below(2) ? -85.0 : -78.0}},
                          .rate = {draw.below(2) ? 2e6 : 11e6},
                          .antenna_height = {height}};
        radios.push_back(radio);
        net.add({.name = {},
                 .at = place(),
                 .radio = radio,
                 .move = Waypoints{.path = {place(), place()}, .speed = {draw.uniform(1, 3000)}}});
    }
    void change() {
        const NodeId node = anyone();
        switch (draw.below(5)) {
            case 0: return net.place(node, place());
            case 1: return net.switch_off(node);
            case 2: return net.switch_on(node);
            case 3: return add();
            default:
                return net.move(node,
                                Waypoints{.path = {place()}, .speed = {draw.uniform(1, 900)}});
        }
    }
    void play() {
        for (int i = 0; i < 25; ++i) add();
        for (int i = 0; i < 150; ++i) {
            const Time t = start_of_run + Duration{draw.below(40'000'000)};
            net.at(t, [this] {
                net.send(anyone(), everyone, "x",
                         {.size = 50 + 50 * static_cast<std::uint32_t>(draw.below(8))});
            });
            for (int k = 0; k < 2; ++k) {
                net.at(t + Duration{draw.below(1'000'000)}, [this] { change(); });
            }
        }
        net.run_for(100ms);
        for (const Sending& sending : log->sendings) {
            auto& at_each = arrivals.emplace_back();
            for (std::uint32_t i = 0; i < radios.size(); ++i)
                at_each.push_back(arrival(sending, NodeId{i}));
        }
    }

    /// A sending as it arrives at `node`, if it is strong enough to interfere there.
    std::optional<Heard> heard(const Sending& sending, NodeId node) const {
        return arrivals[static_cast<std::size_t>(&sending - log->sendings.data())][node.index()];
    }
    std::optional<Heard> arrival(const Sending& sending, NodeId node) const {
        if (node.index() >= sending.robots.size() || !sending.robots[node.index()].on) return {};
        const Vec3 from = sending.robots[sending.from.index()].antenna;
        const Vec3 to = sending.robots[node.index()].antenna;
        const Radio& sender = radios[sending.from.index()];
        const std::uint64_t from_key = key(sending.from), to_key = key(node);
        const Scene scene;
        const LinkBatch link{.frequency = sender.frequency,
                             .from = from,
                             .to = {&to, 1},
                             .from_key = from_key,
                             .to_keys = {&to_key, 1},
                             .scene = &scene,
                             .seed = seed};
        double loss = 0;
        propagation.loss(link, Db{std::numeric_limits<double>::infinity()}, {&loss, 1});
        if (Db{loss} > sensing_budget(sender, radios[node.index()])) return {};
        const Duration delay = from_seconds(distance(from, to) / speed_of_light);
        return Heard{sending.begin + delay, sending.end + delay,
                     received_power(sender, radios[node.index()], Db{loss}).value};
    }
    std::uint64_t key(NodeId node) const { return name_key(net.name(node)); }

    /// Sendings onto which the receiver of `node` locks, as in ns-2: it is free when they begin. A
    /// frame that begins while it is not free is ignored if it is weaker by the capture ratio than
    /// the current one; otherwise both collide, and the one that ends last is the current one.
    std::vector<bool> locks_at(NodeId node) const {
        std::vector<std::pair<std::size_t, Heard>> all;
        for (std::size_t i = 0; i < log->sendings.size(); ++i) {
            if (log->sendings[i].from == node) continue;
            if (const auto h = heard(log->sendings[i], node)) all.emplace_back(i, *h);
        }
        std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
            return std::pair(a.second.begin, -a.second.level_dbm) <
                   std::pair(b.second.begin, -b.second.level_dbm);
        });
        std::vector<bool> locked(log->sendings.size());
        std::optional<Heard> current;
        for (const auto& [sending, h] : all) {
            locked[sending] = !current || current->end <= h.begin;
            const bool is_ignored = !locked[sending] && is_stronger(*current, h);
            if (locked[sending] || (!is_ignored && h.end > current->end)) current = h;
        }
        return locked;
    }
    bool is_stronger(const Heard& a, const Heard& b) const {
        return a.level_dbm >= b.level_dbm + reception.capture_ratio.value;
    }

    /// What becomes of a sending at a node that can receive it.
    Fate expected(const Sending& f, NodeId node) {
        const bool first = reception.capture == CaptureOrder::first;
        if (first && locks.empty()) {
            for (std::uint32_t i = 0; i < radios.size(); ++i) locks.push_back(locks_at(NodeId{i}));
        }
        const auto number = static_cast<std::size_t>(&f - log->sendings.data());
        if (first && !locks[node.index()][number]) return Fate::collided;
        const Heard mine = *heard(f, node);
        Fate fate = Fate::waiting;
        for (const Sending& g : log->sendings) {
            if (&g == &f) continue;
            const bool own = g.from == node;
            const auto other = own ? Heard{g.begin, g.end, 1e300} : heard(g, node);
            if (!other || mine.begin >= other->end || other->begin >= mine.end) continue;
            if (own) fate = Fate::busy;
            // The receiver ignored what was on air when it locked onto this one.
            const bool matters = !first || other->begin >= mine.begin;
            if (!own && matters && !is_stronger(mine, *other)) return Fate::collided;
        }
        return fate;
    }
};

}  // namespace

namespace {

/// Plays with a model and compares every reception; what became of them.
std::map<Fate, int> play(const Propagation& model, std::uint32_t seeds) {
    std::map<Fate, int> fates;
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
        CAPTURE(std::string(model.name()));
        CAPTURE(seed);
        const auto capture = seed % 2 ? CaptureOrder::first : CaptureOrder::later;
        const bool reference = seed % 4 == 0;
        Playground ground(seed, model, {.capture_ratio = Db{6}, .capture = capture}, reference);
        ground.play();
        for (const auto& [sending, reception] : ground.log->receptions) {
            if (reception.fate == Fate::off) continue;
            const Fate expected = ground.expected(ground.log->sendings[sending], reception.node);
            const Fate fate = is_decoded(reception.fate) ? Fate::waiting : reception.fate;
            REQUIRE(fate == expected);
            ++fates[fate];
        }
    }
    return fates;
}

template <class Model>
Propagation listed() {
    return Model{};
}
template <>
Propagation listed<Disc>() {
    return Disc{.range = {90}};
}

}  // namespace

TEST_CASE(
    "air: interference agrees with a check of all pairs as robots move, jump or are switched off") {
    for (const Propagation& model :
         {Propagation{LogDistance{.exponent = 2, .sigma = Db{0}}},
          Propagation{LogDistance{.exponent = 2, .sigma = Db{4}}}, Propagation{Slope{}}}) {
        auto fates = play(model, 8);
        CHECK(fates[Fate::waiting] > 1000);
        CHECK(fates[Fate::collided] > 1000);
        CHECK(fates[Fate::busy] > 3);
    }
}

TEST_CASE("air: with every propagation model, interference agrees with a check of all pairs") {
    for_each_model([]<class Model>() {
        auto fates = play(listed<Model>(), 6);
        CHECK(fates[Fate::waiting] > 20);
        CHECK(fates[Fate::collided] > 20);
    });
}

namespace {

/// The fates of what `node` gets, in the order of their arrival.
std::vector<Fate> fates_at(const Log& log, NodeId node) {
    std::vector<Fate> fates;
    for (const auto& [sending, r] : log.receptions) {
        if (r.node == node) fates.push_back(is_decoded(r.fate) ? Fate::waiting : r.fate);
    }
    return fates;
}

/// Robots in free space that send 100 bytes at 1 Mb/s (992 us) when they are told.
struct OpenField {
    Network net;
    std::shared_ptr<Log> log = std::make_shared<Log>();

    explicit OpenField(ReceptionModel model = Collision{})
        : net({.propagation = Friis{}, .reception = model, .metrics = false}) {
        log->net = &net;
        net.add_sink(Sink{log});
        net.route(Flood{.ttl = 1});
    }
    NodeId add(double x, Radio radio = {.power = {0}}) {
        radio.sensitivity = Dbm{-75};
        radio.rate = BitRate{1e6};
        return net.add({.name = {}, .at = {x, 0}, .radio = radio});
    }
    void send(NodeId node, Duration t, std::uint32_t bytes = 100) {
        net.at(start_of_run + t,
               [this, node, bytes] { net.send(node, everyone, "x", {.size = bytes}); });
    }
};

}  // namespace

TEST_CASE(
    "air: if a robot jumps, frames already on air reach it as if it were at its old position") {
    for (const bool jumps : {false, true}) {
        OpenField space;
        const NodeId there = space.add(0), here = space.add(1e6), robot = space.add(1);
        if (!jumps) space.net.place(robot, {1e6 + 1, 0});
        space.send(there, 1ms);
        space.net.at(start_of_run + 1100us, [&space, robot] {
            space.net.place(robot, {1e6 + 1, 0});
        });
        space.send(here, 1200us);
        space.net.run_for(10ms);
        const auto both = std::vector{Fate::collided, Fate::collided};
        CHECK(fates_at(*space.log, robot) == (jumps ? both : std::vector{Fate::waiting}));
    }
}

TEST_CASE(
    "air: a frame from far away interferes when it arrives, even if its sender has already "
    "finished") {
    for (const bool later : {false, true}) {
        OpenField space;
        const NodeId robot = space.add(0), near = space.add(30);
        const NodeId far = space.add(29'979.2458, {.power = {80}});  // 100 us away
        space.send(far, 1ms);
        // The far frame ends at 1992 us, and 100 us later at the robot.
        space.send(near, later ? 2095us : 2085us);
        space.net.run_for(10ms);
        const auto fates = fates_at(*space.log, robot);
        REQUIRE(fates.size() == 2);
        CHECK(fates[1] == (later ? Fate::waiting : Fate::collided));
    }
}

TEST_CASE(
    "air: with the reception model `collision`, an ignored frame does not affect later frames, as "
    "in ns-2") {
    // ns-2.35: a strong frame, a weak one under it that lasts longer, and one while that is on air.
    for (const bool strong : {true, false}) {
        Network net({.propagation = LogDistance{.exponent = 4, .sigma = Db{0}},
                     .reception = Collision{},
                     .metrics = false});
        const auto log = std::make_shared<Log>();
        log->net = &net;
        net.add_sink(Sink{log});
        const Radio radio{.power = {20}, .sensitivity = {-120}, .rate = {1e6}, .preamble = 0ns};
        for (const Vec3 at : {Vec3{}, Vec3{50, 0}, Vec3{-240, 0}, Vec3{0, 150}}) {
            net.add({.name = {}, .at = at, .radio = radio});
        }
        const auto send = [&](Time t, std::uint32_t from, std::uint32_t bytes) {
            net.at(t, [&net, from, bytes] { net.send({from}, {0}, "", {.size = bytes}); });
        };
        if (strong) send(start_of_run, 1, 1000);
        send(start_of_run + 6ms, 2, 1000);
        send(start_of_run + 10ms, 3, 100);
        net.run_for(1s);
        const auto fates = fates_at(*log, {0});
        if (strong) {
            CHECK(fates == std::vector{Fate::waiting, Fate::waiting, Fate::collided});
        } else {
            CHECK(fates == std::vector{Fate::collided, Fate::collided});
        }
    }
}

TEST_CASE(
    "air: frames of another essid do not interfere, unless their sender's key `gate` is `none`") {
    for (const Gate gate : {Gate::network, Gate::none}) {
        OpenField space;
        const Radio ours{.power = {0}, .essid = "ours"};
        const NodeId robot = space.add(0, ours), near = space.add(30, ours);
        const NodeId other = space.add(10, {.power = {0}, .essid = "theirs", .gate = gate});
        space.send(near, 1ms);
        space.send(other, 1100us);
        space.net.run_for(10ms);
        const auto fates = fates_at(*space.log, robot);
        REQUIRE(fates.size() == (gate == Gate::network ? 1 : 2));
        CHECK(fates[0] == (gate == Gate::network ? Fate::waiting : Fate::collided));
    }
}

TEST_CASE(
    "air: with the reception model `sinr`, a receiver locked onto a frame misses a stronger one") {
    for (const bool decodable : {false, true}) {
        OpenField space{Sinr{}};
        const NodeId robot = space.add(0), strong = space.add(1);
        const NodeId weak = space.add(decodable ? 40 : 100);
        space.send(weak, 1ms);
        space.send(strong, 1100us);
        space.net.run_for(10ms);
        const auto fates = fates_at(*space.log, robot);
        CHECK(fates == (decodable ? std::vector{Fate::collided, Fate::collided}
                                  : std::vector{Fate::waiting}));
    }
}

TEST_CASE(
    "air: with the reception model `sinr`, a frame that was missed does not lock the receiver") {
    OpenField space{Sinr{}};
    const NodeId robot = space.add(0), strong = space.add(1);
    const NodeId first = space.add(20), second = space.add(-40);
    space.send(first, 1ms);           // until 1992 us
    space.send(second, 1900us, 200);  // missed for the first, until 3692 us
    space.send(strong, 2ms, 10);      // until 2272 us
    space.net.run_for(10ms);
    CHECK(fates_at(*space.log, robot) == std::vector{Fate::waiting, Fate::waiting, Fate::collided});
}

TEST_CASE(
    "air: with the reception model `sinr`, bit errors are drawn anew for each frame of a sender") {
    OpenField space{Sinr{}};
    const Radio radio{.power = {0}, .sensitivity = Dbm{-95}, .rate = BitRate{11e6}};
    const NodeId sender = space.net.add({.name = {}, .at = {0, 0}, .radio = radio});
    // 6 dB above the noise, where bit errors spoil about half of the frames.
    const NodeId robot = space.net.add({.name = {}, .at = {235, 0}, .radio = radio});
    for (int frame = 1; frame <= 100; ++frame) space.send(sender, frame * 5ms, 1000);
    space.net.run_for(1s);
    const auto fates = fates_at(*space.log, robot);
    REQUIRE(fates.size() == 100);
    const auto decoded = std::count(fates.begin(), fates.end(), Fate::waiting);
    CHECK(decoded > 20);
    CHECK(decoded < 80);
}

}  // namespace air_test
