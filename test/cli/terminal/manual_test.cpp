// SPDX-License-Identifier: MIT
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace manual_test {
using namespace rovernet::test;
namespace fs = std::filesystem;

namespace {

const std::vector<std::string> commands = {
    "run",        "sweep",        "compare",     "link",        "links",         "routes",
    "scene",      "where",        "draw",        "plot",        "move convert",  "results",
    "explain",    "models",       "loss",        "trace stats", "trace convert", "trace cut",
    "trace diff", "trace follow", "bench flood", "version",     "replay"};

/// What a line of the shell ends with, where `rovernet` is the command and `examples` the folder.
Ended shell(const TemporaryFolder& folder, const std::string& line) {
    const fs::path bin = folder.path("bin");
    if (!fs::exists(bin)) {
        fs::create_directory(bin);
        fs::create_symlink(ROVERNET_COMMAND, bin / "rovernet");
        fs::create_symlink(ROVERNET_EXAMPLES, folder.path("examples"));
    }
    const std::string there = "cd '" + folder.path("") + "' && PATH=\"$PWD/bin:$PATH\" && ";
    return Process(folder, {"-c", there + line}, "/bin/bash").wait();
}

std::vector<std::string> examples_in(const std::string& help) {
    std::vector<std::string> lines;
    std::istringstream text(help.substr(std::min(help.find("Examples:"), help.size())));
    for (std::string line; std::getline(text, line);) {
        if (line.starts_with("  ")) lines.push_back(line.substr(2));
    }
    return lines;
}

/// What bash offers after `words`, of which it completes the last.
std::vector<std::string> completed(const TemporaryFolder& folder, const std::string& words,
                                   int last) {
    const std::string script = "source <(rovernet completion bash); COMP_WORDS=(" + words +
                               "); COMP_CWORD=" + std::to_string(last) +
                               "; _rovernet; printf '%s\\n' \"${COMPREPLY[@]}\"";
    std::istringstream lines(shell(folder, script).out);
    std::vector<std::string> offers;
    for (std::string line; std::getline(lines, line);) offers.push_back(line);
    return offers;
}

}  // namespace

TEST_CASE("every command has examples in its --help, and the examples work") {
    const TemporaryFolder folder;
    for (const std::string& name : commands) {
        const std::vector<std::string> examples =
            examples_in(shell(folder, "rovernet " + name + " --help").out);
        CAPTURE(name);
        // Those of a replay first make the trace that they replay.
        CHECK(std::any_of(examples.begin(), examples.end(), [&](const std::string& line) {
            return line.starts_with("rovernet " + name);
        }));
        for (const std::string& line : examples) {
            CAPTURE(line);
            CHECK(line.starts_with("rovernet "));
            const Ended ended = shell(folder, line);
            CAPTURE(ended.err);
            // The store that is drawn takes minutes to make, so there is none here.
            CHECK(ended.exit == (name == "plot" ? 3 : 0));
        }
    }
}

TEST_CASE("bash completion offers commands, subcommands and options") {
    const TemporaryFolder folder;
    CHECK(completed(folder, "rovernet ex", 1) == std::vector<std::string>{"explain"});
    CHECK(completed(folder, "rovernet move ''", 2).front() == "convert");
    const auto options = completed(folder, "rovernet run --s", 2);
    for (const char* option : {"--seed", "--set", "--speed"}) {
        CHECK(std::count(options.begin(), options.end(), option) == 1);
    }
    CHECK(completed(folder, "rovernet bench flood --no", 3) == std::vector<std::string>{"--nodes"});
    const auto all = completed(folder, "rovernet ''", 1);
    for (const std::string& name : commands) {
        const std::string first = name.substr(0, name.find(' '));
        CHECK(std::count(all.begin(), all.end(), first) == 1);
    }
    CHECK(std::count(all.begin(), all.end(), "man") == 0);
}

TEST_CASE("shell completion is available for zsh and fish; other shells are refused") {
    const TemporaryFolder folder;
    CHECK(command(folder, {"completion", "zsh"}).out.starts_with("#compdef rovernet\n"));
    CHECK(command(folder, {"completion", "fish"}).out.find("-l seed") != std::string::npos);
    const Ended other = command(folder, {"completion", "csh"});
    CHECK(other.exit == 2);
    CHECK(other.err.find("expected one of bash, zsh, fish") != std::string::npos);
}

TEST_CASE("the man page names every command") {
    const TemporaryFolder folder;
    const std::string page = command(folder, {"man"}).out;
    CHECK(page.starts_with(".TH ROVERNET 1"));
    for (const std::string& name : commands) {
        CHECK(page.find(".SS rovernet " + name + "\n") != std::string::npos);
    }
}

TEST_CASE("--quiet suppresses notices, --verbose prints how long each step takes") {
    const TemporaryFolder folder;
    const std::string file =
        folder.write("s.toml", "[[robot]]\nname = \"r\"\nat = [\"0 m\", \"0 m\"]\n");
    const auto said = [&](const char* option) {
        return command(folder, {"run", file, "--out", folder.path("out"), option}).err;
    };
    CHECK(said("--lenient").find("results in") != std::string::npos);
    CHECK(said("--quiet").empty());
    CHECK(said("-v").find("reading " + file) != std::string::npos);
    CHECK(command(folder, {"run", folder.path("none.toml"), "--quiet"}).err.size() > 0);
}

}  // namespace manual_test
