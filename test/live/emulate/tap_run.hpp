// SPDX-License-Identifier: MIT
#pragma once

#include "test/live/emulate/emulation.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

// Runs of `emulate` with TAP devices, and programs inside.

namespace rovernet::test {

/// A and B hear one another, and a ping takes 2 ms each way: 84 bytes at 11 Mb/s behind a preamble.
/// W is out of range.
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

/// The emulation, if this machine allows it.
inline std::unique_ptr<Emulation> emulated_by_tap(const std::string& text = tap_scenario) {
    auto emulation = std::make_unique<Emulation>(
        text, std::vector<std::string>{"--late", "60 s", "--set", "scenario.seed=1"});
    if (emulation->listening(3).size() == 3) return emulation;
    MESSAGE("skipped: no TAP devices in namespaces here: " << emulation->said_to_person());
    CHECK(emulation->said_to_person().find("there is --udp") != std::string::npos);
    return nullptr;
}

/// A program with a robot's network.
inline Process in(const TemporaryFolder& folder, const Emulation& run, const std::string& robot,
                  std::vector<std::string> program) {
    program.insert(program.begin(), {"in", robot, "--run", std::to_string(run.pid()), "--"});
    return {folder, std::move(program)};
}

/// Whether something of a run is left on the machine.
inline bool has_listeners(pid_t run) {
    return content("/proc/net/unix").find("@rovernet/" + std::to_string(run) + "/") !=
           std::string::npos;
}

}  // namespace rovernet::test
