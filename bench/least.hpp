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

/// Least CPU time of each benchmark over its repetitions, by name and argument. The least time is
/// used because other work of the machine can only increase a time.
class Least : public benchmark::BenchmarkReporter {
  public:
    /// @param per  [-] number of operations in an iteration; times are for one operation
    explicit Least(double per = 1) : per_(per) {}

    /// Adds a benchmark: run() measures `iterations` iterations of `call` in each of three
    /// repetitions.
    static void add(const char* name, void (*call)(benchmark::State&), std::size_t argument,
                    int iterations) {
        benchmark::RegisterBenchmark(name, call)
            ->Arg(static_cast<std::int64_t>(argument))
            ->Iterations(iterations)
            ->Repetitions(3)
            ->Unit(benchmark::kNanosecond);
    }
    /// Runs the added benchmarks in order, or those that the options of google-benchmark select.
    /// @return false if the command line is invalid
    bool run(int argc, char** argv) {
        benchmark::Initialize(&argc, argv);
        if (benchmark::ReportUnrecognizedArguments(argc, argv)) return false;
        benchmark::RunSpecifiedBenchmarks(this);
        return true;
    }

    /// Least CPU time [ns] of a benchmark; 0 if it was not run.
    double ns(const std::string& name, std::size_t argument) const {
        const auto found = ns_.find({name, std::to_string(argument)});
        return found == ns_.end() ? 0 : found->second;
    }
    /// Ratio [-] of the time of the benchmark `name` to the time of `base`.
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

/// Prints the names of a table's columns, each padded to `width` characters.
inline void print_heads(std::initializer_list<const char*> names, int width) {
    for (const char* name : names) fmt::print("{:>{}}", name, width);
}

}  // namespace rovernet::bench
