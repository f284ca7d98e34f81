// SPDX-License-Identifier: MIT
// Steps and pauses of ROS clients, without any messages.
#include "live/rosbridge/clock.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <string>
#include <vector>

namespace clock_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// Step of a client; its call has an id by which it is known again.
RosClock::Step step(const std::string& id, Duration until, RosClock::Connection client = 0) {
    return {client, {.name = "call_service", .id = id, .target = {}}, start_of_run + until};
}

/// Ids of calls, in their order.
std::string ids(const std::vector<RosClock::Step>& steps) {
    std::string found;
    for (const RosClock::Step& each : steps) found += *each.call.id;
    return found;
}

}  // namespace

TEST_CASE(
    "rosbridge clock: steps with the same end time are answered in the order of their calls") {
    RosClock clock;
    for (const char* id : {"b", "c", "a"}) clock.begin(step(id, 10ms));
    clock.begin(step("longer", 11ms));
    CHECK(ids(clock.end_steps(start_of_run + 10ms)) == "bca");
    CHECK_FALSE(clock.is_step_end(start_of_run + 10ms));
    CHECK(clock.next() == start_of_run + 11ms);
}

TEST_CASE("rosbridge clock: pause and resume end all unfinished steps, the oldest call first") {
    RosClock clock;
    const auto begin = [&] {
        clock.begin(step("a", 30ms, 1));
        clock.begin(step("b", 20ms, 2));
    };
    begin();
    CHECK(ids(clock.pause(3, start_of_run + 5ms)) == "ab");
    CHECK(clock.limit() == start_of_run + 5ms);
    CHECK(clock.next() == never);
    begin();
    CHECK(clock.limit() == start_of_run + 30ms);
    CHECK(ids(clock.unpause()) == "ab");
    CHECK(clock.limit() == never);
    CHECK(clock.next() == never);
}

TEST_CASE(
    "rosbridge clock: a step of a client that has left continues while another client pauses "
    "time") {
    RosClock clock;
    CHECK(clock.pause(1, start_of_run).empty());
    clock.begin(step("a", 10ms, 2));
    CHECK(clock.left(2).empty());
    CHECK(clock.next() == start_of_run + 10ms);
    CHECK(clock.limit() == start_of_run + 10ms);
    CHECK(clock.left(3).empty());  // it held nothing
    CHECK(clock.left(1).empty());  // nobody waits for the answer to "a"
    CHECK(clock.limit() == never);
    CHECK(clock.next() == never);
}

TEST_CASE(
    "rosbridge clock: if clients leave during steps, only the latest end of these steps is kept") {
    RosClock clock;
    CHECK(clock.pause(1, start_of_run).empty());
    for (RosClock::Connection client = 2; client < 1000; ++client) {
        clock.begin(step("a", client * 1ms, client));
        clock.begin(step("b", 5ms, client));
        CHECK(clock.left(client).empty());
        CHECK(clock.steps(client) == 0);
    }
    CHECK(clock.limit() == start_of_run + 999ms);
    CHECK(clock.next() == start_of_run + 999ms);
    CHECK_FALSE(clock.is_step_end(start_of_run + 5ms));
    CHECK(clock.is_step_end(start_of_run + 999ms));
    CHECK(clock.end_steps(start_of_run + 999ms).empty());
    CHECK(clock.next() == never);
}

}  // namespace clock_test
