// SPDX-License-Identifier: MIT
#include "cli/terminal/options.hpp"
#include "cli/tools/tool_commands.hpp"

namespace rovernet::cli {
namespace {

void add_models(Command app) {
    const auto [models, a] =
        add_command(app, "models", "List the propagation models and their parameters", cli::models);
    models.add_examples({"rovernet models", "rovernet models log_distance"});
    models.add_option("NAME", a.name, "print only this propagation model");
    add_json(models, a.json);
}

void add_loss(Command app) {
    const auto [loss, a] = add_command(
        app, "loss", "Print or draw the median path loss of models over the distance", cli::loss);
    loss.add_examples({"rovernet loss friis --distance 1,10,100",
                       "rovernet loss raytrace_2007 coefficient=20 --distance 20 --wall 0.5",
                       "rovernet loss two_ray form=exact --distance 36 --heights 1.5,1.5",
                       "rovernet loss friis log_distance exponent=4 --distance 1,100 -o loss.svg"});
    loss.add_option("MODELS", a.models,
                    "propagation models (see rovernet models), each followed by its parameters "
                    "KEY=VALUE")
        .required();
    loss.add_option("--frequency", a.frequency, "carrier frequency, such as \"2450 MHz\"")
        .shows_default();
    loss.add_option("--distance", a.distances,
                    "distances between the antennas, such as 1,10,100 (in metres) or \"1 km\"")
        .delimiter(',')
        .required();
    loss.add_option("--heights", a.heights,
                    "heights of the antennas above the ground in metres: 1.5 for both, or 1.5,0.3 "
                    "for sender and receiver (default: 1 m)")
        .delimiter(',');
    loss.add_option("--wall", a.wall, "length of the path inside a wall, such as 0.5 (in metres)");
    const Option out =
        loss.add_option("-o,--output", a.out,
                        "draw curves from the least to the largest distance: NAME.svg, NAME.png or "
                        "NAME.pdf");
    add_json(loss, a.json);
    loss.option("--json").excludes(out);
}

void add_bench(Command app) {
    Command bench = app.add_command("bench", "Measure the speed of this build on this machine");
    bench.needs_command();
    const auto [flood, a] = add_command(
        bench, "flood", "Measure the CPU time per reception in floods", cli::bench_flood);
    flood.add_examples({"rovernet bench flood --nodes 1000 --cpu 0.1"});
    flood.add_option("--nodes", a.bench.nodes, "numbers of robots, such as 1000,10000")
        .delimiter(',')
        .range(2, 10'000'000)
        .shows_default();
    flood.add_option("--reception", a.reception, "reception model: threshold, collision or sinr")
        .shows_default();
    flood.add_option("--access", a.access, "access model: none, aloha or csma").shows_default();
    flood.add_option("--mobility", a.mobility, "movement of the robots: static or random_waypoint")
        .shows_default();
    flood
        .add_option(
            "--suppression", a.suppression,
            "rule by which a robot decides not to forward a message: none, counter, probability, "
            "distance, location or cluster")
        .shows_default();
    flood
        .add_option("--shadowing", a.bench.shadowing.value,
                    "standard deviation of the shadowing of each link, in dB")
        .check(not_negative())
        .shows_default();
    flood.add_flag("--recorded", a.bench.recorded,
                   "also compute metrics, fingerprint and timeline, as rovernet run does");
    flood
        .add_option("--cpu", a.bench.cpu_s,
                    "each number of robots is measured for at least this CPU time, in seconds")
        .check(above_zero())
        .shows_default();
    flood.add_option("--seed", a.bench.seed, "seed of all random draws").shows_default();
    add_json(flood, a.json);
}

void add_material(Command app) {
    const auto [material, a] = add_command(
        app, "material", "Print the losses of a slab of a building material", cli::material);
    material.add_examples(
        {"rovernet material concrete --thickness 0.2",
         "rovernet material concrete --thickness 0.2 --frequency \"2.4 GHz\" --angle 30 --json",
         "rovernet material glass --thickness \"6 mm\" --frequency \"5.2 GHz\" --angle 30"});
    material
        .add_option("MATERIAL", a.material, "building material: concrete, brick, glass, metal, ...")
        .required();
    material
        .add_option("--thickness", a.thickness,
                    "thickness of the slab, such as 0.2 (in metres) or \"13 mm\"")
        .required();
    material.add_option("--frequency", a.frequency, "carrier frequency, such as \"2450 MHz\"")
        .shows_default();
    material
        .add_option("--angle", a.angle,
                    "angle between the wave and the normal of the slab, in degrees")
        .check(below_90_degrees())
        .shows_default();
    add_json(material, a.json);
}

void add_validate(Command app) {
    const auto [validate, a] =
        add_command(app, "validate", "Measure errors and costs of this build's methods and models",
                    cli::validate);
    validate.add_examples({"rovernet validate --quick -o report",
                           "rovernet validate --field measurements -o report"});
    validate
        .add_option("-o,--output", a.out,
                    "folder to write report.html and the files of each chart to")
        .required();
    validate.add_option(
        "--field", a.field,
        "folder of measured levels, with the subfolders flat/ and lab/; models are compared with "
        "these levels");
    validate.add_flag("--quick", a.quick, "use fewer samples: takes seconds instead of minutes");
}

void add_help(Command app) {
    const auto [help, a] = add_command(app, "help", "Print a page of the documentation", cli::help);
    help.add_examples({"rovernet help", "rovernet help first-run", "rovernet help scenario | less",
                       "rovernet help packet loss"});
    help.add_option(
        "TOPIC", a.words,
        "name of a page, or words to search the pages for; without TOPIC, all pages are "
        "listed");
    a.program = app;
}

void add_version(Command app) {
    const auto [version, a] = add_command(
        app, "version", "Print the version, the build options and the models of this program",
        cli::print_version);
    version.add_examples({"rovernet version --json"});
    add_json(version, a.json);
}

void add_schema(Command app) {
    const auto [schema, a] = add_command(
        app, "schema", "Print the JSON Schema of scenario files, by which editors check them",
        cli::print_schema);
    schema.add_examples({"rovernet schema > scenario.schema.json"});
}

/// Scripts and pages that are made from the commands themselves.
void add_completion(Command app) {
    const auto [completion, a] = add_command(
        app, "completion", "Print a completion script for a shell", cli::print_completion);
    completion.add_option("SHELL", a.shell, "name of the shell: bash, zsh or fish").required();
    completion.add_examples(
        {"source <(rovernet completion bash)",
         "rovernet completion fish > ~/.config/fish/completions/rovernet.fish"});
    a.program = app;
    const auto [man, m] =
        add_command(app, "man", "Print the page rovernet(1)", cli::print_man_page);
    man.hide();
    m.program = app;
}

}  // namespace

void add_tool_commands(Command app) {
    add_models(app);
    add_loss(app);
    add_material(app);
    add_validate(app);
    add_trace(app);
    add_replay(app);
    add_view(app);
    add_bench(app);
    add_help(app);
    add_schema(app);
    add_version(app);
    add_completion(app);
}

}  // namespace rovernet::cli
