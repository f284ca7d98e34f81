// SPDX-License-Identifier: MIT
#include "cli/terminal/options.hpp"

#include "cli/terminal/manual.hpp"
#include "cli/terminal/stop.hpp"
#include "experiment/version.hpp"
#include "files/kept_inputs.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <string_view>

namespace rovernet::cli {
namespace {

/// The number that is the whole text.
template <class T>
std::optional<T> number_in(std::string_view text) {
    T v{};
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, v);
    if (error != std::errc{} || rest != end) return std::nullopt;
    return v;
}

/// Accepts what `is_good` accepts.
template <class T>
Check number_check(const char* expected, const char* kind, bool (*is_good)(T)) {
    return {kind, [=](const std::string& text) -> std::string {
                const auto v = number_in<T>(text);
                if (v && is_good(*v)) return "";
                return fmt::format("found \"{}\"; expected {}", text, expected);
            }};
}

}  // namespace

Check above_zero() {
    return number_check<double>("a number > 0", "POSITIVE",
                                [](double v) { return std::isfinite(v) && v > 0; });
}

Check speed_of_time() {
    constexpr double slowest = 1e-6, fastest = 1e9;
    return number_check<double>("a speed from 1e-6 to 1e9 (1: real time)", "SPEED",
                                [](double v) { return v >= slowest && v <= fastest; });
}

Check not_negative() {
    return number_check<double>("a number >= 0", "NONNEGATIVE",
                                [](double v) { return std::isfinite(v) && v >= 0; });
}

Check below_90_degrees() {
    return number_check<double>("an angle to the normal from 0 to below 90 degrees", "DEGREES",
                                [](double v) { return v >= 0 && v < 90; });
}

Check whole_number() {
    return number_check<std::int64_t>("a whole number >= 0, below 2^63", "",
                                      [](std::int64_t v) { return v >= 0; });
}

void print_completion(const ManualArguments& a) {
    fmt::print("{}", completion_script(a.program->text(), a.shell));
}

void print_man_page(const ManualArguments& a) { fmt::print("{}", man_page(a.program->text())); }

int run_program(int argc, char** argv, const std::function<void(Command program)>& declare) {
    end_on_signals();
    keep_inputs();
    std::signal(SIGPIPE, SIG_IGN);
    return run_command_line(
        argc, argv, "rovernet",
        "rovernet: discrete-event simulator of wireless networks of moving robots",
        std::string(version()), declare);
}

void add_verbosity(Command command) {
    Option quiet = command.add_flag(
        "-q,--quiet", [] { set_verbosity(Verbosity::errors); },
        "print results and errors only: no notices, no progress");
    command
        .add_flag(
            "-v,--verbose", [] { set_verbosity(Verbosity::everything); },
            "also print a summary of the scenario, and how long each step of the command took")
        .excludes(quiet);
}

void add_study_file(Command command, FileArguments& a, const char* what) {
    command.add_option("FILE", a.file, what).required();
    command.add_option("--seed", a.seed, "seed of all random draws (default: [scenario] seed)")
        .check(whole_number());
    command
        .add_option("--set", a.options.set,
                    "KEY=VALUE: set a key of the scenario, such as radio.power=\"15 dBm\"")
        .one_word();
    command
        .add_option("--world-path", a.options.world_path,
                    "folder to search for includes and bitmaps of a Stage world")
        .one_word();
    command
        .add_option("--bitmap", a.options.bitmaps,
                    "OLD=NEW: read the bitmap file NEW wherever a Stage world names OLD")
        .one_word();
    command.add_flag("--lenient", a.options.lenient,
                     "ignore missing includes and bitmaps of a Stage world");
}

void add_file(Command command, FileArguments& a, const char* what) {
    add_study_file(command, a, what);
    command
        .add_option("--replication", a.replication,
                    "number of the replication (independent repetition), from 0 (default: "
                    "[scenario] replication)")
        .check(whole_number());
}

void add_json(Command command, bool& json) {
    command.add_flag("--json", json, "print the result as one JSON document");
}

void add_interval(Command command, std::optional<std::string>& interval) {
    command
        .add_option("--interval", interval,
                    "method of the confidence intervals of means: t (Student), betting or star "
                    "(STaR-Bets). Default: t for unbounded metrics; star for bounded ones, or "
                    "betting if the study uses --precision")
        .one_of({"t", "betting", "star"});
}

}  // namespace rovernet::cli
