// SPDX-License-Identifier: MIT
#include "experiment/replay/recorded_air.hpp"

#include "experiment/run.hpp"
#include "experiment/session.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "test/traces/record_stream.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace recorded_air_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

using Key = std::tuple<std::uint64_t, std::uint32_t, std::uint32_t, Time>;

/// Levels of all receptions of a run, by message, sender, receiver and time.
struct Levels {
    std::map<Key, double> all;
    KindMask kinds() const { return kind_of<Received>() | kind_levels; }
    void on(const Record& record, const RecordContext& context) {
        const auto& received = std::get<Received>(record);
        for (std::size_t i = 0; i < received.receptions.size(); ++i) {
            const Reception& at = received.receptions[i];
            all[{context.messages[received.frame.message].uid, received.frame.sender.value,
                 at.node.value, at.time}] = received.levels[i].value;
        }
    }
};

/// A patrol of robots that move, turn, and are switched off, under some radio.
std::string scenario(const std::string& more) {
    std::string text = R"(
[scenario]
duration = "6 s"
[routing]
protocol = "flood"
ttl = 4
[[robot]]
name = "A"
at = ["0 m", "0 m"]
move = { model = "waypoints", path = [["60 m", "40 m"], ["10 m", "90 m"]], speed = "30 m/s" }
[[robot]]
name = "B"
at = ["50 m", "0 m"]
move = { model = "waypoints", path = [["0 m", "80 m"]], speed = "25 m/s" }
[[robot]]
name = "C"
at = ["100 m", "20 m"]
radio = { power = "20 dBm", antenna_height = "2 m" }
[[robot]]
name = "D"
at = ["30 m", "100 m"]
radio = { antenna = "cosine", antenna_beamwidth = "90 deg" }
off = ["2 s"]
on = ["3 s"]
[[traffic]]
from = "A"
payload = "hello"
start = "0.1 s"
every = "0.17 s"
)";
    return text + more;
}

/// A steel door that closes during the run, on a map without other walls.
const char* const a_door = R"(
[propagation]
model = "multi_wall"
[scene]
map = "plain.pgm"
size = ["120 m", "120 m"]
[[scene.door]]
from = ["20 m", "2 m"]
to = ["40 m", "95 m"]
material = "steel"
closes = ["1.7 s"]
opens = ["4 s"]
[scene.materials]
steel = { per_crossing = "5 dB" }
)";

struct Run {
    TempFolder folder;
    std::string recorded = folder / "trace.mcap";
    std::shared_ptr<Levels> levels = std::make_shared<Levels>();

    explicit Run(const std::string& more) {
        write_file(folder / "s.toml", scenario(more));
        write_file(folder / "plain.pgm", std::string("P2 2 2 255\n255 255 255 255\n"));
        const Scenario loaded = load_scenario(folder / "s.toml", {.set = {"trace.record=true"}});
        RunOptions to;
        to.folder = folder / ".";
        run_scenario(loaded, to);
        Session session(loaded);
        session.network().add_sink(levels);
        session.run({}, {});
    }
};

}  // namespace

TEST_CASE("recorded air: levels and times of all receptions equal those of the run") {
    const std::pair<const char*, const char*> radios[] = {
        {"free space", "[propagation]\nmodel = \"friis\"\n"},
        {"shadowing of links", "[shadowing]\nmodel = \"link\"\nsigma = \"6 dB\"\n"},
        {"a field of shadowing", "[shadowing]\nmodel = \"field\"\n"},
        {"fading by frame", "[fading]\nmodel = \"rayleigh\"\n"},
        {"fading by place", "[fading]\nmodel = \"rician\"\ncoherence = \"place\"\n"},
        {"csma", "[access]\nmodel = \"csma\"\n[reception]\nmodel = \"sinr\"\n"},
        {"a door", a_door},
        {"no delay", "[medium]\npropagation_delay = false\n"}};
    for (const auto& radio : radios) {
        CAPTURE(radio.first);
        const Run run(radio.second);
        RecordedReader trace(run.recorded);
        RecordedAir air(LoadedRun(trace.run(), run.recorded));
        std::size_t compared = 0;
        while (const Record* record = trace.next()) {
            air.take(*record, trace.context());
            const auto* received = std::get_if<Received>(record);
            if (!received) continue;
            const std::uint64_t uid = trace.context().messages[received->frame.message].uid;
            for (const Reception& at : received->receptions) {
                const auto* frame = air.frame_of({.frame = received->frame}, uid, at);
                REQUIRE(frame);
                const Arrival arrival = air.arrival(*frame, at.node);
                CHECK(arrival.end == at.time);
                const Key key{uid, received->frame.sender.value, at.node.value, at.time};
                REQUIRE(run.levels->all.contains(key));
                CHECK(std::abs(arrival.level_dbm - run.levels->all.at(key)) < 1e-9);
                ++compared;
            }
        }
        CHECK(compared > 50);
        CHECK(compared == run.levels->all.size());
    }
}

TEST_CASE(
    "recorded air: a robot is switched off and on as in the run, and ended frames are removed") {
    const Run run("");
    RecordedReader trace(run.recorded);
    RecordedAir air(LoadedRun(trace.run(), run.recorded));
    std::size_t most = 0;
    bool was_off = false;
    while (const Record* record = trace.next()) {
        air.take(*record, trace.context());
        most = std::max(most, air.frames().size());
        was_off = was_off || !air.medium().stations().is_on(NodeId{3});
    }
    CHECK(air.robots() == 4);
    CHECK(was_off);
    CHECK(air.medium().stations().is_on(NodeId{3}));
    CHECK(most >= 2);
    CHECK(most < 20);
}

TEST_CASE("recorded air: a robot's own frame arrives at its own antenna without delay") {
    const Run run("");
    RecordedReader trace(run.recorded);
    RecordedAir air(LoadedRun(trace.run(), run.recorded));
    while (const Record* record = trace.next()) {
        air.take(*record, trace.context());
        if (!std::holds_alternative<AirSent>(*record)) continue;
        const RecordedFrame& frame = air.frames().back();
        const Arrival own = air.arrival(frame, frame.air.frame.sender);
        CHECK(own.own);
        CHECK(own.begin == frame.begin);
        CHECK(own.end == frame.end);
        break;
    }
}

}  // namespace recorded_air_test
