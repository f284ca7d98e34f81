// SPDX-License-Identifier: MIT
#include "cli/commands.hpp"
#include "cli/diagnostics.hpp"
#include "experiment/version.hpp"
#include "sim/error.hpp"
#include "study/command_words.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <csignal>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace rovernet;
using cli::ok, cli::usage;

/// The command that the words of the command line name, as far as they do.
const CLI::App& named_command(const CLI::App& app) {
    const auto named = app.get_subcommands();
    return named.empty() ? app : named_command(*named.front());
}

std::vector<std::string> options_of(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const auto& name : option->get_lnames()) names.push_back("--" + name);
        for (const auto& name : option->get_snames()) names.push_back("-" + name);
    }
    return names;
}

std::vector<std::string> commands_of(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::App* sub : command.get_subcommands(nullptr)) names.push_back(sub->get_name());
    return names;
}

/// What is wrong with the words of the command line, and what was probably meant.
std::string usage_error(const CLI::App* app, const CLI::Error& error) {
    std::string what = error.what();
    const std::vector<std::string> unexpected = app->remaining(true);
    if (!unexpected.empty()) {
        const std::string word = unexpected.front().substr(0, unexpected.front().find('='));
        const CLI::App& command = named_command(*app);
        const std::vector<std::string> commands = commands_of(command);
        const bool is_option = word.starts_with('-');
        if (is_option) {
            what = fmt::format("unknown option \"{}\"", word);
        } else if (!commands.empty()) {
            what = fmt::format("unknown command \"{}\"; expected one of {}", word,
                               fmt::join(commands, ", "));
        } else {
            what = fmt::format("unexpected \"{}\"", word);
        }
        const std::string near = did_you_mean(word, is_option ? options_of(command) : commands);
        if (!near.empty()) what += "; " + near;
    }
    return fmt::format("rovernet: {}; run with --help for more\n", what);
}

CLI::App* add_command(CLI::App& app, const char* name, const char* what, int& exit,
                      std::function<void()> command) {
    CLI::App* sub = app.add_subcommand(name, what);
    sub->callback([&exit, command = std::move(command)] { exit = cli::guarded(command); });
    return sub;
}

/// FILE and the options that go over it, but for those of one run.
void add_study_file(CLI::App& command, cli::FileArguments& a, const char* what) {
    command.add_option("FILE", a.file, what)->required();
    command.add_option("--seed", a.seed, "seed of every random draw");
    command
        .add_option("--set", a.options.set,
                    "key=value over the file's, such as radio.power=\"15 dBm\"")
        ->allow_extra_args(false);
    command
        .add_option("--world-path", a.options.world_path,
                    "folder for the includes and bitmaps of a Stage world")
        ->allow_extra_args(false);
    command
        .add_option("--bitmap", a.options.bitmaps,
                    "OLD=NEW: another bitmap for one that a Stage world names")
        ->allow_extra_args(false);
    command.add_flag("--lenient", a.options.lenient,
                     "go on without an include or bitmap that is missing");
}

/// FILE and the options that go over it.
void add_file(CLI::App& command, cli::FileArguments& a, const char* what) {
    add_study_file(command, a, what);
    command.add_option("--replication", a.replication, "which independent repetition");
}

constexpr const char* any_file = "scenario (.toml), Stage world (.world) or movement file";

void add_run(CLI::App& app, int& exit) {
    static cli::RunArguments a;
    CLI::App* run = add_command(app, "run", "Run a scenario", exit, [] { cli::run(a); });
    add_file(*run, a, any_file);
    run->add_option("--out", a.out, "folder for the results (default: runs/NAME-sSEED)");
    run->add_option("--speed", a.speed, "pace the run: 1 is real time, 2 (or x2) twice as fast")
        ->transform(
            [](const std::string& text) { return text.starts_with('x') ? text.substr(1) : text; })
        ->check(CLI::PositiveNumber);
    run->add_flag("--json", a.json, "print one JSON document");
    run->add_flag("--print-scenario", a.print_scenario,
                  "print the scenario with every default, and do not run it");
}

void add_loss(CLI::App& app, int& exit) {
    static cli::LossArguments a;
    CLI::App* loss =
        add_command(app, "loss", "Median path loss of a propagation model over distance", exit,
                    [] { cli::loss(a); });
    loss->add_option("MODEL", a.model, "its name; see rovernet models")->required();
    loss->add_option("PARAMETERS", a.parameters, "param=value ...");
    loss->add_option("--frequency", a.frequency, "such as \"2450 MHz\"")->capture_default_str();
    loss->add_option("--distance", a.distances, "such as 1,10,100 or \"1 km\"")
        ->delimiter(',')
        ->required();
    loss->add_option("--wall", a.wall, "length of wall on the way, such as 0.5");
    loss->add_flag("--json", a.json, "print one JSON document");
}

void add_link(CLI::App& app, int& exit) {
    static cli::LinkArguments a;
    CLI::App* link = add_command(app, "link", "The budget of the link from robot A to robot B",
                                 exit, [] { cli::link(a); });
    add_file(*link, a, any_file);
    link->add_option("A", a.from, "transmitting robot")->required();
    link->add_option("B", a.to, "receiving robot")->required();
    link->add_option("--at", a.at, "time of the run, such as 12.5s")->capture_default_str();
    link->add_flag("--json", a.json, "print one JSON document");
}

void add_links(CLI::App& app, int& exit) {
    static cli::LinksArguments a;
    CLI::App* links =
        add_command(app, "links", "What every robot's radio hears", exit, [] { cli::links(a); });
    add_file(*links, a, any_file);
    links->add_option("--at", a.at, "time of the run, such as 12.5s")->capture_default_str();
    links->add_option("--robot", a.robot, "of this robot only");
    CLI::Option* history =
        links->add_flag("--history", a.history, "every link change of the run, as CSV");
    links->add_flag("--json", a.json, "print one JSON document")->excludes(history);
}

void add_scene(CLI::App& app, int& exit) {
    static cli::SceneArguments a;
    CLI::App* scene = add_command(app, "scene", "The map, the robots and how links join them", exit,
                                  [] { cli::scene(a); });
    add_file(*scene, a, "as for run; or a map alone: map.yaml, or a picture with --size");
    scene->add_option("--size", a.size, "of a picture, in metres: 16x16");
    scene->add_option("--at", a.at, "time of the run, such as 12.5s")->capture_default_str();
    scene->add_flag("--json", a.json, "print one JSON document, with every wall");
}

void add_where(CLI::App& app, int& exit) {
    static cli::WhereArguments a;
    CLI::App* where =
        add_command(app, "where", "Where every robot is", exit, [] { cli::where(a); });
    add_file(*where, a, any_file);
    where->add_option("--at", a.at, "times of the run, such as 10s,31.25s")
        ->delimiter(',')
        ->required();
    where->add_flag("--json", a.json, "print one JSON document");
}

void add_draw(CLI::App& app, int& exit) {
    static cli::DrawArguments a;
    CLI::App* draw =
        add_command(app, "draw", "Draw map, robots and radio", exit, [] { cli::draw(a); });
    add_file(*draw, a, any_file);
    draw->add_option("--at", a.at, "time of the run, such as 12.5s")->capture_default_str();
    draw->add_option("--coverage", a.coverage, "robot whose received power is shown");
    draw->add_flag("--links", a.links, "show who hears whom");
    draw->add_flag("--trails", a.trails, "show where the robots have been");
    draw->add_option("--width", a.width, "of the picture, in pixels")
        ->check(CLI::Range(100, 10000))
        ->capture_default_str();
    draw->add_option("-o,--output", a.out, "picture to write: NAME.svg or NAME.png")->required();
}

void add_move(CLI::App& app, int& exit) {
    static cli::ConvertArguments a;
    CLI::App* move = app.add_subcommand("move", "Work with movement files");
    move->require_subcommand(1);
    CLI::App* convert =
        add_command(*move, "convert", "Write the motion of a scenario or movement file for others",
                    exit, [] { cli::convert_movements(a); });
    add_file(*convert, a, any_file);
    convert->add_option("OUT", a.out, "NAME.tcl (ns-2) or NAME.movements (BonnMotion)")->required();
}

void add_bench(CLI::App& app, int& exit) {
    static cli::BenchArguments a;
    CLI::App* bench = app.add_subcommand("bench", "Measure the speed of this build here");
    bench->require_subcommand(1);
    CLI::App* flood = add_command(*bench, "flood", "CPU time of floods, per reception", exit,
                                  [] { cli::bench_flood(a); });
    flood->add_option("--nodes", a.bench.nodes, "sizes of network, such as 1000,10000")
        ->delimiter(',')
        ->check(CLI::Range(2, 10'000'000))
        ->capture_default_str();
    flood->add_option("--reception", a.reception, "threshold, collision or sinr")
        ->capture_default_str();
    flood->add_option("--access", a.access, "none, aloha or csma")->capture_default_str();
    flood->add_option("--mobility", a.mobility, "static or random_waypoint")->capture_default_str();
    flood->add_option("--shadowing", a.bench.shadowing.value, "of each link, sigma in dB")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    flood->add_flag("--in-order", a.bench.in_order,
                    "look at all receptions in their order, as a trace does");
    flood->add_option("--cpu", a.bench.cpu_s, "seconds of CPU for each size, at least")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    flood->add_option("--seed", a.bench.seed, "of every random draw")->capture_default_str();
    flood->add_flag("--json", a.json, "print one JSON document");
}

/// The command as it was typed, for a person to go on with: what it threw away stays so.
std::string command_line(int argc, char** argv) {
    std::vector<std::string> words{"rovernet"};
    std::copy_if(argv + 1, argv + argc, std::back_inserter(words),
                 [](std::string_view word) { return word != "--fresh" && word != "--yes"; });
    return shell_command(words);
}

/// How a study is run.
void add_study_run(CLI::App& command, cli::StudyArguments& a) {
    command
        .add_option("--workers", a.workers, "processes at once (default: as many as processors)")
        ->check(CLI::Range(1, 1024));
    command.add_option("--replications", a.replications, "of each point; or [study] replications")
        ->check(CLI::Range(1, 1'000'000));
    command
        .add_option("--precision", a.precision,
                    "repeat until the interval of the first metric has this half-width")
        ->check(CLI::PositiveNumber);
    command.add_option("--max-replications", a.max_replications, "for --precision, at most")
        ->check(CLI::Range(1, 1'000'000));
    command.add_option("--timeout", a.timeout, "of one run, in real time, such as 60s");
    command.add_option("--memory", a.memory, "of one run, such as 2GB");
    command.add_flag("--fail-fast", a.fail_fast, "begin nothing new once a run has failed");
    command.add_flag("--json", a.json, "print one JSON document");
}

void add_sweep(CLI::App& app, int& exit, const std::string& command) {
    static cli::SweepArguments a;
    a.command = command;
    CLI::App* sweep = add_command(app, "sweep", "Run a study: every point, every replication", exit,
                                  [] { cli::sweep(a); });
    add_study_file(*sweep, a, any_file);
    sweep->add_flag("--dry-run", a.dry_run, "list the points and runs, and run nothing");
    sweep->add_option("--store", a.store, "file for the results (default: FILE with .db)");
    add_study_run(*sweep, a);
    CLI::Option* resume =
        sweep->add_flag("--resume", a.resume, "go on where the store ends: usual");
    sweep->add_flag("--fresh", a.fresh, "throw away the runs that the store has; asks")
        ->excludes(resume);
    sweep->add_flag("--yes", a.yes, "do not ask");
    sweep->add_option("--shard", a.shard, "make only the runs of this chunk, from 0");
    sweep->add_option("--chunk", a.chunk, "runs of a chunk")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    sweep->add_option("--except", a.except, "make no run that this store has finished");
    sweep->add_option("--merge", a.merge, "move the runs of these stores into the study's")
        ->excludes("--shard");
    sweep->add_option("--executor", a.executor, "local (default), or slurm: a job array")
        ->check(CLI::IsMember({"local", "slurm"}))
        ->excludes("--shard")
        ->excludes("--merge");
    sweep->add_option("--sbatch", a.sbatch, "more options for sbatch, such as \"--time=1:00\"");
}

void add_compare(CLI::App& app, int& exit, const std::string& command) {
    static cli::CompareArguments a;
    a.command = command;
    CLI::App* compare =
        add_command(app, "compare", "Propagation models beside each other on one scenario", exit,
                    [] { cli::compare(a); });
    add_study_file(*compare, a, any_file);
    compare->add_option("--models", a.models, "which (default: those of [study] vary)")
        ->delimiter(',');
    compare->add_option("--metric", a.metric, "compared (default: the study's first)");
    compare->add_option("--baseline", a.baseline, "to differ from (default: the dearest)");
    compare->add_option("--store", a.store, "keep the runs in this file, and go on from there");
    compare->add_option("-o,--output", a.picture, "picture to write: NAME.svg");
    add_study_run(*compare, a);
}

void add_results(CLI::App& app, int& exit) {
    constexpr const char* only_points = "only points with KEY=VALUE, such as ttl=6";
    static cli::ResultsArguments a;
    CLI::App* results =
        add_command(app, "results", "What a study came to", exit, [] { cli::results(a); });
    results->add_option("STUDY", a.store, "store of a study, as sweep makes it")->required();
    results->add_option("--metric", a.metrics, "which, such as delivery_ratio,latency_mean_s")
        ->delimiter(',');
    results->add_option("--group-by", a.group_by, "keys that vary; the others are averaged over")
        ->delimiter(',');
    results->add_option("--where", a.where, only_points)->allow_extra_args(false);
    results->add_option("--confidence", a.confidence, "of the intervals, such as 0.95")
        ->check(CLI::Range(0.5, 0.9999));
    results->add_option("--quantile", a.quantile, "this quantile in place of the mean, such as 0.9")
        ->check(CLI::Range(0.0001, 0.9999));
    results->add_flag("--csv", a.csv, "a row per run and metric, for pandas and R");
    results->add_flag("--provenance", a.provenance,
                      "with --csv: a row per run, its times and host");
    results->add_flag("--failures", a.failures, "the runs that failed, and why");
    results->add_option("--sql", a.sql, "answer this question, such as 'SELECT * FROM result'");
    results->add_flag("--json", a.json, "print one JSON document");

    static cli::PlotArguments p;
    CLI::App* plot =
        add_command(app, "plot", "Draw what a study came to", exit, [] { cli::plot(p); });
    plot->add_option("STUDY", p.store, "store of a study, as sweep makes it")->required();
    plot->add_option("-x", p.x, "key that varies, such as robots or radio.power");
    plot->add_option("-y", p.y, "metric, such as delivery_ratio")->required();
    plot->add_option("--by", p.by, "key of the lines, or of the rows of a heat map");
    plot->add_option("--where", p.where, only_points)->allow_extra_args(false);
    plot->add_option("--kind", p.kind,
                     "lines, bars, cdf or heat_map (default: lines over numbers, "
                     "bars over words)");
    plot->add_option("--confidence", p.confidence, "of the intervals, such as 0.95")
        ->check(CLI::Range(0.5, 0.9999));
    plot->add_option("--quantile", p.quantile, "this quantile in place of the mean, such as 0.9")
        ->check(CLI::Range(0.0001, 0.9999));
    plot->add_flag("--log-x", p.log_x, "a logarithmic axis");
    plot->add_flag("--log-y", p.log_y, "a logarithmic axis");
    plot->add_option("--width", p.width, "of the picture, in pixels")
        ->check(CLI::Range(200, 10000))
        ->capture_default_str();
    plot->add_option("-o,--output", p.out,
                     "NAME.svg, or to restyle it NAME.gp (gnuplot) or NAME.vl.json (Vega-Lite)")
        ->required();

    static cli::ExplainArguments e;
    CLI::App* explain = add_command(app, "explain", "How one run of a study came about", exit,
                                    [] { cli::explain(e); });
    explain->add_option("STUDY", e.store, "store of a study, as sweep makes it")->required();
    explain->add_option("RUN", e.run, "POINT/REPLICATION, or the beginning of its id")->required();
    explain->add_flag("--json", e.json, "print one JSON document");
}

void add_others(CLI::App& app, int& exit) {
    static bool json = false;
    static std::string file;
    add_command(app, "models", "List the propagation models and their parameters", exit, [] {
        cli::models(json);
    })->add_flag("--json", json, "print one JSON document");
    CLI::App* trace = app.add_subcommand("trace", "Work with trace files");
    trace->require_subcommand(1);
    CLI::App* stats =
        add_command(*trace, "stats", "The metrics of an ns-2 trace written by rovernet", exit,
                    [] { cli::trace_stats(file, json); });
    stats->add_option("FILE", file, "trace file (.tr)")->required();
    stats->add_flag("--json", json, "print one JSON document");
    add_command(app, "version", "Print the version and how it was built", exit, [] {
        cli::print_version(json);
    })->add_flag("--json", json, "print one JSON document");
}

}  // namespace

int main(int argc, char** argv) {
    const auto stop = [](int) { cli::stop_requested = cli::stop_requested + 1; };
    std::signal(SIGINT, stop);
    std::signal(SIGTERM, stop);
    std::signal(SIGPIPE, SIG_IGN);

    CLI::App app{"rovernet: wireless networks of moving robots, event by event", "rovernet"};
    app.set_version_flag("--version", std::string(version()));
    app.require_subcommand(1);
    app.failure_message(usage_error);
    int exit = ok;
    add_run(app, exit);
    add_loss(app, exit);
    add_link(app, exit);
    add_links(app, exit);
    add_scene(app, exit);
    add_where(app, exit);
    add_draw(app, exit);
    add_move(app, exit);
    add_bench(app, exit);
    add_sweep(app, exit, command_line(argc, argv));
    add_compare(app, exit, command_line(argc, argv));
    add_results(app, exit);
    add_others(app, exit);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? ok : usage;
    }
    return exit;
}
