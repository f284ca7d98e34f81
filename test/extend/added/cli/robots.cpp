// SPDX-License-Identifier: MIT
#include "cli/terminal/commands.hpp"
#include "cli/terminal/options.hpp"
#include "experiment/build.hpp"
#include "models/medium/medium.hpp"
#include "scenario/document/json.hpp"

#include <fmt/format.h>

namespace rovernet::cli {
namespace {

struct RobotsArguments : FileArguments {
    bool json = false;
};

/// Prints who is in a scenario, where everybody starts and how strong the radios are.
void robots(const RobotsArguments& arguments) {
    const Scenario scenario = scenario_of(arguments);
    Network network(network_settings(scenario));
    populate(network, scenario);
    Array rows;
    for (NodeId node{0}; node.index() < network.size(); ++node.value) {
        const Vec3 at = network.position(node);
        const double power = network.medium().stations().radio(node).power.value;
        if (!arguments.json) {
            fmt::print("{:12} {:9.2f} {:9.2f} m {:6.1f} dBm\n", network.name(node), at.x, at.y,
                       power);
            continue;
        }
        Table row;
        row.set("name", network.name(node));
        row.set("x_m", at.x);
        row.set("y_m", at.y);
        row.set("power_dbm", power);
        rows.emplace_back(std::move(row));
    }
    if (!arguments.json) return;
    Table table;
    table.set("robots", std::move(rows));
    fmt::print("{}\n", to_json(table));
}

}  // namespace

void add_robots(Command app) {
    const auto [command, a] =
        add_command(app, "robots", "Who is in a scenario, and where everybody starts", robots);
    command.add_examples({"rovernet robots examples/rescue/rescue.toml"});
    add_file(command, a, any_file);
    add_json(command, a.json);
}

}  // namespace rovernet::cli
