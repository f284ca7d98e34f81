// SPDX-License-Identifier: MIT
#include "cli/results/result_commands.hpp"
#include "cli/terminal/options.hpp"

namespace rovernet::cli {
namespace {

constexpr const char* only_points =
    "use only the runs with this value of a varied key, such as ttl=6";
constexpr const char* only_cells =
    "if runs are missing from some rows of the table: leave the same runs (values of other keys, "
    "and replication) out of every row";

void add_results(Command app) {
    const auto [results, a] =
        add_command(app, "results", "Print the results of a study", cli::results);
    results.add_examples({"rovernet results patrol.db --metric delivery_ratio",
                          "rovernet results patrol.db --sql 'SELECT * FROM result'",
                          "rovernet results patrol.db --csv > patrol.csv"});
    results
        .add_option("STUDY", a.store,
                    "store (file with the results) of a study, as written by rovernet sweep")
        .required();
    Option metric = results
                        .add_option("--metric", a.metrics,
                                    "metrics to print, such as delivery_ratio,latency_mean_s")
                        .delimiter(',');
    Option group_by =
        results
            .add_option("--group-by", a.group_by,
                        "varied keys: print one row for each combination of their values; each row "
                        "averages the results over all other varied keys")
            .delimiter(',');
    Option where = results.add_option("--where", a.where, only_points);
    where.one_word();
    Option common = results.add_flag("--common", a.common, only_cells);
    Option confidence =
        results
            .add_option(
                "--confidence", a.confidence,
                "confidence level of the intervals, such as 0.95 (default: [study] confidence)")
            .range(0.5, 0.9999);
    add_interval(results, a.interval);
    Option quantile = results
                          .add_option("--quantile", a.quantile,
                                      "compute this quantile instead of the mean, such as 0.9")
                          .range(0.0001, 0.9999);
    Option csv =
        results
            .add_flag(
                "--csv", a.csv,
                "print CSV for pandas and R, with a line for each run and metric; with --group-by, "
                "a line for each combination of the --group-by values, metric and replication")
            .excludes(confidence)
            .excludes(results.option("--interval"))
            .excludes(quantile);
    Option provenance =
        results
            .add_flag("--provenance", a.provenance,
                      "with --csv: print a line for each run, with its id, times and host")
            .needs(csv);
    Option failures =
        results.add_flag("--failures", a.failures, "list the failed runs with their errors")
            .excludes(csv);
    Option sql =
        results
            .add_option(
                "--sql", a.sql,
                "print the result of this SQL query on the store, such as 'SELECT * FROM result'")
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
    const auto [plot, p] = add_command(
        app, "plot", "Draw the results of a study, or the numbers of a table", cli::plot);
    plot.add_examples(
        {"rovernet plot density.db -x robot.r.count -y delivery_ratio -o density.svg",
         "rovernet plot measured.csv -x distance -y level --by robot -o measured.svg"});
    plot.add_option("STUDY", p.store,
                    "store (file with the results) of a study, as written by rovernet sweep; or a "
                    "table NAME.csv, whose columns are keys and metrics")
        .required();
    plot.add_option("-x", p.x, "varied key along the x axis, such as robots or radio.power");
    plot.add_option("-y", p.y,
                    "metrics along the y axis, such as delivery_ratio or airtime_s/messages; each "
                    "metric has a chart")
        .delimiter(',')
        .required();
    plot.add_option(
        "--by", p.by,
        "varied key; each of its values has a line of the chart, or a row of the heat map");
    plot.add_option("--where", p.where, only_points).one_word();
    plot.add_flag("--common", p.common, only_cells);
    plot.add_option(
        "--beside", p.beside,
        "CSV file with values from a different source, drawn as marks beside the lines");
    plot.add_option("--kind", p.kind,
                    "kind of chart: lines, bars, cdf or heat_map (default: lines if the values of "
                    "x are numbers, otherwise bars)");
    plot.add_option("--confidence", p.confidence,
                    "confidence level of the intervals, such as 0.95 (default: [study] confidence)")
        .range(0.5, 0.9999);
    add_interval(plot, p.interval);
    plot.add_option("--quantile", p.quantile,
                    "compute this quantile instead of the mean, such as 0.9")
        .range(0.0001, 0.9999);
    plot.add_option(
        "--x-title", p.x_title,
        "title of the x axis, such as 'robots on a square kilometre' (default: the key)");
    plot.add_option("--y-title", p.y_titles,
                    "title of the y axis (default: the metric); for several metrics, give one "
                    "title for each, in the same order")
        .one_word();
    plot.add_flag("--log-x", p.log_x, "give the x axis a logarithmic scale");
    plot.add_flag("--log-y", p.log_y, "give the y axis a logarithmic scale");
    plot.add_option("--width", p.width,
                    "width of the picture in pixels (for a PDF: in points); the text is scaled "
                    "with the width (default: 672 for one chart, 352 for each of several charts)")
        .range(100, 10000);
    plot.add_option(
            "--font-size", p.font_size,
            "font size in points; without --width, one chart is 672 points wide, and each of "
            "several charts 352 points")
        .range(4, 36)
        .shows_default();
    plot.add_option(
            "-o,--output", p.out,
            "picture to write: NAME.svg, NAME.png or NAME.pdf; or NAME.gp, a gnuplot script")
        .required();
}

void add_explain(Command app) {
    const auto [explain, e] =
        add_command(app, "explain", "Print how to repeat one run of a study", cli::explain);
    explain.add_examples({"rovernet explain patrol.db 0/2"});
    explain
        .add_option("STUDY", e.store,
                    "store (file with the results) of a study, as written by rovernet sweep")
        .required();
    explain
        .add_option("RUN", e.run,
                    "run, given as POINT/REPLICATION or by the first characters of its id")
        .required();
    add_json(explain, e.json);
}

}  // namespace

void add_result_commands(Command app) {
    add_results(app);
    add_plot(app);
    add_explain(app);
}

}  // namespace rovernet::cli
