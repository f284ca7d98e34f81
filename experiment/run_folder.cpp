// SPDX-License-Identifier: MIT
#include "experiment/run_folder.hpp"

#include "scenario/document/toml.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <string_view>

namespace rovernet {
namespace {

using Settings = std::map<std::string, std::string>;  // path -> text of the value

void flatten(const Value& value, const std::string& path, Settings& out) {
    const Table* table = value.table();
    if (!table) {
        out[path] = plain_text(value);
        return;
    }
    for (const Entry& entry : table->entries) {
        flatten(entry.value, path.empty() ? entry.key : path + "." + entry.key, out);
    }
}

/// Settings that the folder's name has to say: each once, and not what it says anyhow.
Settings settings_of(const std::vector<std::string>& set) {
    Value document{Table{}};
    for (const std::string& option : set) set_option(document, option, "--set " + option);
    Settings settings;
    flatten(document, "", settings);
    for (const char* key : {"scenario.name", "scenario.seed", "scenario.replication"}) {
        settings.erase(key);
    }
    return settings;
}

/// "20dBm" for "20 dBm", other texts as they are.
std::string shortened(const std::string& text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const auto blank = static_cast<std::size_t>(end - text.data());
    const bool quantity =
        error == std::errc{} && text.find(' ') == blank && text.find(' ', blank + 1) == text.npos;
    return quantity ? text.substr(0, blank) + text.substr(blank + 1) : text;
}

bool is_plain(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("._=+-").find(c) != std::string_view::npos;
}

std::string name_of(const Settings& settings) {
    constexpr std::size_t longest = 80;
    std::string text, name;
    for (const auto& [path, value] : settings) {
        text += fmt::format("{}={}\n", path, value);
        name += fmt::format("-{}={}", path, shortened(value));
    }
    const bool plain = std::all_of(name.begin(), name.end(), is_plain);
    if (plain && name.size() <= longest) return name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !is_plain(c); }, '_');
    const auto digest = static_cast<std::uint32_t>(XXH64(text.data(), text.size(), 0));
    return fmt::format("{}-{:08x}", name.substr(0, longest), digest);
}

}  // namespace

std::string run_folder(const Scenario& scenario, const std::vector<std::string>& set) {
    const auto& s = scenario.scenario;
    const std::string replication = s.replication == 0 ? "" : fmt::format("-r{}", s.replication);
    return fmt::format("runs/{}-s{}{}{}", s.name, s.seed, replication, name_of(settings_of(set)));
}

Table document_in(const std::string& folder, Scenario scenario) {
    namespace fs = std::filesystem;
    const auto rename = [&](std::string& path) {
        path = fs::proximate(fs::path(scenario.file).parent_path() / path, folder).string();
    };
    auto& scene = scenario.scene;
    for (auto* path : {&scene.map, &scene.world, &scenario.movement.file}) {
        if (*path) rename(**path);
    }
    for (FloorTable& floor : scene.floors) rename(floor.map);
    if (scene.world_path) std::for_each(scene.world_path->begin(), scene.world_path->end(), rename);
    return to_document(scenario);
}

}  // namespace rovernet
