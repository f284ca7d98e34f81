// SPDX-License-Identifier: MIT
#pragma once

#include "cli/terminal/command_line.hpp"
#include "cli/terminal/commands.hpp"
#include "study/validation/flood_bench.hpp"

#include <optional>
#include <string>
#include <vector>

/// Commands that need no scenario: models, loss, material, validate, bench, help, version.
namespace rovernet::cli {

struct LossArguments {
    std::vector<std::string> models;  ///< names, each before its parameters KEY=VALUE
    std::string frequency = "2450 MHz";
    std::vector<std::string> distances;
    std::vector<std::string> heights;
    std::optional<std::string> wall;
    std::string out;  ///< picture to write; empty: none
    bool json = false;
};
void loss(const LossArguments& arguments);

struct MaterialArguments {
    std::string material, thickness;
    std::string frequency = "2450 MHz";
    double angle = 0;  ///< angle of incidence of the wave, from the wall's normal [degrees]
    bool json = false;
};
void material(const MaterialArguments& arguments);

struct BenchArguments {
    FloodBench bench;
    std::string reception = "threshold", access = "none", mobility = "static";
    std::string suppression = "none";
    bool json = false;
};
void bench_flood(const BenchArguments& arguments);

struct ValidateArguments {
    std::string out;
    std::optional<std::string> field;  ///< folder with received levels [dBm] measured in buildings
    bool quick = false;
};
void validate(const ValidateArguments& arguments);

struct HelpArguments {
    /// Name of a page without its ending, or words to search for; empty: list of pages.
    std::vector<std::string> words;
    std::optional<Command> program;  ///< for the names of the commands
};
void help(const HelpArguments& arguments);

struct ModelsArguments {
    std::string name;  ///< model to print; empty: all
    bool json = false;
};
void models(const ModelsArguments& arguments);

/// Arguments of a command whose only option is --json.
struct PrintArguments {
    bool json = false;
};
void print_schema(const PrintArguments& arguments);
void print_version(const PrintArguments& arguments);

}  // namespace rovernet::cli
