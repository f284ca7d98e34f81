// SPDX-License-Identifier: MIT
#include "scenario/stage/stage_radio.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

namespace rovernet {
namespace {

/// Models of the 2007 device, and their names here.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> models{{
    {"friis", "friis"},
    {"ITU indoor", "itu_indoor"},
    {"log distance", "log_distance"},
    {"raytrace", "raytrace_2007"},
    {"simple", "disc"},
}};

const std::vector<std::string>& wifi_keys() {
    static const std::vector<std::string> keys{
        "ip",          "netmask",  "mac",         "essid",
        "model",       "power",    "freq",        "frequency",
        "range",       "plc",      "ple",         "sigma",
        "sensitivity", "range_db", "wall_factor", "link_success_rate",
        "random_seed"};
    return keys;
}

/// Whether every model of Stage has this key: it does not concern the radio.
bool is_model_key(std::string_view key) {
    constexpr std::array<std::string_view, 20> keys{
        "name",           "color",         "color_rgba",      "pose",         "size",
        "origin",         "velocity",      "alwayson",        "watts",        "update_interval",
        "laser_return",   "ranger_return", "obstacle_return", "blob_return",  "fiducial_return",
        "gripper_return", "gui_nose",      "gui_grid",        "gui_movemask", "gui_outline"};
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

class RadioReader {
  public:
    RadioReader(const WorldEntity& wifi, const WorldUnits& units) : wifi_(wifi), units_(units) {}

    StageRadio read() {
        for (const std::string_view label : {"essid", "ip", "netmask", "mac"}) {
            if (const auto* p = wifi_.find(label))
                out_.radio.set(label, placed(p->text(), p->where));
        }
        quantity("power", "power", "mW");
        quantity("sensitivity", "sensitivity", "dBm");
        quantity(wifi_.find("freq") ? "freq" : "frequency", "frequency", "MHz");
        quantity("range_db", "range_db", "dBm");
        success_rate();
        model();
        parameter("plc", "coefficient");
        parameter("ple", "exponent");
        if (const auto* p = wifi_.find("sigma")) {
            out_.propagation.set("sigma", text(p->number(), "dB", p->where));
        }
        parameter("wall_factor", "wall_factor");
        range();
        seed();
        unknown_keys();
        return std::move(out_);
    }

  private:
    static Value text(double number, std::string_view unit, const Location& where) {
        return placed(fmt::format("{} {}", number, unit), where);
    }
    void quantity(std::string_view key, std::string_view ours, std::string_view unit) {
        if (const auto* p = wifi_.find(key)) {
            out_.radio.set(ours, text(p->number(), unit, p->where));
        }
    }
    void parameter(std::string_view key, std::string_view ours) {
        if (const auto* p = wifi_.find(key)) {
            out_.propagation.set(ours, placed(p->number(), p->where));
        }
    }
    void success_rate();
    void model();
    void range();
    void seed();
    void unknown_keys();

    const WorldEntity& wifi_;
    const WorldUnits& units_;
    StageRadio out_;
};

/// Success rate: Stage draws a whole number from 0 to 100 and lets the message pass if it is at
/// most the rate.
void RadioReader::success_rate() {
    const auto* p = wifi_.find("link_success_rate");
    if (!p) return;
    const double share = (std::floor(p->number()) + 1) / 101;
    out_.radio.set("success_rate", placed(std::clamp(share, 0.0, 1.0), p->where));
}

void RadioReader::model() {
    const auto* p = wifi_.find("model");
    out_.model_given = p != nullptr;
    if (!p) return;
    std::vector<std::string> names;
    std::string list;
    for (const auto& [theirs, ours] : models) {
        if (p->text() == theirs) return out_.propagation.set("model", placed(ours, p->where));
        names.emplace_back(theirs);
        list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", theirs);
    }
    const std::string near = did_you_mean(p->text(), names);
    throw InputError(p->where, fmt::format("model: found \"{}\"; expected one of {}; {}", p->text(),
                                           list, near.empty() ? "write model \"friis\"" : near));
}

void RadioReader::range() {
    const auto* p = wifi_.find("range");
    if (p) {
        out_.propagation.set("range", text(units_.metres(p->number()), "m", p->where));
        return;
    }
    const auto* model = wifi_.find("model");
    if (!model || model->text() != "simple") return;
    out_.propagation.set("range", text(0, "m", model->where));
    out_.notices.push_back(
        world_notice(model->where,
                     "a wifi of model \"simple\" without a range has the range 0 m, as in Stage; "
                     "to connect robots, give this wifi a range"));
}

void RadioReader::seed() {
    const auto* p = wifi_.find("random_seed");
    if (!p) return;
    constexpr double most = 9e15;  // whole numbers are exact up to here
    const double number = p->number();
    if (number >= 0 && number <= most && number == std::floor(number)) {
        out_.seed = placed(static_cast<std::int64_t>(number), p->where);
        return;
    }
    throw InputError(p->where, fmt::format("random_seed: found {}; expected a whole number from 0 "
                                           "to 9e15; such as 1",
                                           number));
}

void RadioReader::unknown_keys() {
    for (const auto& p : wifi_.properties) {
        const auto& keys = wifi_keys();
        if (std::find(keys.begin(), keys.end(), p.name) != keys.end()) continue;
        if (is_model_key(p.name)) continue;
        const std::string near = did_you_mean(p.name, keys);
        out_.notices.push_back(world_notice(
            p.where, fmt::format("a wifi has no key \"{}\", so this key is ignored{}{}", p.name,
                                 near.empty() ? "" : "; ", near)));
    }
}

}  // namespace

StageRadio stage_radio(const WorldEntity& wifi, const WorldUnits& units) {
    return RadioReader(wifi, units).read();
}

}  // namespace rovernet
