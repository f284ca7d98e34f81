// SPDX-License-Identifier: MIT
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"
#include "test/study/small_scenarios.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

namespace fit_test {
using namespace rovernet;
using namespace rovernet::test;

TEST_CASE(
    "fit: the number after +- is half of Student's 95 % interval, with (groups - 1) degrees of "
    "freedom") {
    // Measured at three receivers: t(2) is 4.303, and not 1.96.
    const TemporaryFolder folder;
    const std::string file = folder.write("talkers.toml", talkers);
    std::string csv = "from_x_m,from_y_m,to_x_m,to_y_m,group,level_dbm\n";
    for (int receiver = 0; receiver < 3; ++receiver) {
        for (int i = 1; i <= 8; ++i) {
            const double wave = (receiver * 7 + i * 5) % 6;  // not on the line
            const double level = -40 - 10 * 2.5 * std::log10(5.0 * i) - wave;
            csv += std::to_string(5 * i) + ",0,0,0,r" + std::to_string(receiver) + "," +
                   std::to_string(level) + "\n";
        }
    }
    const std::string links = folder.write("levels.csv", csv);
    const Ended text = command(folder, {"fit", file, "--links", links});
    CAPTURE(text.err);
    REQUIRE(text.exit == 0);
    const Json json = json_of(folder, {"fit", file, "--links", links});
    REQUIRE(json["groups"] == 3);
    for (const Json& model : json["models"]) {
        if (model["model"] != "log_distance") continue;
        const Json& parameter = model["parameters"][0];
        const std::string key = parameter["key"];
        const std::size_t at = text.out.find(" +- ", text.out.find(key + " "));
        REQUIRE(at != std::string::npos);
        const double half = std::stod(text.out.substr(at + 4));
        const double expected = 4.3027 * parameter["se_by_group"].get<double>();
        CHECK(std::abs(half - expected) <= 0.06 * expected);  // two digits
        return;
    }
    FAIL("log_distance is not fitted");
}

namespace {

/// Levels of senders at some places on the x axis, at receivers by name, whose gains differ.
std::string levels_by(const std::vector<std::string>& receivers) {
    std::string csv = "from_x_m,from_y_m,to_x_m,to_y_m,group,level_dbm\n";
    int y = 0;
    for (const std::string& receiver : receivers) {
        y += 3;
        for (int i = 1; i <= 6; ++i) {
            const double d = std::sqrt(25.0 * i * i + y * y), gain = i % 2 == 0 ? 4 : -4;
            const double level = -40 - 25 * std::log10(d) + gain + (i * y) % 3;
            csv += fmt::format("{},0,0,{},{},{:.3f}\n", 5 * i, y, receiver, level);
        }
    }
    return csv;
}

}  // namespace

TEST_CASE(
    "fit: prints the column that divides the links into groups; with one group, errors are marked "
    "as in-sample") {
    const TemporaryFolder folder;
    const std::string file = folder.write("talkers.toml", talkers);
    const auto fitted = [&](const std::vector<std::string>& receivers) {
        const Ended text = command(
            folder, {"fit", file, "--links", folder.write("levels.csv", levels_by(receivers))});
        CAPTURE(text.err);
        REQUIRE(text.exit == 0);
        return text.out;
    };
    const auto has = [](const std::string& text, const char* part) {
        return text.find(part) != std::string::npos;
    };
    const std::string two = fitted({"monday", "tuesday"}), one = fitted({"monday"});
    CHECK(has(two, "in 2 groups (by group)"));
    CHECK(has(two, "error on each group, with the model fitted to all others"));
    CHECK_FALSE(has(two, "in-sample"));
    CHECK(has(one, "in 1 group (by group)"));
    CHECK(has(one, "rmse in-sample"));
    CHECK(has(one, "errors on the fitted links"));
}

TEST_CASE("fit --gains: prints the gain of each transmitter as a line for the scenario file") {
    const TemporaryFolder folder;
    const std::string file =
        folder.write("s.toml", talkers + "[[robot]]\nname = \"AP\"\nat = [\"10 m\", \"0 m\"]\n");
    const std::string links = folder.write("levels.csv", levels_by({"a", "b", "c"}));
    const std::vector<std::string> words = {"fit", file, "--links", links, "--gains"};
    const Ended text = command(folder, words);
    CAPTURE(text.err);
    REQUIRE(text.exit == 0);
    CHECK(text.out.find("dB\" }  # [[robot]] AP at (10.00, 0.00, 0.00) m") != std::string::npos);
    const Json json = json_of(folder, words);
    for (const Json& model : json["models"]) {
        if (model["model"] != "log_distance") continue;
        REQUIRE(model["gains"].size() == 6);
        const std::string line = model["gains"][1]["toml"];
        CAPTURE(line);
        CHECK(text.out.find(line + "  # [[robot]] AP") != std::string::npos);
        // The line is one of a [[robot]].
        const std::string pasted = folder.write(
            "pasted.toml",
            talkers + "[[robot]]\nname = \"AP\"\nat = [\"10 m\", \"0 m\"]\n" + line + "\n");
        const Json budget = json_of(folder, {"link", pasted, "AP", "r0"});
        const double found = std::stod(line.substr(line.find('"') + 1));
        CHECK(std::abs(found - model["gains"][1]["gain_db"].get<double>()) <= 0.005);
        CHECK(budget["up"].is_boolean());
        return;
    }
    FAIL("log_distance is not fitted");
}

}  // namespace fit_test
