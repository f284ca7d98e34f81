// SPDX-License-Identifier: MIT
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

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
