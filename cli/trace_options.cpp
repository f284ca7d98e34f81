// SPDX-License-Identifier: MIT
#include "cli/options.hpp"

namespace rovernet::cli {
namespace {

constexpr const char* any_trace = "ns-2 trace (.tr), which may be packed by gzip or zstd";

void add_strict(Command command, bool& strict) {
    command.add_flag("--strict", strict, "stop at the first line that is none of ns-2");
}

void add_trace_stats(Command trace) {
    const auto [stats, a] =
        add_command(trace, "stats", "Print the metrics of an ns-2 trace", cli::trace_stats);
    stats.add_examples({"rovernet trace stats runs/patrol-s3/trace.tr",
                        "rovernet trace stats out.tr.gz --by flow --csv"});
    stats.add_option("FILE", a.file, any_trace).required();
    stats.add_option("--by", a.by, "also the counts of each robot, flow or second")
        .one_of({"robot", "flow", "second"});
    add_strict(stats, a.strict);
    stats.add_flag("--csv", a.csv, "print the rows of --by, or else the totals, as CSV");
    add_json(stats, a.json);
}

}  // namespace

void add_trace(Command app) {
    Command trace = app.add_command("trace", "Work with trace files");
    trace.needs_command();
    add_trace_stats(*trace);
}

}  // namespace rovernet::cli
