// SPDX-License-Identifier: MIT
#include "study/calibration/free_parameters.hpp"

#include "models/propagation/list.hpp"
#include "scenario/document/toml.hpp"
#include "sim/error.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>

namespace free_parameters_test {
using namespace rovernet;

namespace {

Scenario open_field(const std::string& keys = "") {
    return read_scenario(
        parse_toml("robot = [{ name = \"A\", at = [\"0 m\", \"0 m\"] }]\n" + keys, "s.toml"),
        "s.toml");
}

}  // namespace

TEST_CASE(
    "free parameters: for each model, the keys that a fit may change and their base values are as "
    "expected") {
    std::string all;
    for_each_model([&]<class Model>() {
        for (const FreeParameter& p : free_parameters(Model::name)) {
            all += fmt::format("{} {} {}{}{} {}\n", p.model, p.key, p.fit.base, p.unit,
                               p.non_negative ? " >= 0" : "", static_cast<int>(p.fit.way));
        }
    });
    CHECK(all ==
          "disc range 0m >= 0 4\n"
          "itu_indoor coefficient 30 1\n"
          "log_distance exponent 2 1\n"
          "log_distance excess 500dB 2\n"
          "multi_wall exponent 2 1\n"
          "multi_wall excess 500dB 2\n"
          "multi_wall light_wall 0dB >= 0 1\n"
          "multi_wall heavy_wall 0dB >= 0 1\n"
          "raytrace_2007 coefficient 30 1\n"
          "raytrace_2007 wall_factor 0 >= 0 1\n"
          "rays wall_loss 10dB >= 0 3\n"
          "rays reflection_loss 6dB >= 0 3\n");
    CHECK(key_determined(LogDistance::name, Fit::Way::spread) == "sigma");
}

TEST_CASE(
    "free parameters: a parameter gets exactly the given value; a value out of range is refused") {
    const Scenario scenario = open_field("[propagation]\nmodel = \"friis\"\nexponent = 3.0\n");
    const Propagation fitted = model_with(scenario, LogDistance::name, {{"exponent", 0.1 + 0.2}});
    CHECK(fitted.as<LogDistance>()->exponent == 0.1 + 0.2);
    CHECK(model_with(scenario, LogDistance::name, {}).as<LogDistance>()->exponent == 3);
    CHECK_THROWS_WITH_AS(model_with(scenario, LogDistance::name, {{"exponent", -1}}),
                         "s.toml:2:1: exponent: found the number -1.0; expected a value > 0",
                         InputError);
    CHECK_THROWS_AS(model_with(scenario, Disc::name, {}), InputError);  // it needs a range
}

}  // namespace free_parameters_test
