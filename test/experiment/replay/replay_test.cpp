// SPDX-License-Identifier: MIT
#include "experiment/replay/replay.hpp"

#include "experiment/recorded_scenario.hpp"
#include "experiment/run.hpp"
#include "experiment/session.hpp"
#include "experiment/summary.hpp"
#include "scenario/document/json.hpp"
#include "scenario/scenario_file.hpp"
#include "test/traces/record_stream.hpp"
#include "traces/fingerprint.hpp"
#include "traces/metrics.hpp"
#include "traces/ns2/ns2_trace.hpp"
#include "traces/recorded/record_text.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <memory>

namespace replay_test {
using namespace rovernet;
namespace {

using namespace testing;

/// A scenario that was run with `[trace] record`.
struct RecordedRunOf {
    TempFolder folder;
    RunResult result;
    std::string trace = folder / "trace.mcap";

    RecordedRunOf(const std::string& path, std::vector<std::string> set) {
        for (const char* each : {"trace.record=true", "trace.ns2=old", "trace.mac=true"}) {
            set.emplace_back(each);
        }
        result =
            run_scenario(load_scenario(path, {.set = set}), {.folder = folder / ".", .speed = {}});
    }
};

/// Seven robots that move, speak to everyone and to one another, and are switched off and on.
const char* const busy = R"(
[scenario]
name = "busy"
duration = "6 s"
[radio]
power = "12 dBm"
[[robot]]
count = 5
name = "r"
place = { model = "uniform", area = [["0 m", "0 m"], ["60 m", "60 m"]] }
move = { model = "random_waypoint", area = [["0 m", "0 m"], ["60 m", "60 m"]], min_speed = "1 m/s", max_speed = "3 m/s" }
[[robot]]
name = "A"
at = ["10 m", "10 m"]
[[robot]]
name = "B"
at = ["30 m", "10 m"]
[[traffic]]
from = "A"
every = "100 ms"
size = "200 B"
[[traffic]]
from = "B"
kind = "unicast"
to = "A"
every = "150 ms"
size = "900 B"
start = "1 s"
)";

const std::string examples = ROVERNET_EXAMPLES;

TEST_CASE("an example's run is repeated from its trace, with equal fingerprint and ns-2 trace") {
    for (const char* name : {"patrol/patrol.toml", "rescue/rescue.toml", "stage/office.world"}) {
        CAPTURE(name);
        const RecordedRunOf run(examples + "/" + name, {});
        const auto fingerprint = std::make_shared<Fingerprint>();
        const auto text = std::make_shared<Ns2Trace>(run.folder / "later.tr", Ns2Format::old_format,
                                                     MacTrace::on);
        RecordedReader(run.trace).read(Sink(fingerprint));
        RecordedReader(run.trace).read(Sink(text));
        text->close();
        CHECK(fingerprint->text() == run.result.fingerprint);
        CHECK(content(run.folder / "later.tr") == content(run.folder / "trace.tr"));
        const Verification again = verify_replay(run.trace, {});
        CHECK_FALSE(again.difference);
        CHECK(again.same > 0);
        CHECK(again.damage.empty());
        CHECK(again.recorded_by == again.version);
    }
}

TEST_CASE("metrics from a recorded trace equal those of the run") {
    for (const char* warmup : {"0 s", "10 s"}) {
        const RecordedRunOf run(examples + "/patrol/patrol.toml",
                                {"scenario.duration=30 s", fmt::format("study.warmup={}", warmup)});
        std::vector<std::string> damage;
        Table before, after;
        append_metrics(before, run.result.metrics);
        append_metrics(after, recorded_metrics(run.trace, damage));
        CHECK(to_json(after) == to_json(before));
        CHECK(damage.empty());
    }
}

TEST_CASE(
    "for several models of propagation, reception and access, a run can be repeated from its "
    "trace") {
    TempFolder folder;
    const std::string path = folder / "busy.toml";
    testing::write_file(path, busy);
    for (const char* set : {"propagation.model=log_distance", "propagation.model=two_ray",
                            "propagation.model=multi_wall", "reception.model=collision",
                            "reception.model=sinr", "access.model=csma", "access.model=aloha"}) {
        CAPTURE(set);
        const RecordedRunOf run(path, {set, "trace.links=true"});
        const Verification again = verify_replay(run.trace, {});
        CHECK_FALSE(again.difference);
        CHECK(again.same > 500);
    }
}

TEST_CASE("a run that stopped between the receptions of a frame can be repeated from its trace") {
    TempFolder folder;
    testing::write_file(folder / "busy.toml", busy);
    const RecordedRunOf whole(folder / "busy.toml", {});
    std::vector<Time> firsts;
    RecordedReader reader(whole.trace);
    std::uint64_t records = 0;
    for (; const Record* record = reader.next(); ++records) {
        const auto* received = std::get_if<Received>(record);
        if (received) firsts.push_back(received->receptions[0].time);
    }
    const Scenario scenario = load_scenario(folder / "busy.toml", {.set = {"trace.record=true"}});
    ScenarioRun run(scenario);
    run.write_to(folder / "stopped");
    for (const Time time : firsts) run.session().step(time);
    run.session().step(run.session().end());
    run.finish();
    const Verification again = verify_replay(folder / "stopped/trace.mcap", {});
    CHECK_FALSE(again.difference);
    CHECK(again.same > records);
}

TEST_CASE("a run can be repeated from a trace of format 3, which lacks bit rates of frames") {
    // Two robots with 802.11b, recorded by the commit 155f421f.
    const std::string path = std::string(ROVERNET_TEST_DATA) + "/recorded_format3.mcap";
    RecordedReader trace(path);
    CHECK(trace.format() == 3);
    const Verification again = verify_replay(path, {});
    CHECK_FALSE(again.difference);
    CHECK(again.same == 28);
}

TEST_CASE("a run can be repeated from a trace of format 4, which lacks sizes of frames") {
    // Two robots with AODV, recorded before format 5.
    const std::string path = std::string(ROVERNET_TEST_DATA) + "/recorded_format4.mcap";
    CHECK(RecordedReader(path).format() == 4);
    const Verification again = verify_replay(path, {});
    CHECK_FALSE(again.difference);
    CHECK(again.same > 20);
}

TEST_CASE(
    "if the scenario no longer reproduces its trace, the line that differs is shown, old and new") {
    const RecordedRunOf run(examples + "/patrol/patrol.toml", {"scenario.duration=30 s"});
    std::string bytes = content(run.trace);
    const auto at = bytes.find("seed = 3");
    REQUIRE(at != bytes.npos);
    bytes[at + 7] = '4';
    testing::write_file(run.trace, bytes);
    const Verification again = verify_replay(run.trace, {});
    REQUIRE(again.difference);
    CHECK(again.difference->recorded != again.difference->now);
}

TEST_CASE("an incomplete trace is compared up to its end, and the missing end is reported") {
    const RecordedRunOf run(examples + "/patrol/patrol.toml", {"scenario.duration=30 s"});
    const std::string bytes = content(run.trace);
    testing::write_file(run.trace, bytes.substr(0, bytes.size() - 40));
    const Verification again = verify_replay(run.trace, {});
    CHECK_FALSE(again.difference);
    CHECK(again.damage == std::vector<std::string>{"the end is missing"});
}

TEST_CASE("a run can be repeated from its recorded trace without the files of its scenario") {
    TempFolder folder;
    for (const char* name : {"rescue.toml", "map.yaml", "office.png"}) {
        std::filesystem::copy(examples + "/rescue/" + name, folder / name);
    }
    const RecordedRunOf run(folder / "rescue.toml", {});
    for (const char* name : {"rescue.toml", "map.yaml", "office.png"}) {
        std::filesystem::remove(folder / name);
    }
    CHECK_FALSE(verify_replay(run.trace, {}).difference);
}

TEST_CASE("a run on several storeys can be repeated from its recorded trace without the maps") {
    TempFolder folder;
    for (const char* name : {"storeys.toml", "ground.png", "upper.png"}) {
        std::filesystem::copy(examples + "/storeys/" + name, folder / name);
    }
    const RecordedRunOf run(folder / "storeys.toml", {});
    for (const char* name : {"storeys.toml", "ground.png", "upper.png"}) {
        std::filesystem::remove(folder / name);
    }
    CHECK_FALSE(verify_replay(run.trace, {}).difference);
}

TEST_CASE(
    "a reader in Python, written from docs/formats/trace-format.md, reads what rovernet reads") {
    if (std::system("python3 --version > /dev/null && zstd --version > /dev/null") != 0) {
        MESSAGE("python3 or zstd is missing: not checked");
        return;
    }
    TempFolder folder;
    const std::string path = folder / "busy.toml";
    testing::write_file(path, busy);
    const std::string script = std::string(ROVERNET_TEST_DATA) + "/../traces/recorded/read.py";
    for (const char* set : {"trace.links=true", "access.model=csma", "routing.protocol=dsr"}) {
        const RecordedRunOf run(path, {set});
        std::string ours;
        RecordedReader reader(run.trace);
        while (const Record* record = reader.next()) append_text(*record, reader.context(), ours);
        const std::string printed = run.folder / "printed";
        REQUIRE(std::system((script + " " + run.trace + " > " + printed).c_str()) == 0);
        CHECK(ours.size() > 10'000);
        CHECK((content(printed) == ours));
    }
}

}  // namespace

}  // namespace replay_test
