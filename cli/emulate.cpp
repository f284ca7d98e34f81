// SPDX-License-Identifier: MIT
#include "cli/diagnostics.hpp"
#include "cli/options.hpp"
#include "cli/run_output.hpp"
#include "cli/serving.hpp"
#include "cli/stop.hpp"
#include "live/emulate/device_addresses.hpp"
#include "live/emulate/door.hpp"
#include "live/emulate/namespaces.hpp"
#include "live/player/door.hpp"
#include "live/rosbridge/door.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <unistd.h>

namespace rovernet::cli {
namespace {

struct EmulateArguments : FileArguments {
    std::optional<std::string> out, udp, player, rosbridge;
    std::string late = "10ms", on_late = "warn";
    double speed = 1;
    Reach reach;
    bool json = false;
};

PacedOptions emulation_options(const EmulateArguments& a, const Scenario& scenario) {
    PacedOptions options;
    options.folder = results_folder(a.out, scenario, a.options);
    options.speed = a.speed;
    options.fronts.push_back(a.udp ? udp_relay(a.reach.without_token(*a.udp)) : tap_devices());
    if (a.player) {
        options.fronts.push_back(
            player_ports(a.reach.without_token(*a.player), robot_names(scenario), {}));
    }
    if (a.rosbridge) options.fronts.push_back(rosbridge_door(a.reach.with_token(*a.rosbridge)));
    options.go_on = goes_on;
    options.say = say_to_all;
    options.most_late = time_of("--late", a.late);
    options.late_ends = a.on_late == "fail";
    return options;
}

void emulate(const EmulateArguments& a) {
    const Scenario scenario = scenario_of(a);
    const PacedOptions options = emulation_options(a, scenario);
    const HeldStop serving;
    const LiveResult result = run_paced(scenario, options);
    print_run(result.scenario, result.run, a.json);
    if (!a.json) {
        fmt::print(
    if (!a.udp) {
        for (const std::string& each : check_device_addresses(scenario)) notice(each);
    }
            "late               {:.3f} ms at most, {:.1f} % of the times by more than 1 ms\n",
            1e3 * seconds(result.lateness->most), 100 * result.lateness->share());
    }
    if (!result.fault.empty()) throw CommandEnd(failed, result.fault);
}

struct InArguments {
    std::string robot;
    std::optional<std::uint64_t> run;
    std::vector<std::string> program;
};

void run_in(const InArguments& a) {
    enter_namespace(a.robot, a.run ? std::optional(static_cast<pid_t>(*a.run)) : std::nullopt);
    std::vector<std::string> words = a.program;
    std::vector<char*> arguments;
    for (std::string& each : words) arguments.push_back(each.data());
    arguments.push_back(nullptr);
    std::signal(SIGPIPE, SIG_DFL);
    execvp(arguments.front(), arguments.data());
    throw CommandEnd(failed, fmt::format("{}: {}", words.front(), std::strerror(errno)));
}

}  // namespace

void add_emulate(Command app) {
    const auto [command, a] = add_command(
        app, "emulate", "Carry the packets of real programs by the robots' radios, in real time",
        emulate);
    command.add_examples({"rovernet emulate examples/emulate/emulate.toml",
                          "rovernet emulate examples/rescue/rescue.toml --udp --rosbridge"});
    add_file(command, a, any_file);
    command
        .add_option("--udp", a.udp,
                    "serve datagrams, at 127.0.0.1:PORT and the ports that follow, one for each "
                    "robot; port 0: any that is free (default: 7100)")
        .usually(relay_address.data());
    command
        .add_option("--player", a.player,
                    "serve Player clients, too, at 127.0.0.1:PORT and the ports that follow; port "
                    "0: any that is free (default: 6665)")
        .usually(player_address.data());
    command
        .add_option("--rosbridge", a.rosbridge,
                    "serve ROS clients, too, at 127.0.0.1:PORT; port 0: any that is free (default: "
                    "9090)")
        .usually(rosbridge_address.data());
    command.add_option("--speed", a.speed, "simulated per real time").check(above_zero());
    command.add_option("--late", a.late, "real time by which it may be behind the clock")
        .shows_default();
    command.add_option("--on-late", a.on_late, "then: warn, once; or fail, and end the run")
        .one_of({"warn", "fail"})
        .shows_default();
    command.add_option("--out", a.out, "folder for the results (default: as that of run)");
    a.reach.add_to(command);
    add_json(command, a.json);
}

void add_in(Command app) {
    const auto [command, a] = add_command(
        app, "in", "Run a program with the network of a robot of rovernet emulate", run_in);
    command.add_examples({"rovernet in A -- ping 10.0.0.2"});
    command.add_option("ROBOT", a.robot, "name of the robot").required();
    command.add_option("PROGRAM", a.program, "program and its arguments, behind --").required();
    command.add_option("--run", a.run, "process of the run, if several have such a robot")
        .range(1, 1 << 22);
}

}  // namespace rovernet::cli
