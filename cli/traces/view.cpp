// SPDX-License-Identifier: MIT
#include "cli/display/browser.hpp"
#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/options.hpp"
#include "cli/terminal/stop.hpp"
#include "cli/terminal/waiting.hpp"
#include "cli/traces/assignments.hpp"
#include "cli/traces/trace_commands.hpp"
#include "cli/traces/trace_notices.hpp"
#include "experiment/recorded_scenario.hpp"
#include "experiment/replay/ns2_record.hpp"
#include "experiment/replay/recorded_day.hpp"
#include "experiment/replay/run_comparison.hpp"
#include "experiment/reports/loss_table.hpp"
#include "experiment/run.hpp"
#include "files/part_file.hpp"
#include "files/temporary_directory.hpp"
#include "live/viewer/answers.hpp"
#include "live/viewer/view_server.hpp"
#include "pictures/viewer/view_page.hpp"
#include "pictures/viewer/view_run.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

namespace rovernet::cli {
namespace {

namespace fs = std::filesystem;

/// Size of the option --limit [bytes], such as "5 MB".
std::size_t option_size(const std::string& text) {
    double number = 0;
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    const std::string_view unit(rest + (rest != end && *rest == ' '), end);
    const double factor = unit == "kB" ? 1e3 : unit == "MB" ? 1e6 : unit == "GB" ? 1e9 : 0;
    if (error != std::errc{} || factor == 0 || !(number > 0 && number * factor < 1e12)) {
        throw InputError(Location{"--limit " + text, 0, 0, true},
                         "expected a size in kB, MB or GB; for example \"5 MB\"");
    }
    return static_cast<std::size_t>(number * factor);
}

/// Recorded trace to be viewed: that of a run's folder, the trace itself, or that of a scenario,
/// which is run first.
class TraceToView {
  public:
    explicit TraceToView(const std::string& file, const ViewArguments& a) {
        if (fs::is_directory(file)) {
            path_ = (fs::path(file) / "trace.mcap").string();
            if (fs::exists(path_)) return;
            throw InputError(Location{file},
                             "no trace.mcap in this folder; record a trace with `rovernet run FILE "
                             "--record`, or name a scenario, which is then run first");
        }
        if (is_page(file)) {
            throw InputError(Location{file},
                             "this is a page, which a browser opens; expected the folder of a run, "
                             "a trace or a scenario file");
        }
        if (is_ns2_name(file)) {
            read_ns2(file, a);
        } else {
            path_ = is_recorded_trace(file) ? file : run(file);
        }
    }
    /// Trace of the same movements and messages, simulated again with other settings.
    TraceToView(const TraceToView& recorded, const std::vector<std::string>& set) {
        const RecordedDay day(recorded.path());
        if (const std::string doubt = day.starts_together(set); !doubt.empty()) notice(doubt);
        folder_ = std::make_unique<TemporaryDirectory>();
        path_ = folder_->path() + "/trace.mcap";
        Waiting waiting("replaying " + recorded.path());
        day.record(path_, set, [&](double share) {
            waiting.tell(share);
            return true;
        });
    }
    const std::string& path() const { return path_; }
    /// Sentences about what the input does not tell.
    const std::vector<std::string>& missing() const { return missing_; }

    /// Whether a file has the name of an ns-2 trace: NAME.tr, also packed.
    static bool is_ns2_name(const std::string& file) {
        const fs::path name = fs::path(file).filename();
        return name.extension() == ".tr" || name.stem().extension() == ".tr";
    }

  private:
    /// Whether a file is a page for a browser, such as `rovernet view -o` writes.
    static bool is_page(const std::string& file) {
        constexpr std::string_view doctype = "<!doctype html";
        if (!fs::is_regular_file(file)) return false;
        std::string begin(doctype.size(), ' ');
        std::ifstream(file).read(begin.data(), static_cast<std::streamsize>(begin.size()));
        return begin == doctype;
    }
    void read_ns2(const std::string& file, const ViewArguments& a) {
        folder_ = std::make_unique<TemporaryDirectory>();
        path_ = folder_->path() + "/trace.mcap";
        const Waiting waiting("reading " + file);
        missing_ = record_ns2_trace(file, path_, {.movements = a.movements});
    }
    std::string run(const std::string& file) {
        FileArguments given;
        given.file = file;
        given.options.set.emplace_back("trace.record=true");
        const Scenario scenario = scenario_of(given);
        check_viewable(scenario, file);
        folder_ = std::make_unique<TemporaryDirectory>();
        Waiting waiting("running " + file);
        run_scenario(scenario,
                     {.folder = folder_->path(), .speed = {}, .progress = [&](double share) {
                          waiting.tell(share);
                          return true;
                      }});
        return folder_->path() + "/trace.mcap";
    }

    std::unique_ptr<TemporaryDirectory> folder_;
    std::string path_;
    std::vector<std::string> missing_;
};

/// Choice of the content of view files. @param page  size of the page without them [bytes]
ViewChoice choice_of(const ViewArguments& a, std::size_t page) {
    ViewChoice choice;
    if (a.from) choice.frames.from = start_of_run + option_time("--from", *a.from);
    if (a.to) choice.frames.to = start_of_run + option_time("--to", *a.to);
    if (choice.frames.to < choice.frames.from) {
        throw InputError(Location{"--to " + *a.to, 0, 0, true},
                         "expected a time later than --from, " + *a.from);
    }
    if (a.no_payloads) choice.frames.payload_bytes = 0;
    choice.map = !a.no_map;
    choice.packs = a.out || a.listen;  // a browser on this machine reads plain columns sooner
    if (!a.limit) return choice;
    // In the page, the view file takes 4 bytes for 3.
    const std::size_t limit = option_size(*a.limit);
    choice.most_bytes = limit > page ? (limit - page) / 4 * 3 : 0;
    return choice;
}

ViewedRun read_view(const std::string& trace, const ViewChoice& choice) {
    ViewedRun run = [&] {
        const Waiting waiting("reading " + trace);
        return view_of_trace(trace, choice);
    }();
    tell_damage(trace, run.damage);
    for (const std::string& what : run.left_out) notice(what);
    return run;
}

/// Short name of a file that makes two runs of one scenario distinct: the folder of a trace.
std::string short_name(const std::string& file) {
    const fs::path path(file);
    return (path.filename() == "trace.mcap" && path.has_parent_path() ? path.parent_path() : path)
        .filename()
        .string();
}

/// Second run and its view file, for a comparison with the first run.
struct Beside {
    std::optional<TraceToView> trace;
    std::optional<ViewComparison> comparison;
    std::optional<ViewedRun> run;

    std::string path() const { return trace ? trace->path() : ""; }
    std::string bytes() const { return run ? run->bytes : ""; }
};

/// Second trace that the arguments name: another run, or the first under other settings; none
/// without such an argument.
std::optional<TraceToView> second_trace(const ViewArguments& a, const TraceToView& first) {
    if (a.other) return TraceToView(*a.other, a);
    if (a.with.empty()) return std::nullopt;
    std::vector<std::string> set;
    for (const std::string& each : a.with)
        for (std::string& one : assignments(each)) set.push_back(std::move(one));
    return TraceToView(first, set);
}

std::string scenario_name(const std::string& trace) {
    return ReplayedScenario(RecordedReader(trace).run(), trace).with({}).scenario.name;
}

/// Names of the runs in two traces, as the page shows them.
std::array<std::string, 2> names_of(const ViewArguments& a, const std::string& trace,
                                    const std::string& other) {
    const std::string first = scenario_name(trace), second = scenario_name(other);
    if (!a.with.empty())
        return {first, fmt::format("{}, with {}", second, fmt::join(a.with, "; "))};
    if (first != second) return {first, second};
    return {fmt::format("{} ({})", first, short_name(a.file)),
            fmt::format("{} ({})", second, short_name(*a.other))};
}

/// Number of objects in words: "1 robot", "2 robots".
std::string counted(std::size_t number, std::string_view what) {
    return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

void write_page(const ViewArguments& a, const ViewedRun& run, const Beside& beside) {
    const std::string page = page_with(run.bytes, beside.bytes());
    PartFile file(*a.out);
    file.write(page);
    file.give_name();
    const auto size = static_cast<double>(page.size()) / 1e3;
    if (beside.run) {
        const RunComparison& result = beside.comparison->result;
        fmt::print("{}: {}; A: {}, {}; B: {}, {}; {:.0f} kB\n", *a.out,
                   counted(run.robots, "robot"), counted(run.messages, "message"),
                   counted(run.frames, "frame"), counted(beside.run->messages, "message"),
                   counted(beside.run->frames, "frame"), size);
        fmt::print("deliveries: {} gained in B, {} lost in B, {} in both\n", result.gained,
                   result.lost, result.same);
    } else {
        fmt::print("{}: {}, {}, {}; {:.0f} kB\n", *a.out, counted(run.robots, "robot"),
                   counted(run.messages, "message"), counted(run.frames, "frame"), size);
    }
    if (!a.limit || page.size() <= option_size(*a.limit)) return;
    notice(fmt::format(
        "--limit {}: too small for the page, the robots and the messages; expected a larger size",
        *a.limit));
}

/// Serves the page until Ctrl-C.
void serve_page(const ViewArguments& a, const std::string& trace, ViewedRun run,
                const Beside& beside) {
    ViewerAnswers answers({trace, run.index},
                          {beside.path(), beside.run ? beside.run->index : nullptr});
    if (a.no_map) answers.hide_map();
    Address address = read_loopback(a.address);
    if (a.listen) address.host = read_host(*a.listen);
    ViewServer server(
        address, std::move(run.bytes),
        [&](std::string_view question) { return answers.answer(question); }, beside.bytes());
    const HeldStop until_told;
    fmt::print(
        "{} at {} until Ctrl-C\n",
        beside.run ? beside.comparison->names[0] + " and " + beside.comparison->names[1] : run.name,
        server.url());
    std::fflush(stdout);
    if (a.opens) open_in_browser(server.url());
    server.serve([] { return stops_asked() == 0; });
}

/// @throws CommandEnd for options that exclude each other
void check_options(const ViewArguments& a) {
    if (a.other && !a.with.empty()) {
        throw CommandEnd(usage,
                         fmt::format("view: found a second run, {}, and --with {}; expected only "
                                     "one of the two: --with makes the second run from the first",
                                     *a.other, a.with[0]));
    }
    if (a.out && (a.listen || a.address != ViewArguments().address)) {
        throw CommandEnd(usage, fmt::format("view: found -o and {}; expected only one of the two: "
                                            "-o writes the page to a file, without a server",
                                            a.listen ? "--listen" : "--address"));
    }
    const bool has_ns2 =
        TraceToView::is_ns2_name(a.file) || (a.other && TraceToView::is_ns2_name(*a.other));
    if (a.movements && !has_ns2) {
        throw CommandEnd(
            usage, fmt::format("view: --movements is for an ns-2 trace, such as run.tr; found {}",
                               a.file));
    }
}

}  // namespace

void view(const ViewArguments& a) {
    check_options(a);
    ViewChoice choice =
        choice_of(a, page_with("", a.other || !a.with.empty() ? "other" : "").size());
    const std::size_t most_bytes = choice.most_bytes;
    const TraceToView trace(a.file, a);
    choice.missing = trace.missing();
    Beside beside{.trace = second_trace(a, trace), .comparison = {}, .run = {}};
    if (beside.trace) {
        const Waiting waiting("comparing the runs");
        beside.comparison = {.names = names_of(a, trace.path(), beside.path()),
                             .result = compare_runs({trace.path(), a.file},
                                                    {beside.path(), a.other.value_or(a.file)},
                                                    {.is_replay = !a.other})};
        choice.most_bytes = most_bytes / 2;
    }
    ViewedRun run = read_view(trace.path(), choice);
    if (beside.trace) {
        ViewComparison& comparison = *beside.comparison;
        comparison.messages = run.message_names;
        choice.comparison = &comparison;
        choice.missing = beside.trace->missing();
        choice.most_bytes = most_bytes - std::min(most_bytes, run.bytes.size());
        beside.run = read_view(beside.path(), choice);
    }
    if (a.out) {
        write_page(a, run, beside);
        if (a.opens) open_in_browser(*a.out);
        return;
    }
    serve_page(a, trace.path(), std::move(run), beside);
}

void add_view(Command app) {
    const auto [view, a] = add_command(app, "view", "Show a run in a browser", cli::view);
    view.add_examples({"rovernet view examples/rescue/rescue.toml",
                       "rovernet view examples/rescue/rescue.toml -o rescue.html",
                       "rovernet run examples/patrol/patrol.toml --record",
                       "rovernet view runs/patrol-s3 -o patrol.html --from \"10 s\" --to \"20 s\"",
                       "rovernet view runs/patrol-s3 --with propagation.model=friis -o both.html"});
    view.add_option("RUN", a.file,
                    "folder of a run made with --record, its trace.mcap, an ns-2 trace, or a "
                    "scenario file, which is then run")
        .required();
    view.add_option("OTHER", a.other,
                    "second run with the same robots, shown on the right of the first run");
    view.add_option(
            "--with", a.with,
            "KEY=VALUE of a different radio or model (several are separated by \";\"): show a "
            "second run with this radio or model, in which robots move and send messages as in the "
            "first run")
        .one_word();
    view.add_option("--movements", a.movements, "for an ns-2 trace: movement file of its robots");
    view.add_option("-o,--output", a.out,
                    "instead of serving the page, write it to this file, which needs no server");
    view.add_flag("--open", a.opens, "open the page in a browser, by xdg-open");
    view.add_option(
            "--address", a.address,
            "address of this machine at which to serve the page; port 0 selects a free port")
        .shows_default();
    view.add_option("--listen", a.listen,
                    "serve the page to other machines, too, at this IP address of this machine "
                    "(0.0.0.0: at all addresses of this machine); browsers on other machines need "
                    "the token in the printed address");
    view.add_option("--from", a.from, "show only frames from this time of the run on");
    view.add_option("--to", a.to, "show only frames up to this time of the run");
    view.add_option(
        "--limit", a.limit,
        "largest size of the page, such as \"5 MB\"; later frames are left out if necessary");
    view.add_flag("--no-payloads", a.no_payloads, "leave out the contents of messages");
    view.add_flag("--no-map", a.no_map, "leave out walls, doors and stairs");
}

}  // namespace rovernet::cli
