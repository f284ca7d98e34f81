// SPDX-License-Identifier: MIT
#include "cli/runs/run_commands.hpp"
#include "cli/terminal/options.hpp"

namespace rovernet::cli {
namespace {

void add_run(Command app) {
    const auto [run, a] = add_command(app, "run", "Run a scenario", run_or_view);
    add_run_options(run, a);
    const Option view = a.view.add_to(run);
    run.add_option(
           "--listen", a.reach.listen,
           "serve the page to other machines, too, at this IP address of this machine (0.0.0.0: at "
           "all addresses of this machine); browsers on other machines need the token in the "
           "printed address")
        .needs(view);
}

/// Options of how a study's runs are made.
void add_workers(Command command, StudyArguments& a) {
    command
        .add_option("--workers", a.workers,
                    "number of worker processes (default: number of processors)")
        .range(1, 1024);
    command.add_option("--timeout", a.timeout,
                       "limit of real time for one run, such as 60s (default: no limit)");
    command.add_option("--memory", a.memory,
                       "limit of memory for one run, such as 2GB (default: memory of the machine "
                       "divided by the number of workers)");
}

/// Options of how a study is run.
void add_study_run(Command command, StudyArguments& a) {
    add_workers(command, a);
    command
        .add_option("--replications", a.replications,
                    "number of replications of each point (default: [study] replications)")
        .range(1, 1'000'000);
    command
        .add_option("--precision", a.precision,
                    "add replications until the confidence interval of the first metric has this "
                    "half-width, in the metric's unit")
        .check(above_zero());
    command
        .add_option("--max-replications", a.max_replications,
                    "largest number of replications of a point with --precision (default: [study] "
                    "max_replications)")
        .range(1, 1'000'000);
    add_interval(command, a.interval);
    command.add_flag("--fail-fast", a.fail_fast, "start no further run after a run has failed");
    add_json(command, a.json);
}

void add_sweep(Command app, const std::string& typed) {
    const auto [sweep, a] = add_command(
        app, "sweep", "Run a study: all combinations of the varied values, in all replications",
        cli::sweep);
    sweep.add_examples(
        {"rovernet sweep examples/density/density.toml --dry-run",
         "rovernet sweep examples/patrol/patrol.toml --replications 3 --store patrol.db"});
    a.command = typed;
    add_study_file(sweep, a, any_file);
    sweep.add_flag("--dry-run", a.dry_run,
                   "list the points and runs of the study, without running them");
    sweep.add_option("--store", a.store,
                     "file for the results (default: FILE with the ending .db)");
    add_study_run(sweep, a);
    Option resume = sweep.add_flag("--resume", a.resume,
                                   "make only the runs that the store lacks (this is the default)");
    sweep
        .add_flag("--fresh", a.fresh,
                  "ask for confirmation, delete the runs in the store, then make all runs again")
        .excludes(resume);
    sweep.add_flag("--yes", a.yes, "with --fresh: delete the runs without asking");
    const Option shard =
        sweep
            .add_option("--shard", a.shard,
                        "make only the runs of this chunk of the study; chunks are numbered from 0")
            .check(whole_number());
    sweep.add_option("--chunk", a.chunk, "number of runs in each chunk of --shard")
        .check(above_zero())
        .shows_default();
    sweep.add_option("--except", a.except,
                     "do not make the runs that are already finished in this store");
    const Option merge =
        sweep.add_option("--merge", a.merge, "move the runs of these stores into the study's store")
            .excludes(shard);
    sweep
        .add_option("--executor", a.executor,
                    "where runs are made: in worker processes on this machine (local, the "
                    "default), or in a job array of Slurm (slurm)")
        .one_of({"local", "slurm"})
        .excludes(shard)
        .excludes(merge);
    sweep.add_option("--sbatch", a.sbatch, "further options for sbatch, such as \"--time=1:00\"");
}

void add_compare(Command app, const std::string& typed) {
    const auto [compare, a] = add_command(
        app, "compare", "Compare propagation models, routing protocols or values of any other key",
        cli::compare);
    compare.add_examples(
        {"rovernet compare examples/patrol/patrol.toml --models "
         "friis,log_distance --replications 3",
         "rovernet compare examples/detour/detour.toml --protocols flood,aodv --replications 5"});
    a.command = typed;
    add_study_file(compare, a, any_file);
    compare
        .add_option(
            "--models", a.models,
            "propagation models to compare, such as friis,disc (default: those in [study] vary)")
        .delimiter(',');
    Option protocols =
        compare
            .add_option("--protocols", a.protocols,
                        "routing protocols to compare instead of models, such as flood,aodv")
            .delimiter(',')
            .excludes(compare.option("--models"));
    compare
        .add_option("--vary", a.vary,
                    "key and values to compare instead of models, such as routing.ttl=4,8")
        .excludes(compare.option("--models"))
        .excludes(protocols);
    compare
        .add_option("--metric", a.metrics,
                    "metrics to compare (default: first metric of the study; for protocols "
                    "delivery_ratio, latency_mean_s, routing_load, airtime_per_byte_us)")
        .delimiter(',');
    compare.add_option("--baseline", a.baseline,
                       "model, protocol or value with which all others are compared (default: the "
                       "most detailed model, or the first protocol or value)");
    compare
        .add_option("--margin", a.margin,
                    "test for each model whether its mean differs from the baseline's mean by less "
                    "than this margin (in the metric's unit)")
        .check(above_zero());
    compare
        .add_option("--confidence", a.confidence,
                    "confidence level of the intervals, such as 0.95 (default: [study] confidence)")
        .range(0.5, 0.9999);
    compare.add_option(
        "--store", a.store,
        "file in which to keep the runs; runs that it already contains are not repeated");
    compare.add_option("-o,--output", a.picture,
                       "picture to write: NAME.svg, NAME.png or NAME.pdf");
    Option csv = compare.add_flag("--csv", a.csv,
                                  "print CSV, with a line for each compared value and metric");
    add_study_run(compare, a);
    csv.excludes(compare.option("--json"));
}

void add_advise(Command app, const std::string& typed) {
    const auto [advise, a] = add_command(
        app, "advise", "Find the cheapest models that give the same results as detailed models",
        cli::advise);
    advise.add_examples(
        {"rovernet advise examples/rescue/rescue.toml --tolerance 0.1 --models "
         "friis,log_distance,multi_wall --max-replications 200"});
    a.command = typed;
    add_study_file(advise, a, any_file);
    advise
        .add_option("--tolerance", a.tolerance,
                    "largest acceptable error of the metric, in the metric's unit (default: 0.02 "
                    "for metrics between 0 and 1)")
        .check(above_zero());
    advise
        .add_option("--criterion", a.criterion,
                    "error to compare with the tolerance: mean (error of the mean of many runs) or "
                    "run (mean error of a single run)")
        .one_of({"mean", "run"})
        .shows_default();
    advise.add_option("--metric", a.metric, "metric that the models must reproduce")
        .shows_default();
    advise
        .add_option("--reference", a.question.reference,
                    "change a parameter of the reference models: propagation.KEY=VALUE or "
                    "reception.KEY=VALUE")
        .one_word();
    advise
        .add_option("--models", a.question.models,
                    "candidate models, separated by commas (default: all models less detailed than "
                    "the reference)")
        .delimiter(',');
    advise.add_flag("--as-given", a.question.as_given,
                    "do not fit the models: use their parameters in the scenario file");
    advise
        .add_option("--max-replications", a.max_replications,
                    "largest number of replications; a model that is still undecided after these "
                    "replications counts as insufficient (default: 4000)")
        .range(1, 1'000'000);
    advise
        .add_option(
            "--budget", a.budget,
            "real time after which the command ends with a preliminary verdict, such as 60s")
        .shows_default();
    advise.add_flag(
        "--no-cost", a.no_cost,
        "do not measure the CPU time of the models, so that equal commands print equal results");
    advise.add_option(
        "--store", a.store,
        "file in which to keep the runs; runs that it already contains are not repeated");
    advise.add_option("-o,--output", a.picture, "picture to write: NAME.svg, NAME.png or NAME.pdf");
    add_workers(advise, a);
    add_json(advise, a.json);
}

void add_fit(Command app) {
    const auto [fit, a] = add_command(
        app, "fit", "Fit the parameters of each propagation model to known losses", cli::fit);
    fit.add_examples({"rovernet fit examples/rescue/rescue.toml --to multi_wall",
                      "rovernet fit office.toml --links monday.csv --check tuesday.csv",
                      "rovernet fit office.toml --links monday.csv --floor \"-94 dBm\""});
    add_file(fit, a, any_file);
    Option to = fit.add_option(
        "--to", a.to,
        "reference model to which the other models are fitted (default: the scenario's model)");
    Option links =
        fit.add_option(
               "--links", a.links,
               "CSV file of measured levels to which the models are fitted, with columns from_x_m, "
               "from_y_m, to_x_m, to_y_m, level_dbm; optional: from_z_m, to_z_m, group")
            .excludes(to);
    fit.add_option("--check", a.check,
                   "CSV file of levels from a different measurement, such as that of another day, "
                   "to check the fitted models")
        .needs(links);
    fit.add_option("--floor", a.floor,
                   "level below which nothing was received, such as \"-94 dBm\"; needed if "
                   "level_dbm is empty in some rows of the CSV files")
        .needs(links);
    fit.add_flag("--gains", a.gains,
                 "fit a separate gain for each transmitter position, relative to the mean gain")
        .needs(links);
    add_json(fit, a.json);
}

void add_probe(Command app) {
    const auto [probe, a] = add_command(
        app, "probe",
        "Show which results change if antenna positions, walls or materials change slightly",
        cli::probe);
    probe.add_examples({"rovernet probe examples/rescue/rescue.toml",
                        "rovernet probe examples/rescue/rescue.toml --no-messages --top 30"});
    add_file(probe, a, any_file);
    probe.add_option("--links", a.links, "largest number of links to check")
        .range(1, 1'000'000)
        .shows_default();
    probe.add_option("--top", a.top, "largest number of links, and of messages, to list")
        .range(0, 1'000'000)
        .shows_default();
    probe.add_flag("--no-messages", a.no_messages,
                   "check only links, without running the scenario");
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
