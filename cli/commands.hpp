// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/flood_bench.hpp"
#include "scenario/scenario.hpp"
#include "study/advise_candidates.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

/// The commands behind their options: each prints its result to standard output and throws what
/// goes wrong.
namespace rovernet::cli {

/// Exit codes of commands.
enum ExitCode {
    ok = 0,
    failed = 1,
    usage = 2,
    bad_input = 3,
    partly_failed = 4,
    interrupted = 130
};

/// Ends a command that has done a part of its work, with its code and what to say of it.
class CommandEnd : public std::runtime_error {
  public:
    CommandEnd(ExitCode code, const std::string& message)
        : std::runtime_error(message), code_(code) {}
    ExitCode code() const { return code_; }

  private:
    ExitCode code_;
};

/// FILE and what may be said over it: a scenario, a Stage world or a movement file.
struct FileArguments {
    std::string file;
    std::optional<std::uint64_t> seed, replication;
    ScenarioOptions options;
};
/// The options over the file, those for the seed and the replication among them.
ScenarioOptions options_of(const FileArguments& arguments);
/// Reads FILE, and says its notices.
Scenario scenario_of(const FileArguments& arguments);

/// The time of an option --at; one after the end of the run is told.
Time time_in(const Scenario& scenario, const std::string& at);

struct RunArguments : FileArguments {
    std::optional<std::string> out;
    std::optional<double> speed;
    bool json = false;
    bool print_scenario = false;
    bool record = false;
};
void run(const RunArguments& arguments);

struct LossArguments {
    std::string model;
    std::vector<std::string> parameters;
    std::string frequency = "2450 MHz";
    std::vector<std::string> distances;
    std::vector<std::string> heights;
    std::optional<std::string> wall;
    bool json = false;
};
void loss(const LossArguments& arguments);

struct MaterialArguments {
    std::string material, thickness;
    std::string frequency = "2450 MHz";
    double angle = 0;  ///< to the normal [degrees]
    bool json = false;
};
void material(const MaterialArguments& arguments);

struct LinkArguments : FileArguments {
    std::string from, to;
    std::string at = "0 s";
    bool json = false;
};
void link(const LinkArguments& arguments);

struct LinksArguments : FileArguments {
    std::string at = "0 s";
    std::optional<std::string> robot;
    bool history = false;
    bool json = false;
};
void links(const LinksArguments& arguments);

struct SceneArguments : FileArguments {
    std::string at = "0 s";
    std::optional<std::string> size;  ///< size of a bare picture, WIDTHxHEIGHT in metres
    bool json = false;
};
void scene(const SceneArguments& arguments);

struct BenchArguments {
    FloodBench bench;
    std::string reception = "threshold", access = "none", mobility = "static";
    bool json = false;
};
void bench_flood(const BenchArguments& arguments);

struct WhereArguments : FileArguments {
    std::vector<std::string> at;
    bool json = false;
};
void where(const WhereArguments& arguments);

struct DrawArguments : FileArguments {
    std::string at = "0 s";
    std::optional<std::string> coverage;
    bool links = false;
    bool trails = false;
    bool axes = false;
    int width = 1200;
    double font_size = 12;
    std::string out;
};
void draw(const DrawArguments& arguments);

struct ConvertArguments : FileArguments {
    std::string out;
};
void convert_movements(const ConvertArguments& arguments);

/// A study, and how it is run.
struct StudyArguments : FileArguments {
    std::optional<std::string> store;
    std::optional<std::uint64_t> replications, max_replications;
    std::optional<double> precision;
    std::optional<std::string> interval;
    std::uint64_t workers = 0;  ///< 0: as many as processors
    std::optional<std::string> timeout, memory;
    bool fail_fast = false, json = false;
    std::string command;  ///< command as it was typed
};

struct SweepArguments : StudyArguments {
    std::optional<std::uint64_t> shard;
    std::uint64_t chunk = 50;
    std::optional<std::string> except;  ///< store whose finished runs are not made
    std::vector<std::string> merge;     ///< stores
    std::string executor = "local", sbatch;
    bool dry_run = false, resume = false, fresh = false, yes = false;
};
void sweep(const SweepArguments& arguments);

struct CompareArguments : StudyArguments {
    std::vector<std::string> models;
    std::string metric, baseline;
    std::optional<double> margin;
    std::optional<std::string> picture;
};
void compare(const CompareArguments& arguments);

struct AdviseArguments : StudyArguments {
    std::string metric = "delivery_ratio", criterion = "mean";
    std::optional<double> tolerance;
    CandidateQuestion question;
    bool no_cost = false;
    std::optional<std::string> picture;
};
void advise(const AdviseArguments& arguments);

struct FitArguments : FileArguments {
    std::string to;
    std::optional<std::string> links, check, floor;
    bool json = false;
};
void fit(const FitArguments& arguments);

struct ProbeArguments : FileArguments {
    std::size_t links = 1000, top = 10;
    bool no_messages = false;
    bool json = false;
};
void probe(const ProbeArguments& arguments);

struct ResultsArguments {
    std::string store;
    std::vector<std::string> metrics, group_by, where;
    std::optional<double> confidence, quantile;
    std::optional<std::string> interval;
    std::optional<std::string> sql;
    bool csv = false, json = false, provenance = false, failures = false, common = false;
};
void results(const ResultsArguments& arguments);

struct PlotArguments {
    std::string store, x, y, by, kind, out;
    std::vector<std::string> where;
    std::optional<double> confidence, quantile;
    std::optional<std::string> interval;
    bool log_x = false, log_y = false, common = false;
    int width = 672;
    double font_size = 12;
};
void plot(const PlotArguments& arguments);

struct ExplainArguments {
    std::string store, run;
    bool json = false;
};
void explain(const ExplainArguments& arguments);

struct ValidateArguments {
    std::string out;
    std::optional<std::string> field;  ///< folder of measurements
    bool quick = false;
};
void validate(const ValidateArguments& arguments);

struct TraceStatsArguments {
    std::string file;
    std::string by;  ///< robot, flow or second; empty: the totals alone
    bool strict = false, csv = false, json = false;
};
void trace_stats(const TraceStatsArguments& arguments);

struct TraceConvertArguments {
    std::string in, out, to;
    bool mac = false, strict = false;
};
void trace_convert(const TraceConvertArguments& arguments);

struct TraceCutArguments {
    std::string in, out;
    std::optional<std::string> from, to;
    std::optional<std::uint32_t> robot;
    std::optional<std::uint64_t> message;
    bool strict = false;
};
void trace_cut(const TraceCutArguments& arguments);

struct TraceDiffArguments {
    std::string a, b;
    std::string time_tolerance = "0 s";
    bool strict = false;
};
void trace_diff(const TraceDiffArguments& arguments);

struct TraceFollowArguments {
    std::string file;
    std::uint64_t message = 0;
    std::optional<std::string> robot;
    bool strict = false, json = false;
};
void trace_follow(const TraceFollowArguments& arguments);

struct ReplayArguments {
    std::string file;
    bool verify = false;
    std::vector<std::string> with;   ///< radios, each "path=value" or several of them after ";"
    std::optional<std::string> map;  ///< map of these
    std::optional<double> speed;
    // Of an ns-2 trace: its radio, as one of `with`, and "flood" or "direct".
    std::optional<std::string> as, routing, movements;
    std::optional<std::string> store;
    bool json = false;
};
void replay(const ReplayArguments& arguments);

/// Arguments of a command whose only option is --json.
struct PrintArguments {
    bool json = false;
};
void models(const PrintArguments& arguments);
void print_version(const PrintArguments& arguments);

}  // namespace rovernet::cli
