// SPDX-License-Identifier: MIT
#include "scenario/scenario.hpp"

#include "scenario/document/json.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario_file.hpp"
#include "scenario/schema.hpp"
#include "test/scenario/json_schema.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace scenario_test {
using namespace rovernet;
using namespace std::chrono_literals;
using rovernet::test::TemporaryFolder;

namespace {

const std::string robot_a = "[[robot]]\nname = \"A\"\nat = [\"2 m\", \"3 m\"]\n";

// Every key of every table, none at its default.
const std::string every_key = R"([scenario]
name = "all"
duration = "12345678 us"
seed = 7
replication = 3
event_limit = 5000

[scene]
map = "m.png"
size = ["48 m", "24 m"]
floor_height = "4 m"
wall_height = "3 m"

[scene.materials]
glass = { greys = [90, 110], itu = "glass", thickness = "6 mm", height = "2 m" }
door = { grey = 50, color = "red", per_crossing = "2 dB", per_metre = "5 dB/m" }

[radio]
power = "21 dBm"
sensitivity = "-81.5 dBm"
frequency = "5200 MHz"
rate = "54 Mb/s"
preamble = "96 us"
antenna_gain = "2 dB"
antenna = "table"
antenna_direction = "90 deg"
antenna_beamwidth = "45 deg"
front_to_back = "30 dB"
antenna_pattern = [[-90.5, -12], [0, 0], [90, -12.25]]
cable_loss = "1 dB"
antenna_height = "150 cm"
bandwidth = "20 MHz"
noise_figure = "5 dB"
success_rate = 0.9
essid = "search"
channel = 6
gate = "none"
netmask = "255.0.0.0"
mode = "master"
encryption = true
range_db = "-60 dBm"

[medium]
propagation_delay = false

[propagation]
model = "itu_indoor"
coefficient = 28.0
environment = "office"
floors = 1
range = "77 m"
exponent = 3.5
sigma = "6 dB"
reference_distance = "2 m"
wall_factor = 10.0

[shadowing]
model = "field"
sigma = "6 dB"
decorrelation_distance = "7 m"

[fading]
model = "rician"
coherence = "place"
k_factor = "3 dB"
m = 1.5

[reception]
model = "collision"
capture_ratio = "6 dB"
capture = "later"
interference_cut = "3 dB"
preamble_threshold = "6 dB"

[access]
model = "csma"
slot = "20 us"
queue = 10
standard = "802.11a"
sifs = "10 us"
difs = "50 us"
cca_time = "4 us"
turnaround = "5 us"
rx_start_delay = "20 us"
cw_min = 15
cw_max = 63
basic_rates = ["6 Mbit/s", "12 Mbit/s"]
eifs = "ns2"
short_retries = 3
long_retries = 2
rts_threshold = "100 B"
header = "30 B"
priority = true

[links]
tolerance = "1 us"
min_dwell = "10 ms"

[movement]
syntax = "tolerant"

[[robot]]
name = "A"
at = ["2 m", "3 m", "1 m"]
radius = "30 cm"
radio = { power = "5 dBm", antenna_gain = "3 dB", ip = "10.1.1.2", mac = "00:01:02:03:04:06" }
propagation = { model = "disc", range = "20 m" }
move = { model = "waypoints", path = [["5 m", "3 m"], ["5 m", "9 m"]], speed = "2 m/s", times = ["1 s", "20 s"], order = "shuffled" }
on_receive = { payload = "F", from = "c", hops = 2, once = false, move = { model = "goal", to = ["1 m", "1 m"], speed = "3 m/s" } }
on_arrival = [{ send = "here", size = "9 B", once = false }, { stop = true, once = false }]
on_link_lost = { from = "c", once = false, stop = true }
on_time = { time = "3 s", send = "three", to = "c" }
heading = "90 deg"
top_speed = "2 m/s"
turn_rate = "45 deg/s"
off = ["1 s", "5 s"]
on = ["2 s"]

[[robot]]
name = "r"
count = 3
place = { model = "uniform", area = [["0 m", "0 m"], ["9 m", "9 m"]] }
move = { model = "goal", among = [["1 m", "1 m"], ["2 m", "2 m"]], speed = "1.5 m/s" }

[[robot]]
name = "c"
place = { model = "choice", points = [["1 m", "1 m"], ["2 m", "2 m"]] }
move = { model = "fixed" }

[routing]
protocol = "flood"
ttl = 9
duplicates = "forward"
upgrade = false
jitter = "7 ms"
ttl_in_payload = true

[[traffic]]
name = "warning"
kind = "broadcast"
hops = 1
from = "A"
payload = "F"
size = "99 B"
start = "10 s"
every = "3 s"
stop = "11 s"
count = 4

[[traffic]]
name = "beacon"
from = "r2"
size = "5 B"
start = "arrival"

[metrics]
reach = false
flows = false
robots = true
topology = true
path_stretch = true

[trace]
record = true
links = true
ns2 = "old"
mac = true

[study]
replications = 30
confidence = 0.9
precision = 0.02
max_replications = 60
warmup = "2 s"
metrics = ["reach"]
vary."propagation.model" = ["disc", "friis"]
vary."routing.ttl" = [1, 2, 3]
vary."routing.jitter" = ["1 ms", "2 ms", "3 ms"]
zip = [["routing.ttl", "routing.jitter"]]
exclude = [{ "propagation.model" = "disc", "routing.ttl" = [1, 2] }]
)";

/// Reads a scenario; its schema accepts each that is read.
Scenario read(const std::string& text) {
    static const Table schema = scenario_schema();
    const Value document = parse_toml(text, "s.toml");
    Scenario scenario = read_scenario(document, "s.toml");
    CAPTURE(text);
    CHECK(test::JsonSchema::accepts(schema, document));
    return scenario;
}

Scenario with(const std::string& text, const std::vector<std::string>& options) {
    const TemporaryFolder folder;
    return load_scenario(folder.write("s.toml", text), {.set = options});
}

std::string printed(const Scenario& scenario) { return to_toml(to_document(scenario)); }

/// Key paths of a document, list items without their number.
void list_keys(const Value& value, const std::string& path, std::vector<std::string>& out) {
    if (const Table* table = value.table()) {
        for (const auto& entry : table->entries) {
            const std::string key = path + "." + entry.key;
            out.push_back(key);
            list_keys(entry.value, key, out);
        }
    } else if (const Array* list = value.array()) {
        for (const auto& item : *list) list_keys(item, path, out);
    }
}

}  // namespace

TEST_CASE("scenario: one robot is enough, and all other keys have the documented defaults") {
    const Scenario s = read(robot_a);
    CHECK(s.scenario.name == "run");
    CHECK(s.scenario.duration == 60s);
    CHECK(s.scenario.seed == 1);
    CHECK(s.scenario.replication == 0);
    CHECK_FALSE(s.scene.map);
    CHECK(std::abs(s.radio.power.value - 10 * std::log10(45.0)) < 1e-12);
    CHECK(s.radio.sensitivity == Dbm{-75});
    CHECK(s.radio.frequency == Hertz{2450e6});
    CHECK(s.medium.propagation_delay);
    CHECK(s.propagation.model == 1);
    CHECK(std::get<Flood>(s.routing.parameters).ttl == 3);
    CHECK(std::get<Flood>(s.routing.parameters).jitter == 10ms);
    CHECK(s.trace.ns2 == Ns2Choice::none);
    REQUIRE(s.robots.size() == 1);
    CHECK(s.robots[0].at == Vec3{2, 3, 0});
    CHECK(s.robots[0].radius == Meters{0.2});
    CHECK(s.robots[0].move.model.index() == 0);
    CHECK(s.traffic.empty());
}

TEST_CASE("scenario: keys of protocols that are not chosen are checked and kept") {
    const std::string both =
        robot_a + "[routing]\nduplicates = \"forward\"\nhello = \"1 s\"\nprotocol = ";
    const Scenario flood = read(both + "\"flood\""), aodv = read(both + "\"aodv\"");
    CHECK(flood.routing.name() == "flood");
    CHECK(aodv.routing.name() == "aodv");
    for (const Scenario* s : {&flood, &aodv}) {
        CHECK(std::get<Aodv>(s->routing.parameters).hello == 1s);
        CHECK(std::get<Flood>(s->routing.parameters).duplicates == Duplicates::forward);
        CHECK(read(printed(*s)).routing.name() == s->routing.name());
        CHECK(std::get<Aodv>(read(printed(*s)).routing.parameters).hello == 1s);
    }
    const Scenario set = with(both + "\"flood\"", {"routing.protocol=aodv"});
    CHECK(printed(set) == printed(with(both + "\"aodv\"", {})));
    CHECK_THROWS_WITH(with(robot_a, {"routing.protocol=adov"}),
                      doctest::Contains("did you mean \"aodv\"?"));
    CHECK_THROWS_WITH(with(robot_a, {"routing.hullo=1"}),
                      doctest::Contains("did you mean \"hello\"?"));
}

TEST_CASE("scenario: every key of a scenario file is read and stored in the right field") {
    const Scenario s = read(every_key);
    CHECK(s.scenario.duration == 12345678us);
    CHECK(s.scenario.event_limit == 5000);
    CHECK(s.scene.floor_height == Meters{4});
    CHECK(s.radio.preamble == 96us);
    CHECK(s.radio.rate == BitRate{54e6});
    CHECK_FALSE(s.medium.propagation_delay);
    CHECK(s.propagation.model == 3);
    REQUIRE(s.robots.size() == 3);
    const RobotTable& a = s.robots[0];
    CHECK(a.at == Vec3{2, 3, 1});
    CHECK(a.radio.power == Dbm{5});
    CHECK(a.off == std::vector<Duration>{1s, 5s});
    CHECK(a.on == std::vector<Duration>{2s});
    const auto& path = std::get<WaypointsTable>(a.move.model);
    CHECK(path.path == std::vector<Vec3>{{5, 3, 0}, {5, 9, 0}});
    CHECK(path.times == std::vector<Duration>{1s, 20s});
    CHECK(path.order == WaypointsTable::Order::shuffled);
    REQUIRE(a.reactions.size() == 5);
    const ReactionTable& heard = a.reactions[0];
    CHECK(heard.trigger == Trigger::on_receive);
    CHECK(heard.from == "c");
    CHECK(heard.hops == 2);
    CHECK_FALSE(heard.once);
    CHECK(a.reactions[1].send == "here");
    CHECK(a.reactions[1].size == Bytes{9});
    CHECK(a.reactions[2].stop);
    CHECK(a.reactions[3].trigger == Trigger::on_link_lost);
    CHECK(a.reactions[4].time == Duration{3s});
    CHECK(a.heading == Radians{std::numbers::pi / 2});
    CHECK(a.top_speed == MetersPerSecond{2});
    CHECK(a.turn_rate == RadiansPerSecond{std::numbers::pi / 4});
    CHECK(s.radio.gate == Gate::none);
    CHECK(s.radio.antenna == AntennaShape::table);
    CHECK(s.radio.antenna_direction == Radians{std::numbers::pi / 2});
    REQUIRE(s.radio.antenna_pattern->size() == 3);
    CHECK(s.radio.antenna_pattern->front() == PatternPoint{-90.5, -12});
    CHECK(s.shadowing.model == ShadowingModel::field);
    CHECK(s.shadowing.decorrelation_distance == Meters{7});
    CHECK(s.fading.model == FadingModel::rician);
    CHECK(s.fading.coherence == Coherence::place);
    CHECK(s.fading.m == 1.5);
    CHECK(s.radio.labels.range_db == Dbm{-60});
    CHECK(s.links.tolerance == 1us);
    CHECK(s.movement.syntax == MovementSyntax::tolerant);
    REQUIRE(s.scene.materials.size() == 2);
    CHECK(s.scene.materials[0].itu == ItuMaterial::glass);
    CHECK(s.scene.materials[1].per_metre == DbPerMeter{5});
    CHECK(s.robots[1].count == 3);
    CHECK(s.robots[1].place->area.size() == 2);
    CHECK(s.robots[2].place->points.size() == 2);
    CHECK(std::get<Flood>(s.routing.parameters).duplicates == Duplicates::forward);
    CHECK_FALSE(std::get<Flood>(s.routing.parameters).upgrade);
    REQUIRE(s.traffic.size() == 2);
    CHECK(s.traffic[0].size == Bytes{99});
    CHECK(s.traffic[0].start == Duration{10s});
    CHECK(s.traffic[0].count == 4);
    CHECK_FALSE(s.traffic[1].start);
    CHECK(s.trace.ns2 == Ns2Choice::old_format);
    CHECK(s.study.replications == 30);
    REQUIRE(s.study.vary.size() == 3);
    CHECK(s.study.vary[0].path == "propagation.model");
    CHECK(s.study.vary[1].values.size() == 3);
    CHECK(s.study.warmup.given == Duration{2s});
    CHECK(s.study.zip.size() == 1);
    CHECK(s.study.exclude.size() == 1);
}

TEST_CASE("scenario: a scenario printed with all defaults is read back unchanged") {
    for (const auto& text : {robot_a, every_key}) {
        const std::string once = printed(read(text));
        CHECK(printed(read(once)) == once);
    }
}

TEST_CASE(
    "scenario: if the test scenario with all keys is printed, exactly the same keys are printed") {
    std::vector<std::string> given, shown;
    list_keys(parse_toml(every_key, ""), "", given);
    list_keys(Value(to_document(read(every_key))), "", shown);
    for (const auto& key : given) {
        CAPTURE(key);
        CHECK(std::count(shown.begin(), shown.end(), key) > 0);
    }
    for (const auto& key : shown) {
        CAPTURE(key);
        if (key.starts_with(".robot.propagation.")) continue;  // the scenario's, under its own
        CHECK(std::count(given.begin(), given.end(), key) > 0);
    }
}

TEST_CASE("scenario: in the test scenario that has all keys, no key has its default value") {
    const Table all = to_document(read(every_key));
    const Table usual = to_document(read(robot_a));
    for (const char* name : {"scenario", "scene", "radio", "medium", "routing", "trace", "study"}) {
        for (const auto& entry : usual.find(name)->table()->entries) {
            if (entry.key == "protocol") continue;  // there is one only
            CAPTURE(entry.key);
            CHECK(to_json(entry.value) != to_json(*all.find(name)->table()->find(entry.key)));
        }
    }
}

TEST_CASE(
    "scenario: keys of a model that is not selected are kept, so a sweep can select this model") {
    const std::string text = "[propagation]\nmodel = \"friis\"\nexponent = 3\nrange = \"50 m\"\n";
    const Scenario s = read(text + robot_a);
    CHECK(std::get<LogDistance>(s.propagation.parameters).exponent == 3);
    CHECK(std::get<Disc>(s.propagation.parameters).range == Meters{50});
    const Scenario swapped = with(printed(s), {"propagation.model=disc"});
    CHECK(swapped.propagation.model == 0);
    CHECK(std::get<Disc>(swapped.propagation.parameters).range == Meters{50});
}

TEST_CASE(
    "scenario: the key `coefficient` applies to the models `itu_indoor` and `raytrace_2007`") {
    const Scenario s = read("[propagation]\ncoefficient = 22\n" + robot_a);
    CHECK(std::get<ItuIndoor>(s.propagation.parameters).coefficient == 22);
    CHECK(std::get<Raytrace2007>(s.propagation.parameters).coefficient == 22);
}

TEST_CASE("scenario: a robot's own keys override [radio] and [propagation]") {
    const Scenario s = read(
        "[radio]\npower = \"10 dBm\"\nrate = \"1 Mb/s\"\n[propagation]\nmodel = \"log_distance\"\n"
        "exponent = 4\n" +
        robot_a + "radio = { power = \"20 dBm\" }\npropagation = { sigma = \"0 dB\" }\n");
    CHECK(s.robots[0].radio.power == Dbm{20});
    CHECK(s.robots[0].radio.rate == BitRate{1e6});
    CHECK(s.radio.power == Dbm{10});
    const auto& own = std::get<LogDistance>(s.robots[0].propagation->parameters);
    CHECK(s.robots[0].propagation->model == 4);
    CHECK(own.sigma == Db{0});
    CHECK(own.exponent == 4);
    CHECK(std::get<LogDistance>(s.propagation.parameters).sigma == Db{5});
}

TEST_CASE(
    "scenario: an OFDM standard sets the preamble and rate of radios, unless the scenario sets "
    "them") {
    const std::string ofdm = robot_a + "[access]\nmodel = \"csma\"\nstandard = \"802.11a\"\n";
    CHECK(read(ofdm).robots[0].radio.preamble == 20us);
    CHECK(read(ofdm).robots[0].radio.rate == BitRate{54e6});
    const Scenario own = read(ofdm + "[radio]\nrate = \"6 Mbit/s\"");
    CHECK(own.robots[0].radio.preamble == 20us);
    CHECK(own.robots[0].radio.rate == BitRate{6e6});
    CHECK(read(robot_a + "[access]\nmodel = \"csma\"").robots[0].radio.preamble == 192us);
}

TEST_CASE("scenario: traffic can name a single robot of those created with `count`") {
    const std::string robots = "[[robot]]\nname = \"r\"\ncount = 3\nat = [\"0 m\", \"0 m\"]\n";
    CHECK_NOTHROW(read(robots + "[[traffic]]\nfrom = \"r2\"\npayload = \"x\"\n"));
    CHECK_THROWS_AS(read(robots + "[[traffic]]\nfrom = \"r3\"\npayload = \"x\"\n"), InputError);
    CHECK_THROWS_AS(read(robots + "[[traffic]]\nfrom = \"r\"\npayload = \"x\"\n"), InputError);
}

TEST_CASE("--set can change any key of a scenario") {
    const std::string text = robot_a + "[[traffic]]\nfrom = \"A\"\npayload = \"F\"\n";
    const Scenario s =
        with(text, {"radio.power=15 dBm", "robot.A.radio.power=\"1 dBm\"", "traffic.0.start=2.5",
                    "propagation.model=friis", "radio.frequency=2.4e9", "scenario.duration=1e-3",
                    "robot.A.at=[1, \"2 km\"]", "trace.ns2=new"});
    CHECK(s.radio.power == Dbm{15});
    CHECK(s.robots[0].radio.power == Dbm{1});
    CHECK(s.traffic[0].start == Duration{2500ms});
    CHECK(s.propagation.model == 1);
    CHECK(s.radio.frequency == Hertz{2.4e9});
    CHECK(s.scenario.duration == 1ms);
    CHECK(s.robots[0].at == Vec3{1, 2000, 0});
    CHECK(s.trace.ns2 == Ns2Choice::new_format);
}

TEST_CASE("--set: a power without a unit is in watts") {
    constexpr double rounding_db = 1e-12;
    const Scenario s = with(robot_a, {"radio.power=0.1"});
    CHECK(std::abs(s.radio.power.value - 20) < rounding_db);
}

TEST_CASE("--set: if two options set the same key, the last one counts") {
    CHECK(with(robot_a, {"scenario.seed=2", "scenario.seed=3"}).scenario.seed == 3);
}

}  // namespace scenario_test
