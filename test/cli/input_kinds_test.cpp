// SPDX-License-Identifier: MIT
// Loops of links, FIFOs and devices in the place of every file that a command reads: it ends with
// exit code 3 and a reason.
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <sys/stat.h>
#include <vector>

namespace input_kinds_test {
using namespace rovernet::test;

namespace {

const char* const one = R"([scenario]
duration = "1 s"
[study]
replications = 1
[[robot]]
name = "A"
at = ["0 m", "0 m"]
)";

struct Inputs {
    TemporaryFolder folder;

    Inputs() {
        folder.write("one.toml", one);
        folder.write("notes.txt", "no store\n");
        for (const char* ending :
             {"", ".toml", ".tr", ".csv", ".png", ".yaml", ".world", ".db", ".tcl", ".jsonl"}) {
            const std::string name = std::string("loop") + ending;
            std::filesystem::create_symlink(name, folder.path(name));
        }
    }
    Ended run(const std::vector<std::string>& arguments) const {
        return command(folder, arguments);
    }
    std::string scenario(const std::string& section) const {
        return folder.write("names.toml", std::string(one) + section);
    }
    std::string path(const std::string& name) const {
        return name.starts_with('/') ? name : folder.path(name);
    }
};

void check_told(const Ended& ended, const std::string& reason) {
    CAPTURE(ended.out);
    CAPTURE(ended.err);
    CHECK(ended.exit == 3);
    CHECK(ended.err.find(reason) != std::string::npos);
    for (const char* raw : {"filesystem error", "Too many levels", "SQLite", "std::", "errno"}) {
        CHECK(ended.err.find(raw) == std::string::npos);
    }
}

struct Kind {
    std::string name, reason;
};

const std::string loop = "a loop of symbolic links", device = "a device, not a regular file";

}  // namespace

TEST_CASE(
    "input kinds: a symlink loop or an endless device is refused as a scenario, trace or file of "
    "measured levels") {
    const Inputs in;
    const std::string one_toml = in.path("one.toml");
    for (const Kind& kind : {Kind{"loop.tr", loop}, Kind{"/dev/zero", device}}) {
        const std::string file = in.path(kind.name);
        for (std::vector<std::string> arguments : std::vector<std::vector<std::string>>{
                 {"run", file},
                 {"where", file, "--at", "1s"},
                 {"trace", "stats", file},
                 {"trace", "follow", file, "--message", "0"},
                 {"trace", "convert", file, in.path("o.csv"), "--to", "csv"},
                 {"trace", "cut", file, in.path("o.tr")},
                 {"trace", "diff", file, file},
                 {"replay", file, "--verify"},
                 {"replay", file, "--speed", "2"},
                 {"replay", file, "--with", "radio.power=3dBm"},
                 {"fit", one_toml, "--links", file},
                 {"locate", one_toml, "--sigma", "4dB", "--links", file},
                 {"locate", file, "--anchors", "A"},
                 {"results", file},
                 {"explain", file, "1"},
                 {"sweep", one_toml, "--store", file, "--workers", "1"},
                 {"sweep", one_toml, "--store", in.path("s.db"), "--merge", file},
                 {"sweep", one_toml, "--store", in.path("s.db"), "--except", file}}) {
            if (kind.name == "loop.tr" && (arguments[0] == "run" || arguments[0] == "where"))
                arguments[1] = in.path("loop.toml");
            CAPTURE(arguments[0]);
            CAPTURE(arguments[1]);
            check_told(in.run(arguments), kind.reason);
        }
    }
}

TEST_CASE("input kinds: a scenario that names a file of a wrong kind is refused") {
    const Inputs in;
    for (const auto& each : std::vector<std::pair<std::string, std::string>>{
             {"[scene]\nmap = \"loop.png\"\n", loop},
             {"[scene]\nmap = \"loop.yaml\"\n", loop},
             {"[scene]\nworld = \"loop.world\"\n", loop},
             {"[movement]\nfile = \"loop.tcl\"\n", loop},
             {"[movement]\nfile = \"/dev/zero\"\n", device},
             {"[traffic]\nfile = \"loop.tcl\"\n", loop},
             {"[traffic]\nfile = \"/dev/zero\"\n", device},
             {"[scene]\nmap = \"/dev/zero\"\n", "is not a regular file"},
             {"[scene]\nworld = \"/dev/zero\"\n", "is not a regular file"}}) {
        CAPTURE(each.first);
        check_told(in.run({"where", in.scenario(each.first), "--at", "1s"}), each.second);
    }
}

TEST_CASE(
    "input kinds: reading a FIFO without a writer is an error, and a FIFO is refused as a store") {
    const Inputs in;
    REQUIRE(mkfifo(in.path("fifo").c_str(), 0600) == 0);
    const std::string fifo = in.path("fifo"), one_toml = in.path("one.toml");
    check_told(in.run({"fit", one_toml, "--links", fifo}),
               "a FIFO into which no program has "
               "written");
    check_told(in.run({"results", fifo}), "it is a pipe, not a regular file");
    check_told(in.run({"sweep", one_toml, "--store", fifo}), "it is a pipe, not a regular file");
    check_told(in.run({"where", in.scenario("[movement]\nfile = \"fifo\"\n"), "--at", "1s"}),
               "a movement file is read twice");
}

TEST_CASE("input kinds: measured levels can be read from a pipe, as from a file") {
    const Inputs in;
    const std::string levels =
        in.folder.write("l.csv",
                        "from_x_m,from_y_m,to_x_m,to_y_m,level_dbm\n2,1,1,1,-37\n5,1,1,1,-52\n"
                        "12,1,1,1,-60\n25,1,1,1,-71\n");
    const std::string rest = " fit " + in.path("one.toml") + " --links ";
    const std::string shell = std::string(ROVERNET_COMMAND) + rest + "<(cat " + levels + ")";
    const Process piped(in.folder, {"-c", shell}, "/bin/bash");
    const Ended by_pipe = piped.wait();
    CHECK(by_pipe.exit == 0);
    CHECK(by_pipe.out == in.run({"fit", in.path("one.toml"), "--links", levels}).out);
}

TEST_CASE(
    "input kinds: movements that end after the longest possible run are refused, with line and "
    "column") {
    const Inputs in;
    const std::string tcl = in.folder.write(
                          "late.tcl",
                          "$node_(0) set X_ 1\n$ns_ at 2e9 \"$node_(0) setdest 5 5 1\"\n"),
                      bonn = in.folder.write("late.movements", "0 0 0 2e9 5 5\n");
    const std::string late = "the movements end after 200000000";
    check_told(in.run({"where", tcl, "--at", "1s"}), tcl + ":2:1: " + late);
    check_told(in.run({"run", bonn}), bonn + ":1:7: " + late);
    const std::string part = in.scenario("[movement]\nfile = \"late.tcl\"\n");
    CHECK(in.run({"where", part, "--at", "1s"}).exit == 0);  // a scenario has its own end
}

TEST_CASE("sweep --merge: a file that is not a store is refused, and no file is changed") {
    const Inputs in;
    const std::string notes = in.path("notes.txt"), store = in.path("s.db");
    check_told(
        in.run({"sweep", in.path("one.toml"), "--store", store, "--merge", notes}),
        notes + ": this file is not a store of a study; expected a store that sweep --shard wrote");
    CHECK_FALSE(std::filesystem::exists(store));
    CHECK(content(notes) == "no store\n");
}

TEST_CASE("results --sql: one statement is executed; zero or two statements are refused") {
    const Inputs in;
    const std::string store = in.path("s.db");
    REQUIRE(in.run({"sweep", in.path("one.toml"), "--store", store, "--workers", "1"}).exit == 0);
    const auto ask = [&](const std::string& sql) {
        return in.run({"results", store, "--sql", sql});
    };
    for (const char* none : {"", " ", ";", "-- nothing", ";; /* x */ ;"}) {
        CAPTURE(none);
        const Ended ended = ask(none);
        CHECK(ended.exit == 2);
        CHECK(ended.err.find("--sql: found no statement; expected one") != std::string::npos);
    }
    for (const char* two :
         {"select 1; select 2", "select 1; drop table run", "select 1; nonsense"}) {
        CAPTURE(two);
        const Ended ended = ask(two);
        CHECK(ended.exit == 2);
        CHECK(ended.out == "");
        CHECK(ended.err.find("--sql: found more than one statement") != std::string::npos);
    }
    for (const char* single : {"select 1", "select 1;", "; select 1 ; -- x", "/* x */ select 1"}) {
        CAPTURE(single);
        CHECK(ask(single).out == "1\n1\n");
    }
    CHECK(ask("drop table run").err.find("only reading is allowed") != std::string::npos);
    CHECK(ask("select").err.find("incomplete input") != std::string::npos);
}

}  // namespace input_kinds_test
