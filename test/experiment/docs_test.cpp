// SPDX-License-Identifier: MIT
// The scenarios in the documentation, as a reader would try them.
#include "experiment/build.hpp"
#include "experiment/run.hpp"
#include "scenario/scenario.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using namespace rovernet;
using rovernet::test::TemporaryFolder;

namespace {

struct Block {
    std::string place, text;
};

/// Every ```toml block of a page.
std::vector<Block> blocks_of(const std::filesystem::path& path) {
    std::vector<Block> blocks;
    std::ifstream file(path);
    bool inside = false;
    int number = 0;
    for (std::string line; std::getline(file, line);) {
        ++number;
        if (!inside && line == "```toml") {
            blocks.push_back({path.filename().string() + ":" + std::to_string(number), ""});
            inside = true;
        } else if (inside && line == "```") {
            inside = false;
        } else if (inside) {
            blocks.back().text += line + "\n";
        }
    }
    return blocks;
}

const auto root = std::filesystem::path(ROVERNET_EXAMPLES).parent_path();

std::vector<Block> all_blocks() {
    std::vector<std::filesystem::path> pages{root / "README.md"};
    for (const auto& entry : std::filesystem::directory_iterator(root / "docs")) {
        if (entry.path().extension() == ".md") pages.push_back(entry.path());
    }
    std::sort(pages.begin(), pages.end());
    std::vector<Block> blocks;
    for (const auto& page : pages) {
        for (Block& block : blocks_of(page)) blocks.push_back(std::move(block));
    }
    return blocks;
}

/// What is wrong with the scenario; empty if it runs.
std::string fault_of(const TemporaryFolder& folder, const std::string& text) {
    try {
        const Scenario scenario =
            load_scenario(folder.write("block.toml", text), ScenarioOptions{});
        Network network(network_settings(scenario));
        populate(network, scenario);
        network.run_for(std::chrono::milliseconds{10});
        return "";
    } catch (const std::exception& error) {
        return error.what();
    }
}

/// The text of a page.
std::string page(const std::string& name) {
    std::ifstream file(root / "docs" / name);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The `count` characters behind `words`; empty if they are not there.
std::string behind(const std::string& text, const std::string& words, std::size_t count) {
    const auto found = text.find(words);
    return found == text.npos ? "" : text.substr(found + words.size(), count);
}

std::string fingerprint_of(const std::string& text, const std::vector<std::string>& set) {
    const TemporaryFolder folder;
    const Scenario scenario = load_scenario(folder.write("s.toml", text), {.set = set});
    return run_scenario(scenario, {.folder = folder.path("out"), .speed = {}}).fingerprint;
}

}  // namespace

TEST_CASE("docs: the fingerprints on the pages are those of their scenarios") {
    constexpr std::size_t digits = 16;
    const auto hello = blocks_of(root / "docs" / "scenario.md").at(0).text;
    CHECK(behind(page("scenario.md"), "fingerprint        ", digits) == fingerprint_of(hello, {}));

    const auto blocks = blocks_of(root / "docs" / "determinism.md");
    const std::string two = blocks.at(0).text, three = two + blocks.at(1).text;
    const auto row = [text = page("determinism.md")](const std::string& arguments) {
        return behind(text, "| `rovernet run " + arguments + "` | ", digits);
    };
    CHECK(row("two.toml") == fingerprint_of(two, {}));
    CHECK(row("three.toml") == fingerprint_of(three, {}));
    CHECK(row("two.toml --set propagation.model=itu_indoor") ==
          fingerprint_of(two, {"propagation.model=itu_indoor"}));
    CHECK(row("two.toml --seed 2") == fingerprint_of(two, {"scenario.seed=2"}));
}

TEST_CASE("docs: every TOML block runs, or is a part of a scenario that runs") {
    const TemporaryFolder folder;
    folder.write("robots.world", "position ( name \"robot1\" wifi ( model \"friis\" ) )\n");
    folder.write("scen.tcl", "$node_(0) set X_ 1.0\n$node_(3) set X_ 9.0\n");
    folder.write("cbr.tcl",
                 "set udp_(0) [new Agent/UDP]\n$ns_ attach-agent $node_(3) $udp_(0)\n"
                 "set null_(0) [new Agent/Null]\n$ns_ attach-agent $node_(0) $null_(0)\n"
                 "set cbr_(0) [new Application/Traffic/CBR]\n$cbr_(0) attach-agent $udp_(0)\n"
                 "$cbr_(0) set interval_ 0.25\n$cbr_(0) set packetSize_ 512\n"
                 "$ns_ connect $udp_(0) $null_(0)\n$ns_ at 1.0 \"$cbr_(0) start\"\n");
    const std::string robots =
        "[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\n"
        "[[robot]]\nname = \"B\"\nat = [\"9 m\", \"0 m\"]\n";
    const std::vector<Block> blocks = all_blocks();
    REQUIRE(blocks.size() >= 10);
    for (const Block& block : blocks) {
        CAPTURE(block.place);
        const bool whole = block.text.find("robot]]") != std::string::npos ||
                           block.text.find("robot = [") != std::string::npos;
        const std::string alone = fault_of(folder, block.text);
        if (whole) {
            CHECK(alone == "");
            continue;
        }
        const bool part = alone.empty() || fault_of(folder, robots + block.text).empty() ||
                          fault_of(folder, block.text + robots).empty();
        CAPTURE(fault_of(folder, robots + block.text));
        CHECK(part);
    }
}
