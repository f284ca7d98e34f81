// SPDX-License-Identifier: MIT
#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/options.hpp"
#include "cli/terminal/stop.hpp"
#include "cli/terminal/waiting.hpp"
#include "cli/traces/trace_commands.hpp"
#include "cli/traces/trace_notices.hpp"
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

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <optional>
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
    explicit TraceToView(const std::string& file) {
        if (fs::is_directory(file)) {
            path_ = (fs::path(file) / "trace.mcap").string();
            if (fs::exists(path_)) return;
            throw InputError(Location{file},
                             "no trace.mcap in this folder; make one with `rovernet run FILE "
                             "--record`, or name a scenario, which is run first");
        }
        if (fs::path(file).extension() == ".tr") {
            throw InputError(Location{file},
                             "an ns-2 trace has neither map nor outcomes of receptions; expected "
                             "a trace of `rovernet run FILE --record`, or a scenario");
        }
        path_ = is_recorded_trace(file) ? file : run(file);
    }
    const std::string& path() const { return path_; }

  private:
    std::string run(const std::string& file) {
        FileArguments given;
        given.file = file;
        given.options.set.emplace_back("trace.record=true");
        const Scenario scenario = scenario_of(given);
        folder_.emplace();
        Waiting waiting("running " + file);
        run_scenario(scenario,
                     {.folder = folder_->path(), .speed = {}, .progress = [&](double share) {
                          waiting.tell(share);
                          return true;
                      }});
        return folder_->path() + "/trace.mcap";
    }

    std::optional<TemporaryDirectory> folder_;
    std::string path_;
};

ViewChoice choice_of(const ViewArguments& a) {
    ViewChoice choice;
    if (a.from) choice.frames.from = start_of_run + option_time("--from", *a.from);
    if (a.to) choice.frames.to = start_of_run + option_time("--to", *a.to);
    if (choice.frames.to < choice.frames.from) {
        throw InputError(Location{"--to " + *a.to, 0, 0, true},
                         "expected a time after that of --from, " + *a.from);
    }
    if (a.no_payloads) choice.frames.payload_bytes = 0;
    choice.map = !a.no_map;
    if (!a.limit) return choice;
    // In the page, the view file takes 4 bytes for 3.
    const std::size_t page = page_with("").size(), limit = option_size(*a.limit);
    choice.most_bytes = limit > page ? (limit - page) / 4 * 3 : 0;
    return choice;
}

}  // namespace

namespace {

void write_page(const ViewArguments& a, const ViewedRun& run) {
    const std::string page = page_with(run.bytes);
    PartFile file(*a.out);
    file.write(page);
    file.give_name();
    fmt::print("{}: {} robots, {} messages, {} frames; {:.0f} kB\n", *a.out, run.robots,
               run.messages, run.frames, static_cast<double>(page.size()) / 1e3);
    if (!a.limit || page.size() <= option_size(*a.limit)) return;
    notice(fmt::format("--limit {}: the page, the robots and the messages take more than that",
                       *a.limit));
}

/// Serves the page until Ctrl-C.
void serve_page(const ViewArguments& a, const std::string& trace, ViewedRun run) {
    ViewerAnswers answers(trace);
    Address address = read_loopback(a.address);
    if (a.listen) address.host = read_host(*a.listen);
    ViewServer server(address, std::move(run.bytes),
                      [&](std::string_view question) { return answers.answer(question); });
    fmt::print("{} at {} until Ctrl-C\n", run.name, server.url());
    std::fflush(stdout);
    const HeldStop until_told;
    server.serve([] { return stops_asked() == 0; });
}

}  // namespace

void view(const ViewArguments& a) {
    const ViewChoice choice = choice_of(a);
    const TraceToView trace(a.file);
    ViewedRun run = [&] {
        const Waiting waiting("reading " + trace.path());
        return view_of_trace(trace.path(), choice);
    }();
    tell_damage(trace.path(), run.damage);
    for (const std::string& what : run.left_out) notice(what);
    if (a.out) return write_page(a, run);
    serve_page(a, trace.path(), std::move(run));
}

void add_view(Command app) {
    const auto [view, a] = add_command(app, "view", "Show a run in a browser", cli::view);
    view.add_examples(
        {"rovernet view examples/rescue/rescue.toml",
         "rovernet view examples/rescue/rescue.toml -o rescue.html",
         "rovernet run examples/patrol/patrol.toml --record",
         "rovernet view runs/patrol-s3 -o patrol.html --from \"10 s\" --to \"20 s\""});
    view.add_option("RUN", a.file,
                    "folder of a run with --record, its trace.mcap, or a scenario, which is run")
        .required();
    view.add_option("-o,--output", a.out,
                    "write the page as one file, which needs no network, "
                    "instead of serving it");
    view.add_option("--address", a.address, "address of this machine to serve at; port 0: any")
        .shows_default();
    view.add_option(
        "--listen", a.listen,
        "IP address of this machine by which others reach it, or 0.0.0.0: they need the "
        "token in the address that is printed");
    view.add_option("--from", a.from, "time of the first frame");
    view.add_option("--to", a.to, "time of the last frame");
    view.add_option("--limit", a.limit,
                    "largest size of the page, such as \"5 MB\": later frames "
                    "are left out");
    view.add_flag("--no-payloads", a.no_payloads, "leave out the contents of messages");
    view.add_flag("--no-map", a.no_map, "leave out walls, doors and stairs");
}

}  // namespace rovernet::cli
