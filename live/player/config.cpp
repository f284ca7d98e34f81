// SPDX-License-Identifier: MIT
#include "live/player/config.hpp"

#include "scene/stage/worldfile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>

namespace rovernet {
namespace {

/// Address of a device: KEY:HOST:PORT:INTERFACE:INDEX, of which the first ones may be missing.
struct ConfiguredDevice {
    std::string interface;
    std::uint32_t port = 6665, index = 0;
};

std::optional<std::uint32_t> number_of(std::string_view text) {
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_whole = error == std::errc{} && end == text.data() + text.size();
    return is_whole ? std::optional(number) : std::nullopt;
}

ConfiguredDevice read_device(const std::string& text, const Location& where) {
    constexpr std::uint32_t last_port = 65'535;
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(':', begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    const std::size_t n = parts.size();
    const auto index = number_of(parts.back());
    const bool has_port = n >= 3 && !parts[n - 3].empty();
    const auto port = has_port ? number_of(parts[n - 3]) : 6665;
    if (n < 2 || n > 5 || !index || !port || *port == 0 || *port > last_port) {
        throw InputError(where,
                         fmt::format("provides: found \"{}\"; expected PORT:INTERFACE:INDEX, such "
                                     "as \"6665:position2d:0\"",
                                     text));
    }
    return {parts[n - 2], *port, *index};
}

/// Where a driver of Stage provides a robot; nothing if it provides none.
std::optional<PlayerConfig::Robot> read_robot(const WorldEntity& driver) {
    const WorldProperty* model = driver.find("model");
    const WorldProperty* provides = driver.find("provides");
    if (!model || !provides) return std::nullopt;
    for (const WorldAtom& each : provides->values) {
        const auto* text = std::get_if<std::string>(&each);
        if (!text) throw InputError(provides->where, "provides: expected texts");
        const ConfiguredDevice device = read_device(*text, provides->where);
        if (device.interface != "position2d" && device.interface != "position") continue;
        return PlayerConfig::Robot{model->text(), static_cast<std::uint16_t>(device.port),
                                   device.index, model->where};
    }
    return std::nullopt;
}

}  // namespace

PlayerConfig read_player_config(const std::string& path) {
    PlayerConfig config;
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    for (const WorldEntity& driver : read_worldfile(path, {}).root.children) {
        const WorldProperty* name = driver.find("name");
        if (driver.type != "driver" || !name || name->text() != "stage") continue;
        if (const WorldProperty* world = driver.find("worldfile")) {
            config.world = (folder / world->text()).string();
        }
        if (const auto robot = read_robot(driver)) config.robots.push_back(*robot);
    }
    const Location file{.source = path};
    if (config.world.empty()) {
        throw InputError(file,
                         "found no world; expected driver ( name \"stage\" ... worldfile "
                         "\"NAME.world\" )");
    }
    if (config.robots.empty()) {
        throw InputError(file,
                         "found no robot; expected driver ( name \"stage\" provides [ "
                         "\"6665:position2d:0\" ] model \"robot1\" )");
    }
    return config;
}

}  // namespace rovernet
