// SPDX-License-Identifier: MIT
#include "test/cli/process.hpp"

#include <doctest/doctest.h>

#include <string>

namespace validate_test {
using namespace rovernet;
using test::Ended;
using test::TemporaryFolder;

namespace {

bool holds(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("validate: a missing folder of measurements is an error before anything is run") {
    const TemporaryFolder folder;
    const Ended run = test::command(
        folder, {"validate", "--quick", "--field", folder.path("nowhere"), "-o", folder.path("r")});
    CHECK(run.exit == 3);
    CHECK(holds(run.err, "nowhere"));
    CHECK(run.out.empty());
}

TEST_CASE("validate: the folder of the report is required") {
    const TemporaryFolder folder;
    const Ended run = test::command(folder, {"validate", "--quick"});
    CHECK(run.exit == 2);
    CHECK(holds(run.err, "--output"));
}

}  // namespace validate_test
