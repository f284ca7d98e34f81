// SPDX-License-Identifier: MIT
#include "pictures/viewer/view_run.hpp"

#include "experiment/run.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "sim/error.hpp"
#include "sim/legs.hpp"
#include "test/pictures/viewer/view_reader.hpp"
#include "test/scene/temporary_folder.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace view_run_test {
using namespace rovernet;

namespace {

/// Recorded trace of a scenario file, which is an example if its path is relative.
struct Recorded {
    explicit Recorded(const std::filesystem::path& file, std::vector<std::string> set = {}) {
        set.emplace_back("trace.record=true");
        ScenarioOptions options;
        options.set = std::move(set);
        const Scenario scenario =
            load_scenario((std::filesystem::path(ROVERNET_EXAMPLES) / file).string(), options);
        RunOptions run;
        run.folder = folder.path("run");
        run_scenario(scenario, run);
    }
    std::string trace() const { return folder.path("run/trace.mcap"); }
    test::TemporaryFolder folder;
};

/// Place of a robot by the columns, as the page computes it.
Vec3 place(const test::ViewReader& view, std::size_t robot, double t) {
    const auto &first = view.numbers("legs.first"), &start = view.numbers("legs.start");
    auto leg = static_cast<std::size_t>(first[robot]);
    while (leg + 1 < static_cast<std::size_t>(first[robot + 1]) && start[leg + 1] <= t) ++leg;
    const double passed = (std::min(t, view.numbers("legs.end")[leg]) - start[leg]) / 1e9;
    const auto along = [&](const char* at, const char* speed) {
        return view.numbers(at)[leg] + passed * view.numbers(speed)[leg];
    };
    const bool is_flat = !view.has("legs.z");
    return {along("legs.x", "legs.vx"), along("legs.y", "legs.vy"),
            is_flat ? 0 : along("legs.z", "legs.vz")};
}

/// Frame with its receptions: start, sender, uid of its message, and for each receiver, in the
/// order of robots, its outcome. A control frame has no uid.
struct SeenFrame {
    double start, sender, uid;
    std::map<double, double> outcomes;
    friend bool operator==(const SeenFrame&, const SeenFrame&) = default;
};

std::vector<SeenFrame> frames_of(const test::ViewReader& view) {
    std::vector<SeenFrame> frames;
    const auto& uids = view.numbers("messages.uid");
    for (std::size_t block = 0; view.has(fmt::format("{}/flights.start", block)); ++block) {
        const auto of = [&](const char* name) -> const std::vector<double>& {
            return view.numbers(fmt::format("{}/{}", block, name));
        };
        const auto &start = of("flights.start"), &sender = of("flights.sender"),
                   &message = of("flights.message"), &count = of("flights.count"),
                   &robot = of("receptions.robot"), &outcome = of("receptions.outcome");
        std::size_t reception = 0;
        for (std::size_t i = 0; i < start.size(); ++i) {
            const auto index = static_cast<std::size_t>(message[i]);
            frames.push_back({start[i], sender[i], index < uids.size() ? uids[index] : -1, {}});
            for (double k = 0; k < count[i]; ++k, ++reception)
                frames.back().outcomes[robot[reception]] = outcome[reception];
        }
    }
    return frames;
}

/// Frames of a recorded trace, read from its records. A reception belongs to the last frame of its
/// sender and message that was over.
std::vector<SeenFrame> frames_of(const std::string& trace) {
    std::vector<SeenFrame> frames;
    std::vector<Time> ends;
    std::map<std::pair<double, double>, std::vector<std::size_t>> sent;
    RecordedReader reader(trace);
    const auto take = [&](NodeId sender, double uid, const Reception& r) {
        const auto& all = sent.at({sender.value, uid});
        const auto over = std::find_if(all.rbegin(), all.rend(),
                                       [&](std::size_t frame) { return ends[frame] <= r.time; });
        frames[*over].outcomes[r.node.value] =
            2 * static_cast<int>(r.fate) + static_cast<int>(r.delivered);
    };
    while (const Record* record = reader.next()) {
        const auto uid = [&](MessageId id) {
            return static_cast<double>(reader.context().messages[id].uid);
        };
        if (const auto* air = std::get_if<AirSent>(record)) {
            const double message = air->air.control ? -1 : uid(air->air.frame.message);
            const double sender = air->air.frame.sender.value;
            sent[{sender, message}].push_back(frames.size());
            ends.push_back(air->time + air->airtime);
            const auto start = static_cast<double>((air->time - start_of_run).count());
            frames.push_back({start, sender, message, {}});
        } else if (const auto* got = std::get_if<Received>(record)) {
            for (const Reception& r : got->receptions)
                take(got->frame.sender, uid(got->frame.message), r);
        } else if (const auto* control = std::get_if<ControlReceived>(record)) {
            take(control->air.frame.sender, -1, control->reception);
        }
    }
    return frames;
}

std::string error_of(const std::string& path) {
    try {
        view_of_trace(path, {});
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

constexpr std::array examples{"rescue/rescue.toml", "storeys/storeys.toml", "detour/detour.toml",
                              "patrol/patrol.toml"};

}  // namespace

TEST_CASE("view of a run: frames and outcomes of receptions equal those recorded in the trace") {
    for (const char* example : examples) {
        CAPTURE(example);
        const Recorded run(example);
        const ViewedRun viewed = view_of_trace(run.trace(), {});
        const test::ViewReader view(viewed.bytes);
        const auto seen = frames_of(view), recorded = frames_of(run.trace());
        CHECK(seen == recorded);
        CHECK(seen.size() == viewed.frames);
        CHECK(seen.size() > 10);
        std::vector<SeenFrame> wrong = recorded;  // negative control
        wrong.back().start += 1;
        CHECK_FALSE(seen == wrong);
    }
}

TEST_CASE(
    "view of a run: the positions of robots at any time follow from their recorded movements") {
    for (const char* example : examples) {
        CAPTURE(example);
        const Recorded run(example);
        const test::ViewReader view(view_of_trace(run.trace(), {}).bytes);
        const auto end = static_cast<double>(test::ViewReader::integer(view.head(), "duration_ns"));
        std::mt19937_64 random(7);
        std::vector<double> times;
        for (int i = 0; i < 20; ++i)
            times.push_back(std::uniform_real_distribution(0.0, end)(random));
        std::sort(times.begin(), times.end());
        RecordedReader reader(run.trace());
        const Record* record = reader.next();
        for (const double t : times) {
            const Time now = start_of_run + Duration{static_cast<std::int64_t>(t)};
            while (record && reader.now() <= now) record = reader.next();
            // The context is one record ahead, so legs that begin later are skipped.
            const Legs& legs = reader.context().legs;
            for (std::uint32_t robot = 0; robot < legs.size(); ++robot) {
                if (legs.leg(NodeId{robot}).start > now) continue;
                const Vec3 expected = legs.position(NodeId{robot}, now);
                const Vec3 found = place(view, robot, std::floor(t));
                CHECK(distance(expected, found) < 1e-9);
            }
        }
    }
}

TEST_CASE(
    "view of a run: at each zoom level of the time line, the counted outcomes add up to all "
    "receptions") {
    const Recorded run("detour/detour.toml");
    const test::ViewReader view(view_of_trace(run.trace(), {}).bytes);
    std::map<double, double> expected;
    double all = 0;
    for (const SeenFrame& frame : frames_of(run.trace())) {
        for (const auto& [robot, outcome] : frame.outcomes) ++expected[outcome], ++all;
    }
    const std::size_t outcomes = view.head().find("outcomes")->array()->size();
    for (const char* level : {"density.0", "density.1"}) {
        const auto counts = view.numbers(level);
        std::map<double, double> found;
        for (std::size_t i = 0; i < counts.size(); ++i) {
            if (counts[i] > 0) found[static_cast<double>(i % outcomes)] += counts[i];
        }
        CHECK(found == expected);
    }
    const Table& counts = *view.head().find("counts")->table();
    CHECK(static_cast<double>(test::ViewReader::integer(counts, "receptions")) == all);
}

namespace {

double number(const Value& value) {
    const auto* whole = std::get_if<std::int64_t>(&value.data);
    return whole ? static_cast<double>(*whole) : std::get<double>(value.data);
}

/// Series of a view file, by the name of chart and curve, and the outcome.
struct Series {
    std::vector<double> values;
    double width_s = 0;
    std::optional<std::int64_t> outcome;
};
std::map<std::string, std::vector<Series>> series_of(const test::ViewReader& view) {
    std::map<std::string, std::vector<Series>> all;
    std::size_t n = 0;
    for (const Value& each : *view.head().find("series")->array()) {
        const Table& one = *each.table();
        Series series{view.numbers(fmt::format("series.{}", n++)),
                      static_cast<double>(test::ViewReader::integer(one, "width_ns")) / 1e9,
                      {}};
        CHECK(series.values.size() <= 300);
        CHECK(series.values.size() ==
              static_cast<std::size_t>(test::ViewReader::integer(one, "points")));
        if (one.find("outcome")) series.outcome = test::ViewReader::integer(one, "outcome");
        all[*one.find("chart")->string() + " " + *one.find("name")->string()].push_back(series);
    }
    return all;
}

}  // namespace

TEST_CASE(
    "view of a run: charts agree with the metrics of the run and with the counted receptions") {
    for (const char* example : {"rescue/rescue.toml", "detour/detour.toml", "patrol/patrol.toml"}) {
        CAPTURE(example);
        const Recorded run(example, {"trace.links=true"});
        const test::ViewReader view(view_of_trace(run.trace(), {}).bytes);
        const Table& metrics = *view.head().find("metrics")->table();
        const auto metric = [&](const char* name) { return number(*metrics.find(name)); };
        auto series = series_of(view);
        CHECK(series["Delivery ratio so far"][0].values.back() == metric("delivery_ratio"));
        double most = 0;
        for (const double v : series["Latency of deliveries largest"][0].values)
            most = std::max(most, std::isnan(v) ? 0 : v);
        CHECK(most == metric("latency_max_s"));
        const Array& counts = *view.head().find("counts")->table()->find("outcomes")->array();
        double receptions = 0;
        for (const Series& one : series["Receptions "]) {
            double sum = 0;
            for (const double v : one.values) sum += v * one.width_s;
            // The last bin may be shorter than the others, and a rate has the error of a division.
            const double last = one.values.back() * one.width_s;
            const auto expected = number(counts[static_cast<std::size_t>(*one.outcome)]);
            CHECK(std::abs(sum - expected) <= last + 1e-6 * expected);
            receptions += expected;
        }
        CHECK(receptions == static_cast<double>(test::ViewReader::integer(
                                *view.head().find("counts")->table(), "receptions")));
    }
}

TEST_CASE(
    "view of a run: charts of channel and topology agree with values computed from the records") {
    const Recorded run("patrol/patrol.toml", {"trace.links=true"});
    const test::ViewReader view(view_of_trace(run.trace(), {}).bytes);
    auto series = series_of(view);
    double busy = 0, frames = 0, until = 0;
    for (const double share : series["Channel occupancy share of time"][0].values) {
        CHECK(share >= 0);
        CHECK(share <= 1);
        busy += share * series["Channel occupancy share of time"][0].width_s;
    }
    const auto starts = view.numbers("0/flights.start"),
               airtimes = view.numbers("0/flights.airtime");
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const double end = starts[i] + airtimes[i];
        frames += std::max(0.0, end - std::max(starts[i], until));
        until = std::max(until, end);
    }
    CHECK(std::abs(busy - frames / 1e9) < 1e-9);
    // 120 s in 300 bins of 0.4 s: the 10th ends at 4 s.
    std::set<std::pair<double, double>> up;
    const auto time = view.numbers("links.time"), from = view.numbers("links.from"),
               to = view.numbers("links.to"), is_up = view.numbers("links.up");
    for (std::size_t i = 0; i < time.size() && time[i] <= 4e9; ++i) {
        if (is_up[i] > 0) up.emplace(from[i], to[i]);
        if (is_up[i] == 0) up.erase({from[i], to[i]});
    }
    const double robots = static_cast<double>(view.head().find("robots")->array()->size());
    CHECK(up.size() > 10);
    CHECK(series["Neighbours of a robot mean"][0].values[9] ==
          static_cast<double>(up.size()) / robots);
    CHECK(series["Parts of the network connected components"][0].values[9] == 1);
    const Recorded without("patrol/patrol.toml");
    CHECK(series_of(test::ViewReader(view_of_trace(without.trace(), {}).bytes))
              .count("Neighbours of a robot mean") == 0);
}

// While a sends a long message, it begins to send a short message and another long message.
TEST_CASE(
    "view of a run: if frames of one robot overlap, each frame keeps its own receptions and "
    "airtime") {
    for (const auto& [rate, long_ms, short_ms] :
         {std::tuple{"250 kb/s", 48.192, 0.224}, std::tuple{"100 b/s", 120'000.192, 80.192}}) {
        CAPTURE(rate);
        const test::TemporaryFolder folder;
        const std::string file = folder.write("overlap.toml", fmt::format(R"(
[scenario]
name = "overlap"
duration = "200 s"
[radio]
rate = "{}"
[[robot]]
name = "a"
at = ["0 m", "0 m"]
[[robot]]
name = "b"
at = ["20 m", "0 m"]
[routing]
ttl = 1
[[traffic]]
from = "a"
size = "1500 B"
start = "0 s"
every = "1 s"
count = 1
[[traffic]]
from = "a"
size = "1 B"
start = "1 ms"
every = "1 s"
count = 1
[[traffic]]
from = "a"
size = "1500 B"
start = "2 ms"
every = "1 s"
count = 1
)",
                                                                          rate));
        const Recorded run(file);
        const test::ViewReader view(view_of_trace(run.trace(), {}).bytes);
        CHECK(view.numbers("0/flights.count") == std::vector<double>{1, 1, 1});
        CHECK(view.numbers("0/flights.airtime") ==
              std::vector<double>{long_ms * 1e6, short_ms * 1e6, long_ms * 1e6});
    }
}

TEST_CASE("view of a run: frames, payloads and the map can be left out by options") {
    const Recorded run("rescue/rescue.toml");
    const auto all = frames_of(run.trace());
    ViewChoice choice;
    choice.frames.from = start_of_run + Duration{static_cast<std::int64_t>(all[10].start)};
    choice.frames.to = start_of_run + Duration{static_cast<std::int64_t>(all[20].start)};
    choice.frames.payload_bytes = 0;
    choice.map = false;
    const ViewedRun viewed = view_of_trace(run.trace(), choice);
    const test::ViewReader view(viewed.bytes);
    CHECK(frames_of(view) == std::vector(all.begin() + 10, all.begin() + 21));
    CHECK(view.numbers("walls.x").empty());
    for (const std::string& text : view.texts("messages.payload")) CHECK(text.empty());
    CHECK(viewed.left_out.size() == 3);
    const std::size_t whole = view_of_trace(run.trace(), {}).bytes.size();
    choice = {};
    choice.most_bytes = whole - 200;
    const ViewedRun small = view_of_trace(run.trace(), choice);
    CHECK(small.bytes.size() <= choice.most_bytes);
    CHECK(small.frames > 0);
    const auto kept = frames_of(test::ViewReader(small.bytes));
    CHECK(kept == std::vector(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(kept.size())));
    CHECK(test::ViewReader(small.bytes).numbers("legs.x") ==
          test::ViewReader(view_of_trace(run.trace(), {}).bytes).numbers("legs.x"));
}

TEST_CASE("view of a run: the file has a map with storeys, doors and stairs") {
    const Recorded run("storeys/storeys.toml");
    const test::ViewReader view(view_of_trace(run.trace(), {}).bytes);
    const Table& map = *view.head().find("map")->table();
    CHECK(map.find("floors")->array()->size() > 1);
    const auto storeys = view.numbers("walls.storey");
    CHECK(*std::max_element(storeys.begin(), storeys.end()) ==
          static_cast<double>(map.find("floors")->array()->size() - 1));
    CHECK(view.numbers("walls.x").size() == 4 * storeys.size());
}

TEST_CASE("view of a run: if the input is missing or not a trace, the error names the file") {
    const test::TemporaryFolder folder;
    CHECK(error_of(folder.write("a.mcap", "no trace")).find("a.mcap") != std::string::npos);
    CHECK(error_of(folder.path("missing.mcap")).find("missing.mcap") != std::string::npos);
}

}  // namespace view_run_test
