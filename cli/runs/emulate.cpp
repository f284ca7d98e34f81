// SPDX-License-Identifier: MIT
#include "cli/run/run.hpp"
#include "cli/runs/fronts.hpp"
#include "cli/runs/serving.hpp"
#include "cli/runs/view_option.hpp"
#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/options.hpp"
#include "live/emulate/device_addresses.hpp"
#include "live/emulate/inside.hpp"
#include "live/emulate/listeners.hpp"
#include "live/emulate/robot_network.hpp"
#include "live/player/listeners.hpp"

#include <fmt/format.h>

#include <charconv>
#include <pwd.h>
#include <sys/types.h>

namespace rovernet::cli {
namespace {

struct EmulateArguments : FileArguments {
    std::optional<std::string> out, udp, player;
    FrontArguments fronts;
    ViewOption view;
    std::string late = "10ms", on_late = "warn";
    double speed = 1;
    Reach reach;
    bool json = false;
};

FrontListeners udp_listeners(const EmulateArguments& a, const Scenario& scenario) {
    const Address first = a.reach.without_token(*a.udp);
    check_udp_ports(first, robot_names(scenario).size());
    return udp_relay(first);
}

PacedOptions emulation_options(const EmulateArguments& a, const Scenario& scenario,
                               const StopRules& stop) {
    PacedOptions options;
    options.stop = stop;
    options.folder = results_folder(a.out, scenario, a.options);
    options.speed = a.speed;
    options.fronts.push_back(a.udp ? udp_listeners(a, scenario)
                                   : tap_devices(options.folder, stop.go_on));
    if (a.player) {
        options.fronts.push_back(
            player_ports(a.reach.without_token(*a.player), robot_names(scenario), {}));
    }
    a.fronts.append_to(options.fronts, a.reach);
    if (a.view.is_given())
        options.fronts.push_back(a.view.listeners(a.reach, {.speed = options.speed}));
    options.say = a.view.announced(announcer(a.json ? Announced::by_notice : Announced::by_output));
    options.most_late = time_of("--late", a.late);
    options.late_ends = a.on_late == "fail";
    return options;
}

void emulate(const EmulateArguments& a) {
    const Scenario scenario = scenario_of(a);
    if (!a.udp) {
        for (const std::string& each : check_device_addresses(scenario)) notice(each);
    }
    ServingStop stop;
    const PacedOptions options = emulation_options(a, scenario, stop.rules());
    const LiveResult result = run_paced(scenario, options);
    print_run(result.scenario, result.run, a.json);
    if (!a.json) {
        fmt::print(
            "late               {:.3f} ms behind real time at most; more than 1 ms late at {:.1f} "
            "% of the event times\n",
            1e3 * seconds(result.lateness->most), 100 * result.lateness->share());
    }
    if (!result.fault.empty()) throw CommandEnd(failed, result.fault);
}

struct InArguments {
    std::string robot;
    std::optional<std::string> run, user;
    std::vector<std::string> program;
};

std::optional<long> whole_number_of(const std::string& text) {
    long number = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    return error == std::errc{} && rest == end ? std::optional(number) : std::nullopt;
}

/// The user of a name or a number.
uid_t user_of(const std::string& text) {
    if (const passwd* const found = getpwnam(text.c_str())) return found->pw_uid;
    constexpr long largest = 4'294'967'294;
    const auto number = whole_number_of(text);
    if (number && *number >= 0 && *number <= largest) return static_cast<uid_t>(*number);
    throw CommandEnd(usage, fmt::format("--user: found {}, which is no user of this machine; "
                                        "expected the name or the number of a user",
                                        text));
}

WantedRun wanted_run(const InArguments& a) {
    WantedRun wanted;
    if (a.user) wanted.user = user_of(*a.user);
    if (!a.run) return wanted;
    constexpr long largest = 1 << 22;  // of Linux
    const auto number = whole_number_of(*a.run);
    if (number && (*number < 1 || *number > largest)) {
        throw CommandEnd(
            usage,
            fmt::format(
                "--run {}: expected the process id of a run, from 1 to {}, or the folder of a run",
                *a.run, largest));
    }
    if (number) {
        wanted.process = static_cast<pid_t>(*number);
    } else {
        wanted.folder = *a.run;
    }
    return wanted;
}

void run_in(const InArguments& a) {
    const RobotNetwork network = find_network(a.robot, wanted_run(a));
    const ProgramEnd end = run_inside(network, a.program);
    if (!end.run_ended_it) end_like(end.status);
    throw CommandEnd(failed, fmt::format("the run in {} has ended, so {} was stopped",
                                         folder_text(network.folder), a.program.front()));
}

}  // namespace

void add_emulate(Command app) {
    const auto [command, a] = add_command(
        app, "emulate", "Pass the packets of real programs over simulated radios, in real time",
        emulate);
    command.add_examples({"rovernet emulate examples/emulate/emulate.toml",
                          "rovernet emulate examples/rescue/rescue.toml --udp --rosbridge"});
    add_file(command, a, any_file);
    command
        .add_option("--udp", a.udp,
                    "exchange packets with programs as UDP datagrams, at one port for each robot: "
                    "127.0.0.1:PORT and the ports that follow; port 0 selects free ports (default "
                    "port: 7100)")
        .usually(relay_address.data());
    command
        .add_option("--player", a.player,
                    "also serve Player clients, one port for each robot: 127.0.0.1:PORT and the "
                    "ports that follow; port 0 selects free ports (default port: 6665)")
        .usually(player_address.data());
    a.fronts.add_to(command);
    a.view.add_to(command);
    command.add_option("--speed", a.speed, "speed relative to real time (default: 1)")
        .check(speed_of_time());
    command
        .add_option("--late", a.late,
                    "longest time by which the run may lag behind real time; --on-late says what "
                    "happens if the run lags more")
        .shows_default();
    command
        .add_option(
            "--on-late", a.on_late,
            "what to do when the run lags behind real time by more than --late: warn (once), or "
            "fail (end the run)")
        .one_of({"warn", "fail"})
        .shows_default();
    command.add_option("--out", a.out, "folder for the results (default: as for rovernet run)");
    a.reach.add_to(command);
    add_json(command, a.json);
}

void add_in(Command app) {
    const auto [command, a] = add_command(
        app, "in",
        "Run a program with the simulated network interface of a robot of rovernet emulate",
        run_in);
    command.add_examples(
        {"rovernet in A -- ping 10.0.0.2", "rovernet in --run runs/emulate-s1 A -- ping 10.0.0.2"});
    command.add_option("ROBOT", a.robot, "name of the robot").required();
    command.add_option("PROGRAM", a.program, "program and its arguments, after --").required();
    command.add_option(
        "--run", a.run,
        "process id or results folder of the run, if several runs have a robot of this name");
    command.add_option("--user", a.user,
                       "only for root: user who started the run; this user can read and change all "
                       "packets of the program (default: yourself)");
}

}  // namespace rovernet::cli
