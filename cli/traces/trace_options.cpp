// SPDX-License-Identifier: MIT
#include "cli/terminal/options.hpp"
#include "cli/traces/trace_commands.hpp"

#include <filesystem>
#include <string>
#include <system_error>

namespace rovernet::cli {
namespace {

constexpr const char* any_trace =
    "ns-2 trace (.tr, also compressed by gzip or zstd), recorded trace (.mcap), or folder of a run "
    "with one of them";

/// Path of the trace in the folder of a run: the recorded one, or else that of ns-2. Any other text
/// stays.
std::string trace_of_run(const std::string& text) {
    namespace fs = std::filesystem;
    std::error_code error;  // of a path that leads nowhere: its reader tells
    if (!fs::is_directory(text, error)) return text;
    const fs::path recorded = fs::path(text) / "trace.mcap", ns2 = fs::path(text) / "trace.tr";
    return (fs::exists(recorded, error) || !fs::exists(ns2, error) ? recorded : ns2).string();
}

void add_strict(Command command, bool& strict) {
    command.add_flag("--strict", strict, "stop at the first line that is not an ns-2 trace line");
}

void add_trace_stats(Command trace) {
    const auto [stats, a] =
        add_command(trace, "stats", "Print the metrics of a trace", cli::trace_stats);
    stats.add_examples({"rovernet trace stats runs/patrol-s3/trace.tr",
                        "rovernet trace stats runs/patrol-s3/trace.tr --by robot --csv"});
    stats.add_option("FILE", a.file, any_trace).required().transform(trace_of_run);
    stats.add_option("--by", a.by, "also print the counts of each robot, flow or second")
        .one_of({"robot", "flow", "second"});
    add_strict(stats, a.strict);
    stats.add_flag("--csv", a.csv,
                   "print CSV: a row for each value of --by, or one row for the whole trace");
    add_json(stats, a.json);
}

void add_trace_convert(Command trace) {
    const auto [convert, a] =
        add_command(trace, "convert", "Convert a trace to another format", cli::trace_convert);
    convert.add_examples(
        {"rovernet trace convert runs/patrol-s3/trace.tr patrol.csv --to csv",
         "rovernet trace convert runs/rescue-s1/trace.mcap rescue.tr --to ns2-old --mac",
         "rovernet trace convert runs/rescue-s1/trace.mcap rescue.pcapng --to pcapng",
         "rovernet trace convert runs/rescue-s1/trace.mcap rescue.mcap --to foxglove"});
    convert.add_option("IN", a.in, any_trace).required().transform(trace_of_run);
    convert.add_option("OUT", a.out, "file to write").required();
    convert
        .add_option(
            "--to", a.to,
            "format to write: csv, ns2-old, ns2-new; only from a recorded trace: pcapng, foxglove")
        .one_of({"csv", "ns2-old", "ns2-new", "pcapng", "foxglove"})
        .required();
    convert.add_flag("--mac", a.mac,
                     "also write the lines of the MAC layer, as [trace] mac = true does (only from "
                     "a recorded trace)");
    add_strict(convert, a.strict);
}

void add_trace_cut(Command trace) {
    const auto [cut, a] = add_command(
        trace, "cut", "Write selected lines of a trace, as an ns-2 trace", cli::trace_cut);
    cut.add_examples(
        {"rovernet trace cut runs/patrol-s3/trace.tr piece.tr --from \"10 s\" --to \"20 s\"",
         "rovernet trace cut runs/rescue-s1/trace.mcap piece.tr --message 3"});
    cut.add_option("IN", a.in, any_trace).required().transform(trace_of_run);
    cut.add_option("OUT", a.out, "file to write").required();
    cut.add_option("--from", a.from, "time at which the piece begins");
    cut.add_option("--to", a.to, "time at which the piece ends; events at this time are left out");
    cut.add_option("--robot", a.robot, "number of a robot; write only its lines");
    cut.add_option("--message", a.message, "id of a message; write only its packets");
    add_strict(cut, a.strict);
}

void add_trace_diff(Command trace) {
    const auto [diff, a] = add_command(
        trace, "diff", "Show the first difference of two traces; exit code 1 if they differ",
        cli::trace_diff);
    diff.add_examples({"rovernet trace diff runs/rescue-s1/trace.tr runs/rescue-s1/trace.mcap",
                       "rovernet trace diff runs/rescue-s1/trace.tr runs/rescue-s1/trace.mcap "
                       "--time-tolerance \"1 us\""});
    diff.add_option("A", a.a, any_trace).required().transform(trace_of_run);
    diff.add_option("B", a.b, any_trace).required().transform(trace_of_run);
    diff.add_option("--time-tolerance", a.time_tolerance,
                    "two times count as equal if they differ by at most this time")
        .shows_default();
    add_strict(diff, a.strict);
}

void add_trace_follow(Command trace) {
    const auto [follow, a] =
        add_command(trace, "follow", "Follow a message from robot to robot", cli::trace_follow);
    follow.add_examples({"rovernet trace follow runs/rescue-s1/trace.tr --message 3",
                         "rovernet trace follow runs/rescue-s1/trace.mcap --message 0 --robot E"});
    follow.add_option("FILE", a.file, any_trace).required().transform(trace_of_run);
    follow.add_option("--message", a.message, "id of the message").required();
    follow.add_option(
        "--robot", a.robot,
        "name or number of a robot: print only the message's path to this robot; for a recorded "
        "trace also print whether this robot received each frame, and why not");
    add_strict(follow, a.strict);
    add_json(follow, a.json);
}

}  // namespace

void add_trace(Command app) {
    Command trace = app.add_command("trace", "Work with trace files");
    trace.needs_command();
    add_trace_stats(trace);
    add_trace_convert(trace);
    add_trace_cut(trace);
    add_trace_diff(trace);
    add_trace_follow(trace);
}

}  // namespace rovernet::cli
