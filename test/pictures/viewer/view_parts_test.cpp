// SPDX-License-Identifier: MIT
#include "experiment/build.hpp"
#include "experiment/run.hpp"
#include "network/network.hpp"
#include "pictures/viewer/view_run.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "scene/scene.hpp"
#include "sim/error.hpp"
#include "test/pictures/viewer/view_reader.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace view_parts_test {
using namespace rovernet;

namespace {

/// Recorded trace of a scenario file.
struct Recorded {
    explicit Recorded(const std::string& file, std::vector<std::string> set = {}) {
        set.emplace_back("trace.record=true");
        ScenarioOptions options;
        options.set = std::move(set);
        RunOptions run;
        run.folder = folder.path("run");
        run_scenario(load_scenario(file, options), run);
    }
    std::string trace() const { return folder.path("run/trace.mcap"); }
    test::TemporaryFolder folder;
};

std::string example(const std::string& name) {
    return std::string(ROVERNET_EXAMPLES) + "/" + name + "/" + name + ".toml";
}

/// Number of frames and number of the first block of each message, from the blocks of a view file.
/// No block: 4294967295.
std::vector<std::pair<double, double>> frames_in_blocks(const test::ViewReader& view) {
    std::vector<std::pair<double, double>> all(view.numbers("messages.uid").size(),
                                               {0, 4294967295.0});
    for (std::size_t block = 0; view.has(fmt::format("{}/flights.start", block)); ++block) {
        for (const double message : view.numbers(fmt::format("{}/flights.message", block))) {
            if (message >= static_cast<double>(all.size())) continue;
            auto& [frames, first] = all[static_cast<std::size_t>(message)];
            if (frames++ == 0) first = static_cast<double>(block);
        }
    }
    return all;
}

/// Sentences of a head's list.
std::vector<std::string> sentences(const test::ViewReader& view, const char* key) {
    std::vector<std::string> all;
    for (const Value& each : *view.head().find(key)->array()) all.push_back(*each.string());
    return all;
}

using State = std::tuple<double, double, double>;  // time [s], robot, state
std::vector<State> states_of(const test::ViewReader& view) {
    std::vector<State> all;
    const auto &time = view.numbers("states.time"), &robot = view.numbers("states.robot"),
               &what = view.numbers("states.what");
    for (std::size_t i = 0; i < time.size(); ++i)
        all.emplace_back(time[i] / 1e9, robot[i], what[i]);
    return all;
}

/// First bytes of a file.
std::string begin_of(const std::string& path, std::size_t size) {
    std::ifstream file(path, std::ios::binary);
    const std::string all{std::istreambuf_iterator<char>(file), {}};
    return all.substr(0, size);
}

}  // namespace

TEST_CASE(
    "view parts: for each message, the file has the number of frames and the block of the first "
    "frame") {
    const Recorded run(example("detour"));
    const test::ViewReader whole(view_of_trace(run.trace(), {}).bytes);
    const auto in_blocks = frames_in_blocks(whole);
    REQUIRE(in_blocks.size() > 10);
    for (std::size_t i = 0; i < in_blocks.size(); ++i) {
        CHECK(whole.numbers("messages.frames")[i] == in_blocks[i].first);
        CHECK(whole.numbers("messages.block")[i] == in_blocks[i].second);
    }
    ViewChoice choice;
    choice.frames.most_frames = 20;
    const test::ViewReader part(view_of_trace(run.trace(), choice).bytes);
    CHECK(part.numbers("messages.frames") == whole.numbers("messages.frames"));
    const auto shown = frames_in_blocks(part);
    std::size_t without = 0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        CHECK(part.numbers("messages.block")[i] == shown[i].second);
        without += shown[i].first < in_blocks[i].first ? 1 : 0;
    }
    CHECK(without > 0);
}

TEST_CASE(
    "view parts: only messages of applications are counted as messages, not routing packets") {
    const Recorded run(std::string(ROVERNET_EXAMPLES) + "/relay/routes.toml");
    const ViewedRun viewed = view_of_trace(run.trace(), {});
    const test::ViewReader view(viewed.bytes);
    const auto& kind = view.numbers("messages.kind");
    const auto sent = static_cast<std::size_t>(std::count(kind.begin(), kind.end(), 0.0));
    CHECK(sent < kind.size());
    CHECK(viewed.messages == sent);
    CHECK(test::ViewReader::integer(*view.head().find("counts")->table(), "messages") ==
          static_cast<std::int64_t>(sent));
    const Value* metric = view.head().find("metrics")->table()->find("messages");
    CHECK(std::get<std::int64_t>(metric->data) == static_cast<std::int64_t>(sent));
}

TEST_CASE("view parts: a vehicle is absent before it departs, and gone after its last timestep") {
    test::TemporaryFolder folder;
    folder.write("fcd.xml", R"(<fcd-export>
<timestep time="0.00"><vehicle id="a" x="0" y="0" angle="90" speed="1"/></timestep>
<timestep time="5.00"><vehicle id="a" x="5" y="0" angle="90" speed="1"/><vehicle id="late" x="20" y="20" angle="90" speed="1"/></timestep>
<timestep time="10.00"><vehicle id="late" x="30" y="20" angle="90" speed="1"/></timestep>
</fcd-export>
)");
    const std::string file = folder.write("fcd.toml", R"([scenario]
duration = "20 s"
[movement]
file = "fcd.xml"
)");
    const Recorded run(file);
    const auto states = states_of(test::ViewReader(view_of_trace(run.trace(), {}).bytes));
    const auto has = [&](const State& state) {
        return std::count(states.begin(), states.end(), state) == 1;
    };
    CHECK(has({0, 1, 4}));
    CHECK(has({5, 1, 1}));
    CHECK(has({5, 0, 5}));
    CHECK(std::none_of(states.begin(), states.end(),
                       [](const State& state) { return std::get<2>(state) == 0; }));
}

TEST_CASE("view parts: walls are exact far from the origin, as with UTM coordinates") {
    test::TemporaryFolder folder;
    std::filesystem::copy(std::string(ROVERNET_EXAMPLES) + "/rescue/office.png",
                          folder.path("office.png"));
    folder.write("map.yaml", R"(image: office.png
resolution: 0.1
origin: [500000.03, 5400000.07, 0.0]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.25
)");
    const std::string file = folder.write("utm.toml", R"([scenario]
duration = "1 s"
[scene]
map = "map.yaml"
[[robot]]
name = "A"
at = ["500024.0 m", "5400012.0 m"]
)");
    const Recorded run(file);
    const test::ViewReader view(view_of_trace(run.trace(), {}).bytes);
    const NetworkSettings settings = network_settings(load_scenario(file, {}));
    std::vector<double> x, y;
    for (const WallRectangle& wall : settings.scene->wall_rectangles()) {
        for (const Vec3 corner : wall.corners) {
            x.push_back(corner.x);
            y.push_back(corner.y);
        }
    }
    CHECK(x.size() > 100);
    CHECK(view.numbers("walls.x") == x);
    CHECK(view.numbers("walls.y") == y);
}

TEST_CASE("view parts: a page that leaves out the map also leaves out walls, doors and stairs") {
    const Recorded run(example("storeys"));
    ViewChoice choice;
    choice.map = false;
    const test::ViewReader view(view_of_trace(run.trace(), choice).bytes);
    const Table& map = *view.head().find("map")->table();
    CHECK(map.find("doors")->array()->empty());
    CHECK(map.find("stairs")->array()->empty());
    CHECK(view.numbers("doors.time").empty());
    CHECK(view.numbers("walls.x").empty());
}

TEST_CASE(
    "view parts: if a page has no map, its reasons for missed messages do not mention walls") {
    const Recorded run(example("rescue"));
    const auto reasons = [&](bool map) {
        ViewChoice choice;
        choice.map = map;
        const test::ViewReader view(view_of_trace(run.trace(), choice).bytes);
        const Array& list = *view.head().find("follow")->array();
        std::string all;
        for (const Value& each : list) all += *each.table()->find("text")->string();
        return all;
    };
    CHECK(reasons(true).find("wall") != std::string::npos);
    CHECK(reasons(false).find("below the sensitivity") != std::string::npos);
    CHECK(reasons(false).find("wall") == std::string::npos);
}

TEST_CASE(
    "view parts: the page of a cut-off trace shows each robot, and says up to which time the trace "
    "reaches") {
    const Recorded run(example("rescue"));
    const std::string all = begin_of(run.trace(), std::string::npos);
    std::size_t opened = 0, with_records = 0;
    for (std::size_t size = 1000; size < all.size(); size += 997) {
        const std::string cut = run.folder.write("cut.mcap", all.substr(0, size));
        std::string bytes;
        try {
            bytes = view_of_trace(cut, {}).bytes;
        } catch (const InputError&) {
            CHECK(opened == 0);  // what is longer can be shown, too
            continue;
        }
        ++opened;
        const test::ViewReader view(bytes);
        const auto& first = view.numbers("legs.first");
        REQUIRE(first.size() == 6);
        for (std::size_t i = 0; i + 1 < first.size(); ++i) CHECK(first[i] < first[i + 1]);
        CHECK(view.numbers("legs.x").front() == 24.0);  // A begins there
        const auto damage = sentences(view, "damage");
        REQUIRE(damage.size() >= 2);
        CHECK(damage[0] == "The trace is damaged: the end is missing.");
        CHECK(damage[1].find("The trace reaches up to ") == 0);
        CHECK(damage[1].find(" s of 90 s") != std::string::npos);
        with_records += damage[1].find("up to 0.0") == std::string::npos ? 1 : 0;
    }
    CHECK(opened > 5);
    CHECK(with_records > 0);
}

TEST_CASE("view parts: a run of more than 104 days is refused with the reason") {
    test::TemporaryFolder folder;
    const std::string text =
        "[scenario]\nduration = \"{} s\"\n[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\n";
    const auto error_of = [&](const char* duration) {
        const Recorded run(folder.write("long.toml", fmt::format(fmt::runtime(text), duration)));
        try {
            view_of_trace(run.trace(), {});
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(error_of("9.007e6").empty());
    CHECK(error_of("9.1e6").find("the run lasts 9.1e+06 s; expected at most") != std::string::npos);
}

}  // namespace view_parts_test
