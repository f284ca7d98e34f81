// SPDX-License-Identifier: MIT
// Programs of two robots on the sides of a door that closes and opens: examples/emulate/door.toml.
#include "live/emulate/relay.hpp"
#include "scenario/scenario_file.hpp"
#include "test/live/emulate/programs.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>

namespace emulated_door_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;
using namespace std::string_literals;

TEST_CASE(
    "emulate: pings get no answer while the door between two robots is closed, and answers after "
    "it opens") {
    const std::string path = std::string(ROVERNET_EXAMPLES) + "/emulate/door.toml";
    Programs programs(std::make_unique<RelayFormat>(), load_scenario(path, {}));
    std::string answered;  // second by second
    for (Time t = start_of_run; t < start_of_run + 30s; t += 1s) {
        programs.run_to(t + 200ms);
        const std::size_t before = programs.got.size();
        programs.send(0, "RN\x01\x00\x01\x00\x00\x00ping"s);
        programs.run_to(t + 500ms);
        if (programs.got.size() > before) programs.send(1, "RN\x01\x00\x00\x00\x00\x00pong"s);
        programs.run_to(t + 800ms);
        answered += programs.got.size() == before + 2 ? '!' : '.';
    }
    CHECK(answered == "!!!!!!!!!!..........!!!!!!!!!!");
}

}  // namespace emulated_door_test
