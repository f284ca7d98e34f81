// SPDX-License-Identifier: MIT
#include "experiment/timeline.hpp"

#include "experiment/run.hpp"
#include "experiment/session.hpp"
#include "experiment/summary.hpp"
#include "scenario/document/json.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>

namespace timeline_test {
using namespace rovernet;

namespace {

/// A run of two robots in reach of one another; `traffic` is what A sends.
struct Run {
    std::string text;
    RunResult result;
    std::shared_ptr<const Timeline> timeline;
    std::string summary;

    explicit Run(const std::string& traffic) {
        text =
            "robot = [{ name = \"A\", at = [\"0 m\", \"0 m\"] }, { name = \"B\", at = [\"40 m\", "
            "\"0 "
            "m\"] }]\n[scenario]\nduration = \"60 s\"\n[[traffic]]\nfrom = \"A\"\n" +
            traffic;
        const Scenario scenario = read_scenario(parse_toml(text, "s.toml"), "s.toml");
        ScenarioRun run(scenario);
        run.session().run({}, {});
        result = run.finish();
        timeline = result.timeline;
        write_summary(scenario, result, [&](std::string_view piece) { summary += piece; });
    }
};

}  // namespace

TEST_CASE("timeline: a message with a size but without a text has no entry") {
    const Run empty("size = \"64 B\"\nstart = \"1 s\"\nevery = \"1 s\"\n");
    CHECK(empty.timeline->size() == 0);
    CHECK(empty.timeline->left_out() == 0);
    CHECK(empty.summary.find("\"timeline\": []") != empty.summary.npos);
    CHECK(empty.summary.find("timeline_left_out") == empty.summary.npos);
    const Run said("payload = \"F\"\nstart = \"1 s\"\nevery = \"1 s\"\n");
    CHECK(said.timeline->size() == 2);
    CHECK((*said.timeline)[1].text == "hears \"F\" from A over 1 hop");
}

TEST_CASE("timeline: after 10,000 entries, further entries are only counted") {
    std::string off, on;
    // B is switched off and on again 5,100 times: 10,200 entries.
    for (int i = 0; i < 5100; ++i) {
        off += fmt::format("{}\"{} ms\"", i == 0 ? "" : ", ", 10 * i + 2);
        on += fmt::format("{}\"{} ms\"", i == 0 ? "" : ", ", 10 * i + 7);
    }
    const std::string text =
        "[scenario]\nduration = \"60 s\"\n[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 "
        "m\"]\n[[robot]]\n"
        "name = \"B\"\nat = [\"9 m\", \"0 m\"]\noff = [" +
        off + "]\non = [" + on + "]\n";
    const Scenario scenario = read_scenario(parse_toml(text, "s.toml"), "s.toml");
    ScenarioRun run(scenario);
    run.session().run({}, {});
    const RunResult result = run.finish();
    CHECK(result.timeline->size() == 10'000);
    CHECK(result.timeline->left_out() == 200);
    CHECK((*result.timeline)[9'999].text == "is switched on again");
    std::string summary;
    write_summary(scenario, result, [&](std::string_view piece) { summary += piece; });
    CHECK(summary.find("\"timeline_left_out\": 200") != summary.npos);
}

}  // namespace timeline_test
