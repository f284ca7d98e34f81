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
        visit(world_.root, {}, false);
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
    void visit(const WorldEntity& parent, const WorldPose& pose, bool in_robot);
    void robot(const WorldEntity& model, const WorldPose& pose);
    void add_body(Table& table, const WorldEntity& model, const WorldPose& pose);
    void add_radio(Table& table, const WorldEntity& model);
    void add_scanners(Table& table, const WorldEntity& model);
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
    std::set<std::string, std::less<>> given_names_, used_names_;
    std::map<std::string, std::pair<std::string, Location>, std::less<>> labels_;
    std::map<std::string, int> ignored_;
    Affected plain_, nameless_, namesakes_, modelless_, flying_, doubled_, lone_;
    std::vector<std::string> notices_;
    std::set<std::string> noted_;
};

/// Gathers names that robots have, so that no other robot gets one of them.
void Gatherer::reserve_names(const WorldEntity& parent) {
    for (const auto& child : parent.children) {
        const WorldProperty* name = child.find("name");
        if (world_role(child) == WorldRole::robot && name) given_names_.insert(name->text());
        reserve_names(child);
    }
}

void Gatherer::visit(const WorldEntity& parent, const WorldPose& pose, bool in_robot) {
    for (const auto& child : parent.children) {
        WorldRole role = world_role(child);
        if (in_robot && is_stage_scanner(child)) continue;  // the robot's
        if (in_robot && role == WorldRole::robot && child.type != "position") {
            role = WorldRole::ignored;  // its wifi is the robot's
        }
        if (role == WorldRole::ignored) ++ignored_[child.type];
        if (role == WorldRole::radio && !in_robot) lone_.add(child.where, "wifi");
        if (role != WorldRole::robot && role != WorldRole::wall) continue;
        const WorldPose own = pose * world_pose(child, "pose", units_);
        if (role == WorldRole::robot) robot(child, own);
        visit(child, own, in_robot || role == WorldRole::robot);
    }
}

void Gatherer::robot(const WorldEntity& model, const WorldPose& pose) {
    Table table;
    table.set("name", name_of(model));
    add_body(table, model, pose);
    add_radio(table, model);
    add_scanners(table, model);
    robots_.push_back(placed(std::move(table), model.where));
}

/// Adds place, heading and radius.
void Gatherer::add_body(Table& table, const WorldEntity& model, const WorldPose& pose) {
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
    if (pose.at.z != 0) flying_.add(at_where, *table.find("name")->string());
}

/// Adds the radio and the propagation of the robot's wifi; without one those of the scenario count.
void Gatherer::add_radio(Table& table, const WorldEntity& model) {
    const std::string name = *table.find("name")->string();
    const auto radios = wifis(model);
    if (radios.empty()) return plain_.add(model.where, name);
    const WorldEntity& wifi = *radios.front();
    StageRadio radio = stage_radio(wifi, units_);
    for (auto& notice : radio.notices) note(std::move(notice));
    for (const std::string_view label : {"ip", "mac"}) check_label(radio.radio, label, name);
    if (radio.seed) seed_ = *radio.seed;
    table.set("radio", placed(std::move(radio.radio), wifi.where));
    if (!radio.propagation.entries.empty()) {
        table.set("propagation", placed(std::move(radio.propagation), wifi.where));
    }
    if (!radio.model_given) modelless_.add(wifi.where, name);
    if (radios.size() > 1) doubled_.add(model.where, name);
}

void Gatherer::add_scanners(Table& table, const WorldEntity& model) {
    std::vector<std::string> notices;
    Array scanners = stage_scanners(model, units_, notices);
    for (auto& notice : notices) note(std::move(notice));
    if (!scanners.empty()) table.set("scan", placed(std::move(scanners), model.where));
}

/// The robot's own name, if no robot before it has that; else one that nobody has.
Value Gatherer::name_of(const WorldEntity& model) {
    const WorldProperty* given = model.find("name");
    if (given && used_names_.insert(given->text()).second)
        return placed(given->text(), given->where);
    std::string name = given ? given->text() + "_" : fmt::format("robot{}", robots_.size());
    while (given_names_.contains(name) || !used_names_.insert(name).second) name += "_";
    (given ? namesakes_ : nameless_).add(model.where, name);
    return placed(name, model.where);
}

void Gatherer::check_label(const Table& radio, std::string_view key, const std::string& name) {
    const Value* label = radio.find(key);
    if (!label) return;
    const auto [other, is_new] =
        labels_.try_emplace(fmt::format("{} \"{}\"", key, *label->string()), name, label->where);
    if (is_new) return;
    note(world_notice(label->where, fmt::format("the {} of robot \"{}\" is also used by robot "
                                                "\"{}\" ({}); give each robot a different address",
                                                other->first, name, other->second.first,
                                                other->second.second.text())));
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
    summary(nameless_, "names are generated for robots without a name");
    summary(namesakes_, "new names are generated for robots whose name is already in use");
    summary(modelless_,
            "the wifi of these robots has no model, so the model of [propagation] is used "
            "(default: friis)");
    summary(flying_,
            "the height z of these robots is ignored, as in the original wifi model for Stage");
    summary(doubled_, "only the first wifi of these robots is used");
    summary(plain_,
            "robots without a wifi get the radio of [radio] and the model of [propagation] "
            "(default: friis)");
    summary(lone_, "a wifi that belongs to no model of type position is ignored");
    std::vector<std::string> kinds;
    for (const auto& [type, number] : ignored_) {
        kinds.push_back(fmt::format("{} ({})", type, number));
    }
    if (!kinds.empty())
        note(
            world_notice(world_.root.where, "models of these types are ignored: " + listed(kinds)));
}

}  // namespace

Table stage_document(const WorldFile& world, std::vector<std::string>& notices) {
    return Gatherer(world).gather(notices);
}

}  // namespace rovernet
