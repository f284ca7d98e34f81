// SPDX-License-Identifier: MIT
// Varies the key `propagation.exponent` of a scenario: which share of the robots hears a call?
#include "rovernet.hpp"

#include <fmt/format.h>

using namespace rovernet;

constexpr std::string_view line = R"(
[scenario]
duration = "10 s"
[radio]
power = "0 dBm"
[propagation]
model = "log_distance"
[[robot]]
name = "r"
count = 6
move = { model = "random_waypoint", area = [["0 m", "0 m"], ["80 m", "10 m"]], start = "stationary" }
[[traffic]]
from = "r1"
payload = "who hears me?"
every = "1 s"
stop = "9 s"
)";

int main() {
    const ScenarioFile file(parse_toml(line, "line"), "", {});
    for (const double exponent : {2.0, 2.5, 3.0, 3.5}) {
        Table settings;
        settings.set("propagation.exponent", exponent);
        Session session(file, settings);
        session.step(session.end());
        fmt::print("n = {}: {:.2f} of the robots hear a call\n", exponent,
                   *session.network().metrics().delivery_ratio);
    }
}
