// SPDX-License-Identifier: MIT
#include "study/study.hpp"

#include "experiment/build.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario_file.hpp"
#include "sim/error.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <set>

namespace study_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

const std::string two_robots = R"([scenario]
name = "pair"
[propagation]
model = "disc"
range = "10 m"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "r"
count = 3
at = ["5 m", "0 m"]
[[traffic]]
from = "A"
payload = "F"
)";

std::vector<std::string> points_of(const std::string& keys) {
    const Value document = parse_toml("[study]\n" + keys, "s.toml");
    const StudyTable study = read_study(*document.table()->find("study"), Duration::max());
    std::vector<std::string> texts;
    for (const Table& settings : study_points(study, {"s.toml"})) {
        texts.push_back(settings_text(settings));
    }
    return texts;
}

using Texts = std::vector<std::string>;

std::string error_of(const std::string& text) {
    const TemporaryFolder folder;
    try {
        Study(folder.write("s.toml", text), {});
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

/// The id of the only point of a scenario.
std::string id_of(const std::string& text, const ScenarioOptions& options = {}) {
    const TemporaryFolder folder;
    return Study(folder.write("s.toml", text), options).points().at(0).id;
}

}  // namespace

TEST_CASE("study: points are all combinations of the values, and the last key varies fastest") {
    CHECK(points_of("vary.a = [1, 2]\nvary.b = [\"x\", \"y\", \"z\"]") ==
          Texts{"a=1, b=x", "a=1, b=y", "a=1, b=z", "a=2, b=x", "a=2, b=y", "a=2, b=z"});
    CHECK(points_of("") == Texts{"the unchanged scenario"});
}

TEST_CASE("study: keys that are listed in `zip` vary together, in any order of the list") {
    CHECK(points_of("vary.a = [1, 2]\nvary.b = [7, 8]\nvary.c = [3, 4]\nzip = [[\"a\", \"c\"]]") ==
          Texts{"a=1, b=7, c=3", "a=1, b=8, c=3", "a=2, b=7, c=4", "a=2, b=8, c=4"});
    CHECK(points_of("vary.a = [1, 2]\nvary.b = [7, 8]\nvary.c = [3, 4]\nzip = [[\"c\", \"a\", "
                    "\"b\"]]") == Texts{"a=1, b=7, c=3", "a=2, b=8, c=4"});
}

TEST_CASE("study: a point is skipped if each key of an exclusion has one of the excluded values") {
    CHECK(points_of("vary.a = [1, 2, 3]\nvary.b = [7, 8]\nexclude = [{ a = [1, 3], b = 8 }]") ==
          Texts{"a=1, b=7", "a=2, b=7", "a=2, b=8", "a=3, b=7"});
    CHECK(points_of("vary.a = [1, 2]\nvary.b = [7, 8]\nexclude = [{ a = 1 }, { b = 8 }]") ==
          Texts{"a=2, b=7"});
    CHECK_THROWS_WITH_AS(
        points_of("vary.a = [\"disc\", \"friis\"]\nexclude = [{ a = [\"disc\", \"fris\"] }]"),
        doctest::Contains("exclude: found a = \"fris\", which is not among the values of \"vary\"; "
                          "expected one of \"disc\", \"friis\"; did you mean \"friis\"?"),
        InputError);
    CHECK_THROWS_WITH_AS(points_of("vary.a = [1]\nexclude = [{ a = 1 }]"),
                         doctest::Contains("exclude every point"), InputError);
}

TEST_CASE("study: a range includes both of its ends, and its values have no rounding errors") {
    CHECK(points_of("vary.a = { from = 0, to = 0.5, step = 0.1 }") ==
          Texts{"a=0.0", "a=0.1", "a=0.2", "a=0.3", "a=0.4", "a=0.5"});
    CHECK(points_of("vary.a = { from = 0, to = 0.3, step = 0.1 }") ==  // 0.3 / 0.1 is below 3
          Texts{"a=0.0", "a=0.1", "a=0.2", "a=0.3"});
    CHECK(points_of("vary.a = { from = 3, to = 1, step = -1 }") == Texts{"a=3", "a=2", "a=1"});
    CHECK(points_of("vary.a = { from = 1, to = 6, step = 2 }") == Texts{"a=1", "a=3", "a=5"});
    CHECK(points_of("vary.a.b = { from = \"0.5 m\", to = \"1.5 m\", step = \"0.5 m\" }") ==
          Texts{"a.b=0.5 m", "a.b=1 m", "a.b=1.5 m"});
    CHECK(points_of("vary.a = { from = 2, to = 2, step = 1 }") == Texts{"a=2"});
}

TEST_CASE("study: a varied key may be written as a path in quotes or as nested keys") {
    CHECK(points_of("vary.\"a.b\" = [1]\nvary.c.d = [2]\n[study.vary.e]\nf = [3]") ==
          Texts{"a.b=1, c.d=2, e.f=3"});
    // A path that ends in one of the words of a range is a path if its value is a list.
    CHECK(points_of("vary.traffic.0.from = [\"A\"]") == Texts{"traffic.0.from=A"});
}

TEST_CASE("study: a million points are accepted, more are an error") {
    const std::string range = " = { from = 1, to = 1000, step = 1 }\n";
    CHECK(points_of("vary.a" + range + "vary.b" + range).size() == 1'000'000);
    CHECK_THROWS_WITH_AS(points_of("vary.a" + range + "vary.b" + range + "vary.c = [1, 2]"),
                         doctest::Contains("more than 1000000 points"), InputError);
}

TEST_CASE("study: the scenario of a point has the point's values and the requested replication") {
    const TemporaryFolder folder;
    const std::string path = folder.write(
        "s.toml",
        two_robots + "[study]\nvary.robot.r.count = [3, 5]\nvary.radio.power = [\"5 dBm\"]");
    Study study(path, {});
    const Scenario scenario = study.scenario(1, 7);
    CHECK(scenario.robots[1].count == 5);
    CHECK(scenario.radio.power.value == 5.0);
    CHECK(scenario.scenario.replication == 7);
    CHECK(study.scenario(0, 0).robots[1].count == 3);
}

TEST_CASE("study: an error in a varied value is reported before any run, with line and column") {
    const auto wrong = [](const std::string& keys) {
        return error_of(two_robots + "[study]\n" + keys);
    };
    CHECK(wrong("vary.radio.pwer = [\"5 dBm\"]").find("s.toml:17:12: unknown key \"pwer\"") !=
          std::string::npos);
    CHECK(wrong("vary.radio.power = [\"5 dBm\", \"5 m\"]").find("s.toml:17:30: ") !=
          std::string::npos);
    CHECK(wrong("vary.radio.power = [\"5 dBm\", \"5 m\"]")
              .find("this happens with radio.power=5 m") != std::string::npos);
    CHECK(wrong("vary.robot.x.count = [1]").find("no item of the list is named \"x\"") !=
          std::string::npos);
    CHECK(wrong("vary.reception.model = [\"threshold\", \"sinr\"]")
              .find("\"disc\" computes no received levels") != std::string::npos);
}

TEST_CASE("study: a value listed twice is refused, with line and column") {
    const auto wrong = [](const std::string& keys) {
        return error_of(two_robots + "[study]\n" + keys);
    };
    CHECK(wrong("vary.radio.power = [\"5 dBm\", \"6 dBm\", \"5 dBm\"]")
              .ends_with("s.toml:17:39: vary: radio.power=5 dBm is listed twice; expected "
                         "different values"));
    CHECK(wrong("vary.robot.r.count = [2, 3]\nvary.radio.power = [\"0 dBm\", \"1 mW\"]")
              .ends_with("s.toml:18:30: vary: robot.r.count=2, radio.power=1 mW gives the same "
                         "scenario as robot.r.count=2, radio.power=0 dBm; expected values that "
                         "give different scenarios"));
    CHECK(wrong("vary.scenario.name = [\"a\", \"b\"]").find("gives the same scenario as") !=
          std::string::npos);
    // In a zip a value may come again, as long as the others differ.
    const std::string twice = "vary.radio.power = [\"5 dBm\", \"5 dBm\"]\nvary.robot.r.count = ";
    const std::string zip = "zip = [[\"radio.power\", \"robot.r.count\"]]";
    CHECK(wrong(twice + "[2, 3]\n" + zip) == "no error");
    CHECK(wrong(twice + "[2, 2]\n" + zip).find("s.toml:17:30: ") != std::string::npos);
}

TEST_CASE("study: an unknown metric is refused, with line, column and a suggestion") {
    const std::string text =
        error_of(two_robots + "[study]\nmetrics = [\"reach\", \"delivery_ration\"]");
    CHECK(text.find("s.toml:17:21: there is no metric \"delivery_ration\"") != std::string::npos);
    CHECK(text.find("; did you mean \"delivery_ratio\"") != std::string::npos);
    CHECK(text.size() < 400);  // not every metric of every robot
    CHECK(error_of(two_robots + "[study]\nmetrics = [\"airtime_s/messages\"]")
              .find("only `rovernet results` and `rovernet plot` compute") != std::string::npos);
}

TEST_CASE(
    "study: for a metric that [metrics] does not enable, the error names the key that enables it") {
    const auto error = [&](const std::string& metric, const std::string& more = "") {
        return error_of(two_robots + "[study]\nmetrics = [\"" + metric + "\"]\n" + more);
    };
    CHECK(error("degree_mean")
              .ends_with("s.toml:17:12: the metric \"degree_mean\" needs [metrics] "
                         "topology = true"));
    CHECK(error("degree_mean", "[metrics]\ntopology = true\n") == "no error");
    CHECK(error("path_stretch").ends_with("needs [metrics] path_stretch = true"));
    CHECK(error("delivery_ratio.at.A").ends_with("needs [metrics] robots = true"));
    CHECK(error("reach", "[metrics]\nreach = false\n").ends_with("needs [metrics] reach = true"));
    CHECK(error("reach") == "no error");
}

TEST_CASE("study: a point's id changes if, and only if, a change affects the results") {
    const std::string id = id_of(two_robots);
    CHECK(id.size() == 16);
    CHECK(id_of(two_robots) == id);
    CHECK(id_of("# a comment\n" + two_robots) == id);
    CHECK(id_of(two_robots + "[study]\nreplications = 9\nmetrics = [\"delivery_ratio\"]") == id);
    CHECK(id_of(two_robots + "[trace]\nns2 = \"new\"") == id);
    CHECK(id_of(two_robots, {.set = {"scenario.name=other"}}) == id);
    CHECK(id_of(two_robots, {.set = {"routing.jitter=10 ms"}}) ==
          id_of(two_robots));  // the default
    std::set<std::string> ids{id};
    for (const char* set : {"scenario.seed=2", "scenario.duration=5", "radio.power=\"9 dBm\"",
                            "robot.r.count=4", "propagation.range=11", "study.warmup=1"}) {
        CAPTURE(set);
        CHECK(ids.insert(id_of(two_robots, {.set = {set}})).second);
    }
    // Otherwise a run that is costly to search has no reach.
    CHECK(ids.insert(id_of(two_robots + "[study]\nmetrics = [\"reach\"]")).second);
}

TEST_CASE(
    "study: the routing protocol can be varied, with keys of several protocols in one table") {
    const TemporaryFolder folder;
    const std::string text = two_robots + R"([study]
vary."routing.protocol" = ["flood", "aodv"]
)";
    const std::string path = folder.write("s.toml", text);
    Study study(path, {.set = {"routing.hello=1 s", "routing.duplicates=forward"}});
    REQUIRE(study.points().size() == 2);
    CHECK(study.points()[0].id != study.points()[1].id);
    CHECK(settings_text(study.points()[1].settings) == "routing.protocol=aodv");
    CHECK(study.scenario(0, 0).routing.name() == "flood");
    const Scenario aodv = study.scenario(1, 0);
    REQUIRE(aodv.routing.as<Aodv>());
    CHECK(aodv.routing.as<Aodv>()->hello == std::chrono::seconds(1));
    CHECK(error_of(two_robots + "[study]\nvary.routing.protocol = [\"flood\", \"adov\"]")
              .find("s.toml:17:35: unknown protocol \"adov\"; expected one of \"flood\"") !=
          std::string::npos);
}

TEST_CASE("study: a different map under the same name gives a different point") {
    const TemporaryFolder folder;
    const std::string path = folder.write(
        "s.toml", "[scene]\nmap = \"m.pgm\"\nsize = [\"20 m\", \"20 m\"]\n" + two_robots);
    const auto id = [&](const std::string& pixels) {
        folder.write("m.pgm", "P2 2 2 255 " + pixels);
        return Study(path, {}).points()[0].id;
    };
    CHECK(id("255 255 255 255") == id("255 255 255 255"));
    CHECK(id("255 255 255 255") != id("255 255 255 0"));
}

TEST_CASE("study: different materials in the file beside the map give a different point") {
    const TemporaryFolder folder;
    folder.write("m.pgm", "P2 2 2 255 0 255 255 255");
    const std::string path = folder.write(
        "s.toml", "[scene]\nmap = \"m.pgm\"\nsize = [\"20 m\", \"20 m\"]\n" + two_robots);
    const auto id = [&](const std::string& loss) {
        folder.write("m.materials.toml",
                     "all = { greys = [0, 127], per_crossing = \"" + loss + "\" }\n");
        return Study(path, {}).points()[0].id;
    };
    CHECK(id("3 dB") == id("3 dB"));
    CHECK(id("3 dB") != id("4 dB"));
}

TEST_CASE(
    "study: all points with the same doors share the scenes in which these doors are closed") {
    const TemporaryFolder folder;
    folder.write("m.pgm", "P2 2 2 255 255 255 255 255");
    const std::string door =
        "[[scene.door]]\nfrom = [\"8 m\", \"8 m\"]\nto = [\"9 m\", \"8 m\"]\ncloses = [\"1 s\"]\n";
    Study study(
        folder.write("s.toml", "[scene]\nmap = \"m.pgm\"\nsize = [\"20 m\", \"20 m\"]\n" + door +
                                   two_robots +
                                   "[study]\nvary.propagation.range = [\"10 m\", \"9 m\"]\n"),
        {});
    const auto of_first = study.scenario(0, 0).changes, of_second = study.scenario(1, 3).changes;
    REQUIRE(of_first);
    CHECK(of_first->size() == 1);
    CHECK(of_first == of_second);
    CHECK(network_settings(study.scenario(1, 3)).scene_changes.front().scene ==
          of_first->front().scene);
}

TEST_CASE("study: a different movement file under the same name gives a different point") {
    const TemporaryFolder folder;
    const std::string path =
        folder.write("s.toml", "[movement]\nfile = \"m.tcl\"\n[propagation]\nmodel = \"friis\"\n");
    const auto id = [&](const std::string& x) {
        folder.write("m.tcl",
                     "$node_(0) set X_ 1\n$node_(0) set Y_ 1\n$node_(0) set Z_ 0\n$ns_ at 1 "
                     "\"$node_(0) setdest " +
                         x + " 5 1\"\n");
        return Study(path, {}).points()[0].id;
    };
    CHECK(id("7") == id("7"));
    CHECK(id("7") != id("8"));
}

TEST_CASE("study: notices are about the study's points, not about the scenario's own values") {
    const TemporaryFolder folder;
    const auto notices = [&](const std::string& protocols) {
        const Study study(folder.write("s.toml", two_robots +
                                                     "kind = \"unicast\"\nto = \"r0\"\n[study]\n"
                                                     "vary.routing.protocol = [" +
                                                     protocols + "]\n"),
                          {});
        std::string all;
        for (const std::string& each : study.base().notices) all += each + "\n";
        return all;
    };
    CHECK(notices("\"aodv\", \"dsr\"") == "");
    CHECK(notices("\"aodv\", \"managed\"").find("go over one hop only") != std::string::npos);
}

TEST_CASE("study: a run's id depends on point, replication and version") {
    const std::string id = run_id("0123456789abcdef", 3, "0.1.0");
    CHECK(run_id("0123456789abcdef", 3, "0.1.0") == id);
    CHECK(run_id("0123456789abcdee", 3, "0.1.0") != id);
    CHECK(run_id("0123456789abcdef", 4, "0.1.0") != id);
    CHECK(run_id("0123456789abcdef", 3, "0.1.1") != id);
}

}  // namespace study_test
