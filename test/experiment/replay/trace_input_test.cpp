// SPDX-License-Identifier: MIT
#include "experiment/replay/trace_input.hpp"

#include "experiment/run.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "test/traces/record_stream.hpp"
#include "traces/ns2/ns2_diff.hpp"
#include "traces/ns2/ns2_follow.hpp"
#include "traces/ns2/ns2_stats.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>
#include <string>

namespace trace_input_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

/// The rescue, with both traces of it.
struct Rescue {
    TempFolder folder;
    RunResult result;
    std::string recorded = folder / "trace.mcap", text = folder / "trace.tr";

    explicit Rescue(const std::string& format, const std::string& mac) {
        RunOptions to;
        to.folder = folder / ".";
        const std::string path = ROVERNET_EXAMPLES "/rescue/rescue.toml";
        result =
            run_scenario(load_scenario(path, {.set = {"scenario.duration=30 s", "trace.record=true",
                                                      "trace.ns2=" + format, "trace.mac=" + mac}}),
                         to);
    }
};

/// Six messages over a line of five robots, of which the fourth is switched off.
std::string routed(const std::string& protocol, const std::string& format, const std::string& mac) {
    std::string text = "[scenario]\nduration = \"8 s\"\n[access]\nmodel = \"csma\"\n[routing]\n" +
                       protocol + "[trace]\nrecord = true\nns2 = \"" + format + "\"\nmac = " + mac +
                       R"(
[propagation]
model = "disc"
range = "250 m"
[[traffic]]
kind = "unicast"
from = "n0"
to = "n4"
size = "64 B"
start = "1 s"
every = "1 s"
)";
    for (int i = 0; i < 5; ++i) {
        const std::string off = i == 3 ? "off = [\"4.5 s\"]\n" : "";
        text +=
            fmt::format("[[robot]]\nname = \"n{}\"\nat = [\"{} m\", \"0 m\"]\n{}", i, 200 * i, off);
    }
    return text;
}

std::string all_of(Ns2Source source) {
    while (source.more()) continue;
    return std::string(source.window());
}

TraceInput old_with_mac(const std::string& path) {
    return TraceInput(path, {.format = Ns2Format::old_format, .mac = MacTrace::on});
}

}  // namespace

TEST_CASE("the text of a recorded trace equals the ns-2 trace of its run, byte by byte") {
    for (const char* format : {"old", "new"}) {
        for (const char* mac : {"false", "true"}) {
            CAPTURE(format);
            CAPTURE(mac);
            const Rescue run(format, mac);
            const TraceInput::Lines lines{.format = std::string(format) == "old"
                                                        ? Ns2Format::old_format
                                                        : Ns2Format::new_format};
            const TraceInput trace(run.recorded, lines);
            CHECK(trace.is_recorded());
            CHECK(trace.robots().size() == 5);
            CHECK(all_of(trace.text()) == content(run.text));
            CHECK(trace.damage().empty());
            CHECK(render_recorded(run.recorded, run.folder / "later.tr", lines).empty());
            CHECK(content(run.folder / "later.tr") == content(run.text));
        }
    }
}

TEST_CASE("the text of a recorded run with AODV or DSR equals its ns-2 trace, byte by byte") {
    for (const char* protocol :
         {"protocol = \"aodv\"\n", "protocol = \"aodv\"\nprofile = \"ns2\"\nhello = \"1 s\"\n",
          "protocol = \"dsr\"\n", "protocol = \"dsr\"\nprofile = \"ns2\"\n"}) {
        for (const char* format : {"old", "new"}) {
            for (const char* mac : {"false", "true"}) {
                CAPTURE(protocol);
                CAPTURE(format);
                CAPTURE(mac);
                const TempFolder folder;
                testing::write_file(folder / "s.toml", routed(protocol, format, mac));
                RunOptions to;
                to.folder = folder / ".";
                run_scenario(load_scenario(folder / "s.toml", {}), to);
                const std::string text = content(folder / "trace.tr");
                CHECK(text.size() > 2'000);
                const TraceInput trace(
                    folder / "trace.mcap",
                    {.format = std::string(format) == "old" ? Ns2Format::old_format
                                                            : Ns2Format::new_format});
                CHECK(all_of(trace.text()) == text);
            }
        }
    }
}

TEST_CASE(
    "the text of a trace of format 4, which lacks sizes of frames, contains routing packets") {
    const std::string path = std::string(ROVERNET_TEST_DATA) + "/recorded_format4.mcap";
    const std::string text = all_of(old_with_mac(path).text());
    CHECK(text.find("[0x2 1 1 [1 0] [0 1]] (REQUEST)\n") != text.npos);
    CHECK(text.find("_0_ RTR  --- 3 cbr 64 ") != text.npos);
}

TEST_CASE("the text of an ns-2 trace is read unchanged") {
    const Rescue run("new", "false");
    const TraceInput trace(run.text, {});
    CHECK_FALSE(trace.is_recorded());
    CHECK(trace.robots().empty());
    CHECK(all_of(trace.text()) == content(run.text));
}

TEST_CASE("a recorded trace has the same counts, paths and events as the ns-2 trace of its run") {
    const Rescue run("old", "true");
    const TraceStats told = ns2_stats(old_with_mac(run.recorded).text());
    const TraceStats written = ns2_stats(run.text);
    CHECK(told.counts.events == written.counts.events);
    CHECK(told.drops == written.drops);
    CHECK(told.drops_by_layer == written.drops_by_layer);
    CHECK(told.metrics.deliveries == run.result.metrics.deliveries);
    CHECK(diff_ns2(old_with_mac(run.recorded).text(), run.text, Duration{0}).is_equal);
    const FollowedMessage way = follow_ns2(old_with_mac(run.recorded).text(), 0);
    CHECK(way.robots.size() == follow_ns2(run.text, 0).robots.size());
}

TEST_CASE("an incomplete recorded trace is read up to its end, with a notice") {
    const Rescue run("old", "true");
    std::filesystem::resize_file(run.recorded, std::filesystem::file_size(run.recorded) - 40);
    const TraceInput trace = old_with_mac(run.recorded);
    CHECK(all_of(trace.text()) == content(run.text));
    CHECK_FALSE(trace.damage().empty());
}

}  // namespace trace_input_test
