// SPDX-License-Identifier: MIT
#pragma once

#include "test/live/emulate/emulation.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

// Runs of `emulate` with TAP devices, and programs in the robots' networks.

namespace rovernet::test {

/// Scenario in which A and B hear each other, and W is out of range. A ping takes 2 ms in each
/// direction: 84 bytes at 11 Mb/s after a preamble.
inline const std::string tap_scenario = R"([scenario]
name = "tap"
duration = "90 s"
[propagation]
model = "friis"
[radio]
sensitivity = "-70 dBm"
preamble = "1.94 ms"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["150 m", "0 m"]
[[robot]]
name = "W"
at = ["1 km", "0 m"]
)";

/// Emulation with TAP devices; null if this machine does not allow them.
inline std::unique_ptr<Emulation> emulated_by_tap(const std::string& text = tap_scenario) {
    auto emulation = std::make_unique<Emulation>(
        text, std::vector<std::string>{"--late", "60 s", "--set", "scenario.seed=1"});
    if (emulation->listening(3).size() == 3) return emulation;
    MESSAGE("skipped: no TAP devices in namespaces here: " << emulation->said_to_person());
    CHECK(emulation->said_to_person().find("the option --udp") != std::string::npos);
    return nullptr;
}

/// Process of a program that runs in a robot's network.
inline Process in(const TemporaryFolder& folder, const Emulation& run, const std::string& robot,
                  std::vector<std::string> program) {
    program.insert(program.begin(), {"in", robot, "--run", std::to_string(run.pid()), "--"});
    return {folder, std::move(program)};
}

/// Whether sockets of the run with this process id exist on the machine.
inline bool has_listeners(pid_t run) {
    return content("/proc/net/unix").find("@rovernet/" + std::to_string(run) + "/") !=
           std::string::npos;
}

}  // namespace rovernet::test
