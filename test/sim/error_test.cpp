// SPDX-License-Identifier: MIT
#include "sim/error.hpp"

#include <doctest/doctest.h>

#include <string>
#include <type_traits>
#include <vector>

namespace error_test {
using namespace rovernet;

namespace {

const std::vector<std::string> models = {"disc", "friis", "two_ray", "itu_indoor", "log_distance"};

}  // namespace

TEST_CASE(
    "location: text() gives FILE:LINE:COLUMN, FILE if no line is known, or an option's text") {
    CHECK(Location{"rescue.toml", 9, 4}.text() == "rescue.toml:9:4");
    CHECK(Location{"office.png"}.text() == "office.png");
    CHECK(Location{.source = "--set radio.power=3", .is_option = true}.text() ==
          "--set radio.power=3");
}

TEST_CASE("input error: what() returns file, line and column, then the message") {
    const InputError error({"rescue.toml", 9, 4}, "unknown model \"log_distnace\"");
    CHECK(std::string(error.what()) == "rescue.toml:9:4: unknown model \"log_distnace\"");
    CHECK(error.message() == "unknown model \"log_distnace\"");
    CHECK(error.where().line == 9);
    CHECK(std::string(InputError({}, "no input").what()) == "no input");
}

TEST_CASE("run error: a RunError is not an InputError") {
    CHECK_THROWS_AS(throw RunError("too many events"), RunError);
    CHECK(!std::is_base_of_v<InputError, RunError>);
}

TEST_CASE("did you mean: for a misspelt word the nearest known word is suggested") {
    CHECK(did_you_mean("log_distnace", models) == "did you mean \"log_distance\"?");
    CHECK(did_you_mean("fris", models) == "did you mean \"friis\"?");
    CHECK(did_you_mean("a", {"B", "A"}) == "did you mean \"A\"?");
    CHECK(did_you_mean("X", {"B", "A"}).empty());
    CHECK(did_you_mean("disk", models) == "did you mean \"disc\"?");
    CHECK(did_you_mean("rnu", {"runs", "run"}) == "did you mean \"run\"?");
    CHECK(did_you_mean("ta", {"at"}) == "did you mean \"at\"?");
    CHECK(did_you_mean("form", {"forum", "from"}) == "did you mean \"forum\"?");  // equally near
    CHECK(did_you_mean("from", {"form", "front"}) == "did you mean \"form\"?");
    CHECK(did_you_mean("distance", models) == "did you mean \"log_distance\"?");
}

TEST_CASE("did you mean: if no known word is near, nothing is suggested") {
    CHECK(did_you_mean("hovercraft", models).empty());
    CHECK(did_you_mean("", models).empty());
    CHECK(did_you_mean("disc", {}).empty());
    CHECK(did_you_mean(std::string(100'000, 'x'), models).empty());
    CHECK(did_you_mean("xa", {"ay"}).empty());  // no swap
    CHECK(did_you_mean("ax", {"ya"}).empty());
}

}  // namespace error_test
