// SPDX-License-Identifier: MIT
#include "study/study.hpp"

#include "scenario/document/toml.hpp"
#include "scenario/scenario_file.hpp"
#include "scenario/unlikely.hpp"
#include "scene/wall_digest.hpp"
#include "study/measurement.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace rovernet {
namespace {

constexpr std::size_t most_points = 1'000'000;

std::string hash(std::string_view text) {
    return fmt::format("{:016x}", XXH64(text.data(), text.size(), 0));
}

bool same(const Value& a, const Value& b) { return to_toml(a) == to_toml(b); }

/// The keys that vary together, each with the values of one list.
using Axis = std::vector<const Vary*>;

std::vector<Axis> axes_of(const StudyTable& study) {
    std::vector<Axis> axes;
    for (const Vary& vary : study.vary) {
        const auto group = std::find_if(study.zip.begin(), study.zip.end(), [&](const auto& paths) {
            return std::find(paths.begin(), paths.end(), vary.path) != paths.end();
        });
        const auto joined = std::find_if(axes.begin(), axes.end(), [&](const Axis& axis) {
            return group != study.zip.end() &&
                   std::find(group->begin(), group->end(), axis.front()->path) != group->end();
        });
        if (joined == axes.end()) {
            axes.push_back({&vary});
        } else {
            joined->push_back(&vary);
        }
    }
    return axes;
}

bool is_excluded(const StudyTable& study, const Table& settings) {
    const auto matches = [&](const Vary& key) {
        const Value* value = settings.find(key.path);
        return std::any_of(key.values.begin(), key.values.end(),
                           [&](const Value& each) { return same(*value, each); });
    };
    return std::any_of(study.exclude.begin(), study.exclude.end(), [&](const Exclusion& each) {
        return std::all_of(each.begin(), each.end(), matches);
    });
}

/// @throws InputError if the values of an axis are the same at two of its places
void check_differ(const Axis& axis) {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < axis.front()->values.size(); ++i) {
        Table values;
        for (const Vary* vary : axis) values.set(vary->path, vary->values[i]);
        if (seen.insert(to_toml(values)).second) continue;
        throw InputError(axis.front()->values[i].where,
                         fmt::format("vary: {} is listed twice; expected different values",
                                     settings_text(values)));
    }
}

std::string file_bytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream bytes;
    bytes << file.rdbuf();
    return bytes.str();
}

}  // namespace

std::vector<Table> study_points(const StudyTable& study, const Location& where) {
    const std::vector<Axis> axes = axes_of(study);
    std::size_t total = 1;
    for (const Axis& axis : axes) {
        check_differ(axis);
        total *= axis.front()->values.size();
        if (total <= most_points) continue;
        throw InputError(
            where,
            fmt::format("vary: more than {} points (combinations of values); expected fewer values",
                        most_points));
    }
    std::vector<Table> points;
    for (std::size_t i = 0; i < total; ++i) {
        std::vector<std::size_t> digits(axes.size());
        for (std::size_t a = axes.size(), rest = i; a-- > 0;) {
            digits[a] = rest % axes[a].front()->values.size();
            rest /= axes[a].front()->values.size();
        }
        Table settings;
        for (const Vary& vary : study.vary) {
            const auto axis = std::find_if(axes.begin(), axes.end(), [&](const Axis& each) {
                return std::find(each.begin(), each.end(), &vary) != each.end();
            });
            const std::size_t digit = digits[static_cast<std::size_t>(axis - axes.begin())];
            settings.entries.push_back({vary.path, vary.values[digit], vary.where});
        }
        if (!is_excluded(study, settings)) points.push_back(std::move(settings));
    }
    if (points.empty())
        throw InputError(where,
                         "exclude: these tables exclude every point (combination of values) of the "
                         "study; remove some of the tables");
    return points;
}

std::string settings_text(const Table& settings) {
    if (settings.entries.empty()) return "the unchanged scenario";
    std::string text;
    for (const Entry& entry : settings.entries) {
        text +=
            fmt::format("{}{}={}", text.empty() ? "" : ", ", entry.key, plain_text(entry.value));
    }
    return text;
}

std::string run_id(const std::string& point_id, std::uint32_t replication,
                   const std::string& version) {
    return hash(fmt::format("{} {} {}", point_id, replication, version));
}

Study::Study(const std::string& path, const ScenarioOptions& options,
             const std::optional<std::vector<Vary>>& vary, const std::vector<Exclusion>& exclude)
    : options_(options), file_(path, options), base_(file_.scenario()) {
    if (vary) {
        base_.study.vary = *vary;
        base_.study.zip.clear();
        base_.study.exclude = exclude;
    }
    if (!base_.study.vary.empty()) base_.notices.clear();  // only points run; each has its notices
    note_own_models(base_);
    const StudyTable& study = base_.study;
    for (std::size_t i = 0; i < study.metric_places.size(); ++i) {
        check_metric(study.metrics[i], base_, study.metric_places[i]);
    }
    const Location where = base_.study.vary.empty() ? Location{path} : base_.study.vary[0].where;
    for (Table& settings : study_points(base_.study, where)) {
        std::string identity_text;
        try {
            Scenario scenario = at(settings);
            identity_text = to_toml(identity(scenario));
            if (points_.empty()) note_places(scenario, scenario.walls.get());
            for (std::string& notice : scenario.notices) {
                add_notice(base_.notices, std::move(notice));
            }
        } catch (const InputError& error) {
            if (settings.entries.empty()) throw;
            throw InputError(error.where(), fmt::format("{}; this happens with {}", error.message(),
                                                        settings_text(settings)));
        }
        points_.push_back({std::move(settings), hash(identity_text)});
    }
    check_points_differ();
}

void Study::check_points_differ() const {
    std::map<std::string, const StudyPoint*> known;
    for (const StudyPoint& point : points_) {
        const auto [found, is_new] = known.try_emplace(point.id, &point);
        if (is_new) continue;
        const Table& other = found->second->settings;
        const Entry* differs = &point.settings.entries.front();
        for (std::size_t i = point.settings.entries.size(); i-- > 0;) {
            const Entry& entry = point.settings.entries[i];
            if (!same(entry.value, other.entries[i].value)) differs = &entry;
        }
        const Location& where = differs->value.where;
        throw InputError(where, fmt::format("vary: {} gives the same scenario as {}; expected "
                                            "values that give different scenarios",
                                            settings_text(point.settings), settings_text(other)));
    }
}

Scenario Study::at(const Table& settings) {
    Scenario scenario = settings.entries.empty() ? base_ : file_.scenario(settings);
    const Walls& known = walls(scenario);
    scenario.walls = known.scene;
    scenario.changes = known.changes;
    return scenario;
}

bool Study::has_walls() const {
    return std::ranges::any_of(walls_,
                               [](const auto& each) { return each.second.scene != nullptr; });
}

const Study::Walls& Study::walls(const Scenario& scenario) {
    const auto [found, is_new] = walls_.try_emplace(to_toml(*to_document(scenario).find("scene")));
    Walls& walls = found->second;
    if (is_new) {
        walls.scene = scenario.walls ? scenario.walls
                                     : load_map(scenario.scene, scenario.file, base_.notices);
        if (walls.scene) walls.digest = wall_digest(*walls.scene);
        walls.changes = std::make_shared<const std::vector<SceneChange>>(
            load_doors(scenario.scene, walls.scene));
    }
    return walls;
}

Scenario Study::scenario(std::size_t point, std::uint32_t replication) {
    Scenario scenario = at(points_[point].settings);
    scenario.scenario.replication = replication;
    return scenario;
}

Table Study::identity(const Scenario& scenario) {
    Table document = to_document(scenario);
    const auto drop = [](Table& table, std::string_view key) {
        std::erase_if(table.entries, [&](const Entry& entry) { return entry.key == key; });
    };
    for (const char* key : {"name", "replication"}) drop(*document.find("scenario")->table(), key);
    const Value warmup = *document.find("study")->table()->find("warmup");
    for (const char* section : {"study", "trace"}) drop(document, section);
    Table digests;
    digests.set("warmup", warmup);
    digests.set("walls", walls(scenario).digest);
    if (scenario.movement.file) {
        const auto folder = std::filesystem::path(scenario.file).parent_path();
        digests.set("movement", hash(file_bytes(folder / *scenario.movement.file)));
    }
    document.set("digests", std::move(digests));
    return document;
}

}  // namespace rovernet
