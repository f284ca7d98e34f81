// SPDX-License-Identifier: MIT
#include "cli/terminal/diagnostics.hpp"
#include "cli/traces/trace_commands.hpp"
#include "cli/traces/trace_notices.hpp"
#include "experiment/replay/capture.hpp"
#include "experiment/replay/trace_input.hpp"
#include "experiment/reports/loss_table.hpp"
#include "files/input_file.hpp"
#include "pictures/foxglove/foxglove_trace.hpp"
#include "traces/ns2/ns2_convert.hpp"
#include "traces/ns2/ns2_diff.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace rovernet::cli {
namespace {

Ns2Strictness strictness_of(bool strict) {
    return strict ? Ns2Strictness::strict : Ns2Strictness::tolerant;
}

/// Says what of `in` is not in the file that was made of it.
void tell_left_out(const std::string& in, const Converted& converted) {
    tell_refused(in, converted.counts);
    for (const auto& [why, count] : converted.left_out) {
        notice(fmt::format("{}: {} {} left out: {}", in, count,
                           count == 1 ? "event is" : "events are", why));
    }
}

void print_side(const char* sign, const std::vector<NumberedLine>& lines, std::size_t place) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
        fmt::print("{} {:>7}{} {}\n", sign, lines[i].line, i == place ? '>' : ' ', lines[i].text);
    }
    if (place >= lines.size()) fmt::print("{}        > (the file ends)\n", sign);
}

void print_kinds(const TraceDifference& d) {
    fmt::print("\n{:<14} {:>10} {:>10}\n", "events", "A", "B");
    for (const auto& [kind, count] : d.kinds) {
        fmt::print("{:<14} {:>10} {:>10}{}\n", kind, count.first, count.second,
                   count.first == count.second ? "" : "  differ");
    }
}

void check_is_recorded(const TraceConvertArguments& a, std::string_view why) {
    if (is_recorded_trace(a.in)) return;
    need_file(a.in);
    throw InputError({.source = a.in},
                     fmt::format("{} can be made only from a recorded trace (rovernet run "
                                 "--record), because {}, which only a recorded trace contains",
                                 a.to, why));
}

void convert_to_capture(const TraceConvertArguments& a) {
    check_is_recorded(a, "levels are computed from the scenario");
    const Capture made = capture_recorded(a.in, a.out);
    tell_damage(a.in, made.damage);
    if (made.left_out > 0) {
        notice(fmt::format(
            "{}: {} frames are left out, because their messages are in a damaged part of the trace",
            a.in, made.left_out));
    }
}

/// @throws InputError if the output would replace the input
void check_apart(const std::string& in, const std::string& out) {
    std::error_code ignored;
    if (std::filesystem::equivalent(in, out, ignored))
        throw InputError({out}, "this is the trace to be read; expected a different file to write");
}

}  // namespace

void trace_convert(const TraceConvertArguments& a) {
    check_apart(a.in, a.out);
    if (a.to == "pcapng") return convert_to_capture(a);
    if (a.to == "foxglove") {
        check_is_recorded(a, "the map and the bodies of robots are taken from the scenario");
        return tell_damage(a.in, convert_to_foxglove(a.in, a.out));
    }
    TraceInput::Lines lines;
    if (a.to == "ns2-old") lines.format = Ns2Format::old_format;
    if (a.mac) lines.mac = MacTrace::on;
    const TraceInput trace(a.in, lines);
    if (trace.is_recorded() && a.to != "csv") {
        return tell_damage(a.in, render_recorded(a.in, a.out, lines));
    }
    const TraceForm form = a.to == "csv"       ? TraceForm::csv
                           : a.to == "ns2-old" ? TraceForm::ns2_old
                                               : TraceForm::ns2_new;
    tell_left_out(a.in, convert_ns2(trace.text(), a.out, form, strictness_of(a.strict)));
    tell_damage(a.in, trace.damage());
}

void trace_cut(const TraceCutArguments& a) {
    check_apart(a.in, a.out);
    TraceCut cut;
    if (a.from) cut.from = start_of_run + option_time("--from", *a.from);
    if (a.to) cut.to = start_of_run + option_time("--to", *a.to);
    if (a.from && a.to && cut.from >= cut.to) {
        throw InputError({fmt::format("--from {} --to {}", *a.from, *a.to), 0, 0, true},
                         "the piece ends before it begins; expected --from before --to");
    }
    if (a.robot) cut.robot = NodeId{*a.robot};
    cut.message = a.message;
    const TraceInput trace(a.in, {});
    const Converted made = cut_ns2(trace.text(), a.out, cut, strictness_of(a.strict));
    tell_left_out(a.in, made);
    tell_damage(a.in, trace.damage());
    if (made.written > 0) return;
    const bool is_by_time = !a.robot && !a.message;
    notice(fmt::format("{} contains no event, because {} has no event {}", a.out, a.in,
                       is_by_time ? "between --from and --to" : "that matches the options"));
}

void trace_diff(const TraceDiffArguments& a) {
    const Duration tolerance = option_time("--time-tolerance", a.time_tolerance);
    TraceInput::Lines lines{.format = Ns2Format::old_format};
    if (is_recorded_trace(a.a) && is_recorded_trace(a.b)) lines.mac = MacTrace::on;
    const TraceInput left(a.a, lines), right(a.b, lines);
    const TraceDifference d =
        diff_ns2(left.text(), right.text(), tolerance, strictness_of(a.strict));
    tell_refused(a.a, d.counts_a);
    tell_refused(a.b, d.counts_b);
    tell_damage(a.a, left.damage());
    tell_damage(a.b, right.damage());
    if (d.is_equal) {
        fmt::print("equal: {} events\n", d.counts_a.events);
        return;
    }
    fmt::print("A is {}, B is {}; the first difference: {}\n\n", a.a, a.b, d.field);
    print_side("A", d.a, d.place);
    fmt::print("\n");
    print_side("B", d.b, d.place);
    print_kinds(d);
    throw CommandEnd(failed, fmt::format("{} and {} differ", a.a, a.b));
}

}  // namespace rovernet::cli
