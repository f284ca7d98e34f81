// SPDX-License-Identifier: MIT
#include "study/explain.hpp"

#include "scenario/document/toml.hpp"
#include "study/command_words.hpp"
#include "study/stored_row.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

namespace rovernet {
namespace {

namespace fs = std::filesystem;

/// Words that the sweep was given behind its file, such as --set and --seed with theirs.
std::vector<std::string> options_of(const Store& store) {
    std::vector<std::string> words;
    const Value options = store.document("options");
    if (std::holds_alternative<std::monostate>(options.data)) return words;
    const auto refuse = [&](const Value& found, const char* expected) {
        throw damaged_store(store.path(), fmt::format("table \"study\", row with key \"options\", "
                                                      "column \"value\": found {}, expected {}",
                                                      found.description(), expected));
    };
    if (!options.array()) refuse(options, "a list");
    for (const Value& word : *options.array()) {
        if (!word.string()) refuse(word, "texts in the list");
        words.push_back(*word.string());
    }
    return words;
}

/// The replay that makes a row of a store of store_days().
std::string replay_command(const Store& store, const std::string& replay,
                           const StoredPoint& point) {
    const Value* radio = point.settings.find("radio");
    const std::string name = radio ? plain_text(*radio) : "";
    const bool is_with = name.find('=') != name.npos && name != store.property("first");
    if (is_with) return replay + " --with " + shell_word(name);
    const bool has_options = replay.find(" --") != replay.npos;  // they do not go with --verify
    return has_options ? replay : replay + " --verify";
}

}  // namespace

std::string run_command(const Store& store, const StoredPoint& point, std::uint32_t replication) {
    const std::string replay = store.property("replay");
    if (!replay.empty()) return replay_command(store, replay, point);
    const fs::path folder = fs::path(store.path()).parent_path();
    const fs::path file = folder / store.property("file");
    std::string command = "rovernet run " + shell_word(fs::proximate(file).string());
    for (const std::string& word : options_of(store)) command += " " + shell_word(word);
    for (const Entry& setting : point.settings.entries) {
        command += " --set " + shell_word(setting.key + "=" + to_toml(setting.value));
    }
    return command + fmt::format(" --replication {}", replication);
}

FoundRun find_run(const Store& store, const std::string& name) {
    std::vector<StoredRun> found;
    for (StoredRun& run : store.runs()) {
        const std::string place = fmt::format("{}/{}", run.point, run.replication);
        if (place == name || (name.find('/') == std::string::npos && run.id.starts_with(name))) {
            found.push_back(std::move(run));
        }
    }
    if (found.size() != 1) {
        throw std::invalid_argument(
            fmt::format("{} \"{}\"; expected POINT/REPLICATION such as 0/3, or the beginning of a "
                        "run's id; rovernet results STUDY --csv --provenance lists the ids",
                        found.empty() ? "there is no run" : "more than one run begins with", name));
    }
    FoundRun result{.run = std::move(found.front()), .point = {}};
    for (StoredPoint& point : store.points()) {
        if (point.number == result.run.point) result.point = std::move(point);
    }
    for (const std::string& metric : store.metric_names()) {
        for (const StoredValue& v : store.values(metric, result.run.point)) {
            if (v.replication != result.run.replication) continue;
            result.run.measurement.metrics.push_back({metric, v.value});
        }
    }
    return result;
}

}  // namespace rovernet
