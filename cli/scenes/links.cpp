// SPDX-License-Identifier: MIT
#include "cli/scenes/scene_commands.hpp"
#include "cli/terminal/playing.hpp"
#include "experiment/reports/link_history.hpp"
#include "experiment/reports/link_table.hpp"
#include "experiment/reports/network_at.hpp"
#include "scenario/document/json.hpp"

#include <fmt/format.h>

#include <unistd.h>
#include <utility>

namespace rovernet::cli {
namespace {

void print_links(const LinkTable& table) {
    const Device& d = table.device;
    fmt::print("{}  ip {}  mac {}  essid \"{}\"  {:g} MHz  {}{}\n", d.robot, d.ip, d.mac, d.essid,
               d.frequency.value / 1e6, name_of(d.mode), d.encryption ? "  encrypted" : "");
    if (table.rows.empty()) fmt::print("  hears nobody\n");
    for (const LinkTable::Row& row : table.rows) {
        const Device& n = row.neighbour;
        fmt::print(
            "  hears {:<12} ip {:<15} mac {}  essid \"{}\"  {:g} MHz  {}{}  quality {:3}  {}\n",
            n.robot, n.ip, n.mac, n.essid, n.frequency.value / 1e6, name_of(n.mode),
            n.encryption ? "  encrypted" : "", row.quality,
            row.range ? fmt::format("{:.2f} m, within the sender's range of {:.6g} m",
                                    row.distance->value, row.range->value)
                      : fmt::format("level {:.2f} dBm  noise {:.2f} dBm", row.level.value,
                                    row.noise.value));
    }
}

void print_json(const Network& network, const LinksArguments& a) {
    fmt::print("{{\n  \"time_s\": {},\n  \"robots\": [", to_json_line(seconds(network.now())));
    const char* between = "\n";
    for_each_link_table(network, a.robot, [&](const LinkTable& table) {
        fmt::print("{}{}", std::exchange(between, ",\n"), to_json_line(link_table_document(table)));
    });
    fmt::print("\n  ]\n}}\n");
}

void print_history(const Scenario& scenario, const LinksArguments& a) {
    Playing playing(a.file, start_of_run + scenario.scenario.duration);
    // The lines themselves show how far it is if they go to the terminal.
    const TellTime tell = isatty(STDOUT_FILENO) != 0 ? TellTime{} : playing.tell();
    if (!a.json) {
        fmt::print("{}", link_history_csv_head(a.places));
        return for_each_link_change(
            scenario, a.robot,
            [&](const LinkHistoryRow& row) { fmt::print("{}", link_history_csv(row, a.places)); },
            tell);
    }
    fmt::print("{{\n  \"changes\": [");
    const char* between = "\n";
    for_each_link_change(
        scenario, a.robot,
        [&](const LinkHistoryRow& row) {
            fmt::print("{}{}", std::exchange(between, ",\n"),
                       to_json_line(link_history_document(row, a.places)));
        },
        tell);
    fmt::print("\n  ]\n}}\n");
}

}  // namespace

void links(const LinksArguments& a) {
    const Scenario scenario = scenario_of(a);
    if (a.history) return print_history(scenario, a);
    const Time at = time_in(scenario, a.at);
    const auto network = [&] {
        Playing playing(a.file, at);
        return network_at(scenario, at, playing.tell());
    }();
    if (a.json) return print_json(*network, a);
    for_each_link_table(*network, a.robot, print_links);
}

}  // namespace rovernet::cli
