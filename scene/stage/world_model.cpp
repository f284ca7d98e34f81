// SPDX-License-Identifier: MIT
#include "scene/stage/world_model.hpp"

#include "sim/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace rovernet {
namespace {

constexpr double pi_ = 3.14159265358979323846;
constexpr double largest_coordinate = 1e9;  // [m] the plane is no larger

/// Numbers of a tuple. @throws InputError unless there are `least` to `most` of them
std::vector<double> numbers(const WorldProperty& property, std::size_t least, std::size_t most,
                            std::string_view form) {
    std::vector<double> out;
    for (const auto& value : property.values) {
        if (const double* number = std::get_if<double>(&value)) out.push_back(*number);
    }
    const bool all = property.is_tuple && out.size() == property.values.size();
    if (all && out.size() >= least && out.size() <= most) return out;
    const std::string found = !property.is_tuple ? "a single value"
                              : all              ? fmt::format("{} numbers", out.size())
                                                 : "a text";
    throw InputError(property.where,
                     fmt::format("{}: found {}; expected {}; write {} {}", property.name, found,
                                 form, property.name, form.substr(0, form.find(']') + 1)));
}

double length(const WorldProperty& property, double number, const WorldUnits& units) {
    const double metres = units.metres(number);
    if (std::abs(metres) <= largest_coordinate) return metres;
    throw InputError(property.where,
                     fmt::format("{}: found {} m; expected at most 1e9 m; check the number",
                                 property.name, metres));
}

void collect_wifis(const WorldEntity& entity, std::vector<const WorldEntity*>& out) {
    for (const auto& child : entity.children) {
        if (child.type == "wifi") out.push_back(&child);
        if (child.type != "position") collect_wifis(child, out);
    }
}

template <class Size>
Size one_unit(const WorldEntity& root, std::string_view key,
              const std::vector<std::pair<std::string, Size>>& units) {
    const WorldProperty* property = root.find(key);
    if (!property) return units.front().second;
    std::vector<std::string> names;
    std::string list;
    for (const auto& [name, size] : units) {
        if (name == property->text()) return size;
        names.push_back(name);
        list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", name);
    }
    const std::string near = did_you_mean(property->text(), names);
    throw InputError(property->where,
                     fmt::format("{}: found \"{}\"; expected one of {}; {}", key, property->text(),
                                 list, near.empty() ? "write " + units.front().first : near));
}

}  // namespace

const std::vector<std::string>& stage_types() {
    static const std::vector<std::string> types{
        "model",    "position",       "laser",      "ranger",   "sensor",         "wifi",
        "fiducial", "fiducialfinder", "blobfinder", "blob",     "gripper",        "ptz",
        "speech",   "bumper",         "camera",     "actuator", "blinkenlight",   "lightindicator",
        "energy",   "power",          "powerpack",  "mote",     "audio",          "truth",
        "gps",      "block",          "window",     "gui",      "fiducialsensor", "indicator"};
    return types;
}

WorldRole world_role(const WorldEntity& entity) {
    if (entity.type == "position") return WorldRole::robot;
    if (entity.type == "model") return WorldRole::wall;
    if (entity.type == "wifi") return WorldRole::radio;
    if (entity.type == "block") return WorldRole::shape;
    const auto& types = stage_types();
    if (std::find(types.begin(), types.end(), entity.type) != types.end()) {
        return WorldRole::ignored;
    }
    if (!wifis(entity).empty()) return WorldRole::robot;
    return entity.find("bitmap") ? WorldRole::wall : WorldRole::ignored;
}

std::vector<const WorldEntity*> wifis(const WorldEntity& entity) {
    std::vector<const WorldEntity*> out;
    collect_wifis(entity, out);
    return out;
}

WorldUnits world_units(const WorldFile& world) {
    return {one_unit<int>(world.root, "unit_length", {{"m", 0}, {"cm", -2}, {"mm", -3}}),
            one_unit<double>(world.root, "unit_angle", {{"degrees", 1}, {"radians", 180 / pi_}})};
}

WorldPose operator*(const WorldPose& outer, const WorldPose& inner) {
    const auto [sine, cosine] = direction(outer.degrees);
    const Vec3 turned{cosine * inner.at.x - sine * inner.at.y,
                      sine * inner.at.x + cosine * inner.at.y, inner.at.z};
    return {{outer.at.x + turned.x, outer.at.y + turned.y, turned.z},
            outer.degrees + inner.degrees};
}

WorldPose world_pose(const WorldEntity& entity, std::string_view key, const WorldUnits& units) {
    const WorldProperty* property = entity.find(key);
    return property ? world_pose(*property, units) : WorldPose{};
}

WorldPose world_pose(const WorldProperty& property, const WorldUnits& units) {
    const auto v = numbers(property, 2, 4, "[x y a] or [x y z a]");
    WorldPose pose;
    pose.at = {length(property, v[0], units), length(property, v[1], units), 0};
    if (v.size() == 4) pose.at.z = length(property, v[2], units);
    if (v.size() > 2) pose.degrees = std::fmod(v.back() * units.degrees, 360);
    return pose;
}

WorldSize world_size(const WorldEntity& entity, const WorldUnits& units) {
    constexpr double usual = 0.4;
    const WorldProperty* property = entity.find("size");
    if (!property) return {usual, usual};
    constexpr std::size_t all_numbers = 1'000'000;  // Stage reads the first ones
    const auto v = numbers(*property, 2, all_numbers, "[x y] or [x y z]");
    const WorldSize size{length(*property, v[0], units), length(*property, v[1], units)};
    if (size.x >= 0 && size.y >= 0) return size;
    throw InputError(property->where,
                     fmt::format("size: found {} m x {} m; expected lengths >= 0; remove the sign",
                                 size.x, size.y));
}

Direction direction(double degrees) {
    const double turned = std::fmod(degrees, 360);
    const double quarters = turned / 90;
    if (quarters == std::floor(quarters)) {
        constexpr std::array<double, 4> sines{0, 1, 0, -1};
        const auto i = static_cast<std::size_t>(quarters + 4) % 4;
        return {sines[i], sines[(i + 1) % 4]};
    }
    const auto [sine, cosine] = math::sincos(turned * (pi_ / 180));
    return {sine, cosine};
}

}  // namespace rovernet
