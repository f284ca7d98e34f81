// SPDX-License-Identifier: MIT
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"
#include "test/study/small_scenarios.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

namespace fit_test {
using namespace rovernet;
using namespace rovernet::test;

TEST_CASE("fit: +- is half the 95 % interval by Student's t of groups - 1 degrees") {
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

}  // namespace fit_test
