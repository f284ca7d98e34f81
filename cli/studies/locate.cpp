// SPDX-License-Identifier: MIT
#include "study/calibration/locate.hpp"

#include "cli/terminal/options.hpp"
#include "cli/terminal/text_table.hpp"
#include "experiment/reports/loss_table.hpp"
#include "files/input_file.hpp"
#include "scenario/document/json.hpp"
#include "scenario/tables/read_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace rovernet::cli {
namespace {

struct LocateArguments : FileArguments {
    std::vector<std::string> anchors, at;
    std::optional<std::string> links, sigma;
    std::string margin = "0 m";
    bool unknown_power = false;
    bool json = false;
};

LocateQuestion question_of(const LocateArguments& a) {
    LocateQuestion question;
    question.knows_power = !a.unknown_power;
    question.margin = option_length("--margin", a.margin);
    const auto refuse = [](const std::string& typed, const char* expected) {
        throw InputError(Location{typed, 0, 0, true}, expected);
    };
    if (question.margin < Meters{0}) refuse("--margin " + a.margin, "expected a length >= 0 m");
    if (!a.sigma) return question;
    Value value{*a.sigma};
    value.where = {"--sigma " + *a.sigma, 0, 0, true};
    read_value(value, "sigma", question.sigma.emplace());
    if (!(*question.sigma > Db{0})) refuse("--sigma " + *a.sigma, "expected more than 0 dB");
    return question;
}

/// Scenario of a file, or of the run whose folder it is.
Scenario scenario_to_locate(LocateArguments a) {
    if (input_kind(a.file) == InputKind::folder)
        a.file = (std::filesystem::path(a.file) / "scenario.toml").string();
    return scenario_of(a);
}

/// Every tenth of the run if no time is given.
std::vector<Time> times_of(const Scenario& scenario, const std::vector<std::string>& given) {
    std::vector<Time> times;
    for (const std::string& text : given) times.push_back(time_in(scenario, text));
    constexpr int parts = 10;
    for (int i = 0; given.empty() && i <= parts; ++i)
        times.push_back(start_of_run + i * (scenario.scenario.duration / parts));
    std::sort(times.begin(), times.end());
    return times;
}

Located locate(const LocateArguments& a) {
    const LocateQuestion question = question_of(a);
    const Scenario scenario = scenario_to_locate(a);
    if (a.links) return locate_levels(*a.links, scenario, question);
    if (a.anchors.empty())
        throw CommandEnd(usage,
                         "locate: expected --anchors, names of the robots whose positions are "
                         "known, or --links, a file of measured levels");
    return locate_robots(scenario, a.anchors, times_of(scenario, a.at), question);
}

Table as_table(const Fix& fix) {
    Table table;
    table.set("name", fix.name);
    table.set("t_s", fix.at ? Value(seconds(*fix.at)) : Value());
    table.set("anchors", std::uint64_t{fix.anchors});
    table.set("x_m", fix.found.x);
    table.set("y_m", fix.found.y);
    table.set("true_x_m", fix.truth ? Value(fix.truth->x) : Value());
    table.set("true_y_m", fix.truth ? Value(fix.truth->y) : Value());
    const auto error = fix.error();
    table.set("error_m", error ? Value(*error) : Value());
    table.set("bound_m", fix.bound ? Value(fix.bound->value) : Value());
    return table;
}

Table as_table(const Located& located) {
    Table table;
    Array fixes;
    for (const Fix& fix : located.fixes) fixes.push_back(as_table(fix));
    table.set("sigma_db", located.sigma.value);
    table.set("fixes", std::move(fixes));
    table.set("too_few_anchors", std::uint64_t{located.too_few});
    const auto errors = located.errors();
    table.set("rms_error_m", errors ? Value(errors->rms) : Value());
    table.set("rms_bound_m", errors ? Value(errors->bound) : Value());
    return table;
}

void print(const Located& located) {
    TextTable table({"name", "time", "anchors", "found", "truth", "error", "bound"});
    const auto place = [](Vec3 p) { return fmt::format("{:.2f}, {:.2f}", p.x, p.y); };
    const auto metres = [](const auto& value) { return fmt::format("{:.2f} m", value); };
    for (const Fix& fix : located.fixes) {
        const auto error = fix.error();
        table.add({fix.name, fix.at ? fmt::format("{:g} s", seconds(*fix.at)) : "-",
                   fmt::format("{}", fix.anchors), place(fix.found),
                   fix.truth ? place(*fix.truth) : "-", error ? metres(*error) : "-",
                   fix.bound ? metres(fix.bound->value) : "none"});
    }
    if (!located.fixes.empty()) fmt::print("{}\n", table.text());
    if (const auto errors = located.errors()) {
        fmt::print(
            "rms error {:.2f} m; with level errors of {:g} dB, the rms error of an unbiased "
            "estimate of these positions is at least {:.2f} m\n",
            errors->rms, located.sigma.value, errors->bound);
    }
    if (located.too_few > 0) {
        fmt::print("{} positions were not estimated, because fewer than {} anchors were heard\n",
                   located.too_few, fewest_anchors);
    }
}

void locate_command(const LocateArguments& a) {
    const Located located = locate(a);
    if (a.json) {
        fmt::print("{}", to_json(as_table(located)));
    } else {
        print(located);
    }
}

}  // namespace

void add_locate(Command app) {
    const auto [locate, a] = add_command(app, "locate",
                                         "Estimate the positions of robots from signal levels of "
                                         "anchors (robots at known positions)",
                                         locate_command);
    locate.add_examples(
        {"rovernet locate examples/rescue/rescue.toml --anchors A,B,C --sigma \"4 dB\"",
         "rovernet locate office.toml --links levels.csv --sigma \"4 dB\""});
    add_file(locate, a, "scenario (.toml), Stage world (.world), movement file or folder of a run");
    const Option anchors =
        locate.add_option("--anchors", a.anchors, "names of the robots whose positions are known")
            .delimiter(',');
    const Option at =
        locate
            .add_option("--at", a.at,
                        "simulated times, such as 10s,31.25s (default: every tenth of the run)")
            .delimiter(',');
    locate
        .add_option("--links", a.links,
                    "CSV file of measured levels: columns of the anchors (from_x_m, from_y_m) and "
                    "of the receivers (to_x_m, to_y_m, or place); see rovernet fit")
        .excludes(anchors)
        .excludes(at);
    locate.add_option("--sigma", a.sigma,
                      "standard deviation of the levels, such as \"4 dB\" (default: sigma of the "
                      "scenario's shadowing)");
    locate.add_flag(
        "--unknown-power", a.unknown_power,
        "treat the transmit power of the anchors as unknown, but equal for all anchors");
    locate
        .add_option(
            "--margin", a.margin,
            "on an open field: the search covers the smallest rectangle around the anchors, "
            "widened by this length on each side")
        .shows_default();
    add_json(locate, a.json);
}

}  // namespace rovernet::cli
