// SPDX-License-Identifier: MIT
#include "cli/options.hpp"

namespace rovernet::cli {
namespace {

void add_models(CLI::App& app) {
    const auto [models, a] =
        add_command(app, "models", "List the propagation models and their parameters", cli::models);
    add_examples(models, {"rovernet models"});
    add_json(models, a.json);
}

void add_loss(CLI::App& app) {
    const auto [loss, a] =
        add_command(app, "loss", "Median path loss of a model over distance", cli::loss);
    add_examples(loss, {"rovernet loss friis --distance 1,10,100",
                        "rovernet loss raytrace_2007 coefficient=20 --distance 20 --wall 0.5",
                        "rovernet loss two_ray form=exact --distance 36 --heights 1.5,1.5"});
    loss.add_option("MODEL", a.model, "its name; see rovernet models")->required();
    loss.add_option("PARAMETERS", a.parameters, "param=value ...");
    loss.add_option("--frequency", a.frequency, "such as \"2450 MHz\"")->capture_default_str();
    loss.add_option("--distance", a.distances, "such as 1,10,100 or \"1 km\"")
        ->delimiter(',')
        ->required();
    loss.add_option("--heights", a.heights,
                    "antennas above the ground, such as 1.5 or, unlike each other, 1.5,0.3; 1 m if "
                    "not given")
        ->delimiter(',');
    loss.add_option("--wall", a.wall, "length of wall on the way, such as 0.5");
    add_json(loss, a.json);
}

void add_bench(CLI::App& app) {
    CLI::App* bench = app.add_subcommand("bench", "Measure the speed of this build here");
    bench->require_subcommand(1);
    const auto [flood, a] =
        add_command(*bench, "flood", "CPU time of floods, per reception", cli::bench_flood);
    add_examples(flood, {"rovernet bench flood --nodes 1000 --cpu 0.1"});
    flood.add_option("--nodes", a.bench.nodes, "sizes of network, such as 1000,10000")
        ->delimiter(',')
        ->check(CLI::Range(2, 10'000'000))
        ->capture_default_str();
    flood.add_option("--reception", a.reception, "threshold, collision or sinr")
        ->capture_default_str();
    flood.add_option("--access", a.access, "none, aloha or csma")->capture_default_str();
    flood.add_option("--mobility", a.mobility, "static or random_waypoint")->capture_default_str();
    flood.add_option("--shadowing", a.bench.shadowing.value, "of each link, sigma in dB")
        ->check(not_negative())
        ->capture_default_str();
    flood.add_flag("--recorded", a.bench.recorded,
                   "keep metrics, fingerprint and timeline, as `rovernet run` does");
    flood.add_option("--cpu", a.bench.cpu_s, "seconds of CPU for each size, at least")
        ->check(above_zero())
        ->capture_default_str();
    flood.add_option("--seed", a.bench.seed, "of every random draw")->capture_default_str();
    add_json(flood, a.json);
}

void add_material(CLI::App& app) {
    const auto [material, a] = add_command(
        app, "material", "Print the losses of a slab of a building material", cli::material);
    add_examples(
        material,
        {"rovernet material concrete --thickness 0.2",
         "rovernet material concrete --thickness 0.2 --frequency \"2.4 GHz\" --angle 30 --json",
         "rovernet material glass --thickness \"6 mm\" --frequency \"5.2 GHz\" --angle 30"});
    material.add_option("MATERIAL", a.material, "concrete, brick, glass, metal, ...")->required();
    material.add_option("--thickness", a.thickness, "such as 0.2 or \"13 mm\"")->required();
    material.add_option("--frequency", a.frequency, "such as \"2450 MHz\"")->capture_default_str();
    material.add_option("--angle", a.angle, "of the wave's way to the normal [degrees]")
        ->check(below_90_degrees())
        ->capture_default_str();
    add_json(material, a.json);
}

void add_validate(CLI::App& app) {
    const auto [validate, a] =
        add_command(app, "validate", "Measure errors and costs of this build's methods and models",
                    cli::validate);
    add_examples(validate, {"rovernet validate --quick -o report",
                            "rovernet validate --field measurements -o report"});
    validate.add_option("-o,--output", a.out, "folder for report.html, and for each chart's files")
        ->required();
    validate.add_option("--field", a.field,
                        "folder of measured levels, with flat/ and lab/, to hold models against");
    validate.add_flag("--quick", a.quick, "few samples: seconds instead of minutes");
}

void add_trace(CLI::App& app) {
    CLI::App* trace = app.add_subcommand("trace", "Work with trace files");
    trace->require_subcommand(1);
    const auto [stats, a] = add_command(
        *trace, "stats", "The metrics of an ns-2 trace written by rovernet", cli::trace_stats);
    add_examples(stats, {"rovernet trace stats runs/patrol-s3/trace.tr"});
    stats.add_option("FILE", a.file, "trace file (.tr)")->required();
    add_json(stats, a.json);
}

void add_version(CLI::App& app) {
    const auto [version, a] =
        add_command(app, "version", "Print the version and how it was built", cli::print_version);
    add_examples(version, {"rovernet version --json"});
    add_json(version, a.json);
}

/// Scripts and pages that are made from the commands themselves.
void add_completion(CLI::App& app) {
    const auto [completion, a] =
        add_command(app, "completion", "Print a shell's completion script", cli::print_completion);
    completion.add_option("SHELL", a.shell, "bash, zsh or fish")->required();
    add_examples(completion,
                 {"source <(rovernet completion bash)",
                  "rovernet completion fish > ~/.config/fish/completions/rovernet.fish"});
    a.app = &app;
    const auto [man, m] =
        add_command(app, "man", "Print the page rovernet(1)", cli::print_man_page);
    man.group("");
    m.app = &app;
}

}  // namespace

void add_tool_commands(CLI::App& app) {
    add_models(app);
    add_loss(app);
    add_material(app);
    add_validate(app);
    add_trace(app);
    add_bench(app);
    add_version(app);
    add_completion(app);
}

}  // namespace rovernet::cli
