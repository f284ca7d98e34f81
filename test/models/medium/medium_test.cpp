// SPDX-License-Identifier: MIT
#include "models/medium/medium.hpp"

#include "models/link_gain.hpp"
#include "models/medium/reachability.hpp"
#include "models/propagation/list.hpp"
#include "test/scene/drawn_map.hpp"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/connected_components.hpp>
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace medium_test {
using namespace rovernet;

namespace {

using namespace std::chrono_literals;

/// Who hears `from`, in order.
std::vector<Reception> receivers(Medium& medium, NodeId from, Time start, Time end,
                                 const Legs& legs) {
    Medium::Receivers found;
    medium.find_receivers(from, Coding{}, start, end, legs, found);
    std::vector<Reception> all(found.all().begin(), found.all().end());
    std::sort(all.begin(), all.end());
    if (!all.empty()) {
        CHECK(found.first == all.front().time);
        CHECK(found.last == all.back().time);
    }
    return all;
}

template <class Model>
Propagation model() {
    return Model{};
}
template <>
Propagation model<Disc>() {
    return Disc{.range = 15_m};
}

Radio random_radio(test::Draw& draw) {
    const Dbm sensitivity{draw.uniform(-85, -45)};
    return {.power = {draw.uniform(0, 25)},
            .sensitivity = sensitivity,
            .carrier_sense_threshold = sensitivity - Db{draw.uniform(0, 12)},
            .frequency = {draw.uniform(1800e6, 2700e6)},
            .antenna_gain = {draw.uniform(-3, 6)},
            .cable_loss = {draw.uniform(0, 4)},
            .antenna_height = {draw.uniform(0, 2)},
            .gate = Gate::none};
}

/// Robots at random places and on random ways, with radios of their own.
struct Crowd {
    test::Draw draw;
    Scene scene{test::random_map(draw, 40, 40, 10)};
    Medium medium{{.scene = &scene, .seed = 11, .replication = 2}};
    Legs legs{};
    std::vector<Radio> radios{};
    std::size_t sensors = 0;  // that were found

    explicit Crowd(std::uint32_t seed) : draw(seed) {}

    Vec3 place() { return {draw.uniform(-5, 45), draw.uniform(-5, 45), draw.uniform(0, 4)}; }
    void add(const Propagation& propagation) { add(propagation, random_radio(draw)); }
    void add(const Propagation& propagation, const Radio& radio) {
        const Vec3 from = place(), to = place();
        legs.add(
            {.end = start_of_run + 10s, .from = from, .velocity = 0.1 * (to - from), .to = to});
        radios.push_back(radio);
        medium.add(radio, radios.size(), propagation);
    }
    NodeId node(std::size_t i) const { return {static_cast<std::uint32_t>(i)}; }
    static constexpr auto hears = [](const Radio& from, const Radio& to) {
        return link_budget(from, to);
    };
    static constexpr auto senses = [](const Radio& from, const Radio& to) {
        return sensing_budget(from, to);
    };
    /// Path losses from robot i to each robot [dB]; that to itself is infinite.
    std::vector<Db> losses(std::size_t i, Time t) const {
        std::vector<Db> all(radios.size(), Db{std::numeric_limits<double>::infinity()});
        for (std::size_t j = 0; j < radios.size(); ++j)
            if (j != i) all[j] = medium.links().path_loss(node(i), node(j), t, legs);
        return all;
    }
    /// Robots other than i that are on and whose losses from i are at most their budgets.
    template <class Budget>
    std::vector<NodeId> within(std::size_t i, const std::vector<Db>& losses,
                               const Budget& budget) const {
        std::vector<NodeId> out;
        for (std::size_t j = 0; j < radios.size(); ++j)
            if (medium.stations().is_on(node(j)) && losses[j] <= budget(radios[i], radios[j]))
                out.push_back(node(j));
        return out;
    }
    /// What find_receivers() must say.
    std::vector<Reception> brute_force(std::size_t i, const std::vector<Db>& losses, Time start,
                                       Time end) const {
        std::vector<Reception> all;
        for (const NodeId j : within(i, losses, hears)) {
            const double d = distance(medium.stations().antenna(node(i), start, legs),
                                      medium.stations().antenna(j, start, legs));
            all.push_back({end + from_seconds(d / speed_of_light), j});
        }
        std::stable_sort(all.begin(), all.end(),
                         [](const auto& a, const auto& b) { return a.time < b.time; });
        return all;
    }
    /// Compares every robot's receivers at `t` with the brute force; how many links there are.
    std::size_t check(Time t) {
        std::size_t links = 0;
        for (std::size_t i = 0; i < radios.size(); ++i) {
            const Time end = t + 238'545ns;
            const std::vector<Db> from_here = losses(i, t);
            const auto expected = brute_force(i, from_here, t, end);
            const auto heard = receivers(medium, node(i), t, end, legs);
            REQUIRE(heard.size() == expected.size());
            for (std::size_t k = 0; k < heard.size(); ++k) {
                CHECK(heard[k].node == expected[k].node);
                CHECK(heard[k].time == expected[k].time);
            }
            check_sensors(i, from_here, t);
            links += heard.size();
        }
        return links;
    }
    /// Who senses robot i without hearing it.
    void check_sensors(std::size_t i, const std::vector<Db>& losses, Time t) {
        const std::vector<NodeId> hearing = within(i, losses, hears);
        std::vector<NodeId> expected, sensing;
        for (const NodeId j : within(i, losses, senses))
            if (std::find(hearing.begin(), hearing.end(), j) == hearing.end())
                expected.push_back(j);
        Medium::Receivers heard;
        for (const auto& s : medium.find_sensors(node(i), Coding{}, t, t, legs, heard)) {
            sensing.push_back(s.node);
        }
        std::sort(sensing.begin(), sensing.end());
        CHECK(sensing == expected);
        sensors += sensing.size();
    }
};

constexpr std::size_t robots = 60;

}  // namespace

TEST_CASE("medium: receivers are those of a search over all pairs, for every model") {
    for_each_model([]<class Model>() {
        CAPTURE(std::string(Model::name));
        Crowd crowd(1);
        const Propagation propagation = model<Model>();
        for (std::size_t i = 0; i < robots; ++i) crowd.add(propagation);
        for (const auto t : {0s, 3s, 10s, 60s}) {
            const std::size_t links = crowd.check(start_of_run + t);
            CHECK(links > 0);
            CHECK(links < robots * (robots - 1));
        }
    });
}

TEST_CASE(
    "medium: with log_distance and few kinds of radios, receivers are those of a search over all "
    "pairs") {
    for (const std::size_t kinds : {std::size_t{1}, std::size_t{3}}) {
        CAPTURE(kinds);
        Crowd crowd(12);
        std::vector<Radio> radios;
        // Of random sensitivities, some fit the size of the map.
        for (std::size_t k = 0; k < kinds; ++k) {
            radios.push_back(random_radio(crowd.draw));
            radios.back().sensitivity = Dbm{-62 - 3.0 * static_cast<double>(k)};
            radios.back().carrier_sense_threshold = radios.back().sensitivity - Db{5};
        }
        const Propagation shadowed = LogDistance{.exponent = 3.5, .sigma = Db{6}};
        for (std::size_t i = 0; i < robots; ++i) crowd.add(shadowed, radios[i % kinds]);
        std::size_t links = 0;
        for (const auto t : {0s, 3s, 10s, 60s}) links += crowd.check(start_of_run + t);
        CHECK(links > 500);
        CHECK(crowd.sensors > 500);
    }
}

TEST_CASE("medium: if robots have different models, the sender's model applies") {
    Crowd crowd(2);
    std::vector<Propagation> models;
    for_each_model([&]<class Model>() { models.push_back(model<Model>()); });
    for (std::size_t i = 0; i < robots; ++i) crowd.add(models[i % models.size()]);
    crowd.check(start_of_run + 1s);
    for (std::size_t i = 0; i < robots; ++i) {
        CHECK(crowd.medium.stations().model(crowd.node(i)).name() ==
              models[i % models.size()].name());
    }
}

TEST_CASE("medium: a more sensitive receiver that joins later is found immediately") {
    for (const Propagation& model :
         {Propagation{Friis{}}, Propagation{LogDistance{.sigma = {6}}}}) {
        Crowd crowd(3);
        for (int i = 0; i < 10; ++i) crowd.add(model, {.power = {-20.0}, .sensitivity = {-50.0}});
        const std::size_t before = crowd.check(start_of_run);
        for (int i = 0; i < 10; ++i) crowd.add(model, {.power = {-20.0}, .sensitivity = {-85.0}});
        CHECK(crowd.check(start_of_run) > before);
    }
}

TEST_CASE("medium: a reception ends after airtime and propagation delay") {
    const Scene field;
    Medium medium({.scene = &field});
    Legs legs;
    const Propagation disc = Disc{.range = 10'000_m};
    for (const double x : {0.0, 3000.0, 300.0, -300.0, 3000.0}) {
        legs.add({.from = {x, 0, 0}, .to = {x, 0, 0}});
        medium.add({}, legs.size(), disc);
    }
    const auto heard = receivers(medium, {0}, start_of_run, start_of_run + 1us, legs);
    REQUIRE(heard.size() == 4);
    const std::uint32_t order[] = {2, 3, 1, 4};
    for (std::size_t i = 0; i < 4; ++i) CHECK(heard[i].node.value == order[i]);
    CHECK(heard[0].time == start_of_run + 1us + 1001ns);    // 300 m / c = 1000.69 ns
    CHECK(heard[2].time == start_of_run + 1us + 10'007ns);  // 3000 m / c = 10,006.92 ns
}

TEST_CASE("medium: without propagation delay all receptions end with the frame") {
    const Scene field;
    Medium medium({.scene = &field, .propagation_delay = false});
    Legs legs;
    for (const double x : {0.0, 3000.0, 300.0}) {
        legs.add({.from = {x, 0, 0}, .to = {x, 0, 0}});
        medium.add({}, legs.size(), Disc{.range = 10'000_m});
    }
    const auto heard = receivers(medium, {0}, start_of_run, start_of_run + 1us, legs);
    REQUIRE(heard.size() == 2);
    CHECK(heard[0].node == NodeId{1});
    CHECK(heard[0].time == start_of_run + 1us);
    CHECK(heard[1].time == start_of_run + 1us);
}

TEST_CASE(
    "medium: at a loss equal to the budget a link is up; at the next larger loss it is down") {
    const Scene field;
    Legs legs;
    for (const double x : {0.0, 50.0}) legs.add({.from = {x, 0, 0}, .to = {x, 0, 0}});
    const double loss = itu_indoor_db(50, 2450_MHz, 30, 0);
    const auto hears = [&](double sensitivity) {
        Medium medium({.scene = &field});
        const Radio radio{.power = {0}, .sensitivity = {sensitivity}};
        for (int i = 0; i < 2; ++i) medium.add(radio, 1, ItuIndoor{});
        return !receivers(medium, {0}, start_of_run, start_of_run, legs).empty();
    };
    CHECK(hears(-loss));
    CHECK_FALSE(hears(std::nextafter(-loss, 0.0)));
}

TEST_CASE(
    "medium: a radio that is off neither receives nor is reachable, until it is switched on "
    "again") {
    const Scene field;
    Medium medium({.scene = &field});
    Legs legs;
    const Propagation disc = Disc{.range = 1.1_m};
    for (int i = 0; i < 5; ++i) {
        legs.add({.from = {1.0 * i, 0, 0}, .to = {1.0 * i, 0, 0}});
        medium.add({}, static_cast<std::uint64_t>(i), disc);
    }
    const auto heard_by = [&](std::uint32_t from) {
        return receivers(medium, {from}, start_of_run, start_of_run, legs).size();
    };
    CHECK(Reachability::count_anew(medium, {0}, start_of_run, legs) == 4);
    medium.switch_radio({2}, false);
    CHECK(heard_by(1) == 1);
    CHECK(heard_by(3) == 1);
    CHECK(Reachability::count_anew(medium, {0}, start_of_run, legs) == 1);
    CHECK(Reachability::count_anew(medium, {4}, start_of_run, legs) == 1);
    medium.switch_radio({2}, true);
    CHECK(heard_by(1) == 2);
    CHECK(Reachability::count_anew(medium, {0}, start_of_run, legs) == 4);
}

TEST_CASE("medium: with radios switched off, receivers are those of a search over all pairs") {
    Crowd crowd(4);
    const Propagation friis = Friis{};
    for (std::size_t i = 0; i < robots; ++i) crowd.add(friis);
    for (std::size_t i = 0; i < robots; i += 3) crowd.medium.switch_radio(crowd.node(i), false);
    crowd.check(start_of_run + 2s);
}

TEST_CASE(
    "medium: the number of reachable robots agrees with the connected components of Boost.Graph") {
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        Crowd crowd(seed);
        const Propagation disc = Disc{.range = 7_m};
        for (std::size_t i = 0; i < robots; ++i) crowd.add(disc, Radio{});
        const Time t = start_of_run + 4s;
        boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS> graph(robots);
        for (std::size_t i = 0; i < robots; ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const double d = distance(crowd.legs.position(crowd.node(i), t),
                                          crowd.legs.position(crowd.node(j), t));
                if (d <= 7) add_edge(i, j, graph);
            }
        }
        std::vector<int> component(robots);
        connected_components(graph, component.data());
        for (std::size_t i = 0; i < robots; ++i) {
            const auto size = std::count(component.begin(), component.end(), component[i]);
            CHECK(Reachability::count_anew(crowd.medium, crowd.node(i), t, crowd.legs) == size - 1);
        }
    }
}

TEST_CASE("medium: an invalid radio or frequency is refused") {
    const Scene field;
    Medium medium({.scene = &field});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(medium.add({.power = {nan}}, 1, Friis{}), std::invalid_argument);
    CHECK_THROWS_AS(medium.add({.frequency = {0}}, 1, Friis{}), std::invalid_argument);
    CHECK_THROWS_AS(medium.add({.rate = {-1}}, 1, Friis{}), std::invalid_argument);
    CHECK_THROWS_AS(medium.add({.cable_loss = {-1}}, 1, Friis{}), std::invalid_argument);
    ItuIndoor home;
    home.environment = Environment::residential;
    CHECK_THROWS_AS(medium.add({.frequency = 868_MHz}, 1, home), std::invalid_argument);
}

TEST_CASE("medium: ns-2's default radio decodes to 250 m and senses to 550 m over flat ground") {
    // W of its manual: Pt_, RXThresh_ and CSThresh_, each to four digits.
    const auto watts = [](double w) { return Dbm{10 * std::log10(1000 * w)}; };
    const Radio radio{.power = watts(0.28183815),
                      .sensitivity = watts(3.652e-10),
                      .carrier_sense_threshold = watts(1.559e-11),
                      .frequency = {914e6},
                      .antenna_height = Meters{1.5}};
    const Scene field;
    Medium medium{{.scene = &field}};
    Legs legs;
    for (const double x : {0.0, 249.9, 250.1, 549.9, 550.1}) {
        legs.add({.from = {x, 0, 0}, .to = {x, 0, 0}});
        medium.add(radio, legs.size(), TwoRay{});
    }
    Medium::Receivers heard;
    std::vector<NodeId> sensors;
    for (const auto& s :
         medium.find_sensors(NodeId{0}, Coding{}, start_of_run, start_of_run, legs, heard)) {
        sensors.push_back(s.node);
    }
    REQUIRE(heard.all().size() == 1);
    CHECK(heard.all()[0].node == NodeId{1});
    CHECK(heard.heard_within == 249.9);
    CHECK(heard.origin == Vec3{0, 0, radio.antenna_height.value});
    std::sort(sensors.begin(), sensors.end());
    CHECK(sensors == std::vector{NodeId{2}, NodeId{3}});
}

TEST_CASE("medium: a sender without neighbours reaches all robots that jump into its range") {
    const Scene field;
    Medium medium{{.scene = &field}};
    Legs legs;
    constexpr std::uint32_t nodes = 2000, jumping = 40;
    const auto at = [](double x) { return Leg{.from = {x, 0, 0}, .to = {x, 0, 0}}; };
    for (std::uint32_t i = 0; i < nodes; ++i) {
        legs.add(at(i == 0 ? 0 : 1e4 + 300.0 * i));
        medium.add({}, i, Disc{.range = {250}});
    }
    CHECK(receivers(medium, {0}, start_of_run, start_of_run, legs).empty());
    for (std::uint32_t i = 1; i <= jumping; ++i) {
        legs.replace({i}, at(1 + i));
        medium.moved({i}, legs);
    }
    const auto heard = receivers(medium, {0}, start_of_run, start_of_run, legs);
    REQUIRE(heard.size() == jumping);
    for (std::uint32_t i = 1; i <= jumping; ++i) CHECK(heard[i - 1].node == NodeId{i});
}

TEST_CASE(
    "medium: for two frames, is_stronger() agrees with their levels, with four kinds of models") {
    const Scene field;
    test::Draw draw(23);
    int stronger = 0, plain = 0;
    for (const Propagation& model :
         {Propagation{Friis{}}, Propagation{LogDistance{.sigma = {0}}}, Propagation{TwoRay{}},
          Propagation{LogDistance{.sigma = {6}}}}) {
        Medium medium{{.scene = &field, .seed = 5}};
        for (std::uint64_t i = 0; i < 6; ++i) {
            medium.add({.power = {i < 4 ? 20.0 : 26.0}}, i, model);
        }
        const auto arrival = [&](double d2) {
            return Arrival{.begin = start_of_run,
                           .end = start_of_run + 1ms,
                           .level_dbm = std::numeric_limits<double>::quiet_NaN(),
                           .squared_distance = d2,
                           .from = NodeId{static_cast<std::uint32_t>(1 + draw.below(5))}};
        };
        for (int i = 0; i < 20'000; ++i) {
            const double d2 = std::pow(10, draw.uniform(-1, 9)), ratio = draw.uniform(0.1, 30);
            Arrival a = arrival(d2), b = arrival(d2 * ratio);
            const Db by{draw.uniform(0, 20)};
            const double level_a = medium.arrivals().level(a, NodeId{0}).value;
            const double level_b = medium.arrivals().level(b, NodeId{0}).value;
            const bool is = level_a >= level_b + by.value;
            REQUIRE(medium.arrivals().is_stronger(a, b, by, NodeId{0}) == is);
            stronger += is;
            plain += std::isnan(a.level_dbm);
            // Once levels are known they decide, to the last bit.
            a.level_dbm = level_a;
            b.level_dbm = level_a - by.value;
            REQUIRE(medium.arrivals().is_stronger(a, b, by, NodeId{0}) ==
                    (level_a >= b.level_dbm + by.value));
        }
    }
    CHECK(stronger > 10'000);
    CHECK(plain > 10'000);
}

TEST_CASE(
    "medium: the bound on neglected interference assumes that each frame is at the cut-off level") {
    const Scene field;
    // Noise of -93.6 dBm; the cut is at -95 dBm: each adds 0.72 of the noise at most.
    Medium medium{{.scene = &field, .interference_cut = Db{20}}};
    medium.add({}, 1, Friis{});
    const double noise = noise_floor(Radio{}).value;
    const double each = std::pow(10, (-95 - noise) / 10);
    CHECK(medium.stations().kinds().left_out(0) == Db{0});
    CHECK(medium.stations().kinds().left_out(3).value ==
          doctest::Approx(10 * std::log10(1 + 3 * each)).epsilon(1e-9));
    // No lower than 10 dB below the noise.
    Medium wide{{.scene = &field, .interference_cut = Db{60}}};
    wide.add({}, 1, Friis{});
    CHECK(wide.stations().kinds().left_out(10).value ==
          doctest::Approx(10 * std::log10(2.0)).epsilon(1e-9));
}

TEST_CASE("medium: a frame interferes if it can be sensed or is above the interference cut-off") {
    const Scene field;
    const Radio radio{.sensitivity = {-85}};  // nothing weaker is sensed; noise of -93.6 dBm
    for (const std::optional<Db> cut : {std::optional<Db>{}, std::optional{Db{6}}}) {
        Medium medium{{.scene = &field, .interference_cut = cut}};
        medium.add(radio, 1, Friis{});
        medium.add(radio, 2, Friis{});
        for (const double below : {-1.0, 1.0, 5.0, 7.0}) {
            CAPTURE(below);
            const double loss = radio.power.value - radio.sensitivity.value + below;
            const double d = Friis{}.reach(Db{loss}, radio.frequency).value;
            const Emission frame{.begin = start_of_run,
                                 .end = start_of_run + 1ms,
                                 .origin = {0, 0, radio.antenna_height.value},
                                 .from = NodeId{0},
                                 .heard_within = 0,
                                 .squared_reach = medium.arrivals().squared_reach(NodeId{0}),
                                 .flight = 0};
            const auto arrival = medium.arrivals().of(frame, NodeId{1}, {d, 0, 0});
            REQUIRE(arrival.has_value() == (below < (cut ? cut->value : 0)));
            if (!arrival) continue;
            const double level = radio.sensitivity.value - below;
            CHECK(medium.arrivals().level(*arrival, NodeId{1}).value ==
                  doctest::Approx(level).epsilon(1e-9));
            CHECK(arrival->end == frame.end + medium.arrivals().delay(d));
        }
    }
}

}  // namespace medium_test
