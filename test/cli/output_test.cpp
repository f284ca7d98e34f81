// SPDX-License-Identifier: MIT
#include "test/cli/process.hpp"
#include "test/scene/png_writer.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace output_test {
using namespace rovernet::test;

namespace {

const std::string quoted = std::string("'") + ROVERNET_COMMAND + "' ";

/// What a line of the shell ends with.
Ended shell(const TemporaryFolder& folder, const std::string& line) {
    return Process(folder, {"-c", line}, "/bin/bash").wait();
}

/// Robots enough that every list of them is longer than a pipe holds, with few links: joining many
/// takes `scene` long.
std::string crowd(const TemporaryFolder& folder) {
    return "'" + folder.write("s.toml", R"(propagation = { model = "disc", range = "1 m" }
[[robot]]
name = "r"
count = 2000
place = { area = [["0 m", "0 m"], ["1000 m", "1000 m"]] }
)") + "'";
}

}  // namespace

TEST_CASE("output: a write error is reported, and the exit code is 1") {
    if (!std::filesystem::exists("/dev/full")) return;
    const TemporaryFolder folder;
    const std::string file = crowd(folder);
    for (const std::string& arguments :
         {std::string("models"), std::string("models --json"), std::string("--help"),
          std::string("run --help"), std::string("--version"), std::string("version"),
          std::string("loss friis --distance 1"), "where --at 0 " + file, "scene " + file,
          "run --print-scenario " + file}) {
        CAPTURE(arguments);
        const Ended ended = shell(folder, quoted + arguments + " > /dev/full");
        CHECK(ended.exit == 1);
        CHECK(ended.err == "rovernet: the output cannot be written: No space left on device\n");
    }
}

TEST_CASE("output: no command replaces a file that it reads, except by the same contents") {
    const TemporaryFolder folder;
    const std::string text =
        "# mine\n[scene]\nmap = \"m.png\"\nsize = [\"8 m\", \"8 m\"]\n"
        "[[robot]]\nname = \"A\"\nat = [\"2 m\", \"2 m\"]\n";
    const std::string scenario = folder.write("scenario.toml", text), here = folder.path("");
    const std::string map = folder.write("m.png", png_bytes({.rows = {{255}}}));
    const std::string moves = folder.write("m.tcl", "$node_(0) set X_ 3.0\n");
    const std::string link = folder.path("link.toml");
    std::filesystem::create_symlink(scenario, link);
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"run", scenario, "--out", here},
             {"live", scenario, "--controller", "true", "--out", here},
             {"draw", scenario, "-o", map},
             {"view", scenario, "-o", scenario},
             {"run", link, "--out", here},
             {"move", "convert", moves, moves}}) {
        CAPTURE(words[0]);
        const Ended ended = command(folder, words);
        CHECK(ended.exit == 1);
        CHECK(ended.err.find("this file is an input of the command") != std::string::npos);
    }
    CHECK(content(scenario) == text);
    CHECK(content(map) == png_bytes({.rows = {{255}}}));
    CHECK_FALSE(std::filesystem::exists(folder.path("summary.json")));

    // A link in the output folder is replaced, not the file that it leads to.
    const std::string linked = folder.path("linked");
    std::filesystem::create_directory(linked);
    std::filesystem::create_symlink(scenario, linked + "/scenario.toml");
    CHECK(command(folder, {"run", scenario, "--out", linked}).exit == 0);
    CHECK(content(scenario) == text);

    // The scenario of a run's folder may be run into this folder again.
    const std::string out = folder.path("out");
    CHECK(command(folder, {"run", scenario, "--out", out}).exit == 0);
    CHECK(command(folder, {"run", out + "/scenario.toml", "--out", out}).exit == 0);
    CHECK(command(folder, {"run", out + "/scenario.toml", "--seed", "7", "--out", out}).exit == 1);
}

TEST_CASE("output: results that cannot be written are printed") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml",
                                          "[[robot]]\nname = \"A\"\nat = [\"2 m\", \"2 m\"]\n"
                                          "[[traffic]]\nfrom = \"A\"\npayload = \"x\"\n");
    std::filesystem::create_directories(folder.path("out/summary.json"));  // a folder of this name
    const Ended ended = command(folder, {"run", file, "--out", folder.path("out")});
    CHECK(ended.exit == 1);
    CHECK(ended.out.find("messages 1, ") != std::string::npos);
    CHECK(ended.err.find("summary.json: cannot be written") != std::string::npos);
    CHECK(ended.err.find("no results were written") != std::string::npos);
}

TEST_CASE(
    "output: if the reader of a pipe closes it early, the command ends without an error message") {
    const TemporaryFolder folder;
    const std::string file = crowd(folder);
    for (const std::string& arguments : {"where --at 0 " + file, "where --json --at 0 " + file,
                                         "links " + file, "scene --json " + file}) {
        CAPTURE(arguments);
        const Ended ended =
            shell(folder, quoted + arguments + " | head -c 1 > /dev/null; exit ${PIPESTATUS[0]}");
        CHECK(ended.exit == 128 + SIGPIPE);
        CHECK(ended.err.empty());
    }
}

TEST_CASE("output: a closed standard error does not make a command fail") {
    if (!std::filesystem::exists("/dev/full")) return;
    const TemporaryFolder folder;
    const std::string file =
        "'" + folder.write("s.toml", "[[robot]]\nname = \"r\"\nat = [\"0 m\", \"0 m\"]\n") + "'";
    const std::string out = " --out '" + folder.path("out") + "'";
    CHECK(shell(folder, quoted + "run " + file + out + " 2> /dev/full").exit == 0);
}

}  // namespace output_test
