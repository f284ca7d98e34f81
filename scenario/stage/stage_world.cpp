// SPDX-License-Identifier: MIT
#include "scenario/stage/stage_world.hpp"

#include "scenario/document/quantity.hpp"
#include "scenario/stage/stage_radio.hpp"
#include "scenario/stage/stage_scanner.hpp"
#include "scene/stage/world_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace rovernet {
namespace {

/// List of words for a notice: "a, b and 3 more".
std::string listed(const std::vector<std::string>& words) {
    constexpr std::size_t most = 10;
    std::string text;
    for (std::size_t i = 0; i < std::min(most, words.size()); ++i) {
        text += (i > 0 ? ", " : "") + words[i];
    }
    return words.size() > most ? fmt::format("{} and {} more", text, words.size() - most) : text;
}

/// Walks through a world and gathers its robots.
class Gatherer {
  public:
    explicit Gatherer(const WorldFile& world) : world_(world), units_(world_units(world)) {}

    Table gather(std::vector<std::string>& notices) {
        reserve_names(world_.root);
        visit(world_.root, {}, Carrier::none);
        Table document;
        scenario(document);
        if (!robots_.empty()) document.set("robot", placed(std::move(robots_), world_.root.where));
        summaries();
        notices.insert(notices.end(), notices_.begin(), notices_.end());
        return document;
    }

  private:
    /// Robots or models that one notice is about: the first one's place, all their names.
    struct Affected {
        Location first = {};
        std::vector<std::string> names = {};

        void add(const Location& where, std::string name) {
            if (names.empty()) first = where;
            names.push_back(std::move(name));
        }
    };

    void reserve_names(const WorldEntity& parent);
    /// Robot in which a model is: none, a position that is none, or one with a radio.
    enum class Carrier { none, position, robot };

    void visit(const WorldEntity& parent, const WorldPose& pose, Carrier carrier);
    void position(const WorldEntity& model, const WorldPose& pose);
    void robot(const WorldEntity& model, const WorldEntity& wifi, const WorldPose& pose);
    Value name_of(const WorldEntity& model);
    void check_label(const Table& radio, std::string_view key, const std::string& name);
    void scenario(Table& document);
    void summaries();
    void summary(const Affected& affected, std::string_view text);
    void note(std::string notice) {
        if (noted_.insert(notice).second) notices_.push_back(std::move(notice));
    }

    const WorldFile& world_;
    WorldUnits units_;
    Array robots_;
    Value seed_;
    std::map<std::string, Location, std::less<>> given_names_;
    std::map<std::string, std::pair<std::string, Location>, std::less<>> labels_;
    std::map<std::string, int> ignored_;
    Affected silent_, nameless_, modelless_, flying_, doubled_, lone_;
    std::vector<std::string> notices_;
    std::set<std::string> noted_;
};

/// Gathers names that robots have, so that the nameless get none of them.
void Gatherer::reserve_names(const WorldEntity& parent) {
    for (const auto& child : parent.children) {
        const WorldProperty* name = child.find("name");
        if (world_role(child) == WorldRole::robot && name && !wifis(child).empty()) {
            const auto [other, is_new] = given_names_.try_emplace(name->text(), name->where);
            if (!is_new) {
                throw InputError(name->where,
                                 fmt::format("two robots are named \"{}\"; the other is at {}; "
                                             "give each a name of its own",
                                             name->text(), other->second.text()));
            }
        }
        reserve_names(child);
    }
}

void Gatherer::visit(const WorldEntity& parent, const WorldPose& pose, Carrier carrier) {
    const bool in_robot = carrier != Carrier::none;
    for (const auto& child : parent.children) {
        WorldRole role = world_role(child);
        if (carrier == Carrier::robot && is_stage_scanner(child)) continue;  // the robot's
        if (in_robot && role == WorldRole::robot && child.type != "position") {
            role = WorldRole::ignored;  // its wifi is the robot's
        }
        if (role == WorldRole::ignored) ++ignored_[child.type];
        if (role == WorldRole::radio && !in_robot) lone_.add(child.where, "wifi");
        if (role != WorldRole::robot && role != WorldRole::wall) continue;
        const WorldPose own = pose * world_pose(child, "pose", units_);
        if (role == WorldRole::robot) position(child, own);
        Carrier inner = carrier;
        if (role == WorldRole::robot) {
            inner = wifis(child).empty() ? Carrier::position : Carrier::robot;
        }
        visit(child, own, inner);
    }
}

void Gatherer::position(const WorldEntity& model, const WorldPose& pose) {
    const auto radios = wifis(model);
    if (!radios.empty()) return robot(model, *radios.front(), pose);
    const WorldProperty* name = model.find("name");
    silent_.add(model.where, name ? name->text() : fmt::format("line {}", model.where.line));
}

void Gatherer::robot(const WorldEntity& model, const WorldEntity& wifi, const WorldPose& pose) {
    Table table;
    const Value name = name_of(model);
    table.set("name", name);
    const WorldProperty* at = model.find("pose");
    const Location at_where = at ? at->where : model.where;
    const auto length = [&](double metres, const Location& where) {
        return placed(quantity_text(metres, Dimension::length), where);
    };
    table.set("at",
              placed(Array{length(pose.at.x, at_where), length(pose.at.y, at_where)}, at_where));
    table.set("heading", placed(fmt::format("{} deg", pose.degrees), at_where));
    const WorldProperty* size_given = model.find("size");
    const WorldSize size = world_size(model, units_);
    table.set("radius",
              length(std::min(size.x, size.y) / 2, size_given ? size_given->where : model.where));

    StageRadio radio = stage_radio(wifi, units_);
    for (auto& notice : radio.notices) note(std::move(notice));
    for (const std::string_view label : {"ip", "mac"})
        check_label(radio.radio, label, *name.string());
    if (radio.seed) seed_ = *radio.seed;
    table.set("radio", placed(std::move(radio.radio), wifi.where));
    if (!radio.propagation.entries.empty()) {
        table.set("propagation", placed(std::move(radio.propagation), wifi.where));
    }
    std::vector<std::string> notices;
    Array scanners = stage_scanners(model, units_, notices);
    for (auto& notice : notices) note(std::move(notice));
    if (!scanners.empty()) table.set("scan", placed(std::move(scanners), model.where));
    if (!radio.model_given) modelless_.add(wifi.where, *name.string());
    if (pose.at.z != 0) flying_.add(at_where, *name.string());
    if (wifis(model).size() > 1) doubled_.add(model.where, *name.string());
    robots_.push_back(placed(std::move(table), model.where));
}

Value Gatherer::name_of(const WorldEntity& model) {
    if (const WorldProperty* name = model.find("name")) return placed(name->text(), name->where);
    std::string name = fmt::format("robot{}", robots_.size());
    while (given_names_.contains(name)) name += "_";
    nameless_.add(model.where, name);
    return placed(name, model.where);
}

void Gatherer::check_label(const Table& radio, std::string_view key, const std::string& name) {
    const Value* label = radio.find(key);
    if (!label) return;
    const auto [other, is_new] =
        labels_.try_emplace(fmt::format("{} \"{}\"", key, *label->string()), name, label->where);
    if (is_new) return;
    note(world_notice(label->where,
                      fmt::format("{} of {} is also that of {}, at {}", other->first, name,
                                  other->second.first, other->second.second.text())));
}

void Gatherer::scenario(Table& document) {
    Table table;
    if (const WorldProperty* quit = world_.root.find("quit_time"); quit && quit->number() > 0) {
        table.set("duration", placed(fmt::format("{} s", quit->number()), quit->where));
    }
    if (seed_.where.line > 0) table.set("seed", seed_);
    if (!table.entries.empty()) document.set("scenario", placed(table, world_.root.where));
}

void Gatherer::summary(const Affected& affected, std::string_view text) {
    if (affected.names.empty()) return;
    note(world_notice(affected.first, fmt::format("{}: {}", text, listed(affected.names))));
}

void Gatherer::summaries() {
    summary(nameless_, "robots without a name get one");
    summary(modelless_, "a wifi without a model uses that of [propagation], friis by default");
    summary(flying_, "z is left out, as in the 2007 radio, for");
    summary(doubled_, "only the first wifi counts of");
    summary(silent_, "positions without a wifi are left out");
    summary(lone_, "a wifi outside a position is left out");
    std::vector<std::string> kinds;
    for (const auto& [type, number] : ignored_) {
        kinds.push_back(fmt::format("{} ({})", type, number));
    }
    if (!kinds.empty()) note(world_notice(world_.root.where, "ignored: " + listed(kinds)));
}

}  // namespace

Table stage_document(const WorldFile& world, std::vector<std::string>& notices) {
    return Gatherer(world).gather(notices);
}

}  // namespace rovernet
