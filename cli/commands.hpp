// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// The commands behind their options: each prints its result to standard output and throws what
/// goes wrong.
namespace rovernet::cli {

/// Set by Ctrl-C.
extern volatile std::sig_atomic_t stop_requested;

struct RunArguments {
    std::string file;
    std::optional<std::uint64_t> seed, replication;
    std::vector<std::string> set;
    std::optional<std::string> out;
    std::optional<double> speed;
    bool json = false;
    bool print_scenario = false;
};
void run(const RunArguments& arguments);

struct LossArguments {
    std::string model;
    std::vector<std::string> parameters;
    std::string frequency = "2450 MHz";
    std::vector<std::string> distances;
    std::optional<std::string> wall;
    bool json = false;
};
void loss(const LossArguments& arguments);

struct LinkArguments {
    std::string file, from, to;
    std::string at = "0 s";
    std::optional<std::uint64_t> seed;
    std::vector<std::string> set;
    bool json = false;
};
void link(const LinkArguments& arguments);

void models(bool json);
void trace_stats(const std::string& file, bool json);
void print_version(bool json);

}  // namespace rovernet::cli
