// SPDX-License-Identifier: MIT
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace replay_test {
using namespace rovernet::test;

namespace {

const std::string sample = std::string(ROVERNET_TEST_DATA) + "/ns2_old.tr";

/// What a file has.
std::string text_of(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

const char* const two = R"([scenario]
name = "two"
duration = "5 s"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["50 m", "0 m"]
move = { model = "waypoints", path = [["50 m", "30 m"]], speed = "10 m/s" }
[[traffic]]
from = "A"
payload = "F"
every = "1 s"
)";

/// Runs the scenario of two robots. @return folder of its results
std::string run_two(const TemporaryFolder& folder, const std::string& trace) {
    const std::string out = folder.path("out");
    const std::string file = folder.write("two.toml", two);
    REQUIRE(command(folder, {"run", file, "--set", trace, "--out", out, "--quiet"}).exit == 0);
    return out;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// The line of a table that begins with these words; fails if there is none.
std::string row(const std::string& table, const std::string& begin) {
    for (const std::string& line : lines_of(table)) {
        if (line.starts_with(begin)) return line;
    }
    FAIL("no row " << begin << " in\n" << table);
    return "";
}

bool ends_without_difference(const std::string& line) {
    const std::string none = "-           -       -";
    return line.find(none) != std::string::npos;
}

}  // namespace

TEST_CASE(
    "replay of an ns-2 trace compares radios with the default radio, not with the results in the "
    "trace") {
    const TemporaryFolder folder;
    const Ended ended = command(folder, {"replay", sample, "--with", "radio.power=40 dBm;seed=2",
                                         "--with", "radio.power=0 dBm"});
    CHECK(ended.exit == 2);  // there is no key "seed"
    CHECK(ended.err.find("--with seed=2") != std::string::npos);
    const Ended good =
        command(folder, {"replay", sample, "--with", "radio.power=40 dBm;scenario.seed=2", "--with",
                         "radio.power=0 dBm"});
    CAPTURE(good.err);
    REQUIRE(good.exit == 0);
    CHECK(ends_without_difference(row(good.out, "as recorded")));
    CHECK(ends_without_difference(row(good.out, "two_ray, 914 MHz, 250 m")));
    CHECK(row(good.out, "radio.power=40 dBm").find("+0.3333     5       0") != std::string::npos);
    CHECK(row(good.out, "radio.power=0 dBm ").find("-0.6667     0       10") != std::string::npos);
    CHECK(good.out.find("The protocol of the trace is not simulated: messages flood.") !=
          std::string::npos);
}

TEST_CASE("replay --as sets the baseline radio, with which the radios of --with are compared") {
    const TemporaryFolder folder;
    const std::vector<std::string> words = {"replay", sample,         "--as", "radio.power=40 dBm",
                                            "--with", "routing.ttl=2"};
    const Json json = json_of(folder, words);
    CHECK(json["recorded"]["deliveries"] == 10);
    CHECK(json["radios"][0]["deliveries"] == 15);
    CHECK_FALSE(json["radios"][0].contains("lost"));
    CHECK(json["radios"][1]["with"] == "routing.ttl=2");
    CHECK(json["radios"][1]["lost"] == 15 - json["radios"][1]["deliveries"].get<int>());
    std::vector<std::string> direct = words;
    direct.insert(direct.end(), {"--routing", "direct"});
    CHECK(json_of(folder, direct)["radios"][0]["hops_max"] == 1);
}

TEST_CASE("replay: options for ns-2 traces are refused for a recorded trace") {
    const TemporaryFolder folder;
    const std::string out = run_two(folder, "trace.record=true");
    for (const char* option : {"--as", "--movements"}) {
        const Ended ended = command(folder, {"replay", out + "/trace.mcap", "--with",
                                             "radio.power=0 dBm", option, "radio.power=0 dBm"});
        CHECK(ended.exit == 2);
        CHECK(ended.err.find("are for ns-2 traces") != std::string::npos);
    }
    CHECK(command(folder, {"replay", sample}).exit == 2);
}

TEST_CASE(
    "replay --verify of an ns-2 trace runs its scenario, and shows the first different line") {
    const TemporaryFolder folder;
    for (const char* format : {"trace.ns2=old", "trace.ns2=new"}) {
        const std::string trace = run_two(folder, format) + "/trace.tr";
        const std::size_t lines = lines_of(content(trace)).size();
        const Ended same = command(folder, {"replay", trace, "--verify"});
        CHECK(same.exit == 0);
        CHECK(same.out == "identical: " + std::to_string(lines) + " lines\n");
        std::string text = content(trace);
        const std::size_t at = text.rfind("50.00");
        text[at] = '4';
        folder.write("out/trace.tr", text);
        const Ended other = command(folder, {"replay", trace, "--verify"});
        CHECK(other.exit == 1);
        CHECK(other.out.find("\nnow       ") != std::string::npos);
        CHECK(other.out.find("40.00") != std::string::npos);
        folder.write("out/trace.tr", text + "M 9.00000 0 (0.00, 0.00, 0.00), (0.00, 0.00), 0.00\n");
        CHECK(command(folder, {"replay", trace, "--verify"}).exit == 1);
    }
    const Ended alone = command(folder, {"replay", sample, "--verify"});
    CHECK(alone.exit == 3);
    CHECK(alone.err.find("there is no") != std::string::npos);
}

TEST_CASE(
    "replay --verify: for a folder without the log of a live run, the error asks for a trace") {
    const TemporaryFolder folder;
    const Ended ended =
        command(folder, {"replay", run_two(folder, "trace.record=true"), "--verify"});
    CHECK(ended.exit == 3);
    CHECK(ended.err.find("give its trace, such as ") != std::string::npos);
    CHECK(ended.err.find("out/trace.mcap") != std::string::npos);
}

TEST_CASE("replay --verify of an ns-2 trace finds additional and missing lines at the end") {
    const TemporaryFolder folder;
    const std::string trace = run_two(folder, "trace.ns2=old") + "/trace.tr";
    const std::string text = content(trace);
    folder.write("out/trace.tr", text + "# more\n");
    const Ended longer = command(folder, {"replay", trace, "--verify"});
    CHECK(longer.exit == 1);
    CHECK(longer.out.find("recorded  # more\nnow       nothing more\n") != std::string::npos);
    folder.write("out/trace.tr", text.substr(0, text.rfind('\n', text.size() - 2) + 1));
    const Ended shorter = command(folder, {"replay", trace, "--verify"});
    CHECK(shorter.exit == 1);
    CHECK(shorter.out.find("recorded  nothing more\n") != std::string::npos);
}

TEST_CASE("replay --speed prints the events of an ns-2 trace or a recorded trace in order") {
    const TemporaryFolder folder;
    const Ended ns2 = command(folder, {"replay", sample, "--speed", "x1000"});
    CHECK(ns2.exit == 0);
    std::vector<std::string> expected = lines_of(content(sample));
    std::erase_if(expected, [](const std::string& line) { return line.starts_with('#'); });
    CHECK(lines_of(ns2.out) == expected);

    const std::string out = run_two(folder, "trace.record=true");
    const Ended recorded = command(folder, {"replay", out + "/trace.mcap", "--speed", "1000"});
    CHECK(recorded.exit == 0);
    const std::string same_run = run_two(folder, "trace.ns2=old");
    CHECK(recorded.out == content(same_run + "/trace.tr"));
    CHECK(command(folder, {"replay", sample, "--speed", "0"}).exit == 2);
}

TEST_CASE(
    "replay --store: each replay adds rows to the store, and the command results prints them") {
    const TemporaryFolder folder;
    const std::string store = folder.path("radios.db");
    const std::vector<std::string> words = {"replay", sample, "--store", store, "--with"};
    for (const char* radio : {"radio.power=40 dBm", "radio.power=0 dBm", "radio.power=0 dBm"}) {
        std::vector<std::string> each = words;
        each.push_back(radio);
        const Ended ended = command(folder, each);
        CAPTURE(ended.err);
        CHECK(ended.exit == 0);
    }
    const Json json =
        json_of(folder, {"results", store, "--metric", "deliveries", "--metric", "gained.at.n3"});
    REQUIRE(json["rows"].size() == 8);
    const std::vector<std::string> radios = {"as recorded", "two_ray, 914 MHz, 250 m",
                                             "radio.power=40 dBm", "radio.power=0 dBm"};
    const std::vector<int> deliveries = {10, 10, 15, 0};
    for (std::size_t i = 0; i < radios.size(); ++i) {
        CHECK(json["rows"][2 * i]["settings"]["radio"] == radios[i]);
        CHECK(json["rows"][2 * i]["value"] == deliveries[i]);
    }
    CHECK(json["rows"][5]["value"] == 5);
    CHECK(json["missing"] == 0);
    const Ended explained = command(folder, {"explain", store, "2/0"});
    CHECK(explained.out.find("to repeat this run: rovernet replay " + sample +
                             " --with 'radio.power=40 dBm'") != std::string::npos);
    std::vector<std::string> other = words;
    other.insert(other.end(), {"radio.power=0 dBm", "--routing", "direct"});
    const Ended refused = command(folder, other);
    CHECK(refused.exit == 3);
    CHECK(refused.err.find("expected a different --store") != std::string::npos);
    const std::string picture = folder.path("radios.svg");
    CHECK(command(folder, {"plot", store, "-x", "radio", "-y", "delivery_ratio", "-o", picture})
              .exit == 0);
}

TEST_CASE("replay --verify of a damaged, incomplete or empty trace fails and says why") {
    const TemporaryFolder folder;
    folder.write(
        "a.toml",
        "robot = [{ name = \"A\", at = [\"0 m\", \"0 m\"] }, { name = \"B\", at = [\"40 m\", "
        "\"0 m\"] }]\n[scenario]\nduration = \"20 s\"\n[[traffic]]\nfrom = "
        "\"A\"\npayload = \"F\"\nevery = \"1 s\"\n");
    REQUIRE(command(folder, {"run", folder.path("a.toml"), "--record", "--quiet", "--out",
                             folder.path("o")})
                .exit == 0);
    const std::string whole = text_of(folder.path("o/trace.mcap"));
    const auto verify = [&](const std::string& bytes) {
        folder.write("x.mcap", bytes);
        return command(folder, {"replay", folder.path("x.mcap"), "--verify"});
    };
    CHECK(verify(whole).exit == 0);
    const std::size_t chunk = whole.find({"\4\0\0\0zstd", 8});
    std::string broken = whole;
    for (std::size_t i = 0; i < 4; ++i) {
        char& byte = broken[chunk + 60 + i];
        byte = static_cast<char>(~byte);
    }
    std::string last = whole;  // the end of the file alone
    last.resize(last.size() - 60);
    for (const std::string& bytes :
         {broken, whole.substr(0, chunk + 30), whole.substr(0, chunk - 37), last}) {
        const Ended ended = verify(bytes);
        CHECK(ended.exit == 1);
        CHECK(ended.out.find("identical") == ended.out.npos);
        CHECK(ended.out.find("incomplete") != ended.out.npos);
        CHECK(ended.err.find("x.mcap") != ended.err.npos);
        CHECK(command(folder, {"replay", folder.path("x.mcap"), "--verify", "--json"})
                  .out.find("\"identical\": false") != std::string::npos);
    }
    CHECK(verify("").exit == 3);
    CHECK(verify("").err.find("empty") != std::string::npos);
    CHECK(verify("PK\x03\x04 nothing")
              .err.find("is a ZIP archive; expected a recorded trace (.mcap), not compressed") !=
          std::string::npos);
    CHECK(verify(whole.substr(0, 40)).exit == 3);
}

TEST_CASE("replay: errors about a trace that is cut off anywhere name the trace") {
    const TemporaryFolder folder;
    std::string picture = "P2 60 60 255";
    for (int i = 0; i < 60 * 60; ++i) picture += " " + std::to_string(235 + i * 37 % 20);
    folder.write("m.pgm", picture + "\n");
    folder.write("m.yaml",
                 "image: m.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\n"
                 "occupied_thresh: 0.65\nfree_thresh: 0.1\n");
    const std::string file =
        folder.write("s.toml",
                     "[scenario]\nduration = \"2 s\"\n[scene]\nmap = \"m.yaml\"\n"
                     "[[robot]]\nname = \"a\"\nat = [\"1 m\", \"1 m\"]\n"
                     "[[traffic]]\nfrom = \"a\"\npayload = \"x\"\n");
    const std::string out = folder.path("run");
    REQUIRE(command(folder, {"run", file, "--record", "-q", "--out", out}).exit == 0);
    const std::string whole = text_of(out + "/trace.mcap");
    std::size_t cut_in_map = 0;
    for (std::size_t size = 100; size < whole.size(); size += 900) {
        CAPTURE(size);
        const std::string cut = folder.write("cut.mcap", whole.substr(0, size));
        const Ended ended = command(folder, {"replay", cut, "--verify"});
        CHECK(ended.exit != 0);
        CHECK(ended.err.find("cut.mcap: ") != std::string::npos);
        // No file of a temporary folder, which the user does not know.
        std::string rest = ended.err;
        for (auto at = rest.find(cut); at != rest.npos; at = rest.find(cut))
            rest.erase(at, cut.size());
        CHECK(rest.find("/rovernet-") == std::string::npos);
        cut_in_map += ended.err.find("cannot be read: ") != std::string::npos;
    }
    CHECK(cut_in_map > 3);
}

TEST_CASE("replay: a trace whose Stage world has other walls since then is refused") {
    const TemporaryFolder folder;
    const std::string wall = "model ( size [0.2 6 2] pose [5 0 0 0] )\n";
    const std::string robots =
        "position ( name \"a\" wifi ( ) )\nposition ( name \"b\" pose [9 0 0 0] wifi ( ) )\n";
    folder.write("w.world", wall + robots);
    const std::string file =
        folder.write("s.toml",
                     "[scenario]\nduration = \"2 s\"\n[scene]\nworld = \"w.world\"\n"
                     "[[traffic]]\nfrom = \"a\"\npayload = \"x\"\n");
    const std::string out = folder.path("run"), trace = out + "/trace.mcap";
    REQUIRE(command(folder, {"run", file, "--record", "-q", "--out", out}).exit == 0);
    const std::vector<std::vector<std::string>> commands{
        {"replay", trace, "--verify"},
        {"replay", trace, "--with", "radio.power=5 dBm"},
        {"view", trace, "-o", folder.path("v.html")},
        {"trace", "convert", trace, folder.path("x.pcapng"), "--to", "pcapng"}};
    for (const auto& words : commands) CHECK(command(folder, words).exit == 0);
    folder.write("w.world", "model ( size [1 6 2] pose [7 0 0 0] )\n" + wall + robots);
    for (const auto& words : commands) {
        CAPTURE(words[0]);
        const Ended ended = command(folder, words);
        CHECK(ended.exit == 3);
        CHECK(ended.err.find("w.world have changed since this run was recorded") !=
              std::string::npos);
    }
    folder.write("w.world", robots);  // all walls are gone
    CHECK(command(folder, commands[0]).exit == 3);
    // What needs neither levels nor walls is still there.
    CHECK(command(folder, {"trace", "follow", trace, "--message", "0"}).exit == 0);

    // A world that was moved is found beside the trace.
    folder.write("run/w.world", wall + robots);
    std::filesystem::remove(folder.path("w.world"));
    CHECK(command(folder, commands[0]).exit == 0);
}

}  // namespace replay_test
