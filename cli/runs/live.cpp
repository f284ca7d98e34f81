// SPDX-License-Identifier: MIT
#include "cli/run/run.hpp"
#include "cli/runs/fronts.hpp"
#include "cli/runs/serving.hpp"
#include "cli/runs/view_option.hpp"
#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/options.hpp"
#include "live/lockstep/listeners.hpp"
#include "live/player/listeners.hpp"
#include "scenario/document/quantity.hpp"
#include "scenario/scenario_file.hpp"

#include <algorithm>

namespace rovernet::cli {
namespace {

struct LiveArguments : FileArguments {
    std::optional<std::string> out, listen, web, unix_path, patience;
    std::vector<std::string> controllers;
    std::optional<std::uint64_t> wait_for;
    std::string on_loss = "end";
    std::optional<std::string> player;
    FrontArguments fronts;
    ViewOption view;
    std::optional<double> speed;
    bool one_port = false, lockstep = false;
    Reach reach;
    bool json = false;

    bool is_by_clock() const {
        return player || fronts.any() || (view.is_given() && !has_controllers());
    }
    bool has_controllers() const { return !controllers.empty() || listen || web || unix_path; }
    Announced announced() const { return json ? Announced::by_notice : Announced::by_output; }
};

std::string folder_of(const LiveArguments& a, const Scenario& scenario) {
    return results_folder(a.out, scenario, a.options);
}

FrontListeners controller_listeners(const LiveArguments& a,
                                    const std::function<void(std::string_view)>& say) {
    ControllerAccess access{.programs = a.controllers, .unix_path = a.unix_path};
    if (a.listen) access.listen = a.reach.without_token(*a.listen);
    if (a.web) access.web = a.reach.with_token(*a.web);
    Lockstep::Settings settings{.say = say};
    const std::size_t started = std::max<std::size_t>(a.controllers.size(), 1);
    settings.wait_for = a.wait_for ? static_cast<std::size_t>(*a.wait_for) : started;
    settings.on_loss = a.on_loss == "stop"   ? OnLoss::stop
                       : a.on_loss == "wait" ? OnLoss::wait
                                             : OnLoss::end;
    if (a.patience) settings.patience = time_of("--patience", *a.patience);
    return lockstep_listeners(access, settings);
}

FrontListeners player_listeners(const LiveArguments& a, const std::optional<PlayerConfig>& config,
                                const Scenario& scenario) {
    const PlayerSettings settings{.is_lockstep = a.lockstep, .wait_for = a.wait_for.value_or(1)};
    const Address at = a.reach.without_token(*a.player);
    const std::vector<std::string> robots = robot_names(scenario);
    if (config) return player_configured(at, *config, robots, settings);
    return (a.one_port ? player_one_port : player_ports)(at, robots, settings);
}

/// Has the comdrivers of a configuration, if it has any, do the routing: the first byte of a
/// message is its TTL. A world alone forwards without jitter, so that the shortest way comes first
/// and a message reaches exactly the robots within its TTL. What the user sets counts more.
void route_by_comdriver(const PlayerConfig& config, ScenarioOptions& options) {
    if (!config.has_comdriver()) return;
    std::vector<std::string> routing = {"routing.ttl_in_payload=true"};
    if (config.world.ends_with(".world")) routing.push_back("routing.jitter=0 s");
    options.set.insert(options.set.begin(), routing.begin(), routing.end());
}

/// Prints notices about ignored parts of a configuration.
void tell_of(const PlayerConfig& config, const Scenario& scenario) {
    std::vector<std::string> ips;
    for (const PlayerConfig::Robot& each : config.robots) {
        const auto found =
            std::find_if(scenario.robots.begin(), scenario.robots.end(),
                         [&](const RobotTable& robot) { return robot.name == each.model; });
        ips.push_back(found == scenario.robots.end() ? "" : found->radio.labels.ip.value_or(""));
    }
    for (const std::string& text : config.notices) notice(text);
    for (const std::string& text : mapping_notices(config, ips)) notice(text);
}

/// Runs FILE, or the world of a Player configuration.
LiveResult run_by_fronts(LiveArguments a) {
    std::optional<PlayerConfig> config;
    if (a.player && a.file.ends_with(".cfg")) {
        config = read_player_config(a.file);
        a.file = config->world;
        route_by_comdriver(*config, a.options);
    }
    const Scenario scenario = scenario_of(a);
    if (config) tell_of(*config, scenario);
    PacedOptions options;
    options.folder = folder_of(a, scenario);
    options.say = a.view.announced(announcer(a.announced()));
    if (a.speed) options.speed = a.speed;
    if (a.lockstep || !a.is_by_clock()) options.speed.reset();
    if (a.has_controllers()) options.fronts.push_back(controller_listeners(a, options.say));
    if (a.player) options.fronts.push_back(player_listeners(a, config, scenario));
    a.fronts.append_to(options.fronts, a.reach);
    if (a.view.is_given())
        options.fronts.push_back(a.view.listeners(a.reach, {.speed = options.speed}));
    ServingStop stop;
    options.stop = stop.rules();
    return run_paced(scenario, options);
}

void run_live(const LiveArguments& a) {
    if (!a.is_by_clock() && !a.has_controllers()) {
        throw CommandEnd(
            usage,
            "live: found no option by which external programs connect; expected --controller, "
            "--listen-json, --listen-web, --unix, --player, --rosbridge or --view");
    }
    if (!a.is_by_clock() && a.speed) {
        throw CommandEnd(
            usage,
            "live: --speed needs --player, --rosbridge or --view; without these options, the "
            "controllers decide when the next step begins");
    }
    const LiveResult result = run_by_fronts(a);
    print_run(result.scenario, result.run, a.json);
    if (!result.fault.empty()) throw CommandEnd(failed, result.fault);
}

/// Options of runs in lock-step, by JSON lines.
void add_lockstep(Command live, LiveArguments& a) {
    live.add_option(
            "--controller", a.controllers,
            "controller program to start; it exchanges JSON lines by standard input and output; "
            "this option may be given several times")
        .one_word();
    live.add_option("--listen-json", a.listen,
                    "listen for controllers at 127.0.0.1:PORT; port 0 selects a free port");
    live.add_option(
        "--listen-web", a.web,
        "listen for controllers by WebSocket at 127.0.0.1:PORT; each message is one JSON line");
    live.add_option("--unix", a.unix_path,
                    "listen for controllers at a Unix socket with this path");
    live.add_option("--patience", a.patience,
                    "longest real time, such as 30s, that a controller may take for a step, and "
                    "that a started program may take until it sends `hello` (default: no limit)");
    live.add_option("--on-loss", a.on_loss,
                    "what to do when a controller disconnects without `bye`: end the run (end), "
                    "stop the controller's robots (stop), or wait until a controller with the same "
                    "name connects (wait)")
        .one_of({"end", "stop", "wait"})
        .shows_default();
}

/// Options of runs by the clock.
void add_by_clock(Command live, LiveArguments& a) {
    const Option player =
        live.add_option("--player", a.player,
                        "serve Player clients, one port for each robot: 127.0.0.1:PORT and the "
                        "ports that follow; port 0 selects free ports (default port: 6665)")
            .usually(player_address.data());
    const std::vector<Option> others = a.fronts.add_to(live);
    a.view.add_to(live);
    live.add_flag("--player-one-port", a.one_port,
                  "serve the Player devices of all robots at one port: devices of the first robot "
                  "have index 0, devices of the second robot index 1, and so on")
        .needs(player);
    const Option lockstep = live.add_flag("--player-lockstep", a.lockstep,
                                          "advance the simulated time by 0.1 s whenever all "
                                          "clients in PULL mode have requested data")
                                .needs(player);
    for (const Option& each : others) lockstep.excludes(each);
    live.add_option(
            "--speed", a.speed,
            "speed relative to real time, with --player, --rosbridge or --view (default: 1)")
        .check(speed_of_time())
        .excludes(lockstep);
}

}  // namespace

void add_live(Command app) {
    const auto [live, a] = add_command(
        app, "live", "Run a scenario whose robots are driven by external programs", run_live);
    live.add_examples(
        {"rovernet live examples/search/search.toml --controller \"python3 "
         "examples/search/search.py\"",
         "rovernet live examples/rescue/rescue.toml --player",
         "rovernet live examples/rescue/rescue.toml --rosbridge",
         "rovernet live examples/rescue/rescue.toml --view --view-control"});
    add_file(live, a, any_file);
    add_lockstep(live, a);
    add_by_clock(live, a);
    live.add_option("--wait-for", a.wait_for,
                    "number of controllers that must connect before a lock-step run begins "
                    "(default: number of started programs, or 1)")
        .range(1, 500);
    a.reach.add_to(live);
    live.add_option("--out", a.out, "folder for the results (default: as for rovernet run)");
    add_json(live, a.json);
}

}  // namespace rovernet::cli
