// SPDX-License-Identifier: MIT
// Calibration against truths of known parameters, and against two measured buildings, whose
// numbers field_flat_fits.csv and field_lab_fits.csv give. The measurements are read from the
// folder that ROVERNET_FIELD names.
#include "study/calibration/calibration.hpp"

#include "models/propagation/friis.hpp"
#include "models/propagation/log_distance.hpp"
#include "models/propagation/rays.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario_file.hpp"
#include "scene/scene.hpp"
#include "sim/random.hpp"
#include "test/models/vectors.hpp"
#include "test/scene/drawn_map.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace calibration_test {
using namespace rovernet;
using test::near;
using test::Vectors;

namespace {

Scenario scenario_from(const std::string& text) {
    const test::TemporaryFolder folder;
    return load_scenario(folder.write("s.toml", text), {});
}

const std::string wanderers = R"([scenario]
duration = "100 s"
[[robot]]
name = "r"
count = 6
move = { model = "random_waypoint", area = [["0 m", "0 m"], ["300 m", "300 m"]] }
)";

const CalibratedModel& model(const std::vector<CalibratedModel>& all, std::string_view name) {
    const auto at = std::find_if(all.begin(), all.end(),
                                 [&](const CalibratedModel& m) { return m.model == name; });
    REQUIRE(at != all.end());
    CAPTURE(at->failure);
    REQUIRE(at->failure.empty());
    return *at;
}

double value(const CalibratedModel& m, const std::string& key) {
    for (const FittedParameter& p : m.parameters) {
        if (p.key == key) return p.value;
    }
    FAIL("no parameter " << key);
    return 0;
}

std::string error_of(const std::string& levels, std::optional<Dbm> floor = {}) {
    const test::TemporaryFolder folder;
    try {
        read_levels(folder.write("levels.csv", levels), scenario_from(wanderers), floor);
    } catch (const InputError& e) {
        return e.what();
    }
    return "no error";
}

/// Free space that counts how often it is asked.
struct CountedFriis {
    static constexpr std::string_view name = "counted";
    int* asked;

    Meters reach(Db loss, Hertz f) const { return Friis{}.reach(loss, f); }
    void loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const {
        ++*asked;
        Friis{}.loss(links, cutoff, out_db);
    }
};

/// Levels of a law with exponent 3 and 50 dB at 1 m, in a file; those below -95 dBm are empty.
std::string levels_of_a_law(double floor) {
    std::string out = "# a law\nlevel_dbm, to_y_m ,to_x_m,from_x_m,from_y_m,group\n";
    for (int i = 1; i <= 200; ++i) {
        const double d = 2.0 * i, error = 4 * std::sin(1.7 * i);
        const double level = 16.53 - 50 - 30 * std::log10(d) + error;
        out += fmt::format("{},0,{},0,0,{}\n", level < floor ? "" : fmt::format("{}", level), d,
                           i % 5);
    }
    return out;
}

}  // namespace

TEST_CASE(
    "calibration: if losses were computed by a model, fitting this model recovers its parameters") {
    const Scenario scenario = scenario_from(
        wanderers + "[propagation]\nmodel = \"log_distance\"\nexponent = 3.2\nexcess = \"4 dB\"\n");
    const KnownLinks known =
        sample_links(scenario, scenario.propagation.make().median(), {.replications = 5});
    CHECK(known.groups == 5);
    CHECK(known.links.size() > 500);
    const auto models = calibrate(known, scenario, "", Propagation::anything);
    const CalibratedModel& log_distance = model(models, "log_distance");
    CHECK(near(value(log_distance, "exponent"), 3.2, 1e-9));
    CHECK(near(value(log_distance, "excess"), 4, 1e-7));
    CHECK(log_distance.fitted.rmse < 1e-9);
    CHECK(log_distance.left_out->rmse < 1e-9);
    CHECK(log_distance.left_out->wrong() == 0);
    // Without a wall it is multi_wall's law, too; 30 of N in 3.2 cannot make up for its constant.
    const CalibratedModel& multi_wall = model(models, "multi_wall");
    CHECK(near(value(multi_wall, "exponent"), 3.2, 1e-9));
    CHECK(!multi_wall.parameters.back().determined);
    CHECK(model(models, "friis").parameters.empty());
    CHECK(model(models, "friis").fitted.rmse > 10);
    CHECK(model(models, "itu_indoor").fitted.rmse < model(models, "itu_indoor").as_given->rmse);
    // A disc decides like any law of the distance.
    const CalibratedModel& disc = model(models, "disc");
    CHECK(disc.fitted.wrong() == 0);
    const double budget = known.links.front().budget;
    const double at_range = 40.231105 + 4 + 32 * std::log10(value(disc, "range"));
    CHECK(std::abs(at_range - budget) < 1);
}

TEST_CASE(
    "calibration: a scenario with the fitted parameters gives the losses that the fit predicts") {
    const Scenario scenario = scenario_from(wanderers + "[propagation]\nmodel = \"two_ray\"\n");
    Calibration calibration = calibrate_to_model(scenario, "", {});
    CHECK(calibration.reference == "two_ray");
    CHECK(calibration.loss_error <= Calibration::enough);
    const CalibratedModel& fitted = model(calibration.models, "log_distance");
    const Scenario refitted = scenario_from(wanderers + to_toml(fitted.settings));
    const auto again = calibrate(calibration.known, refitted, "", Propagation::anything);
    CHECK(near(model(again, "log_distance").as_given->rmse, fitted.fitted.rmse, 1e-4));
    CHECK(fitted.worst.size() == 5);
    CHECK(std::abs(fitted.worst[0].error) >= std::abs(fitted.worst[4].error));
}

TEST_CASE("calibration: links of robots that never move are sampled once, and grouped by sender") {
    const Scenario scenario = scenario_from(R"([[robot]]
name = "a"
at = ["0 m", "0 m"]
[[robot]]
name = "b"
at = ["30 m", "0 m"]
[[robot]]
name = "c"
at = ["0 m", "90 m"]
)");
    const KnownLinks known = sample_links(scenario, Friis{}, {});
    CHECK(known.links.size() == 3);
    CHECK(known.groups == 2);
    CHECK(std::string(known.group_name) == "sender");
}

TEST_CASE("calibration: a sample of links that grows in steps equals a sample drawn at once") {
    const Scenario scenario = scenario_from(wanderers + "[[robot]]\nname = \"still\"\ncount = 2\n" +
                                            "at = [\"9 m\", \"9 m\"]\n");
    int asked = 0;
    const SampleSize size{.replications = 8, .times = 5, .links = 200};
    LinkSample sample(scenario, CountedFriis{&asked}, size);
    sample.grow(2);
    sample.grow(4);
    const KnownLinks grown = sample.grow(8);
    const int asked_growing = std::exchange(asked, 0);
    const KnownLinks at_once = sample_links(scenario, CountedFriis{&asked}, size);
    REQUIRE(grown.links.size() == at_once.links.size());
    CHECK(grown.groups == at_once.groups);
    std::size_t unequal = 0;
    for (std::size_t i = 0; i < grown.links.size(); ++i) {
        const KnownLink &a = grown.links[i], &b = at_once.links[i];
        unequal += a.name != b.name || a.loss != b.loss || a.group != b.group;
    }
    CHECK(unequal == 0);
    CHECK(asked == static_cast<int>(at_once.links.size()));  // two that stand are one link
    CHECK(asked_growing <= 2 * asked);
}

TEST_CASE(
    "calibration: while links are sampled for the model `rays`, the model `multi_wall` decides "
    "which messages arrive") {
    // B drives off when it hears A, through a wall that takes so much by multi_wall.
    const auto links_with = [](const std::string& heavy_wall) {
        Scenario scenario = scenario_from(R"([scenario]
duration = "5 s"
[propagation]
model = "rays"
heavy_wall = ")" + heavy_wall + R"("
[[robot]]
name = "A"
at = ["1 m", "2.5 m"]
[[robot]]
name = "B"
at = ["4 m", "2.5 m"]
on_receive = { payload = "x", from = "A", move = { model = "goal", to = ["8 m", "2.5 m"], speed = "1 m/s" } }
[routing]
protocol = "flood"
[[traffic]]
kind = "broadcast"
from = "A"
payload = "x"
start = "1 s"
every = "1 s"
)");
        OccupancyGrid map =
            test::drawn_map(std::vector<std::string>(50, ".#" + std::string(98, '.')), 0.1);
        map.origin = {2, 0};
        scenario.walls = std::make_shared<const Scene>(std::move(map));
        return sample_links(scenario, Friis{}, {.replications = 1}).links.size();
    };
    CHECK(links_with("500 dB") == 1);
    CHECK(links_with("1 dB") > 10);
}

TEST_CASE("calibration: if a loss is far above the link budget, only a lower bound of it is used") {
    KnownLinks known;
    for (const double loss : {99.0, 120.0, 120.5}) {
        KnownLink& link = known.links.emplace_back();
        link.loss = loss;
        link.budget = 100;
    }
    const KnownLinks kept = censored(known, Db{20});
    CHECK(kept.links[0].loss == 99);
    CHECK(kept.links[1].loss == 120);
    CHECK(!kept.links[1].unseen);
    CHECK(kept.links[2].loss == 120);
    CHECK(kept.links[2].unseen);
}

TEST_CASE("calibration: losses far beyond the budget of any radio do not distort a fit") {
    // A law of exponent 3, and behind a rock, of far links, hundreds of decibels more.
    KnownLinks known;
    known.scene = std::make_shared<const Scene>();
    known.groups = 10;
    for (std::uint32_t i = 0; i < 400; ++i) {
        const double d = 2 + 0.25 * i, law = 40.231105 + 30 * std::log10(d);
        const bool rock = d > 30 && i % 2 == 0;
        known.links.push_back({.name = "",
                               .from = {0, 0, 1},
                               .to = {d, 0, 1},
                               .frequency = Hertz{2450e6},
                               .group = i % 10,
                               .loss = law + 2 * std::sin(1.7 * i) + (rock ? 5 * d : 0),
                               .budget = 90});
    }
    const Scenario scenario = scenario_from(wanderers);
    const auto exponent_of = [&](const KnownLinks& links) {
        const auto models = calibrate(links, scenario, "", Propagation::anything);
        return model(models, "log_distance").parameters.at(0);
    };
    CHECK(exponent_of(known).value > 15);
    const FittedParameter kept = exponent_of(censored(known, beyond_radio));
    CHECK(kept.value < 8);
    CHECK(std::isfinite(kept.se_by_group));
    CHECK(kept.se_by_group > 0);
}

TEST_CASE(
    "calibration: standard errors by the jackknife are near those computed from groups of links") {
    KnownLinks known;
    known.scene = std::make_shared<const Scene>();
    known.groups = 40;
    for (std::uint32_t i = 0; i < 400; ++i) {
        const double d = 2 + 0.25 * i, shared = 3 * std::sin(2.3 * (i % 40));
        known.links.push_back({.name = "",
                               .from = {0, 0, 1},
                               .to = {d, 0, 1},
                               .frequency = Hertz{2450e6},
                               .group = i % 40,
                               .loss = 40 + 30 * std::log10(d) + shared + std::sin(1.7 * i),
                               .budget = 200});
    }
    const Scenario scenario = scenario_from(wanderers);
    const auto fitted = [&] {
        return model(calibrate(known, scenario, "", Propagation::anything), "log_distance");
    };
    const double by_group = fitted().parameters.at(1).se_by_group;
    known.links[7].unseen = true;  // of one link only that it loses more than that
    known.links[7].loss -= 1;
    const double by_jackknife = fitted().parameters.at(1).se_by_group;
    CHECK(std::abs(by_jackknife / by_group - 1) < 0.15);
}

TEST_CASE("calibration: if some links are too weak to be seen, no fitted wall loss is negative") {
    // Links through a light wall lose less than others of their length.
    KnownLinks known;
    OccupancyGrid map = test::drawn_map(std::vector<std::string>(10, "#........."), 0.05);
    map.origin = {1, 0};
    known.scene = std::make_shared<const Scene>(std::move(map));
    known.groups = 1;
    for (std::uint32_t i = 0; i < 100; ++i) {
        const double d = 2 + 0.5 * i;
        const bool wall = i % 2 == 0;
        known.links.push_back({.name = "",
                               .from = {0, wall ? 0.25 : 5, 1},
                               .to = {d, wall ? 0.25 : 5, 1},
                               .frequency = Hertz{2450e6},
                               .loss = 40 + 30 * std::log10(d) - (wall ? 4 : 0) + std::sin(1.7 * i),
                               .unseen = i > 90,
                               .budget = 90});
    }
    const auto models = calibrate(known, scenario_from(wanderers), "", Propagation::anything);
    CHECK(value(model(models, "multi_wall"), "light_wall") == 0);
}

TEST_CASE(
    "calibration: links of robots at rest are sampled anew in each replication only if the model "
    "has random draws") {
    const Scenario scenario = scenario_from(
        "[[robot]]\nname = \"a\"\nat = [\"0 m\", \"0 m\"]\n"
        "[[robot]]\nname = \"b\"\nat = [\"9 m\", \"0 m\"]\n");
    const SampleSize size{.replications = 3, .times = 2};
    CHECK(sample_links(scenario, LogDistance{.sigma = Db{4}}, size).links.size() == 3);
    CHECK(sample_links(scenario, LogDistance{.sigma = Db{0}}, size).links.size() == 1);
}

TEST_CASE("calibration: levels too weak to be seen are taken into account by the Tobit model") {
    const test::TemporaryFolder folder;
    const Scenario scenario = scenario_from(wanderers);
    const auto fitted = [&](double floor) {
        const auto path = folder.write("levels.csv", levels_of_a_law(floor));
        return calibrate_to_levels(scenario, path, Dbm{floor}).models;
    };
    const double all = value(model(fitted(-300), "log_distance"), "exponent");
    const auto some = fitted(-95);
    CHECK(near(all, 3, 0.05));
    CHECK(near(value(model(some, "log_distance"), "exponent"), 3, 0.1));
    CHECK(near(value(model(some, "log_distance"), "excess"), 50 - 40.231105, 1.5));
    CHECK(std::isfinite(model(some, "log_distance").parameters[0].se_by_group));
    // friis has no constant of its own: the radios' power takes it up.
    CHECK(model(some, "friis").parameters.at(0).key == "power");
}

TEST_CASE("calibration: fitting a gain for each transmitter improves the fit") {
    const test::TemporaryFolder folder;
    const Scenario scenario = scenario_from(wanderers);
    const auto write = [&](const std::string& name, double first, double floor) {
        std::string out = "from_x_m,from_y_m,to_x_m,to_y_m,level_dbm,group\n";
        const double gains[] = {4, -1, -3};  // [dB]
        for (int i = 0; i < 300; ++i) {
            const int t = i % 3;
            const double d = first + 1.3 * i, error = std::sin(1.7 * i);
            const double level = 16.53 - 50 - 30 * std::log10(d) + gains[t] + error;
            out += fmt::format("{},0,{},0,{},{}\n", 1000 * t, 1000 * t + d,
                               level < floor ? "" : fmt::format("{}", level), i % 7);
        }
        return folder.write(name, out);
    };
    for (const double floor : {-300.0, -105.0}) {  // all seen; many not
        CAPTURE(floor);
        const auto path = write("levels.csv", 2, floor);
        const auto fitted = [&](Gains gains) {
            return calibrate_to_levels(scenario, path, Dbm{floor}, gains);
        };
        const Calibration equal = fitted(Gains::equal);
        Calibration free = fitted(Gains::by_transmitter);
        const CalibratedModel& law = model(free.models, "log_distance");
        REQUIRE(law.gains.size() == 3);
        CHECK(law.gains[1].at == Vec3{1000, 0, 0});
        CHECK(std::abs(law.gains[0].gain.value - 4) < 0.3);
        CHECK(std::abs(law.gains[1].gain.value + 1) < 0.3);
        CHECK(std::abs(law.gains[2].gain.value + 3) < 0.3);
        CHECK(law.gains[0].gain.se_by_group > 0);
        CHECK(law.gains[0].gain.se_by_group < 0.5);
        CHECK(near(value(law, "exponent"), 3, 0.02));
        // sin has 0.71 dB rms, the gains 2.9.
        CHECK(law.left_out->rmse < 0.9);
        CHECK(model(equal.models, "log_distance").left_out->rmse > 2.5);
        CHECK(model(equal.models, "log_distance").gains.empty());
        // Another day's levels of the same places have the same gains.
        check(free, scenario, write("other.csv", 2.7, floor), Dbm{floor});
        CHECK(model(free.models, "log_distance").checked->rmse < 0.9);
        CHECK(model(free.models, "disc").gains.empty());
    }
    const auto fault = [&](const std::string& text) {
        try {
            calibrate_to_levels(scenario, folder.write("few.csv", text), {}, Gains::by_transmitter);
            return std::string("no error");
        } catch (const InputError& e) {
            return e.message();
        }
    };
    const std::string head = "from_x_m,from_y_m,to_x_m,to_y_m,level_dbm\n";
    CHECK(fault(head + "0,0,1,0,-50\n0,0,2,0,-55\n")
              .starts_with("found 1 transmitter position; expected"));
    std::string walk = head;
    for (int i = 0; i < 201; ++i) walk += fmt::format("{},0,500,1,-50\n", i);
    CHECK(fault(walk).ends_with(
        "are the columns of transmitters (from) and receivers (to) exchanged?"));
}

TEST_CASE("calibration: a useless fit is refused with the reason") {
    const auto fit_of = [](const char* name, double rmse, double power) {
        CalibratedModel out;
        out.model = name;
        out.fitted = {.losses = 100, .rmse = rmse};
        out.parameters = {{.key = "power", .unit = "dBm", .value = power}};
        return out;
    };
    std::vector<CalibratedModel> models{fit_of("friis", 5, 12), fit_of("two_ray", 9.9, 12),
                                        fit_of("rays", 54, 12), fit_of("itu_indoor", 6, 4212.4)};
    refuse_absurd(models, Dbm{16.5});
    CHECK(models[0].refusal.empty());
    CHECK(models[1].refusal.empty());
    CHECK(models[2].refusal ==
          "the error of this model, 54.0 dB, is far above 5.0 dB, the error of friis with a "
          "fitted constant");
    CHECK(
        models[3].refusal ==
        "the fitted power of 4212 dBm differs by more than 30 dB from the given power of 16.5 dBm; "
        "check the power in [radio]");
    // By real levels: a power that was given 40 dB too high.
    const test::TemporaryFolder folder;
    const auto path = folder.write("levels.csv", levels_of_a_law(-300));
    const auto fitted =
        calibrate_to_levels(scenario_from(wanderers + "[radio]\npower = \"80 dBm\"\n"), path, {});
    CHECK(!model(fitted.models, "friis").refusal.empty());
    CHECK(model(fitted.models, "log_distance").refusal.starts_with("the fitted excess of "));
    // Levels that rise with the distance: no scenario takes such an exponent.
    std::string rising = "from_x_m,from_y_m,to_x_m,to_y_m,level_dbm\n", unheard = rising;
    for (int i = 1; i < 30; ++i) {
        rising += fmt::format("0,0,{},0,{}\n", i, -90 + 20 * std::log10(i));
        unheard += fmt::format("0,0,{},0,\n", i);
    }
    const auto absurd =
        calibrate_to_levels(scenario_from(wanderers), folder.write("rising.csv", rising), {});
    CHECK(model(absurd.models, "log_distance").refusal.find("exponent") != std::string::npos);
    CHECK_THROWS_AS(calibrate_to_levels(scenario_from(wanderers),
                                        folder.write("unheard.csv", unheard), Dbm{-80}),
                    InputError);
    // Two places tell no constant and exponent apart where each is left out: nothing is printed.
    const auto two = calibrate_to_levels(
        scenario_from(wanderers),
        folder.write("two.csv",
                     "from_x_m,from_y_m,to_x_m,to_y_m,level_dbm\n0,0,5,0,-50\n0,0,9,0,"
                     "-53\n"),
        {});
    for (const CalibratedModel& each : two.models)
        CHECK((each.failure.empty() || !each.is_fitted()));
}

TEST_CASE(
    "levels: the error of a single level is the repeatability divided by the square root of two") {
    KnownLinks first, second;
    constexpr int places = 4000;
    for (int i = 0; i < places; ++i) {
        const auto error = [&](std::uint64_t which) {
            return 3 * normal({.purpose = Purpose::placement,
                               .b = which,
                               .index = static_cast<std::uint64_t>(i)});
        };
        KnownLink link{};
        link.place = std::to_string(i);
        link.loss = 80 + error(1);
        first.links.push_back(link);
        link.loss = 80 + error(2);
        second.links.push_back(link);
    }
    CHECK(std::abs(repeatability(first, second).one_level() - 3) < 0.1);
}

TEST_CASE(
    "calibration: the fit finds the wall losses of the model `rays`; without walls they stay "
    "undetermined") {
    const std::string among_walls = R"([scenario]
duration = "100 s"
[[robot]]
name = "r"
count = 6
move = { model = "random_waypoint", area = [["1 m", "1 m"], ["29 m", "19 m"]] }
)";
    std::vector<std::string> rows(100, std::string(150, '.'));
    const auto wall = [&](std::size_t left, std::size_t right, std::size_t low, std::size_t high) {
        for (std::size_t y = low; y < high; ++y)
            for (std::size_t x = left; x < right; ++x) rows[y][x] = '#';
    };
    wall(0, 150, 0, 1), wall(0, 150, 99, 100), wall(0, 1, 0, 100), wall(149, 150, 0, 100);
    wall(50, 51, 0, 60), wall(100, 101, 30, 100), wall(0, 40, 50, 51), wall(110, 150, 55, 56);
    Scenario scenario = scenario_from(among_walls);
    scenario.walls = std::make_shared<const Scene>(test::drawn_map(rows, 0.2));
    const auto rays = [](double wall_loss, double reflection_loss) {
        return Rays{.order = 1,
                    .diffraction = RayDiffraction::none,
                    .wall_loss = Db{wall_loss},
                    .reflection_loss = Db{reflection_loss}};
    };
    std::get<Rays>(scenario.propagation.parameters) =
        rays(3, 12);  // as a user has it who knows no better
    const KnownLinks known = sample_links(scenario, rays(7.3, 4.6), {.replications = 4});
    const auto models = calibrate(known, scenario, "", Propagation::anything);
    const CalibratedModel& found = model(models, "rays");
    CHECK(near(value(found, "wall_loss"), 7.3, 0.02));
    CHECK(near(value(found, "reflection_loss"), 4.6, 0.05));
    CHECK(found.fitted.rmse < 0.1);
    CHECK(found.as_given->rmse > 2);
    // As it is written into a scenario it predicts what the fit says.
    Scenario again =
        scenario_from(among_walls + "[propagation]\norder = 1\ndiffraction = \"none\"\n" +
                      to_toml(found.settings).substr(std::string("[propagation]\n").size()));
    again.walls = scenario.walls;
    const auto refitted = calibrate(known, again, "", Propagation::anything);
    CHECK(model(refitted, "rays").as_given->rmse < 0.2);

    const Scenario open = scenario_from(among_walls);
    const auto in_the_open = calibrate(sample_links(open, Friis{}, {.replications = 2}), open, "",
                                       Propagation::anything);
    const CalibratedModel& nothing = model(in_the_open, "rays");
    for (const FittedParameter& p : nothing.parameters) CHECK(!p.determined);
}

TEST_CASE(
    "levels: an error in a file of levels is reported with its line, a wrong number also with its "
    "column") {
    const auto has = [](const std::string& text, const std::string& words) {
        CAPTURE(text);
        return text.find(words) != std::string::npos;
    };
    CHECK(has(error_of("from_x_m,from_y_m,to_x_m,to_y_m\n"), "levels.csv:1"));
    CHECK(has(error_of("from_x_m,from_y_m,to_x_m,to_y_m\n"), "no column \"level_dbm\""));
    const std::string head = "from_x_m,from_y_m,to_x_m,to_y_m,level_dbm\n";
    CHECK(has(error_of(head), "this file contains no level"));
    CHECK(has(error_of(head + "0,0,1,x,-50\n"), "levels.csv:2:7"));
    CHECK(has(error_of(head + "0,0,1,1\n"), "found 4 fields; expected 5"));
    CHECK(has(error_of(head + "0,0,1,1,\n"), "needs --floor"));
    CHECK(has(error_of(head + "0,0,1,1,\n", Dbm{-90}), "no error"));
    CHECK(has(error_of(""), "empty"));
}

TEST_CASE(
    "calibration: models are fitted to levels measured in a flat and a laboratory, with their "
    "maps") {
    const char* folder = std::getenv("ROVERNET_FIELD");
    if (!folder) {
        MESSAGE("skipped: ROVERNET_FIELD is not set");
        return;
    }
    const std::string field = std::string(folder) + "/";
    const test::TemporaryFolder made;
    const Vectors cells(field, "flat/cells.csv"), anchors(field, "flat/anchors.csv");
    std::map<std::string, std::string> places;
    for (std::size_t i = 0; i < anchors.size(); ++i) {
        places[anchors.text(i, "anchor")] =
            anchors.text(i, "x_m") + "," + anchors.text(i, "y_m") + "," + anchors.text(i, "z_m");
    }
    const auto file = [&](const std::string& set) {
        std::string out = "from_x_m,from_y_m,from_z_m,to_x_m,to_y_m,to_z_m,level_dbm,group,place\n";
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (cells.text(i, "set") != set) continue;
            out += fmt::format("{},{},1.3,{},{},{},{} {}\n", cells.text(i, "x_m"),
                               cells.text(i, "y_m"), places[cells.text(i, "anchor")],
                               cells.text(i, "mean_rssi_dbm"), cells.text(i, "anchor"),
                               cells.text(i, "cell_x"), cells.text(i, "cell_y"));
        }
        return made.write(set + ".csv", out);
    };
    const Scenario scenario =
        scenario_from(fmt::format("[scene]\nmap = \"{}flat/map.yaml\"\n[radio]\nfrequency = \"2440 "
                                  "MHz\"\nsensitivity = \"-65 dBm\"\n[[robot]]\nname = \"tag\"\nat "
                                  "= [\"2 m\", \"4 m\"]\n",
                                  field));
    Calibration flat = calibrate_to_levels(scenario, file("calibration"), {});
    const Repeatability again = check(flat, scenario, file("robot"), {});
    CHECK(again.levels == 240);
    CHECK(near(again.rms, 3.060100, 1e-6));
    const Vectors expected("field_flat_fits.csv");
    const auto row = [&](const std::string& name) {
        for (std::size_t i = 0; i < expected.size(); ++i) {
            if (expected.text(i, "model") == name) return i;
        }
        return expected.size();
    };
    for (const std::string name : {"friis", "log_distance", "multi_wall"}) {
        CAPTURE(name);
        const CalibratedModel& fitted = model(flat.models, name);
        const double own = expected.number(row(name), "rmse_calibration_db");
        const double other = expected.number(row(name), "rmse_robot_db");
        if (name == "multi_wall") {  // light walls have a loss of their own here: it fits no worse
            CHECK(fitted.fitted.rmse < own + 0.2);
            CHECK(fitted.checked->rmse < other + 0.2);
        } else {  // below 1 m, friis goes on
            CHECK(near(fitted.fitted.rmse, own, 0.005));
            CHECK(near(fitted.checked->rmse, other, 0.005));
        }
    }
    CHECK(near(value(model(flat.models, "log_distance"), "exponent"),
               expected.number(row("log_distance"), "exponent_or_wall"), 1e-4));
    CHECK(near(model(flat.models, "friis").checked->wrong(),
               expected.number(row("friis"), "decision_error_at_-65dbm"), 0.005));
}

}  // namespace calibration_test
