// SPDX-License-Identifier: MIT
#include "live/player/config_drivers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace rovernet {
namespace {

constexpr std::uint32_t last_port = 65'535;

std::optional<std::uint32_t> number_of(std::string_view text) {
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_whole = error == std::errc{} && end == text.data() + text.size();
    return is_whole ? std::optional(number) : std::nullopt;
}

/// Parts of an address between its colons, without the blanks around them.
std::vector<std::string> parts_of(const std::string& text) {
    constexpr std::string_view blanks = " \t";
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(':', begin), text.size());
        const std::string part = text.substr(begin, end - begin);
        const std::size_t first = std::min(part.find_first_not_of(blanks), part.size());
        parts.push_back(part.substr(first, part.find_last_not_of(blanks) + 1 - first));
        begin = end + 1;
    }
    return parts;
}

ConfiguredDevice read_device(std::string_view key, const std::string& text, const Location& where) {
    const std::vector<std::string> parts = parts_of(text);
    const std::size_t n = parts.size();
    const auto index = number_of(parts.back());
    const bool has_port = n >= 3 && !parts[n - 3].empty();
    const auto port = has_port ? number_of(parts[n - 3]) : 6665;
    if (n < 2 || n > 5 || !index || !port || *port == 0 || *port > last_port) {
        throw InputError(where, fmt::format("{}: found \"{}\"; expected PORT:INTERFACE:INDEX, such "
                                            "as \"6665:position2d:0\"",
                                            key, text));
    }
    return {parts[n - 2], *port, *index};
}

}  // namespace

std::vector<ConfiguredDevice> configured_devices(const WorldEntity& driver, std::string_view key) {
    std::vector<ConfiguredDevice> devices;
    const WorldProperty* property = driver.find(key);
    if (!property) return devices;
    for (const WorldAtom& each : property->values) {
        const auto* text = std::get_if<std::string>(&each);
        if (!text)
            throw InputError(property->where, fmt::format("{}: expected texts in quotes", key));
        devices.push_back(read_device(key, *text, property->where));
    }
    return devices;
}

std::vector<PlayerConfig::Mapped> read_mapping(const WorldEntity& driver) {
    std::vector<PlayerConfig::Mapped> mapping;
    const WorldProperty* property = driver.find("mapping");
    if (!property) return mapping;
    const auto& values = property->values;
    for (std::size_t i = 0; i < values.size(); i += 2) {
        const auto* ip = std::get_if<std::string>(&values[i]);
        const auto* port = i + 1 < values.size() ? std::get_if<double>(&values[i + 1]) : nullptr;
        const bool is_port = port && *port >= 1 && *port <= last_port && *port == std::floor(*port);
        if (!ip || !is_port) {
            throw InputError(property->where,
                             "mapping: expected pairs of an IP address and the port of its robot, "
                             "such as mapping [\"192.168.0.2\" 6666 \"192.168.0.3\" 6667]");
        }
        mapping.push_back({*ip, static_cast<std::uint16_t>(*port)});
    }
    return mapping;
}

}  // namespace rovernet
