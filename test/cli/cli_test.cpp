// SPDX-License-Identifier: MIT
#include "test/cli/process.hpp"
#include "test/scene/png_writer.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <sstream>
#include <thread>

namespace cli_test {
using namespace rovernet::test;
namespace fs = std::filesystem;

namespace {

const std::string relay = R"([scenario]
name = "relay"
duration = "20 s"
seed = 5
[propagation]
model = "disc"
range = "10 m"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["8 m", "0 m"]
move = { model = "waypoints", path = [["8 m", "5 m"]], speed = "0.5 m/s" }
off = ["9 s"]
on = ["14 s"]
[[robot]]
name = "C"
at = ["16 m", "0 m"]
[[robot]]
name = "D"
at = ["17 m", "4 m"]
[[traffic]]
from = "A"
payload = "F"
every = "1 s"
[[traffic]]
from = "D"
size = "64 B"
start = "500 ms"
every = "3 s"
count = 4
[trace]
ns2 = "new"
)";

std::vector<std::string> names_in(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

const std::vector<std::string> result_files = {"scenario.toml", "summary.json", "trace.tr"};

}  // namespace

TEST_CASE(
    "command line: if an option is before its command, the error says where to write the option") {
    const TemporaryFolder folder;
    for (const char* option : {"-q", "--quiet", "--json"}) {
        CAPTURE(option);
        const Ended ended = command(folder, {option, "scene", "s.toml"});
        CHECK(ended.exit == 2);
        CHECK(ended.err ==
              fmt::format("rovernet: the option \"{}\" is before the command; write it "
                          "after \"scene\"\n",
                          option));
    }
}

TEST_CASE("run --json prints the results as one JSON document") {
    const TemporaryFolder folder;
    const Json run =
        json_of(folder, {"run", folder.write("s.toml", relay), "--out", folder.path("out")});
    for (const char* key : {"name", "seed", "fingerprint", "sim_s", "wall_s", "events", "messages",
                            "transmissions", "receptions", "delivery_ratio", "drops", "trace"}) {
        CAPTURE(key);
        CHECK(run.contains(key));
    }
    CHECK(run["name"] == "relay");
    CHECK(run["seed"] == 5);
    CHECK(run["sim_s"] == 20.0);
    CHECK(run["messages"] == 25);  // at 0, 1 ... 20 s, the end included, and 4 of D's
    CHECK(run["trace"] == folder.path("out/trace.tr"));
    CHECK(run["drops"].is_object());
}

TEST_CASE(
    "run: the results folder has the summary, the scenario and the trace, and no unfinished file") {
    const TemporaryFolder folder;
    const std::string out = folder.path("out");
    const Json run = json_of(folder, {"run", folder.write("s.toml", relay), "--out", out});
    CHECK(names_in(out) == result_files);
    Json summary = Json::parse(content(out + "/summary.json"));
    for (const auto& [key, value] : run.items()) CHECK(summary[key] == value);
    for (const char* key : {"version", "host", "started", "wall_s"}) {
        CHECK(summary["provenance"].contains(key));
    }
    CHECK(summary["scenario"]["robot"].size() == 4);
    CHECK(summary["scenario"]["routing"]["ttl"] == 3);
    CHECK(summary["scenario"]["radio"]["sensitivity"] == "-75 dBm");
}

TEST_CASE(
    "run: in an existing results folder, files of the user stay, and files of rovernet are "
    "replaced") {
    const TemporaryFolder folder;
    const std::string out = folder.path("out");
    fs::create_directory(out);
    folder.write("out/notes.txt", "mine");
    folder.write("out/summary.json", "old");
    folder.write("out/trace.tr", "old");
    json_of(folder, {"run", folder.write("s.toml", relay), "--out", out});
    CHECK(content(out + "/notes.txt") == "mine");
    CHECK(content(out + "/summary.json").size() > 100);
    CHECK(content(out + "/trace.tr").size() > 100);
    CHECK(names_in(out).size() == 4);
}

TEST_CASE("run: runs with different values of --set have folders with different names") {
    const TemporaryFolder folder;
    folder.write("s.toml", relay);
    for (const std::string set : {"", "--set 'radio.power=20 dBm'", "--set routing.ttl=1"}) {
        const std::string line =
            "cd '" + folder.path("") + "' && exec '" ROVERNET_COMMAND "' run s.toml " + set;
        CHECK(Process(folder, {"-c", line}, "/bin/sh").wait().exit == 0);
    }
    CHECK(names_in(folder.path("runs")) == std::vector<std::string>{"relay-s5",
                                                                    "relay-s5-radio.power=20dBm",
                                                                    "relay-s5-routing.ttl=1"});
    for (const std::string& run : names_in(folder.path("runs"))) {
        CHECK(names_in(folder.path("runs/" + run)) == result_files);
    }
}

TEST_CASE(
    "run: the same run is given by the output of --print-scenario and by the saved scenario.toml") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", relay), out = folder.path("out");
    const auto fingerprint = [&](const std::string& scenario) {
        return json_of(folder, {"run", scenario, "--out", out})["fingerprint"];
    };
    const Json expected = fingerprint(file);
    const Ended printed = command(folder, {"run", file, "--print-scenario"});
    REQUIRE(printed.exit == 0);
    CHECK(fingerprint(folder.write("printed.toml", printed.out)) == expected);
    fs::copy_file(out + "/scenario.toml", folder.path("again.toml"));
    CHECK(fingerprint(folder.path("again.toml")) == expected);
}

TEST_CASE("run: --seed and --set change the run; the same seed gives the same run") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", relay), out = folder.path("out");
    const auto fingerprint = [&](const std::string& option, const std::string& value) {
        return json_of(folder, {"run", file, "--out", out, option, value})["fingerprint"];
    };
    CHECK(fingerprint("--seed", "5") == fingerprint("--set", "scenario.seed=5"));
    CHECK(fingerprint("--seed", "5") != fingerprint("--seed", "6"));
    CHECK(fingerprint("--seed", "5") != fingerprint("--set", "robot.B.off=[1]"));
}

TEST_CASE(
    "trace stats: metrics equal those of the summary to the last digit, for both ns-2 formats") {
    std::string routed =
        "[scenario]\nduration = \"4 s\"\n[routing]\nprotocol = \"aodv\"\n"
        "[propagation]\nmodel = \"disc\"\nrange = \"250 m\"\n"
        "[access]\nmodel = \"csma\"\n"
        "[[traffic]]\nkind = \"unicast\"\nfrom = \"n0\"\nto = \"n3\"\n"
        "size = \"64 B\"\nstart = \"1 s\"\nevery = \"250 ms\"\n";
    for (int i = 0; i < 4; ++i) {
        routed += "[[robot]]\nname = \"n" + std::to_string(i) + "\"\nat = [\"" +
                  std::to_string(200 * i) + " m\", \"0 m\"]\n" +
                  (i == 2 ? "off = [\"3 s\"]\n" : "");
    }
    for (const auto& each : {std::pair<std::string, std::string>{"old", relay},
                             {"new", relay},
                             {"old", routed},
                             {"new", routed}}) {
        const std::string &format = each.first, &scenario = each.second;
        CAPTURE(format);
        CAPTURE(scenario);
        const TemporaryFolder folder;
        const std::string out = folder.path("out");
        json_of(folder, {"run", folder.write("s.toml", scenario), "--out", out, "--set",
                         "trace.ns2=" + format, "--set", "trace.mac=true"});
        const Json summary = Json::parse(content(out + "/summary.json"));
        const Json stats = json_of(folder, {"trace", "stats", out + "/trace.tr"});
        int compared = 0;
        for (const auto& metric : stats.items()) {
            const std::string key = metric.key();
            CAPTURE(key);
            if (!summary.contains(key)) continue;
            ++compared;
            // As in ns-2, lines at RTR have one transmission for each hop, however often the MAC
            // repeats it; D MAC RET is no end.
            const bool differs =
                key == "transmissions" || key == "saved_rebroadcasts" || key == "drops";
            if (scenario == routed && differs) continue;
            CHECK(summary[key].dump() == metric.value().dump());
        }
        CHECK(compared == 20);
        CHECK(stats["format"] == format);
        CHECK(stats["refused"] == 0);
        CHECK(stats["lines"] == stats["event_lines"]);
    }
}

TEST_CASE("the delivery ratio can be computed from the columns of an ns-2 trace") {
    const TemporaryFolder folder;
    const Json run = json_of(folder, {"run", folder.write("s.toml", relay), "--out",
                                      folder.path("out"), "--set", "trace.ns2=old"});
    std::istringstream trace(content(folder.path("out/trace.tr")));
    int sent = 0, received = 0, cut_off = 0;
    for (std::string line; std::getline(trace, line);) {
        std::istringstream words(line);
        std::string event, time, node, layer;
        words >> event >> time >> node >> layer;
        sent += event == "s" && layer == "AGT";
        received += event == "r" && layer == "AGT";
        cut_off += event == "D" && layer == "AGT";
    }
    constexpr int others = 3;
    CHECK(sent == run["messages"]);
    CHECK(cut_off == run["cut_off"]);
    CHECK(std::abs(static_cast<double>(received) / ((sent - cut_off) * others) -
                   run["delivery_ratio"].get<double>()) < 1e-12);
}

TEST_CASE("loss: the free-space loss at one metre and 2450 MHz is 40.23 dB") {
    constexpr double half_digit = 0.005;
    const TemporaryFolder folder;
    const Json loss = json_of(folder, {"loss", "friis", "--distance", "1,10,1 km"});
    CHECK(loss["model"] == "friis");
    CHECK(loss["frequency_hz"] == 2450e6);
    REQUIRE(loss["rows"].size() == 3);
    CHECK(loss["rows"][2]["distance_m"] == 1000.0);
    CHECK(std::abs(loss["rows"][0]["loss_db"].get<double>() - 40.23) < half_digit);
    CHECK(std::abs(loss["rows"][1]["loss_db"].get<double>() - 60.23) < half_digit);
}

TEST_CASE("loss --wall: half a metre of wall at 2 dB per centimetre attenuates by 100 dB") {
    const TemporaryFolder folder;
    const auto loss = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = {"loss", "raytrace_2007", "wall_factor=2",
                                              "--distance", "10"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return json_of(folder, arguments)["rows"][0]["loss_db"].get<double>();
    };
    CHECK(std::abs(loss({"--wall", "50 cm"}) - loss({}) - 100) < 1e-9);
    CHECK(command(folder, {"loss", "friis", "--distance", "1", "--wall", "2"}).exit == 2);
}

TEST_CASE(
    "loss --heights: for antennas 1.5 m high, the loss by `two_ray` equals the test vectors") {
    const TemporaryFolder folder;
    const auto loss = [&](const std::string& heights) {
        return json_of(
            folder, {"loss", "two_ray", "form=exact", "polarization=horizontal", "--distance", "10",
                     "--heights", heights, "--frequency", "2398339664 Hz"});
    };
    const Json both = loss("1.5,1.5");
    CHECK(std::abs(both["rows"][0]["loss_db"].get<double>() - 54.8584734406206) < 1e-6);
    CHECK(both["from_height_m"] == 1.5);
    CHECK(loss("1.5") == both);  // one height is that of both antennas
    CHECK(command(folder, {"loss", "friis", "--distance", "1", "--heights", "1,2,3"}).exit == 2);
}

TEST_CASE("loss: each of several models has a column in the table and a curve in the drawing") {
    const TemporaryFolder folder;
    const std::vector<std::string> models = {"loss", "friis", "log_distance", "exponent=4", "disc"};
    const auto with = [&](std::vector<std::string> words, std::size_t number) {
        words.insert(words.begin(), models.begin(),
                     models.begin() + static_cast<std::ptrdiff_t>(number));
        return words;
    };
    const Ended text = command(folder, with({"--distance", "1,10"}, 4));
    CHECK(text.out ==
          "  distance [m]     friis [dB] log_distance exponent=4 [dB]\n"
          "             1      40.231105                    40.231105\n"
          "            10      60.231105                    80.231105\n");
    const Json list = json_of(folder, with({"--distance", "10"}, 4));
    REQUIRE(list.size() == 2);
    CHECK(list[1]["model"] == "log_distance");
    CHECK(list[1]["parameters"] == Json::array({"exponent=4"}));
    CHECK(list[1]["rows"][0]["distance_m"] == 10.0);

    CHECK(command(folder, with({"--distance", "1,100", "-o", folder.path("loss.svg")}, 4)).exit ==
          0);
    const std::string svg = content(folder.path("loss.svg"));
    CHECK(svg.find(">log_distance exponent=4</text>") != svg.npos);
    CHECK(svg.find("path loss [dB]") != svg.npos);
    for (const auto& [words, number] : {std::pair<std::vector<std::string>, std::size_t>{
                                            {"--distance", "1", "-o", folder.path("x.svg")}, 4},
                                        {{"--distance", "0,1", "-o", folder.path("x.svg")}, 4},
                                        {{"--distance", "1,2", "-o", folder.path("x.svg")}, 5},
                                        {{"--distance", "1,2", "-o", "x.txt"}, 4}}) {
        const Ended ended = command(folder, with(words, number));
        CAPTURE(ended.err);
        CHECK(ended.exit != 0);
        CHECK(!std::filesystem::exists(folder.path("x.svg")));
    }
}

TEST_CASE("link --json prints the budget of a link and the walls that the link crosses") {
    const TemporaryFolder folder;
    const png_byte w = 255;
    folder.write(
        "walls.png",
        rovernet::test::png_bytes(
            {.width = 8, .height = 1, .rows = {std::vector<png_byte>{w, w, w, w, 0, w, w, w}}}));
    const std::string file =
        folder.write("s.toml",
                     "[scene]\nmap = \"walls.png\"\nsize = [\"8 m\", \"2 m\"]\n"
                     "[propagation]\nmodel = \"raytrace_2007\"\n"
                     "[[robot]]\nname = \"A\"\nat = [\"1 m\", \"1 m\"]\n"
                     "[[robot]]\nname = \"B\"\nat = [\"7 m\", \"1 m\"]\noff = [\"5 s\"]\n");
    const Json link = json_of(folder, {"link", file, "A", "B"});
    CHECK(link["from"] == "A");
    CHECK(link["to"] == "B");
    CHECK(link["model"] == "raytrace_2007");
    CHECK(link["at_s"] == 0.0);
    CHECK(link["distance_m"] == 6.0);
    REQUIRE(link["walls"].size() == 1);
    constexpr double rounding_m = 1e-9;
    CHECK(std::abs(link["walls"][0]["entry_m"].get<double>() - 3) < rounding_m);
    CHECK(std::abs(link["walls"][0]["exit_m"].get<double>() - 4) < rounding_m);
    CHECK(std::abs(link["wall_m"].get<double>() - 1) < rounding_m);
    CHECK(std::abs(link["walls"][0]["loss_db"].get<double>() - 100) < rounding_m);  // 1 dB/cm
    const double margin = link["margin_db"], received = link["rx_power_dbm"];
    CHECK(std::abs(received + 75 - margin) < rounding_m);
    CHECK(link["up"] == (margin >= 0));
    CHECK(command(folder, {"link", file, "A", "B", "-o", folder.path("budget.svg")}).exit == 0);
    const std::string svg = content(folder.path("budget.svg"));
    CHECK(svg.find(">wall at 3.0 m: ") != svg.npos);
    CHECK(svg.find(">-100.0 dB</text>") != svg.npos);
    CHECK(svg.find(fmt::format(">{:.1f} dBm</text>", received)) != svg.npos);

    const auto loss_by = [&](const std::string& model) {
        return json_of(folder, {"link", file, "A", "B", "--set",
                                "propagation=" + model})["walls"][0]["loss_db"];
    };
    CHECK(loss_by("{ model = \"friis\" }") == 0.0);
    for (const char* model :
         {"{ model = \"rays\" }", "{ model = \"itu_site_general\", los = \"map\" }",
          "{ model = \"disc\", range = \"9 m\" }"})
        CHECK(loss_by(model).is_null());
    std::vector<std::string> clear = {"link", file, "A", "B", "--set", "propagation.model=friis"};
    CHECK(json_of(folder, clear)["up"] == true);
    clear.insert(clear.end(), {"--at", "6"});
    CHECK(json_of(folder, clear)["up"] == false);
    CHECK(json_of(folder, clear)["why_down"] == "B is off");
    CHECK(json_of(folder, clear)["at_s"] == 6.0);
}

TEST_CASE("link --json prints the loss of each wall, and for a link that is down, the reason") {
    const TemporaryFolder folder;
    const png_byte w = 255;
    folder.write(
        "walls.png",
        png_bytes(
            {.width = 8, .height = 1, .rows = {std::vector<png_byte>{w, w, 0, w, w, 60, w, w}}}));
    const std::string file = folder.write("s.toml", R"([scene]
map = "walls.png"
size = ["8 m", "2 m"]
[scene.materials]
door = { grey = 60, per_crossing = "3 dB" }
[propagation]
model = "raytrace_2007"
wall_factor = 0.1
[[robot]]
name = "A"
at = ["1 m", "1 m"]
[[robot]]
name = "B"
at = ["7 m", "1 m"]
[[robot]]
name = "deaf"
at = ["7 m", "1 m"]
radio = { sensitivity = "0 dBm" }
)");
    constexpr double rounding_db = 1e-9;
    const Json link = json_of(folder, {"link", file, "A", "B"});
    REQUIRE(link["walls"].size() == 2);
    CHECK(std::abs(link["walls"][0]["loss_db"].get<double>() - 10) < rounding_db);
    CHECK(std::abs(link["walls"][1]["loss_db"].get<double>() - 3) < rounding_db);
    CHECK(link["why_down"].is_null());
    const auto why = [&](const std::string& to, const std::string& set) -> std::string {
        return json_of(folder, {"link", file, "A", to, "--set", set})["why_down"];
    };
    CHECK(why("B", "robot.B.radio.frequency=5.2 GHz") ==
          "the robots are in different networks: frequency 2450 MHz and 5200 MHz");
    CHECK(why("B", "robot.B.radio.channel=7") ==
          "the robots are in different networks: channel 0 and 7");
    CHECK(why("deaf", "scenario.seed=2") ==
          "the received power is below the receiver's sensitivity");
}

TEST_CASE(
    "models --json lists the models, also those of shadowing and fading, with their parameters") {
    const TemporaryFolder folder;
    const Json listed = json_of(folder, {"models"});
    Json models = listed["models"];
    CHECK(models.size() >= 5);
    CHECK(listed["variations"].size() == 2);  // shadowing and fading
    for (const auto& variation : listed["variations"]) models.push_back(variation);
    for (const auto& model : models) {
        CHECK(model["name"].is_string());
        for (const auto& parameter : model["parameters"]) {
            for (const char* key : {"name", "default", "range", "meaning"}) {
                CHECK(parameter.contains(key));
            }
        }
    }
}

TEST_CASE(
    "the command `models NAME` prints one model; for an unknown name it suggests a known name") {
    const TemporaryFolder folder;
    const Json listed = json_of(folder, {"models", "friis"});
    REQUIRE(listed["models"].size() == 1);
    CHECK(listed["models"][0]["name"] == "friis");
    const Ended wrong = command(folder, {"models", "fris"});
    CHECK(wrong.exit == 2);
    CHECK(wrong.err.find("did you mean \"friis\"?") != std::string::npos);
}

TEST_CASE("the command `version` and the option --version print the version of rovernet") {
    const TemporaryFolder folder;
    const std::string version = json_of(folder, {"version"})["version"];
    CHECK(command(folder, {"--version"}).out == version + "\n");
    CHECK(command(folder, {"version"}).out.starts_with("rovernet " + version + "\n"));
}

TEST_CASE("the command `version` lists the models that can be chosen in each table of a scenario") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", relay);
    const Json models = json_of(folder, {"version"})["models"];
    const std::string text = command(folder, {"version"}).out;
    const auto complaint = [&](const std::string& table, const std::string& name) {
        const std::string key = table == "routing" ? "routing.protocol"
                                : table == "move"  ? "robot.A.move.model"
                                                   : table + ".model";
        return command(folder, {"run", file, "--print-scenario", "--set", key + "=" + name}).err;
    };
    for (const auto& model : models.items()) {
        const std::string& table = model.key();
        const auto& names = model.value();
        CAPTURE(table);
        CHECK(names.size() > 1);
        CHECK(complaint(table, "nonesuch").find("nonesuch") != std::string::npos);
        for (const std::string name : names) {
            CAPTURE(name);
            CHECK(text.find(name) != std::string::npos);
            CHECK(complaint(table, name).find("unknown") == std::string::npos);
        }
    }
}

TEST_CASE("run --speed gives the same fingerprint as a run without --speed") {
    const TemporaryFolder folder;
    std::vector<std::string> arguments = {"run",   folder.write("s.toml", relay),
                                          "--out", folder.path("out"),
                                          "--set", "scenario.duration=2"};
    const Json expected = json_of(folder, arguments)["fingerprint"];
    arguments.insert(arguments.end(), {"--speed", "50"});
    CHECK(json_of(folder, arguments)["fingerprint"] == expected);
}

TEST_CASE("Ctrl-C ends a run with exit code 130 and leaves no trace file, complete or partial") {
    using namespace std::chrono_literals;
    const TemporaryFolder folder;
    const std::string out = folder.path("out");
    const Process run(
        folder, {"run", folder.write("s.toml", relay), "--out", out, "--speed", "0.01", "--json"});
    for (int i = 0; i < 2000 && !(fs::exists(out) && names_in(out).size() == 1); ++i) {
        std::this_thread::sleep_for(5ms);
    }
    run.interrupt();
    const Ended ended = run.wait();
    CHECK(ended.exit == 130);
    CHECK(ended.out.empty());
    CHECK(ended.err.find("interrupted") != std::string::npos);
    CHECK(names_in(out).empty());
}

TEST_CASE("a run that needs more events than allowed exits with code 1 and writes no trace") {
    const TemporaryFolder folder;
    const Ended ended = command(folder, {"run", folder.write("s.toml", relay), "--out",
                                         folder.path("out"), "--set", "scenario.event_limit=5"});
    CHECK(ended.exit == 1);
    CHECK(ended.out.empty());
    CHECK(ended.err.find("event") != std::string::npos);
    CHECK(names_in(folder.path("out")).empty());
}

TEST_CASE("message storm: the run fails, the error says what to change, and older results stay") {
    const TemporaryFolder folder;
    const std::string out = folder.path("out");
    const std::string calm = folder.write("s.toml", R"([scenario]
event_limit = 20000
[propagation]
model = "disc"
range = "1 m"
[[robot]]
name = "r"
count = 10
place = { model = "uniform", area = [["0 m", "0 m"], ["0.1 m", "0.1 m"]] }
[routing]
ttl = 1
[[traffic]]
from = "r0"
payload = "F"
[trace]
ns2 = "new"
)");
    CHECK(json_of(folder, {"run", calm, "--out", out})["deliveries"] == 9);
    std::vector<std::string> before;
    for (const auto& file : result_files) before.push_back(content(out + "/" + file));

    const Ended ended = command(folder, {"run", calm, "--out", out, "--set", "routing.ttl=65535",
                                         "--set", "routing.duplicates=forward"});
    CHECK(ended.exit == 1);
    CHECK(ended.out.empty());
    CAPTURE(ended.err);
    for (const char* part : {"event limit of 20000 is reached at 0.0",
                             "raise [scenario] event_limit", "lower the load", "a smaller ttl"}) {
        CHECK(ended.err.find(part) != std::string::npos);
    }
    CHECK(names_in(out) == result_files);
    for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(content(out + "/" + result_files[i]) == before[i]);
    }
}

TEST_CASE("run: with range 0 no message arrives; a negative range is refused, with file and line") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", relay), out = folder.path("out");
    const Json run = json_of(folder, {"run", file, "--out", out, "--set", "propagation.range=0 m"});
    CHECK(run["transmissions"] == run["messages"]);
    CHECK(run["receptions"] == 0);
    const std::string below =
        folder.write("below.toml", "[propagation]\nmodel = \"disc\"\nrange = \"-1 m\"\n");
    const Ended ended = command(folder, {"run", below, "--out", out});
    CHECK(ended.exit == 3);
    CAPTURE(ended.err);
    for (const char* part : {"below.toml:3:", "range", ">= 0", "-1"}) {
        CHECK(ended.err.find(part) != std::string::npos);
    }
}

TEST_CASE("a run whose results cannot be written exits with 1, and the message names the folder") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", relay);
    const Ended ended = command(folder, {"run", file, "--out", file + "/out"});
    CHECK(ended.exit == 1);
    CHECK(ended.out.empty());
    CHECK(ended.err.find(file + "/out") != std::string::npos);
}

TEST_CASE("trace diff: a trace differs from a part cut out of it, but not from a converted copy") {
    const TemporaryFolder folder;
    const std::string out = folder.path("out"), trace = out + "/trace.tr";
    json_of(folder, {"run", folder.write("s.toml", relay), "--out", out, "--set", "trace.ns2=old",
                     "--set", "trace.mac=true"});
    const std::string as_new = folder.path("new.tr"), piece = folder.path("piece.tr");
    CHECK(command(folder, {"trace", "convert", trace, as_new, "--to", "ns2-new"}).exit == 0);
    CHECK(command(folder, {"trace", "diff", trace, as_new}).exit == 0);
    CHECK(command(folder, {"trace", "cut", trace, piece, "--message", "0"}).exit == 0);
    const Ended differ = command(folder, {"trace", "diff", trace, piece});
    CHECK(differ.exit == 1);
    CHECK(differ.out.find("the first difference: ") != std::string::npos);
    const Ended way = command(folder, {"trace", "follow", trace, "--message", "0"});
    CHECK(way.exit == 0);
    CHECK(way.out.starts_with("message 0 of A for everybody, sent at "));
    CHECK(command(folder, {"trace", "follow", trace, "--message", "0", "--robot", "B"})
              .out.find("B  from A after ") != std::string::npos);
    const Ended unknown =
        command(folder, {"trace", "follow", trace, "--message", "0", "--robot", "Z"});
    CHECK(unknown.exit == 2);
    CHECK(unknown.err.find("no robot has this name") != std::string::npos);
    CHECK(command(folder, {"trace", "follow", trace, "--message", "9999"}).exit == 3);
    CHECK(command(folder, {"trace", "stats", folder.path("s.toml")}).exit == 3);
    const Ended rows = command(folder, {"trace", "stats", trace, "--by", "robot", "--csv"});
    CHECK(rows.out.starts_with("robot,messages,deliveries,"));
}

TEST_CASE("trace stats: an invalid line is counted and shown, and is an error with --strict") {
    const TemporaryFolder folder;
    const std::string trace = folder.write(
        "x.tr", "s 1.0 _0_ AGT  --- 0 cbr 5 [0 0 0 0] ------- [0:0 1:0 32 0] \nhello\n");
    const Ended read = command(folder, {"trace", "stats", trace, "--json"});
    CHECK(read.exit == 0);
    CHECK(Json::parse(read.out)["refused"] == 1);
    CHECK(Json::parse(read.out)["refused_lines"][0]["line"] == 2);
    CHECK(read.err.find("x.tr:2:1: found \"hello\"") != std::string::npos);
    CHECK(command(folder, {"trace", "stats", trace, "--strict"}).exit == 3);
}

}  // namespace cli_test
