// SPDX-License-Identifier: MIT
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <string>

namespace trace_test {
using namespace rovernet::test;

namespace {

/// A run of two robots out of reach of one another, with both traces of it.
struct Run {
    TemporaryFolder folder;
    std::string text, recorded;

    Run() {
        const std::string file = folder.write("s.toml", R"(
[scenario]
duration = "2 s"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["500 m", "0 m"]
[[traffic]]
from = "A"
payload = "x"
start = "1 s"
[trace]
ns2 = "old"
)");
        REQUIRE(
            command(folder, {"run", file, "--record", "-q", "--out", folder.path("run")}).exit ==
            0);
        text = folder.path("run/trace.tr");
        recorded = folder.path("run/trace.mcap");
    }
};

}  // namespace

TEST_CASE("trace follow --json has what the text has, and of a recorded trace the frames") {
    const Run run;
    const Json from_text = json_of(run.folder, {"trace", "follow", run.text, "--message", "0"});
    const Json recorded = json_of(run.folder, {"trace", "follow", run.recorded, "--message", "0"});
    CHECK(from_text == recorded);
    CHECK(recorded["from"] == "A");
    CHECK(recorded["to"].is_null());
    CHECK(recorded["sent_s"] == 1.0);
    CHECK(recorded["robots"].size() == 1);
    CHECK(recorded["without"] == Json::array({"B"}));
    const Json there = json_of(run.folder, {"trace", "follow", run.recorded, "--message", "0",
                                            "--robot", "B"})["at_robot"];
    CHECK(there["robot"] == "B");
    REQUIRE(there["frames"].size() == 1);
    CHECK(there["frames"][0]["outcome"] == "too weak");
    CHECK(there["frames"][0]["walls"] == 0);
    CHECK(there["answer"] ==
          "B never was within reach: the only frame came 2.7 dB below its sensitivity.");
}

TEST_CASE("trace follow says of a robot that only an ns-2 trace tells of what it can") {
    const Run run;
    const Ended ended =
        command(run.folder, {"trace", "follow", run.text, "--message", "0", "--robot", "B"});
    CHECK(ended.exit == 0);
    CHECK(ended.out.find("B received no copy") != std::string::npos);
    CHECK(ended.out.find("within reach") == std::string::npos);
}

TEST_CASE("trace stats names a recorded trace as what it is") {
    const Run run;
    CHECK(json_of(run.folder, {"trace", "stats", run.recorded})["format"] == "recorded");
    CHECK(json_of(run.folder, {"trace", "stats", run.text})["format"] == "old");
}

TEST_CASE("trace convert --to pcapng wants a recorded trace, and says why") {
    const Run run;
    const std::string out = run.folder.path("x.pcapng");
    const Ended ended = command(run.folder, {"trace", "convert", run.text, out, "--to", "pcapng"});
    CHECK(ended.exit == 3);
    CHECK(ended.err.find("pcapng is made of a recorded trace only") != std::string::npos);
    CHECK(content(out).empty());
    CHECK(command(run.folder, {"trace", "convert", run.recorded, out, "--to", "pcapng"}).exit == 0);
    CHECK(content(out).size() > 100);
}

}  // namespace trace_test
