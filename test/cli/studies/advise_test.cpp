// SPDX-License-Identifier: MIT
#include "study/store.hpp"
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"
#include "test/study/small_scenarios.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace advise_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

struct Advised {
    TemporaryFolder folder;
    std::string file = folder.write("talkers.toml", talkers);
    std::string store() const { return folder.path("advice.db"); }

    std::vector<std::string> words(std::vector<std::string> more) const {
        std::vector<std::string> all = {
            "advise",        file,        "--tolerance",        "0.1", "--models",
            "friis,two_ray", "--no-cost", "--max-replications", "60"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
};

std::size_t runs_in(const std::string& store) {
    try {
        return std::filesystem::exists(store) ? Store::open(store).runs().size() : 0;
    } catch (const std::exception&) {
        return 0;  // it is only just being made
    }
}

}  // namespace

TEST_CASE(
    "advise: prints a verdict on each candidate, the advice in words, and the chosen models as "
    "scenario tables") {
    const Advised advised;
    const Ended text = command(advised.folder, advised.words({}));
    CAPTURE(text.err);
    REQUIRE(text.exit == 0);
    for (const char* part :
         {"delivery_ratio in ", "candidate", "friis + sinr", "two_ray + sinr", "reference", "Take ",
          "[propagation]\nmodel = ", "[reception]\nmodel = "}) {
        CAPTURE(part);
        CHECK(text.out.find(part) != std::string::npos);
    }
    // Keys of other models are left out, those of the file's, too.
    const Ended other = command(
        advised.folder, advised.words({"--set", "propagation.coefficient=30", "--as-given"}));
    for (const char* key : {"coefficient", "capture_ratio", "interference_cut"}) {
        CAPTURE(key);
        const bool takes = other.out.find("[reception]\nmodel = \"sinr\"") != std::string::npos;
        if (!takes || std::string(key) != "interference_cut")
            CHECK(other.out.find(key) == std::string::npos);
    }
    // The tables are a part of a scenario: with them it runs.
    const std::string tables = text.out.substr(text.out.find("[propagation]"));
    advised.folder.write("chosen.toml", talkers + tables);
    CHECK(command(advised.folder, {"run", advised.folder.path("chosen.toml"), "--json", "--out",
                                   advised.folder.path("out")})
              .exit == 0);
}

TEST_CASE("advise: notices name the candidate, and none is about a key of another candidate") {
    const Advised advised;
    auto words = advised.words({"--set", "routing.protocol=managed"});
    words[5] = "disc,raytrace_2007";
    advised.folder.write("talkers.toml", talkers + "[propagation]\nwall_factor = 3\n");
    const Ended ended = command(advised.folder, words);
    CHECK(ended.err.find("candidate disc: model: ") != std::string::npos);
    CHECK(ended.err.find("wall_factor") == std::string::npos);
}

TEST_CASE("advise: the number of workers does not change the advice") {
    const Advised advised;
    const Json one = json_of(advised.folder, advised.words({"--workers", "1"}));
    const Json two = json_of(advised.folder, advised.words({"--workers", "2"}));
    CHECK(one == two);
    CHECK(one["candidates"].size() >= 4);
    CHECK(one["method"] == "betting");
    CHECK(one["reference"]["path_loss"] == "two_ray");
}

TEST_CASE(
    "advise: an interrupted and continued study gives the same advice as one without "
    "interruption") {
    const Advised advised;
    const auto with_store = advised.words({"--store", advised.store(), "--workers", "1"});
    const Process first(advised.folder, with_store);
    while (runs_in(advised.store()) < 30) std::this_thread::sleep_for(std::chrono::milliseconds{1});
    first.interrupt();
    const Ended ended = first.wait();
    CHECK(ended.exit == 130);
    CHECK(ended.err.find("continue with\n  rovernet advise ") != std::string::npos);
    const std::size_t kept = runs_in(advised.store());
    CHECK(kept >= 30);
    const Json resumed = json_of(advised.folder, with_store);
    CHECK(runs_in(advised.store()) > kept);
    CHECK(resumed == json_of(advised.folder, advised.words({"--workers", "2"})));
    // A stricter question takes what is there.
    const Json strict =
        json_of(advised.folder, advised.words({"--store", advised.store(), "--criterion", "run"}));
    CHECK(strict["criterion"] == "run");
}

TEST_CASE("advise: at the end of the time budget or at Ctrl-C, the preliminary advice is printed") {
    const Advised advised;
    const auto strict = [&](std::vector<std::string> more) {
        std::vector<std::string> words = advised.words({});
        std::ranges::replace(words, "0.1", "0.001");
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    const Process begun(advised.folder, strict({"--store", advised.store()}));
    while (runs_in(advised.store()) < 30) std::this_thread::sleep_for(std::chrono::milliseconds{1});
    begun.interrupt();
    const Ended ended = begun.wait();
    CHECK(ended.exit == 130);
    CHECK(ended.out.find("Interim: Take ") != std::string::npos);
    CHECK(ended.out.find("undecided when the command was stopped") != std::string::npos);
    // Nothing was compared yet: nothing is advised, and nothing is offered.
    const Ended nothing = command(advised.folder, strict({"--budget", "1us"}));
    CHECK(nothing.exit == 0);
    CHECK(nothing.out.find("Interim: nothing is known yet") != std::string::npos);
    CHECK(nothing.err.find("the time of --budget 1us is used up") != std::string::npos);
    CHECK(nothing.out.find("Take ") == std::string::npos);
    CHECK(nothing.out.find("[propagation]") == std::string::npos);
    CHECK(nothing.out.find("friis + sinr             undecided  -  -     -") != std::string::npos);
    const Json none = json_of(advised.folder, strict({"--budget", "1us"}));
    CHECK(none["choice"].is_null());
    CHECK(none["candidates"][0]["bias"].is_null());
    CHECK(command(advised.folder, strict({"--budget", "0 s"})).err.find("expected a time > 0") !=
          std::string::npos);
    CHECK(command(advised.folder, strict({"--budget", "soon"})).exit == 2);
}

TEST_CASE(
    "advise: unless --no-cost is given, prints CPU times of models, and draws error against cost") {
    const Advised advised;
    auto words = advised.words({"-o", advised.folder.path("advice.svg")});
    std::erase(words, "--no-cost");
    const Json json = json_of(advised.folder, words);
    CHECK(json["reference"]["cost_tx_s"] > 0);
    CHECK(json["candidates"][0]["cpu_run_s"] > 0);
    CHECK(json["candidates"][0]["radio_share"] <= 1);
    const std::string svg = content(advised.folder.path("advice.svg"));
    CHECK(svg.find("CPU time to find receivers per transmission") != std::string::npos);
    CHECK(svg.find("two_ray + sinr") != std::string::npos);
}

TEST_CASE("advise: a metric without bounds needs --tolerance, and is tested by Student's t") {
    const Advised advised;
    const std::vector<std::string> metric = {"advise", advised.file, "--no-cost", "--metric",
                                             "transmissions"};
    const Ended ended = command(advised.folder, metric);
    CHECK(ended.exit == 2);
    CHECK(ended.err.find("--metric transmissions: transmissions has no upper bound, so there is "
                         "no default tolerance; expected --tolerance") != std::string::npos);
    const Json json = json_of(
        advised.folder, {"advise", advised.file, "--no-cost", "--metric", "transmissions",
                         "--tolerance", "30", "--models", "two_ray", "--max-replications", "40"});
    CHECK(json["method"] == "t");
    CHECK(json["advice"].get<std::string>().find("by Student's intervals") != std::string::npos);
}

TEST_CASE("advise: the error for an invalid option says what was expected") {
    const Advised advised;
    const auto error = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"advise", advised.file};
        words.insert(words.end(), more.begin(), more.end());
        return command(advised.folder, words);
    };
    CHECK(error({"--tolerance", "1"}).err.find("expected a value below 1") != std::string::npos);
    CHECK(error({"--tolerance", "1"}).exit == 2);
    CHECK(error({"--tolerance", "0"}).exit == 2);
    CHECK(error({"--criterion", "max"}).exit == 2);
    CHECK(error({"--metric", "delivery"}).err.find("did you mean") != std::string::npos);
    CHECK(error({"--models", "fris"}).err.find("did you mean \"friis\"?") != std::string::npos);
    CHECK(error({"--reference", "radio.power=1"}).exit == 2);
    CHECK(error({"-o", "advice.txt"}).err.find("ends in .svg") != std::string::npos);
}

}  // namespace advise_test
