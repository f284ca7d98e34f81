// SPDX-License-Identifier: MIT
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace view_test {
using namespace rovernet::test;

namespace {

const std::string rescue = std::string(ROVERNET_EXAMPLES) + "/rescue/rescue.toml";

/// Error of the command with these arguments, which must end with that exit code.
std::string error_of(const TemporaryFolder& folder, std::vector<std::string> arguments, int exit) {
    arguments.insert(arguments.begin(), "view");
    const auto ended = command(folder, arguments);
    CHECK(ended.exit == exit);
    return ended.err;
}

}  // namespace

TEST_CASE("view: a page can be made from a scenario, from a run's folder or from a trace") {
    const TemporaryFolder folder;
    const std::string run = folder.path("run"), page = folder.path("page.html");
    REQUIRE(command(folder, {"run", rescue, "--record", "--out", run, "--quiet"}).exit == 0);
    std::vector<std::uintmax_t> sizes;
    for (const std::string& what : {rescue, run, run + "/trace.mcap"}) {
        const auto ended = command(folder, {"view", what, "-o", page});
        CHECK(ended.exit == 0);
        CHECK(ended.out.find("5 robots, 21 messages, 51 frames") != std::string::npos);
        sizes.push_back(std::filesystem::file_size(page));
    }
    CHECK(sizes[0] == sizes[1]);
    CHECK(sizes[1] == sizes[2]);
    CHECK(sizes[0] < 250'000);
}

TEST_CASE("view: a signal during the run of a scenario leaves no temporary folder") {
    const TemporaryFolder folder;
    const std::string temporary = folder.path("tmp");
    std::filesystem::create_directory(temporary);
    const std::string file = folder.write(
        "long.toml",
        "[scenario]\nduration = \"1e6 s\"\n[propagation]\nmodel = \"disc\"\nrange = \"9 m\"\n"
        "[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\n"
        "[[robot]]\nname = \"B\"\nat = [\"1 m\", \"0 m\"]\n"
        "[[traffic]]\nfrom = \"A\"\nevery = \"1 ms\"\npayload = \"x\"\n");
    const Process viewing(
        folder,
        {"TMPDIR=" + temporary, ROVERNET_COMMAND, "view", file, "-o", folder.path("page.html")},
        "/usr/bin/env");
    using namespace std::chrono_literals;
    for (int i = 0; i < 1000 && std::filesystem::is_empty(temporary); ++i)
        std::this_thread::sleep_for(20ms);
    CHECK_FALSE(std::filesystem::is_empty(temporary));
    CHECK(viewing.stop().exit == 130);
    CHECK(std::filesystem::is_empty(temporary));
}

TEST_CASE("view --with: the numbers of gained and lost deliveries equal those of replay --with") {
    const TemporaryFolder folder;
    const std::string run = folder.path("run"), page = folder.path("page.html");
    REQUIRE(command(folder, {"run", rescue, "--record", "--out", run, "--quiet"}).exit == 0);
    const std::string trace = run + "/trace.mcap", radio = "propagation.model=friis";
    const auto table = command(folder, {"replay", trace, "--with", radio, "--json"});
    CHECK(table.out.find("\"gained\": 53") != std::string::npos);
    CHECK(table.out.find("\"lost\": 0") != std::string::npos);
    const auto ended = command(folder, {"view", trace, "--with", radio, "-o", page});
    CHECK(ended.exit == 0);
    CHECK(ended.out.find("5 robots; A: 21 messages, 51 frames; B: 21 messages, 105 frames") !=
          std::string::npos);
    CHECK(ended.out.find("deliveries: 53 gained in B, 0 lost in B, 31 in both") !=
          std::string::npos);
    const auto twice = command(folder, {"view", trace, "--with", radio + ";radio.power=0 dBm",
                                        "--with", "radio.sensitivity=-70 dBm", "-o", page});
    CHECK(twice.exit == 0);
    const auto same = command(folder, {"view", run, rescue, "-o", page});
    CHECK(same.out.find("0 gained in B, 0 lost in B, 31 in both") != std::string::npos);
    const std::uintmax_t limit = std::filesystem::file_size(page) / 1000 - 1;  // [kB]
    const auto small = command(
        folder, {"view", run, rescue, "-o", page, "--limit", std::to_string(limit) + " kB"});
    CHECK(small.exit == 0);
    CHECK(small.err.find("frames are left out") != std::string::npos);
    CHECK(std::filesystem::file_size(page) <= 1000 * limit);
}

TEST_CASE("view: an invalid input or option is an error that says what to do") {
    const TemporaryFolder folder;
    const std::string page = folder.path("page.html");
    const auto has = [](const std::string& error, const char* words) {
        CAPTURE(error);
        CHECK(error.find(words) != error.npos);
    };
    std::filesystem::create_directory(folder.path("empty"));
    has(error_of(folder, {folder.path("empty"), "-o", page}, 3),
        "record a trace with `rovernet run");
    has(error_of(folder, {folder.write("a.tr", "s 1.0 _0_"), "-o", page}, 3),
        "no line of this file is a line of an ns-2 trace");
    has(error_of(folder, {folder.path("no.toml"), "-o", page}, 3), "no such file");
    has(error_of(folder, {rescue, "-o", folder.path("no/page.html")}, 1), "cannot be written");
    has(error_of(folder, {rescue, "-o", page, "--from", "20 s", "--to", "10 s"}, 2),
        "later than --from, 20 s");
    has(error_of(folder, {rescue, "-o", page, "--limit", "5"}, 2), "for example \"5 MB\"");
    has(error_of(folder, {rescue, "-o", page, "--limit", "5 kB"}, 0), "too small for the page");
    has(error_of(folder, {rescue, "-o", page, "--from", "80 s"}, 0), "51 of 51 frames");
    CHECK_FALSE(std::filesystem::exists(folder.path("no")));
    const std::string patrol = std::string(ROVERNET_EXAMPLES) + "/patrol/patrol.toml";
    has(error_of(folder, {rescue, patrol, "-o", page}, 3),
        "patrol.toml: found 9 robots, but 5 robots in");
    has(error_of(folder, {rescue, "no.toml", "-o", page}, 3), "no.toml: no such file");
    has(error_of(folder, {rescue, rescue, "--with", "radio.power=1 dBm", "-o", page}, 2),
        "expected only one of the two");
    has(error_of(folder, {rescue, "--with", "radio.pover=1 dBm", "-o", page}, 2), "radio.pover");
    has(error_of(folder, {page}, 3), "page.html: this is a page, which a browser opens");
    has(error_of(folder, {rescue, "-o", page, "--address", "127.0.0.1:8080"}, 2),
        "found -o and --address; expected only one of the two");
    has(error_of(folder, {rescue, "-o", page, "--listen", "0.0.0.0"}, 2), "found -o and --listen");
    has(error_of(folder, {rescue, "-o", page, "--movements", "no.tcl"}, 2),
        "--movements is for an ns-2 trace, such as run.tr; found");
}

}  // namespace view_test
