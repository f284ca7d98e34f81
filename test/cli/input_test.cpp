// SPDX-License-Identifier: MIT
// What the command takes as input, and what it says of what is none.
#include "test/cli/process.hpp"

#include <string>
#include <vector>

namespace input_test {
using namespace rovernet;
using test::command;
using test::Ended;
using test::Process;
using test::TemporaryFolder;

namespace {

const std::string two =
    "[scenario]\nname = \"two\"\nduration = \"2 s\"\n"
    "[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\n"
    "[[robot]]\nname = \"B\"\nat = [\"9 m\", \"0 m\"]\n"
    "[[traffic]]\nfrom = \"A\"\npayload = \"F\"\n";

/// The command with a file as its standard input.
Ended with_input(const TemporaryFolder& folder, const std::string& text,
                 const std::string& arguments) {
    const std::string input = folder.write("input", text);
    const std::string line = std::string("cd '") + folder.path("") + "' && exec '" +
                             ROVERNET_COMMAND + "' " + arguments + " < '" + input + "'";
    return Process(folder, {"-c", line}, "/bin/sh").wait();
}

bool contains(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("input: every command with a FILE reads the scenario from standard input if FILE is -") {
    const TemporaryFolder folder;
    folder.write("s.toml", two);
    const Ended piped = with_input(folder, two, "run - --out out");
    CHECK(piped.exit == 0);
    CHECK(piped.out ==
          command(folder, {"run", folder.path("s.toml"), "--out", folder.path("o2")}).out);
    for (const char* arguments :
         {"link - A B", "links -", "where - --at 1s", "scene -", "draw - -o x.svg",
          "move convert - x.tcl", "sweep - --store x.db --workers 1",
          "compare - --models friis,two_ray --workers 1 --replications 2"}) {
        CAPTURE(arguments);
        CHECK(with_input(folder, two, arguments).exit == 0);
    }
}

TEST_CASE("input: paths in a scenario from standard input are relative to the current folder") {
    const TemporaryFolder folder;
    folder.write("m.tcl", "$node_(0) set X_ 3.0\n");
    const Ended ended = with_input(folder, "[movement]\nfile = \"m.tcl\"\n", "where - --at 1s");
    CHECK(ended.exit == 0);
    CHECK(contains(ended.out, "n0"));
}

TEST_CASE(
    "input: for a scenario from standard input, errors name the line, and a sweep needs --store") {
    const TemporaryFolder folder;
    const Ended wrong = with_input(folder, "[radio]\npower = 15\n", "run -");
    CHECK(wrong.exit == 3);
    CHECK(contains(wrong.err, "standard input:2:9: power: found the number 15"));
    const Ended nameless = with_input(folder, two, "sweep -");
    CHECK(nameless.exit == 2);
    CHECK(contains(nameless.err, "--store"));
}

TEST_CASE("input: an endless file is refused without reading all of it") {
    const TemporaryFolder folder;
    const Ended ended = command(folder, {"run", "/dev/zero"});
    CHECK(ended.exit == 3);
    CHECK(
        contains(ended.err, "/dev/zero: cannot read the file: it is a device, not a regular file"));
}

TEST_CASE(
    "input: for a file of the wrong kind, the error names the file's kind and the right command") {
    const TemporaryFolder folder;
    const auto said = [&](const std::string& name, const std::string& text) {
        const Ended ended = command(folder, {"run", folder.write(name, text)});
        CHECK(ended.exit == 3);
        return ended.err;
    };
    const std::string player = "driver ( name \"stage\" plugin \"stageplugin\"\n";
    CHECK(contains(said("p.cfg", player + "  worldfile \"simple.world\" )\n"),
                   "this is a configuration of Player, not a scenario; expected the Stage world "
                   "that this file names: " +
                       folder.path("simple.world")));
    CHECK(contains(said("q.cfg", player + ")\n"), "NAME.world"));
    CHECK(contains(said("x.db", ""), "rovernet results"));
    CHECK(contains(said("x.tr", ""), "rovernet trace stats"));
    const std::string recorded =
        "this is a recorded trace, not a scenario; the command \"rovernet "
        "replay\" plays";
    CHECK(contains(said("x.mcap", ""), recorded));
    CHECK(contains(said("renamed", "\x89MCAP0\r\n..."), recorded));
    const std::string capture = "this is a capture of packets, not a scenario";
    CHECK(contains(said("x.pcapng", ""), capture));
    CHECK(contains(said("renamed.bin", "\n\r\r\n..."), capture));
    CHECK(contains(said("renamed.store", "SQLite format 3"), "rovernet results"));
    CHECK(contains(said("x.inc", ""), "the world (.world) that includes this part"));
    CHECK(contains(said("summary.json", "{}"), "scenario.toml"));
    const std::string empty = said("e.world", "");
    CHECK(contains(empty, "found no robot in this world; expected a model of type position"));
    CHECK(!contains(empty, "the key"));
}

TEST_CASE("input: the error about a missing file that an option names begins with the option") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", two);
    for (const std::string option : {"movement.file=none.tcl", "scene.map=none.png",
                                     "scene.world=none.world", "traffic.file=none.tcl"}) {
        CAPTURE(option);
        const Ended ended = command(folder, {"run", file, "--set", option});
        CHECK(ended.exit == 2);
        CHECK(ended.err.starts_with("rovernet: --set " + option + ": "));
    }
}

TEST_CASE("input: the error for an impossible number in an option states what is expected") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", two);
    const auto said = [&](const std::string& option, const std::string& value) {
        const Ended ended = command(folder, {"run", file, option, value});
        CHECK(ended.exit == 2);
        CHECK(ended.err.size() < 120);
        return ended.err;
    };
    for (const std::string speed : {"0", "fast", "-1", "nan", "inf", "1e308", "1e10", "1e-7"}) {
        CHECK(contains(
            said("--speed", speed),
            "--speed: found \"" + speed + "\"; expected a speed from 1e-6 to 1e9 (1: real time)"));
    }
    for (const std::string name : {"live", "emulate", "replay"}) {
        const Ended ended = command(folder, {name, file, "--speed", "1e308"});
        CHECK(ended.exit == 2);
        CHECK(contains(ended.err, "--speed: found \"1e308\"; expected a speed from"));
    }
    CHECK(contains(said("--seed", "-1"), "--seed: found \"-1\"; expected a whole number >= 0"));
    CHECK(contains(said("--seed", "abc"), "--seed: found \"abc\""));
    const Ended parameter = command(folder, {"loss", "two_ray", "n=2", "--distance", "1"});
    CHECK(contains(parameter.err, "rovernet: n=2: unknown key \"n\""));
    const Ended memory = command(folder, {"sweep", file, "--memory", "2GB", "--dry-run"});
    CHECK(memory.exit == 0);
}

TEST_CASE("input: the command `compare` names the robots that have their own propagation model") {
    const TemporaryFolder folder;
    const std::string own =
        "[[robot]]\nname = \"C\"\nat = [\"5 m\", \"0 m\"]\npropagation = { model = \"two_ray\" }\n";
    const std::string file = folder.write("s.toml", two + own);
    const Ended ended = command(folder, {"compare", file, "--models", "friis,two_ray", "--workers",
                                         "1", "--replications", "2"});
    CHECK(ended.exit == 0);
    CHECK(contains(ended.err,
                   "[propagation] do not affect these robots, which have their own propagation "
                   "model: \"C\""));
}

}  // namespace input_test
