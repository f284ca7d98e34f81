// SPDX-License-Identifier: MIT
#include "cli/runs/run_commands.hpp"
#include "cli/terminal/options.hpp"

namespace rovernet::cli {
namespace {

void add_run(Command app) {
    const auto [run, a] = add_command(app, "run", "Run a scenario", cli::run);
    run.add_examples(
        {"rovernet run examples/patrol/patrol.toml",
         "rovernet run examples/rescue/rescue.toml --seed 7 --out rescue-7",
         "rovernet run examples/rescue/rescue.toml --record",
         "rovernet run examples/rescue/rescue.toml --set propagation.model=friis --json"});
    add_file(run, a, any_file);
    run.add_option(
        "--out", a.out,
        "folder for the results (default: runs/NAME-sSEED, with --set runs/NAME-sSEED-KEY=VALUE)");
    run.add_option("--speed", a.speed, "pace the run: 1 is real time, 2 (or x2) twice as fast")
        .transform(
            [](const std::string& text) { return text.starts_with('x') ? text.substr(1) : text; })
        .check(above_zero());
    run.add_flag("--record", a.record, "write trace.mcap, too: all records, to replay");
    const Option view = a.view.add_to(run);
    run.add_option("--listen", a.reach.listen,
                   "IP address of this machine by which others reach the page, or 0.0.0.0: they "
                   "need the token in the address that is printed")
        .needs(view);
    add_json(run, a.json);
    run.add_flag("--print-scenario", a.print_scenario,
                 "print the scenario with every default, and do not run it");
}

/// Options of how a study's runs are made.
void add_workers(Command command, StudyArguments& a) {
    command.add_option("--workers", a.workers, "processes at once (default: as many as processors)")
        .range(1, 1024);
    command.add_option("--timeout", a.timeout, "of one run, in real time, such as 60s");
    command.add_option("--memory", a.memory,
                       "of one run, such as 2GB (default: what the machine has, over the workers)");
}

/// Options of how a study is run.
void add_study_run(Command command, StudyArguments& a) {
    add_workers(command, a);
    command.add_option("--replications", a.replications, "of each point; or [study] replications")
        .range(1, 1'000'000);
    command
        .add_option("--precision", a.precision,
                    "repeat until the interval of the first metric has this half-width")
        .check(above_zero());
    command.add_option("--max-replications", a.max_replications, "for --precision, at most")
        .range(1, 1'000'000);
    add_interval(command, a.interval);
    command.add_flag("--fail-fast", a.fail_fast, "begin nothing new once a run has failed");
    add_json(command, a.json);
}

void add_sweep(Command app, const std::string& typed) {
    const auto [sweep, a] =
        add_command(app, "sweep", "Run a study: every point, every replication", cli::sweep);
    sweep.add_examples(
        {"rovernet sweep examples/density/density.toml --dry-run",
         "rovernet sweep examples/patrol/patrol.toml --replications 3 --store patrol.db"});
    a.command = typed;
    add_study_file(sweep, a, any_file);
    sweep.add_flag("--dry-run", a.dry_run, "list the points and runs, and run nothing");
    sweep.add_option("--store", a.store, "file for the results (default: FILE with .db)");
    add_study_run(sweep, a);
    Option resume = sweep.add_flag("--resume", a.resume, "go on where the store ends: usual");
    sweep.add_flag("--fresh", a.fresh, "throw away the runs that the store has; asks")
        .excludes(resume);
    sweep.add_flag("--yes", a.yes, "do not ask");
    const Option shard =
        sweep.add_option("--shard", a.shard, "make only the runs of this chunk, from 0")
            .check(whole_number());
    sweep.add_option("--chunk", a.chunk, "runs of a chunk").check(above_zero()).shows_default();
    sweep.add_option("--except", a.except, "make no run that this store has finished");
    const Option merge =
        sweep.add_option("--merge", a.merge, "move the runs of these stores into the study's")
            .excludes(shard);
    sweep.add_option("--executor", a.executor, "local (default), or slurm: a job array")
        .one_of({"local", "slurm"})
        .excludes(shard)
        .excludes(merge);
    sweep.add_option("--sbatch", a.sbatch, "more options for sbatch, such as \"--time=1:00\"");
}

void add_compare(Command app, const std::string& typed) {
    const auto [compare, a] = add_command(
        app, "compare",
        "Propagation models, routing protocols or values of another key, beside each other",
        cli::compare);
    compare.add_examples(
        {"rovernet compare examples/patrol/patrol.toml --models "
         "friis,log_distance --replications 3",
         "rovernet compare examples/detour/detour.toml --protocols flood,aodv --replications 5"});
    a.command = typed;
    add_study_file(compare, a, any_file);
    compare.add_option("--models", a.models, "which (default: those of [study] vary)")
        .delimiter(',');
    Option protocols = compare
                           .add_option("--protocols", a.protocols,
                                       "routing protocols in place of models: flood,aodv")
                           .delimiter(',')
                           .excludes(compare.option("--models"));
    compare
        .add_option("--vary", a.vary, "any key and its values in place of models: routing.ttl=4,8")
        .excludes(compare.option("--models"))
        .excludes(protocols);
    compare
        .add_option("--metric", a.metrics,
                    "compared (default: the study's first; of protocols delivery_ratio, "
                    "latency_mean_s, routing_load, airtime_per_byte_us)")
        .delimiter(',');
    compare.add_option(
        "--baseline", a.baseline,
        "to differ from (default: the most detailed model; else the first protocol or value)");
    compare
        .add_option("--margin", a.margin,
                    "say of each model whether its mean is this near to the baseline's")
        .check(above_zero());
    compare.add_option("--confidence", a.confidence, "of the intervals, such as 0.95")
        .range(0.5, 0.9999);
    compare.add_option("--store", a.store, "keep the runs in this file, and go on from there");
    compare.add_option("-o,--output", a.picture,
                       "picture to write: NAME.svg, NAME.png or NAME.pdf");
    Option csv = compare.add_flag("--csv", a.csv, "a line for each value and metric, as CSV");
    add_study_run(compare, a);
    csv.excludes(compare.option("--json"));
}

void add_advise(Command app, const std::string& typed) {
    const auto [advise, a] = add_command(
        app, "advise", "The cheapest models with which a scenario has the results of detailed ones",
        cli::advise);
    advise.add_examples(
        {"rovernet advise examples/rescue/rescue.toml --tolerance 0.1 --models "
         "friis,log_distance,multi_wall --max-replications 200"});
    a.command = typed;
    add_study_file(advise, a, any_file);
    advise
        .add_option("--tolerance", a.tolerance,
                    "error of the metric that does not matter (default: 0.02 of a share)")
        .check(above_zero());
    advise
        .add_option("--criterion", a.criterion,
                    "error that is meant: mean, of many runs; run, of a single one")
        .one_of({"mean", "run"})
        .shows_default();
    advise.add_option("--metric", a.metric, "that has to be right").shows_default();
    advise
        .add_option("--reference", a.question.reference,
                    "change of the reference: propagation.KEY=VALUE or reception.KEY=VALUE")
        .one_word();
    advise
        .add_option("--models", a.question.models,
                    "models to judge, or candidates by their names (default: those less detailed)")
        .delimiter(',');
    advise.add_flag("--as-given", a.question.as_given,
                    "do not fit models first, but take the parameters of the file");
    advise
        .add_option("--max-replications", a.max_replications,
                    "what is undecided then counts as insufficient (default: 4000)")
        .range(1, 1'000'000);
    advise
        .add_option("--budget", a.budget,
                    "time after which it ends with the interim verdict, such as 60s")
        .shows_default();
    advise.add_flag("--no-cost", a.no_cost, "do not measure costs, which differ from time to time");
    advise.add_option("--store", a.store, "keep the runs in this file, and go on from there");
    advise.add_option("-o,--output", a.picture, "picture to write: NAME.svg, NAME.png or NAME.pdf");
    add_workers(advise, a);
    add_json(advise, a.json);
}

void add_fit(Command app) {
    const auto [fit, a] = add_command(
        app, "fit", "The parameters with which each model comes nearest to known losses", cli::fit);
    fit.add_examples({"rovernet fit examples/rescue/rescue.toml --to multi_wall",
                      "rovernet fit office.toml --links monday.csv --check tuesday.csv",
                      "rovernet fit office.toml --links monday.csv --floor \"-94 dBm\""});
    add_file(fit, a, any_file);
    Option to = fit.add_option("--to", a.to,
                               "model that the others are fitted to (default: the scenario's own)");
    Option links =
        fit.add_option("--links", a.links,
                       "measured levels (.csv) to fit to: columns from_x_m, from_y_m, to_x_m, "
                       "to_y_m, level_dbm; also from_z_m, to_z_m, group")
            .excludes(to);
    fit.add_option("--check", a.check, "levels of another day or drive, to judge the fits by")
        .needs(links);
    fit.add_option("--floor", a.floor, "level below which nothing was received: an empty level_dbm")
        .needs(links);
    fit.add_flag("--gains", a.gains,
                 "each place that sends has a gain of its own, beyond the mean of all")
        .needs(links);
    add_json(fit, a.json);
}

void add_probe(Command app) {
    const auto [probe, a] = add_command(
        app, "probe", "What changes if places, walls or materials are a little others", cli::probe);
    probe.add_examples({"rovernet probe examples/rescue/rescue.toml",
                        "rovernet probe examples/rescue/rescue.toml --no-messages --top 30"});
    add_file(probe, a, any_file);
    probe.add_option("--links", a.links, "links looked at, at most")
        .range(1, 1'000'000)
        .shows_default();
    probe.add_option("--top", a.top, "links and messages that are listed, at most")
        .range(0, 1'000'000)
        .shows_default();
    probe.add_flag("--no-messages", a.no_messages, "look at links only, without runs");
    add_json(probe, a.json);
}

}  // namespace

void add_run_commands(Command app, const std::string& typed) {
    add_run(app);
    add_live(app);
    add_emulate(app);
    add_in(app);
    add_sweep(app, typed);
    add_compare(app, typed);
    add_advise(app, typed);
    add_fit(app);
    add_probe(app);
    add_locate(app);
}

}  // namespace rovernet::cli
