// SPDX-License-Identifier: MIT
#pragma once

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace rovernet::bench {

/// Benchmarks by name and argument, and the least CPU time of each over its repetitions: what the
/// machine's other work adds to a time is never negative.
class Least : public benchmark::BenchmarkReporter {
  public:
    /// @param per  [-] pieces of work in an iteration: times are of one piece
    explicit Least(double per = 1) : per_(per) {}

    /// Adds a call: run() times `iterations` of `call` in each of three repetitions.
    static void add(const char* name, void (*call)(benchmark::State&), std::size_t argument,
                    int iterations) {
        benchmark::RegisterBenchmark(name, call)
            ->Arg(static_cast<std::int64_t>(argument))
            ->Iterations(iterations)
            ->Repetitions(3)
            ->Unit(benchmark::kNanosecond);
    }
    /// Runs what was added, in its order, or what the options of google-benchmark leave of it.
    /// False if the command line makes no sense.
    bool run(int argc, char** argv) {
        benchmark::Initialize(&argc, argv);
        if (benchmark::ReportUnrecognizedArguments(argc, argv)) return false;
        benchmark::RunSpecifiedBenchmarks(this);
        return true;
    }

    /// [ns]; 0 if it was not run.
    double ns(const std::string& name, std::size_t argument) const {
        const auto found = ns_.find({name, std::to_string(argument)});
        return found == ns_.end() ? 0 : found->second;
    }
    /// Ratio of its time to that of `base`.
    double times(const std::string& name, const std::string& base, std::size_t argument) const {
        return ns(name, argument) / ns(base, argument);
    }

    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration) continue;
            const auto least =
                ns_.try_emplace({run.run_name.function_name, run.run_name.args}, 1e300);
            least.first->second = std::min(least.first->second, run.GetAdjustedCPUTime() / per_);
        }
    }

  private:
    double per_;
    std::map<std::pair<std::string, std::string>, double> ns_;
};

/// Prints the heads of a table's columns, each `width` wide.
inline void print_heads(std::initializer_list<const char*> names, int width) {
    for (const char* name : names) fmt::print("{:>{}}", name, width);
}

}  // namespace rovernet::bench
