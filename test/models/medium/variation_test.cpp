// SPDX-License-Identifier: MIT
// Shadowing, fading and directional antennas, as the medium decides with them.
#include "models/links/link_changes.hpp"
#include "models/medium/medium.hpp"
#include "models/medium/reachability.hpp"
#include "models/medium/shadowed.hpp"
#include "models/propagation/list.hpp"
#include "test/models/links/moving_pair.hpp"
#include "test/models/vectors.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

namespace variation_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr NodeId a{0}, b{1};
const Scene open_field;

const Shadowing link_shadowing{.model = ShadowingModel::link, .sigma = Db{6}};
const Shadowing field_shadowing{
    .model = ShadowingModel::field, .sigma = Db{6}, .decorrelation_distance = 5_m};

/// What varies in a medium, by name.
struct Variation {
    const char* name;
    Shadowing shadowing = {};
    Fading fading = {};
    bool directional = false;
};
const std::vector<Variation>& variations() {
    static const std::vector<Variation> all = {
        {"link", link_shadowing},
        {"field", field_shadowing},
        {"frame", {}, {.model = FadingModel::rayleigh}},
        {"place", {}, {.model = FadingModel::rician, .coherence = Coherence::place}},
        {"nakagami", field_shadowing, {.model = FadingModel::nakagami, .m = 0.75}},
        {"antennas", {}, {}, true},
        {"all", field_shadowing, {.model = FadingModel::rayleigh}, true}};
    return all;
}

Radio radio_of(test::Draw& draw, bool directional) {
    const Dbm sensitivity{draw.uniform(-70, -50)};
    Radio radio{.power = {draw.uniform(5, 15)},
                .sensitivity = sensitivity,
                .carrier_sense_threshold = sensitivity - 6_dB,
                .antenna_height = {draw.uniform(0, 2)}};
    if (!directional) return radio;
    if (draw.below(3) > 0) {
        radio.antenna = AntennaShape::cosine;
        radio.antenna_direction = Radians{draw.uniform(-4, 4)};
    } else {
        radio.antenna = AntennaShape::table;
        radio.antenna_pattern = {{-90, -12}, {0, 0}, {90, -9}};
    }
    return radio;
}

/// Two media with the same robots: one looks at every pair and keeps nothing. Some robots rest,
/// some drive, some turn in place.
struct Twins {
    test::Draw draw;
    Scene scene{test::random_map(draw, 40, 40, 10)};
    Medium fast, plain;
    Legs legs{};
    std::vector<Radio> radios{};

    Twins(const Variation& v, std::uint32_t seed)
        : draw(seed), fast(settings(v, false)), plain(settings(v, true)) {}
    Medium::Settings settings(const Variation& v, bool all_pairs) const {
        return {.scene = &scene,
                .keep_losses = !all_pairs,
                .all_pairs = all_pairs,
                .interference_cut = Db{10},
                .shadowing = v.shadowing,
                .fading = v.fading,
                .seed = 11,
                .replication = 2};
    }
    void add(const Propagation& model, const Radio& radio) {
        const auto place = [&] { return Vec3{draw.uniform(-5, 45), draw.uniform(-5, 45), 0}; };
        const Vec3 from = place(), to = place();
        const int kind = draw.below(3);
        Leg leg{.from = from, .to = from, .heading = draw.uniform(-3, 3)};
        if (kind == 1)
            leg = {.end = start_of_run + 10s,
                   .from = from,
                   .velocity = 0.1 * (to - from),
                   .to = to,
                   .heading = leg.heading};
        if (kind == 2) {
            leg.end = start_of_run + 10s;
            leg.turning = 0.4;
        }
        legs.add(leg);
        radios.push_back(radio);
        for (Medium* each : {&fast, &plain}) each->add(radio, radios.size(), model);
    }
};

constexpr std::uint32_t robots = 30;

std::vector<NodeId> receivers(Medium& medium, NodeId from, Time t, const Legs& legs) {
    Medium::Receivers found;
    medium.find_receivers(from, Coding{}, t, t + 1ms, legs, found);
    std::vector<NodeId> nodes;
    for (const Reception& r : found.all()) nodes.push_back(r.node);
    std::sort(nodes.begin(), nodes.end());
    return nodes;
}

/// The frame that `from` sends at `t`, as the channel makes it after a search.
Emission frame_of(Medium& medium, NodeId from, Time t, const Legs& legs) {
    return {.begin = t,
            .end = t + 1ms,
            .origin = medium.stations().antenna(from, t, legs),
            .from = from,
            .squared_reach = medium.arrivals().squared_reach(from)};
}

}  // namespace

TEST_CASE(
    "variation: the receivers are exactly the robots where the level exceeds the sensitivity") {
    for (const Variation& v : variations()) {
        CAPTURE(std::string(v.name));
        Twins twins(v, 3);
        const std::vector<Propagation> models = {Friis{}, Raytrace2007{.wall_factor = 0.3},
                                                 TwoRay{}};
        for (std::uint32_t i = 0; i < robots; ++i)
            twins.add(models[i % 3], radio_of(twins.draw, v.directional));
        std::size_t links = 0;
        for (const Time t : {start_of_run, start_of_run + 1s, start_of_run + 7s}) {
            for (NodeId from{0}; from.value < robots; ++from.value) {
                const auto heard = receivers(twins.fast, from, t, twins.legs);
                CHECK(heard == receivers(twins.plain, from, t, twins.legs));
                links += heard.size();
                const Emission frame = frame_of(twins.fast, from, t, twins.legs);
                for (NodeId to{0}; to.value < robots; ++to.value) {
                    if (to == from) continue;
                    const Headings headings{{twins.legs.leg(from).heading_at(t)},
                                            {twins.legs.leg(to).heading_at(t)}};
                    const Vec3 at = twins.legs.position(to, t);
                    const auto arrives = v.directional
                                             ? twins.fast.arrivals().of(frame, to, at, headings)
                                             : twins.fast.arrivals().of(frame, to, at);
                    const bool hears = std::binary_search(heard.begin(), heard.end(), to);
                    if (!arrives) CHECK_FALSE(hears);
                    if (!arrives) continue;
                    const bool open = std::isnan(arrives->level_dbm);
                    const Dbm level =
                        open ? twins.fast.arrivals().level(*arrives, to) : Dbm{arrives->level_dbm};
                    const Db margin = level - twins.radios[to.index()].sensitivity;
                    if (std::abs(margin.value) > 1e-9) CHECK(hears == (margin > Db{0}));
                }
            }
        }
        CHECK(links > 3 * robots);
        CHECK(links < 3 * robots * (robots - 1) / 2);
    }
}

TEST_CASE("variation: shadowing of sigma 0 has no effect") {
    for (const ShadowingModel kind : {ShadowingModel::link, ShadowingModel::field}) {
        Medium medium({.shadowing = {.model = kind, .sigma = Db{0}}});
        const Propagation friis = Friis{};
        medium.add({}, 1, friis);
        CHECK(medium.stations().model(NodeId{0}).as<Shadowed>() == nullptr);
        CHECK(medium.stations().model(NodeId{0}) == friis);
    }
}

TEST_CASE(
    "variation: losses with the shadowing `link` equal those of `log_distance` with the same "
    "sigma") {
    Medium own({.scene = &open_field, .seed = 4, .replication = 1});
    Medium over({.scene = &open_field,
                 .shadowing = {.model = ShadowingModel::link, .sigma = Db{7}},
                 .seed = 4,
                 .replication = 1});
    Legs legs;
    for (std::uint64_t i = 0; i < 20; ++i) {
        legs.add(test::resting({7.0 * static_cast<double>(i), 3, 0}));
        own.add({}, i, LogDistance{.exponent = 3, .sigma = Db{7}});
        over.add({}, i, LogDistance{.exponent = 3, .sigma = Db{0}});
    }
    for (NodeId to{1}; to.value < 20; ++to.value) {
        CHECK(own.links().path_loss(a, to, start_of_run, legs).value ==
              over.links().path_loss(a, to, start_of_run, legs).value);
    }
}

TEST_CASE("variation: a shadowed loss is equal in both directions, and exact up to the cut-off") {
    for (const Shadowing& shadowing : {link_shadowing, field_shadowing}) {
        const Propagation model = Shadowed(Friis{}, shadowing, 3, 5);
        CHECK(model.as<Shadowed>()->base().name() == Friis::name);
        for (std::uint64_t i = 0; i < 400; ++i) {
            const double d = 1 + static_cast<double>(i);
            const test::OneLink link{.from = {2, d, 1}, .to = {d, 5, 1}, .from_key = i, .seed = 3};
            const test::OneLink back{
                .from = link.to, .to = link.from, .from_key = 2, .to_key = i, .seed = 3};
            const double loss = link.loss(model);
            CHECK(loss == back.loss(model));
            CHECK(loss >= 0);
            CHECK(distance(link.from, link.to) <=
                  model.reach(Db{loss}, link.frequency).value * (1 + 1e-9));
            CHECK(link.loss(model, loss) == loss);
            CHECK(link.loss(model, loss - 1) > loss - 1);
        }
    }
}

TEST_CASE("variation: the loss of a link with strong shadowing is never below 0") {
    const Propagation deep =
        Shadowed(Friis{}, {.model = ShadowingModel::field, .sigma = Db{60}}, 3, 5);
    int none = 0;
    for (int i = 0; i < 200; ++i) {
        const double loss = test::OneLink{.to = {1.0 + 9 * i, 2, 0}, .seed = 3}.loss(deep);
        CHECK(loss >= 0);
        none += loss == 0;
    }
    CHECK(none > 0);
}

TEST_CASE("variation: shadowing is refused for a propagation model with its own random part") {
    Medium medium({.scene = &open_field, .shadowing = field_shadowing});
    CHECK_THROWS_AS(medium.add({}, 1, LogDistance{}), std::invalid_argument);
    CHECK_NOTHROW(medium.add({}, 1, LogDistance{.sigma = Db{0}}));
}

TEST_CASE("variation: fading has no effect on the levels of links, which are local means") {
    Medium medium({.scene = &open_field, .fading = {.model = FadingModel::rayleigh}}),
        plain({.scene = &open_field});
    Legs legs;
    for (const double x : {0.0, 100.0, 200.0, 300.0, 420.0}) {
        legs.add(test::resting({x, 0, 0}));
        medium.add({}, legs.size(), Friis{});
        plain.add({}, legs.size(), Friis{});
    }
    int differ = 0;
    for (int i = 0; i < 50; ++i) {
        const Time t = start_of_run + i * 1s;
        for (NodeId to{1}; to.value < 5; ++to.value) {
            CHECK(medium.hears(a, to, t, legs) == plain.hears(a, to, t, legs));
            CHECK(medium.links().margin(a, to, t, legs) == plain.links().margin(a, to, t, legs));
        }
        CHECK(medium.hearers(a, t, legs).size() == 3);
        const auto heard = receivers(medium, a, t, legs);
        differ += heard.size() != 3;
        CHECK(medium.hearers(a, t, legs).size() == 3);
        CHECK(receivers(medium, a, t, legs) == heard);
    }
    CHECK(differ > 20);
}

TEST_CASE(
    "variation: with Rayleigh fading, frames reach a robot with probability e^(-1 / margin), near "
    "and far") {
    Medium medium({.scene = &open_field, .fading = {.model = FadingModel::rayleigh}});
    Legs legs;
    const std::vector<double> places{0, 100, 300, 420, 700, 1000};
    for (const double x : places) {
        legs.add(test::resting({x, 0, 0}));
        medium.add({}, legs.size(), Friis{});
    }
    constexpr int frames = 2000;
    std::vector<int> heard(places.size());
    for (int i = 0; i < frames; ++i) {
        for (const NodeId node : receivers(medium, a, start_of_run + i * 1ms, legs))
            ++heard[node.index()];
    }
    for (NodeId to{1}; to.value < places.size(); ++to.value) {
        CAPTURE(places[to.index()]);
        const double margin = medium.links().margin(a, to, start_of_run, legs).value;
        const double p = std::exp(-std::pow(10, -margin / 10));
        const double four_sigma = 4 * std::sqrt(p * (1 - p) / frames);
        CHECK(test::near(heard[to.index()] / double{frames}, p, four_sigma));
    }
}

TEST_CASE(
    "variation: if fading depends on the place, a robot that returns to a place has the same level "
    "again") {
    Medium medium({.scene = &open_field,
                   .fading = {.model = FadingModel::rayleigh, .coherence = Coherence::place}});
    Legs legs;
    legs.add(test::resting({0, 0, 0}));
    legs.add(
        {.end = start_of_run + 10s, .from = {200, 0, 0}, .velocity = {1, 0, 0}, .to = {210, 0, 0}});
    for (const std::uint64_t key : {1U, 2U}) medium.add({}, key, Friis{});
    const auto level = [&](Time t) {
        Emission frame = frame_of(medium, a, t, legs);
        frame.squared_reach = 1e12;
        const auto arrives = medium.arrivals().of(frame, b, legs.position(b, t));
        return arrives ? arrives->level_dbm : -1000;
    };
    const double before = level(start_of_run + 2s), later = level(start_of_run + 3s);
    legs.replace(b, test::resting({202, 0, 0}));
    medium.moved(b, legs);
    CHECK(level(start_of_run + 20s) == before);
    CHECK(later != before);
}

TEST_CASE("antennas: a sector antenna has its gain ahead, not behind, for sending and receiving") {
    Medium medium({.scene = &open_field});
    Legs legs;
    Radio sector{.antenna = AntennaShape::cosine,
                 .antenna_beamwidth = Radians{60 * degree},
                 .front_to_back = Db{25}};
    for (const Leg& leg : {test::resting({}), test::resting({50, 0, 0}), test::resting({-50, 0, 0}),
                           test::resting({0, 50, 0})}) {
        legs.add(leg);
        medium.add(legs.size() == 1 ? sector : Radio{}, legs.size(), Friis{});
    }
    const auto gain = [&](std::uint32_t to) {
        return medium.stations().gain(a, {to}, start_of_run, legs).sender.value;
    };
    constexpr double tolerance = 1e-9;
    CHECK(test::near(gain(1), 0, tolerance));
    CHECK(test::near(gain(2), -25, tolerance));
    // cos(phi / 2)^2n with 20 n log10 cos(15 deg) = -3 dB, at 90 deg.
    const double n = -3 / (20 * std::log10(std::cos(15 * degree)));
    CHECK(test::near(gain(3), std::max(-25.0, 20 * n * std::log10(std::cos(45 * degree))),
                     tolerance));
    CHECK((medium.links().level(a, {1}, start_of_run, legs) -
           medium.links().level(a, {2}, start_of_run, legs)) > Db{24.9});
    CHECK(test::near(medium.links().level({2}, a, start_of_run, legs).value,
                     medium.links().level(a, {2}, start_of_run, legs).value, tolerance));
}

TEST_CASE(
    "antennas: a robot that turns in place gains and loses links at the times of the closed form") {
    const Scene field;
    test::MovingPair pair{&field};
    Radio sector{.antenna = AntennaShape::cosine, .antenna_beamwidth = Radians{60 * degree}};
    // In free space at 200 m a link has 5.27 dB to spare: it is up within 79 degrees or so.
    Leg turning = test::resting({});
    turning.end = start_of_run + 36s;
    turning.turning = 10 * degree;
    turning.heading = -180 * degree;
    pair.add(Friis{}, turning, sector);
    pair.add(Friis{}, test::resting({200, 0, 0}));
    const double spare = 91.532125137753436 - free_space_db(200, 2450_MHz);
    const double n = -3 / (20 * std::log10(std::cos(15 * degree)));
    const double edge = 2 * std::acos(std::pow(10, -spare / (20 * n))) / degree;
    const auto found =
        pair.changes(a, b, start_of_run, start_of_run + 36s, {.tolerance = 1us, .min_dwell = 10ms});
    REQUIRE(found.size() == 2);
    constexpr double tolerance = 2e-6;
    CHECK(test::near(seconds(found[0] - start_of_run), (180 - edge) / 10, tolerance));
    CHECK(test::near(seconds(found[1] - start_of_run), (180 + edge) / 10, tolerance));
    // The metric `reach` looks at headings, too.
    Reachability reach;
    CHECK(reach.count(pair.medium, a, start_of_run, pair.legs) == 0);
    CHECK(reach.count(pair.medium, a, start_of_run + 18s, pair.legs) == 1);
}

TEST_CASE(
    "shadowing: times of link changes are exact to the tolerance with the model `field`, and to 1 "
    "ns with the model `link`") {
    const Scene scene;
    for (const Shadowing& shadowing : {link_shadowing, field_shadowing}) {
        Medium medium({.scene = &scene, .shadowing = shadowing, .seed = 5});
        Legs legs;
        legs.add(test::resting({}));
        legs.add(test::moving({-900, 30, 0}, {20, 0, 0}, 90s));
        for (const std::uint64_t key : {1U, 2U}) medium.add({}, key, Friis{});
        const LinkSearch search{.tolerance = 1us, .min_dwell = 20ms};
        std::vector<Time> found;
        Time after = start_of_run;
        while (const auto t =
                   next_link_change(medium, legs, scene, a, b, after, start_of_run + 90s, search))
            found.push_back(after = *t);
        const bool by_field = shadowing.model == ShadowingModel::field;
        CHECK(medium.links().shape(a, b, start_of_run, legs) ==
              (by_field ? LossShape::unknown : LossShape::by_pair));
        if (by_field) CHECK(found.size() >= 2);
        if (!by_field) CHECK(found.size() == 2);
        for (const Time t : found) {
            CHECK(medium.links().is_up(a, b, t, legs) !=
                  medium.links().is_up(a, b, t - (by_field ? 1us : 1ns), legs));
        }
    }
}

}  // namespace variation_test
