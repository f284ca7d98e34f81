// SPDX-License-Identifier: MIT
// A session: the program drives a robot of a scenario by velocity commands, reads its laser, and
// hears what it hears.
#include "rovernet.hpp"

#include <fmt/format.h>

using namespace rovernet;
using namespace std::chrono_literals;

constexpr std::string_view scenario = R"(
[scenario]
duration = "20 s"

[[robot]]
name = "beacon"
at = ["12 m", "0 m"]

[[robot]]
name = "rover"
at = ["0 m", "0 m"]
scan = { beams = 1, from = "0 deg", to = "0 deg", range = "20 m" }

[[traffic]]
from = "beacon"
payload = "here"
every = "4 s"
)";

int main() {
    Session session(ScenarioFile(parse_toml(scenario, "scenario"), "", {}));
    const NodeId rover = *session.network().find("rover");
    const ClientId client = session.attach({rover});
    for (Time t = start_of_run; t < session.end(); t += 1s) {
        const double free = session.scan(rover).front();
        session.drive(client, rover, {free > 3 ? 1.0 : 0.0}, {0});
        session.step(t + 1s);
        for (const HeardMessage& message : session.heard(client))
            fmt::print("{:6.3f} s  hears \"{}\", {:.1f} m ahead is something\n",
                       seconds(message.time), message.payload, free);
    }
    fmt::print("stops at {:.1f} m\n", session.network().position(rover).x);
}
