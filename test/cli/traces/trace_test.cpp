// SPDX-License-Identifier: MIT
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

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

TEST_CASE("trace follow --json: an ns-2 trace and a recorded trace of a run give the same result") {
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
    CHECK(
        there["answer"] ==
        "B was never in range: the only frame came 2.7 dB below the sensitivity of the receiver.");
}

TEST_CASE("trace follow: for an ns-2 trace, the option --robot works without a scenario") {
    const Run run;
    const Ended ended =
        command(run.folder, {"trace", "follow", run.text, "--message", "0", "--robot", "B"});
    CHECK(ended.exit == 0);
    CHECK(ended.out.find("B received no copy") != std::string::npos);
    CHECK(ended.out.find("was never in range") == std::string::npos);
}

TEST_CASE(
    "trace: for a run's folder the recorded trace is read, or if there is none, the text trace") {
    const Run run;
    const std::string folder = run.folder.path("run");
    const auto stats = [&](const std::string& trace) {
        return command(run.folder, {"trace", "stats", trace}).out;
    };
    CHECK(stats(folder) == stats(run.recorded));
    CHECK(stats(folder) != "");
    std::filesystem::remove(run.recorded);
    CHECK(stats(folder) == stats(run.text));
    std::filesystem::remove(run.text);
    const Ended none = command(run.folder, {"trace", "stats", folder});
    CHECK(none.exit != 0);
    CHECK(none.err.find("trace.mcap") != std::string::npos);
}

TEST_CASE("trace stats prints whether a trace is recorded or in a format of ns-2") {
    const Run run;
    CHECK(json_of(run.folder, {"trace", "stats", run.recorded})["format"] == "recorded");
    CHECK(json_of(run.folder, {"trace", "stats", run.text})["format"] == "old");
}

TEST_CASE(
    "trace stats: metrics of a recorded trace equal those of the summary, also those of routing") {
    const std::string aodv =
        "[routing]\nprotocol = \"aodv\"\n[access]\nmodel = \"csma\"\n"
        "[[traffic]]\nkind = \"unicast\"\nfrom = \"n0\"\nto = \"n4\"\n"
        "size = \"64 B\"\nstart = \"1 s\"\nevery = \"250 ms\"\n";
    const std::string cluster =
        "[routing]\nprotocol = \"suppression\"\nscheme = \"cluster\"\n"
        "[[traffic]]\nfrom = \"n0\"\nsize = \"64 B\"\nstart = \"1 s\"\nevery = \"250 ms\"\n";
    for (const std::string& scenario : {aodv, aodv + "[study]\nwarmup = \"3 s\"\n", cluster}) {
        CAPTURE(scenario);
        std::string text = "[scenario]\nduration = \"8 s\"\n" + scenario +
                           "[propagation]\nmodel = \"disc\"\nrange = \"250 m\"\n";
        for (int i = 0; i < 5; ++i) {
            text += "[[robot]]\nname = \"n" + std::to_string(i) + "\"\nat = [\"" +
                    std::to_string(200 * i) + " m\", \"0 m\"]\n" +
                    (i == 3 ? "off = [\"4.9 s\"]\n" : "");
        }
        const TemporaryFolder folder;
        const std::string out = folder.path("out");
        json_of(folder, {"run", folder.write("s.toml", text), "--record", "--out", out});
        const Json summary = Json::parse(content(out + "/summary.json"));
        const Json stats = json_of(folder, {"trace", "stats", out + "/trace.mcap"});
        REQUIRE(stats.contains("data_transmissions"));
        for (const auto& metric : stats.items()) {
            const std::string key = metric.key();
            CAPTURE(key);
            if (summary.contains(key)) CHECK(summary[key].dump() == metric.value().dump());
        }
    }
}

TEST_CASE("trace convert, trace cut: the input file is refused as the output file") {
    const Run run;
    const std::string before = content(run.recorded);
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"trace", "convert", run.recorded, run.recorded, "--to", "csv"},
          {"trace", "cut", run.recorded, run.recorded, "--to", "1 s"}}) {
        const Ended ended = command(run.folder, arguments);
        CHECK(ended.exit == 3);
        CHECK(ended.err.find("this is the trace to be read") != std::string::npos);
    }
    CHECK(content(run.recorded) == before);
}

TEST_CASE(
    "trace follow: robots of an ns-2 trace that only the movement file lists are found by name") {
    const TemporaryFolder folder;
    folder.write("scen.tcl", "$node_(0) set X_ 1.0\n$node_(3) set X_ 9.0\n");
    const std::string file = folder.write(
        "s.toml",
        "[scenario]\nduration = \"3 s\"\n[movement]\nfile = \"scen.tcl\"\n[trace]\nns2 = \"new\"\n"
        "[[traffic]]\nfrom = \"n0\"\nevery = \"1 s\"\npayload = \"x\"\n");
    REQUIRE(command(folder, {"run", file, "--out", folder.path("o")}).exit == 0);
    const Ended ended = command(
        folder, {"trace", "follow", folder.path("o/trace.tr"), "--message", "0", "--robot", "n3"});
    CHECK(ended.exit == 0);
    CHECK(ended.out.find("n3") != std::string::npos);
}

TEST_CASE("trace convert: a recorded trace is converted to pcapng; an ns-2 trace is refused") {
    const Run run;
    const std::string out = run.folder.path("x.pcapng");
    const Ended ended = command(run.folder, {"trace", "convert", run.text, out, "--to", "pcapng"});
    CHECK(ended.exit == 3);
    CHECK(ended.err.find("pcapng can be made only from a recorded trace") != std::string::npos);
    CHECK(content(out).empty());
    for (const std::string to : {"pcapng", "foxglove", "csv"}) {
        const std::string missing = run.folder.path("none.mcap");
        const Ended none = command(run.folder, {"trace", "convert", missing, out, "--to", to});
        CHECK(none.exit == 3);
        CHECK(none.err.find("none.mcap: cannot read the file: no such file") != std::string::npos);
    }
    CHECK(command(run.folder, {"trace", "convert", run.recorded, out, "--to", "pcapng"}).exit == 0);
    CHECK(content(out).size() > 100);
}

TEST_CASE("trace: an empty file, or a file compressed by xz or bzip2, is refused with the reason") {
    const TemporaryFolder folder;
    const std::vector<std::pair<std::string, std::string>> files = {
        {"", "the file is empty"},
        {"\n\n# nothing\n", "blank lines and comments only"},
        {std::string("\xfd\x37zXZ\0 packed", 13), "compressed by xz"},
        {"BZh91AY packed", "compressed by bzip2"},
        {"<html>\n</html>\n", "no line of this file"}};
    for (const auto& each : files) {
        const std::string &bytes = each.first, &why = each.second;
        CAPTURE(why);
        const std::string in = folder.write("in.tr", bytes);
        for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
                 {"trace", "stats", in},
                 {"trace", "follow", in, "--message", "0"},
                 {"trace", "diff", in, in},
                 {"trace", "cut", in, folder.path("out.tr")},
                 {"trace", "convert", in, folder.path("out.csv"), "--to", "csv"}}) {
            CAPTURE(words[1]);
            const Ended ended = command(folder, words);
            CHECK(ended.exit == 3);
            const bool has_none =
                words[1] == "follow" && ended.err.find("found no message") != ended.err.npos;
            CHECK((has_none || ended.err.find(why) != ended.err.npos));
        }
    }
}

TEST_CASE("an ns-2 movement file may begin with the command `set`; a bzip2 file is refused") {
    const TemporaryFolder folder;
    const std::string moves =
        "set opt(nn) 3\n$node_(0) set X_ 5.0\n$ns_ at 1.0 \"$node_(0) setdest 10.0 0.0 1.0\"\n";
    for (const char* name : {"m.tcl", "m.txt", "m"}) {
        CAPTURE(name);
        const Ended ended = command(folder, {"where", folder.write(name, moves), "--at", "3 s"});
        CHECK(ended.exit == 0);
        CHECK(ended.out.find("at (7.000000, 0.000000") != ended.out.npos);
        CHECK(ended.err.find("1 line is left out") != ended.err.npos);
    }
    const Ended packed =
        command(folder, {"where", folder.write("m.tcl.bz2", "BZh91AY"), "--at", "3 s"});
    CHECK(packed.exit == 3);
    CHECK(packed.err.find("compressed by bzip2") != packed.err.npos);
    const Ended toml = command(folder, {"where", folder.write("x", "set = 3\n"), "--at", "3 s"});
    CHECK(toml.err.find("unknown key \"set\"") != toml.err.npos);
}

TEST_CASE("model `disc`: no command prints a level, a loss or a margin of a link") {
    const TemporaryFolder folder;
    const std::string file = folder.write(
        "d.toml",
        "robot = [{ name = \"A\", at = [\"0 m\", \"0 m\"] }, { name = \"B\", at = [\"150 m\", \"0 "
        "m\"] }, { name = \"C\", at = [\"90 m\", \"0 m\"] }]\n[scenario]\nduration = \"5 "
        "s\"\n[propagation]\nmodel = \"disc\"\nrange = \"100 m\"\n[[traffic]]\nfrom = "
        "\"A\"\npayload = \"F\"\nstart = \"1 s\"\n");
    REQUIRE(command(folder, {"run", file, "--record", "-q", "--out", folder.path("o")}).exit == 0);
    const std::string trace = folder.path("o/trace.mcap");
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"link", file, "A", "B"},
             {"link", file, "A", "C"},
             {"links", file},
             {"loss", "disc", "range=50", "--distance", "1,51"},
             {"trace", "follow", trace, "--message", "0", "--robot", "B"},
             {"trace", "follow", trace, "--message", "0", "--robot", "C"}}) {
        const Ended ended = command(folder, words);
        CAPTURE(ended.out);
        CHECK(ended.exit == 0);
        CHECK(ended.out.find("dB") == ended.out.npos);
        CHECK(ended.out.find("range") != ended.out.npos);
    }
    const auto link = json_of(folder, {"link", file, "A", "B"});
    CHECK(link["margin_db"].is_null());
    CHECK(link["why_down"] == "150 m, beyond the sender's range of 100 m");
}

}  // namespace trace_test
