// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <string>

// Scenarios whose runs take one or two milliseconds, for tests of studies and their commands.

namespace rovernet::test {

/// Scenario of eight robots on an open field that send messages.
inline const std::string talkers = R"([scenario]
name = "talkers"
duration = "4 s"
[radio]
power = "-20 dBm"
sensitivity = "-85 dBm"
antenna_height = "1 m"
[[robot]]
name = "r"
count = 8
place = { model = "uniform", area = [["0 m", "0 m"], ["60 m", "60 m"]] }
[routing]
protocol = "flood"
ttl = 2
jitter = "10 ms"
[[traffic]]
from = "random"
size = "64 B"
every = "500 ms"
)";

/// Scenario with robot A at the origin and B at (x, 0) [m]; A sends a message each second.
/// @param more  further tables of the scenario, placed before the robots
inline std::string two_robots(double x, const std::string& more) {
    return fmt::format(R"([scenario]
duration = "5 s"
{}
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["{} m", "0 m"]
[routing]
protocol = "flood"
[[traffic]]
kind = "broadcast"
from = "A"
payload = "x"
start = "1 s"
every = "1 s"
)",
                       more, x);
}

/// Table [propagation] with a disc of 10 m.
inline const std::string disc = R"([propagation]
model = "disc"
range = "10 m"
)";

}  // namespace rovernet::test
