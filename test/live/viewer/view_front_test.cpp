// SPDX-License-Identifier: MIT
// A run that goes on, as the viewer's page gets it: file by file, without sockets.
#include "live/viewer/view_front.hpp"

#include "experiment/replay/message_at_robot.hpp"
#include "experiment/run.hpp"
#include "live/viewer/view_history.hpp"
#include "pictures/viewer/view_run.hpp"
#include "scenario/document/json.hpp"
#include "scenario/scenario_file.hpp"
#include "test/live/run_front.hpp"
#include "test/pictures/viewer/view_reader.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace view_front_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::ViewReader;

namespace {

using Numbers = std::vector<double>;

Scenario rescue(std::vector<std::string> set = {}) {
    ScenarioOptions options;
    options.set = std::move(set);
    options.set.emplace_back("trace.record=true");
    return load_scenario(std::string(ROVERNET_EXAMPLES) + "/rescue/rescue.toml", options);
}

/// Run of a scenario with a front for the viewer, and what its pages get.
struct Viewed {
    explicit Viewed(Scenario what, ViewControl control = {.is_for_page = true, .speed = {}})
        : scenario(std::move(what)),
          run(scenario),
          front(control,
                {.send = [this](auto, auto text) { answers.emplace_back(text); },
                 .close = [](auto) {},
                 .send_binary = [this](auto to, auto bytes) { files[to].emplace_back(bytes); },
                 .fingerprint = [] { return std::string(); },
                 .unsent = [this](auto to) { return unsent[to]; },
                 .set_speed = [this](auto speed) { speeds.push_back(speed.value()); }}) {
        run.write_to(folder.path("run"));
        front.prepare(run.session(), scenario);
        run.session().step(start_of_run);
        front.begin(run.session(), scenario);
    }
    void go(Time until) { test::run_front(run.session(), front, until); }
    void finish() {
        const RunResult result = run.finish();
        front.ended(result.fingerprint, {});
    }
    std::string ask(const std::string& question) {
        front.received(1, question);
        const Value answer = parse_json(answers.back());
        const Value* error = answer.table()->find("error");
        return error ? *error->string() : "";
    }
    Time now() { return run.session().network().now(); }
    const Table& live() {
        last.emplace(files[1].back());
        return *last->head().find("live")->table();
    }

    test::TemporaryFolder folder;
    Scenario scenario;
    ScenarioRun run;
    std::map<Front::Connection, std::vector<std::string>> files;
    std::map<Front::Connection, std::size_t> unsent;
    std::vector<std::string> answers;
    std::vector<double> speeds;
    std::optional<ViewReader> last;
    ViewFront front;
};

bool is(const Table& live, const char* key) { return std::get<bool>(live.find(key)->data); }

/// Column of all files of a page, joined.
Numbers joined(const std::vector<std::string>& files, const std::string& name) {
    Numbers all;
    for (const std::string& each : files) {
        const ViewReader reader(each);
        if (!reader.has(name)) continue;
        const Numbers some = reader.numbers(name);
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

/// Starts of the legs of each robot, each once.
std::map<std::size_t, Numbers> starts_of_legs(const std::vector<std::string>& files) {
    std::map<std::size_t, Numbers> all;
    for (const std::string& each : files) {
        const ViewReader reader(each);
        if (!reader.has("legs.first")) continue;
        const Numbers first = reader.numbers("legs.first"), start = reader.numbers("legs.start");
        for (std::size_t robot = 0; robot + 1 < first.size(); ++robot) {
            for (auto i = static_cast<std::size_t>(first[robot]);
                 i < static_cast<std::size_t>(first[robot + 1]); ++i) {
                Numbers& own = all[robot];
                if (own.empty() || own.back() != start[i]) own.push_back(start[i]);
            }
        }
    }
    return all;
}

}  // namespace

TEST_CASE(
    "live view: the parts that a page gets during a run add up to the view of the run's trace") {
    Viewed viewed(rescue());
    viewed.front.opened(1, {});
    viewed.go(viewed.run.session().end());
    viewed.finish();
    const std::vector<std::string>& files = viewed.files[1];
    CHECK(files.size() > 3);
    const ViewReader recorded(view_of_trace(viewed.folder.path("run/trace.mcap"), {}).bytes);
    for (const char* name : {"messages.uid", "messages.created", "messages.to", "drops.time",
                             "drops.message", "states.time", "states.robot"})
        CHECK_MESSAGE(joined(files, name) == recorded.numbers(name), name);
    for (const char* name : {"0/flights.start", "0/flights.sender", "0/flights.message",
                             "0/flights.count", "0/receptions.robot", "0/receptions.outcome"})
        CHECK_MESSAGE(joined(files, name) == recorded.numbers(name), name);
    CHECK(joined(files, "0/receptions.outcome").size() > 100);
    CHECK(starts_of_legs(files) ==
          starts_of_legs({view_of_trace(viewed.folder.path("run/trace.mcap"), {}).bytes}));
    double receptions = 0;
    for (const double n : joined(files, "density.1")) receptions += n;
    CHECK(receptions == static_cast<double>(joined(files, "0/receptions.outcome").size()));
    CHECK(is(viewed.live(), "ended"));
}

TEST_CASE("live view: a run is observed only after a page has been opened") {
    Viewed viewed(rescue(), {});
    CHECK(viewed.front.next() == never);
    CHECK(viewed.front.limit() == never);
    viewed.front.opened(1, {});
    CHECK(viewed.front.next() < never);
    REQUIRE(viewed.files[1].size() == 1);
    CHECK(ViewReader(viewed.files[1][0]).numbers("legs.first").size() == 6);
}

TEST_CASE(
    "live view: a run with --view waits for its page, which can pause and step it and set its "
    "speed") {
    Viewed viewed(rescue(), {.of_time = true, .is_for_page = true, .speed = 1});
    viewed.go(Time(5s));
    CHECK(viewed.now() == start_of_run);
    viewed.front.opened(1, {});
    viewed.go(Time(5s));
    CHECK(viewed.now() == Time(5s));
    CHECK(viewed.ask(R"({"id": 1, "op": "pace", "paused": true})").empty());
    viewed.go(Time(6s));
    CHECK(viewed.now() == Time(5s));
    CHECK(is(viewed.live(), "paused"));
    CHECK(viewed.ask(R"({"id": 2, "op": "step", "ns": 1000000})").empty());
    viewed.go(Time(6s));
    CHECK(viewed.now() == Time(5s + 1ms));
    CHECK(viewed.ask(R"({"id": 3, "op": "pace", "paused": false, "speed": 4})").empty());
    viewed.go(Time(6s));
    CHECK(viewed.now() == Time(6s));
    CHECK_FALSE(is(viewed.live(), "paused"));
    CHECK(viewed.speeds == std::vector<double>{4});
    CHECK(viewed.ask(R"({"id": 4, "op": "pace", "speed": -1})").find("1e-6") != std::string::npos);
    CHECK(viewed.ask(R"({"id": 4, "op": "pace", "spede": 2})").find("speed") != std::string::npos);
}

TEST_CASE(
    "live view: pages need permission to change a run, and their commands are logged as inputs") {
    Viewed looking(rescue(), {});
    looking.front.opened(1, {});
    CHECK(looking.ask(R"({"id": 1, "op": "pace", "paused": true})").find("--view-control") !=
          std::string::npos);
    CHECK(looking.ask(R"({"id": 1, "op": "step", "ns": 1})").find("--view-control") !=
          std::string::npos);
    CHECK(looking.ask(R"({"id": 1, "op": "command", "robot": 0, "do": {"stop": true}})")
              .find("--view-control") != std::string::npos);
    CHECK(looking.front.limit() == never);

    Viewed viewed(rescue(), {.of_time = true, .of_robots = true});
    std::vector<Input> inputs;
    viewed.run.session().on_input([&](const Input& input) { inputs.push_back(input); });
    viewed.front.opened(1, {});
    viewed.go(Time(2s));
    CHECK(viewed.ask(R"({"id": 1, "op": "command", "robot": 0, "do": {"goal": [3, 9]}})").empty());
    CHECK(viewed.ask(R"({"id": 2, "op": "command", "robot": 1, "do": {"data": "hi", "to": "C"}})")
              .empty());
    REQUIRE(inputs.size() == 2);
    CHECK(std::holds_alternative<GoalCommand>(inputs[0].command));
    CHECK(inputs[0].client == "viewer");
    CHECK(std::get<SendCommand>(inputs[1].command).payload == "hi");
    CHECK(std::get<SendCommand>(inputs[1].command).to == NodeId{2});
    CHECK(viewed.ask(R"({"id": 3, "op": "command", "robot": 9, "do": {"stop": true}})") != "");
    CHECK(viewed.ask(R"({"id": 3, "op": "command", "robot": 2, "do": {"data": "hi", "to": "C"}})")
              .starts_with("a robot cannot send to itself"));
    CHECK(viewed.ask(R"({"id": 3, "op": "command", "robot": 0, "do": {}})") != "");
    CHECK(viewed.ask(R"({"id": 3, "op": "command", "robot": 0, "do": {"stp": true}})") != "");
    viewed.run.session().attach({NodeId{3}}, "another");
    CHECK(viewed.ask(R"({"id": 4, "op": "command", "robot": 3, "do": {"stop": true}})")
              .find("another program") != std::string::npos);
    viewed.front.closed(1);
    REQUIRE(inputs.size() == 3);  // the robot that the pages drove stops, the one that sent goes on
    CHECK(inputs[2].robot == NodeId{0});
    CHECK(std::holds_alternative<StopCommand>(inputs[2].command));
}

TEST_CASE("live view: during a run, answers are for the current time, whatever time is requested") {
    Viewed viewed(rescue());
    viewed.front.opened(1, {});
    viewed.go(Time(10s));
    CHECK(viewed.ask(R"({"id": 1, "op": "pair", "a": 0, "b": 4, "t_ns": 0})").empty());
    const Value pair = parse_json(viewed.answers.back());
    CHECK(ViewReader::integer(*pair.table(), "t_ns") == 10'000'000'000);
    CHECK(pair.table()->find("links")->array()->size() == 2);
    CHECK(viewed.ask(R"({"id": 1, "op": "robot", "robot": 0})").empty());
    CHECK(viewed.ask(R"({"id": 1, "op": "why", "uid": 99, "robot": 4})")
              .find("no records of message 99") != std::string::npos);
}

/// Answer without the keys that the server adds.
std::string plain(std::string_view answer) {
    Table table;
    const Value read = parse_json(answer);
    for (const char* key : {"robot", "frames", "answer", "from_s", "to_s", "busy", "sending",
                            "frames_sent", "frames_heard", "senders"})
        if (const Value* value = read.table()->find(key)) table.set(key, *value);
    return to_json_line(std::move(table));
}

TEST_CASE(
    "live view: during the run, requests `why` and `air` get the answers of the recorded trace") {
    Viewed viewed(rescue());
    viewed.front.opened(1, {});
    viewed.go(Time(30s));
    std::vector<std::string> why, air;
    for (const int robot : {1, 2, 3, 4}) {
        const std::string about = R"(, "robot": )" + std::to_string(robot) + "}";
        CHECK(viewed.ask(R"({"id": 1, "op": "why", "uid": 0)" + about).empty());
        why.push_back(plain(viewed.answers.back()));
        CHECK(viewed.ask(R"({"id": 1, "op": "air")" + about).empty());
        air.push_back(plain(viewed.answers.back()));
    }
    viewed.finish();
    ViewerAnswers recorded({viewed.folder.path("run/trace.mcap")});
    for (const std::size_t i : {0U, 1U, 2U, 3U}) {
        const std::string about = R"(, "robot": )" + std::to_string(i + 1) + "}";
        CHECK(why[i] == plain(recorded.answer(R"({"id": 1, "op": "why", "uid": 0)" + about)));
        CHECK(air[i] ==
              plain(recorded.answer(R"({"id": 1, "op": "air", "t_ns": 30000000000)" + about)));
    }
    CHECK(why[3].find(R"("answer":"E )") != std::string::npos);
}

TEST_CASE(
    "view history: the records of a recent message are found, those of an old message are not") {
    ScenarioRun run(rescue());
    Session& session = run.session();
    session.step(Time(11s));
    const Scenario scenario = rescue();
    ViewHistory history(scenario, session.shared_network(), 600);
    session.step(Time(40s));
    std::uint64_t newest = 1000;
    while (newest > 1 && history.of_message(newest).path.empty()) --newest;
    CHECK(history.of_message(0).path.empty());
    const IndexedTrace last = history.of_message(newest);
    REQUIRE_FALSE(last.path.empty());
    const MessageAtRobot there = message_at_robot(last.path, newest, NodeId{1}, last.index.get());
    CHECK_FALSE(there.frames.empty());
    CHECK(to_json_line(document_of(there)) ==
          to_json_line(document_of(message_at_robot(last.path, newest, NodeId{1}))));
}

TEST_CASE("live view: chart values of completed intervals equal those of the recorded trace") {
    Viewed viewed(rescue());
    viewed.front.opened(1, {});
    viewed.go(Time(30s));
    CHECK(viewed.ask(R"({"id": 1, "op": "series"})").empty());
    const Value answer = parse_json(viewed.answers.back());
    CHECK(ViewReader::integer(*answer.table(), "from_ns") == 0);
    viewed.go(viewed.run.session().end());
    viewed.finish();
    const ViewReader recorded(view_of_trace(viewed.folder.path("run/trace.mcap"), {}).bytes);
    const Array& series = *answer.table()->find("series")->array();
    std::size_t compared = 0;
    for (std::size_t i = 0; i < series.size(); ++i) {
        const Table& one = *series[i].table();
        const Array& values = *one.find("values")->array();
        const Numbers whole = recorded.numbers("series." + std::to_string(i));
        CHECK(values.size() == 100);  // 30 of 90 s, in 300 bins
        for (std::size_t bin = 0; bin < values.size(); ++bin) {
            const auto* value = std::get_if<double>(&values[bin].data);
            CHECK((value ? *value : -1) == (std::isnan(whole[bin]) ? -1 : whole[bin]));
            if (value && *value > 0) ++compared;
        }
    }
    CHECK(series.size() > 4);
    CHECK(compared > 50);
}

TEST_CASE("live view: a slow page gets all events later; a page opened late gets the whole run") {
    Viewed viewed(rescue());
    viewed.front.opened(1, {});
    viewed.front.opened(2, {});
    const std::size_t before = viewed.files[2].size();
    viewed.unsent[2] = 10'000'000;
    viewed.go(Time(20s));
    CHECK(viewed.files[2].size() == before);
    CHECK(viewed.files[1].size() > before);
    viewed.unsent[2] = 0;
    viewed.front.opened(3, {});
    viewed.go(viewed.run.session().end());
    viewed.finish();
    CHECK(viewed.files[2] == viewed.files[1]);
    CHECK(viewed.files[3] == viewed.files[1]);
}

TEST_CASE(
    "view log: if radio frames exceed the size limit of the log, only the oldest frames are "
    "removed") {
    ViewLog log;
    log.begin("start");
    const std::size_t size = ViewLog::most_frame_bytes / 2 - 10;
    for (int i = 0; i < 4; ++i)
        log.add(
            {.rest = std::to_string(i), .frames = std::string(size, 'f'), .number_of_frames = 7});
    CHECK(log.left_out() == 14);
    std::vector<std::string> got;
    ViewLog::Place place = 0;
    const auto take = [&](std::string_view file) { got.emplace_back(file.substr(0, 5)); };
    log.send(
        place, [] { return true; }, take);
    CHECK(got == std::vector<std::string>{"start", "0", "1", "2", "fffff", "3", "fffff"});
    log.add({.rest = "4", .frames = {}});
    log.send(
        place, [] { return true; }, take);
    CHECK(got.size() == 8);
}

}  // namespace view_front_test
