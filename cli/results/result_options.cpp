// SPDX-License-Identifier: MIT
#include "cli/results/result_commands.hpp"
#include "cli/terminal/options.hpp"

namespace rovernet::cli {
namespace {

constexpr const char* only_points = "only points with KEY=VALUE, such as ttl=6";
constexpr const char* only_cells =
    "where rows lack runs, average only over the cells that all of them have";

void add_results(Command app) {
    const auto [results, a] = add_command(app, "results", "What a study came to", cli::results);
    results.add_examples({"rovernet results patrol.db --metric delivery_ratio",
                          "rovernet results patrol.db --sql 'SELECT * FROM result'",
                          "rovernet results patrol.db --csv > patrol.csv"});
    results.add_option("STUDY", a.store, "store of a study, as sweep makes it").required();
    Option metric =
        results.add_option("--metric", a.metrics, "which, such as delivery_ratio,latency_mean_s")
            .delimiter(',');
    Option group_by =
        results.add_option("--group-by", a.group_by, "keys that vary; the others are averaged over")
            .delimiter(',');
    Option where = results.add_option("--where", a.where, only_points);
    where.one_word();
    Option common = results.add_flag("--common", a.common, only_cells);
    Option confidence =
        results.add_option("--confidence", a.confidence, "of the intervals, such as 0.95")
            .range(0.5, 0.9999);
    add_interval(results, a.interval);
    Option quantile =
        results
            .add_option("--quantile", a.quantile, "this quantile in place of the mean, such as 0.9")
            .range(0.0001, 0.9999);
    Option csv = results
                     .add_flag("--csv", a.csv,
                               "a row per run and metric, for pandas and R; with --group-by "
                               "one per row, metric and replication")
                     .excludes(confidence)
                     .excludes(results.option("--interval"))
                     .excludes(quantile);
    Option provenance =
        results
            .add_flag("--provenance", a.provenance, "with --csv: a row per run, its times and host")
            .needs(csv);
    Option failures =
        results.add_flag("--failures", a.failures, "the runs that failed, and why").excludes(csv);
    Option sql =
        results.add_option("--sql", a.sql, "answer this question, such as 'SELECT * FROM result'")
            .excludes(csv)
            .excludes(failures)
            .excludes(where);
    for (Option of_answers : {metric, group_by, common}) {
        for (Option other : {provenance, failures, sql}) other.excludes(of_answers);
    }
    for (Option of_values : {confidence, quantile, results.option("--interval")}) {
        for (Option other : {failures, sql}) other.excludes(of_values);
    }
    add_json(results, a.json);
    for (Option text : {csv, failures, sql}) results.option("--json").excludes(text);
}

void add_plot(Command app) {
    const auto [plot, p] = add_command(app, "plot", "Draw what a study came to", cli::plot);
    plot.add_examples(
        {"rovernet plot density.db -x robot.r.count -y delivery_ratio -o density.svg"});
    plot.add_option("STUDY", p.store, "store of a study, as sweep makes it").required();
    plot.add_option("-x", p.x, "key that varies, such as robots or radio.power");
    plot.add_option("-y", p.y,
                    "metrics, such as delivery_ratio or airtime_s/messages: a chart each")
        .delimiter(',')
        .required();
    plot.add_option("--by", p.by, "key of the lines, or of the rows of a heat map");
    plot.add_option("--where", p.where, only_points).one_word();
    plot.add_flag("--common", p.common, only_cells);
    plot.add_option("--beside", p.beside,
                    "CSV file with values of another source: marks beside the lines");
    plot.add_option("--kind", p.kind,
                    "lines, bars, cdf or heat_map (default: lines over numbers, "
                    "bars over words)");
    plot.add_option("--confidence", p.confidence, "of the intervals, such as 0.95")
        .range(0.5, 0.9999);
    add_interval(plot, p.interval);
    plot.add_option("--quantile", p.quantile, "this quantile in place of the mean, such as 0.9")
        .range(0.0001, 0.9999);
    plot.add_flag("--log-x", p.log_x, "a logarithmic axis");
    plot.add_flag("--log-y", p.log_y, "a logarithmic axis");
    plot.add_option("--width", p.width,
                    "of the picture, in pixels (points of a PDF); all is scaled "
                    "(default: 672, for several charts 352 each)")
        .range(100, 10000);
    plot.add_option("--font-size", p.font_size,
                    "in points, of which a chart is 672 wide, 352 beside others")
        .range(4, 36)
        .shows_default();
    plot.add_option("-o,--output", p.out,
                    "NAME.svg, NAME.png or NAME.pdf; to restyle it NAME.gp (gnuplot)")
        .required();
}

void add_explain(Command app) {
    const auto [explain, e] =
        add_command(app, "explain", "How one run of a study came about", cli::explain);
    explain.add_examples({"rovernet explain patrol.db 0/2"});
    explain.add_option("STUDY", e.store, "store of a study, as sweep makes it").required();
    explain.add_option("RUN", e.run, "POINT/REPLICATION, or the beginning of its id").required();
    add_json(explain, e.json);
}

}  // namespace

void add_result_commands(Command app) {
    add_results(app);
    add_plot(app);
    add_explain(app);
}

}  // namespace rovernet::cli
