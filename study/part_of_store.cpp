// SPDX-License-Identifier: MIT
#include "study/part_of_store.hpp"

#include "experiment/version.hpp"
#include "files/input_file.hpp"
#include "study/merge.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <vector>

namespace rovernet {
namespace {

/// Points of a store that a study has.
std::vector<std::uint32_t> shared_points(const Store& store, const Study& study) {
    std::vector<std::uint32_t> shared;
    for (const StoredPoint& point : store.points()) {
        const bool known = std::ranges::any_of(
            study.points(), [&](const StudyPoint& each) { return each.id == point.id; });
        if (known) shared.push_back(point.number);
    }
    return shared;
}

/// Number of replications of a study; with `precision` all existing ones.
std::uint32_t asked_replications(const Study& study) {
    if (study.table().precision) return std::numeric_limits<std::uint32_t>::max();
    return static_cast<std::uint32_t>(study.table().replications);
}

/// Settings with the keys of two points of a kind, those of the first in front: values that the
/// settings lack are those of these points.
Table with_keys_of(const Table& first, const Table& second, const Table& settings) {
    Table out;
    for (const Table* keys : {&first, &second}) {
        for (const Entry& entry : keys->entries) {
            const Value* own = settings.find(entry.key);
            if (!out.find(entry.key)) out.set(entry.key, own ? *own : entry.value);
        }
    }
    return out;
}

}  // namespace

std::optional<std::uint32_t> more_replications(const Store& store, const Study& study) {
    const std::vector<std::uint32_t> shared = shared_points(store, study);
    std::optional<std::uint32_t> most;
    for (const StoredRun& run : store.runs()) {
        const bool is_asked = run.replication < asked_replications(study);
        if (is_asked || std::ranges::find(shared, run.point) == shared.end()) continue;
        most = std::max(most.value_or(0), run.replication + 1);
    }
    return most;
}

bool takes_part_of(const std::string& path, const Study& study) {
    if (input_kind(path) == InputKind::nothing) return false;
    const Store store = Store::open(path);
    if (store.property("version") != code_version()) return false;
    const std::size_t shared = shared_points(store, study).size();
    if (shared == 0) return false;
    return shared < store.points().size() || more_replications(store, study).has_value();
}

void take_part(const Store& whole, const Study& study, Store& part) {
    copy_runs(whole, part, asked_replications(study));
}

void give_back(const Store& part, Store& whole) {
    std::vector<StoredPoint> points = whole.points();
    std::map<std::string, Table> known;
    std::uint32_t next = 0;
    for (const StoredPoint& point : points) {
        known[point.id] = point.settings;
        next = std::max(next, point.number + 1);
    }
    Table held_by_whole, held_by_part;
    std::vector<StoredPoint> added;
    for (const StoredPoint& point : part.points()) {
        if (const auto same = known.find(point.id); same != known.end()) {
            held_by_whole = same->second;
            held_by_part = point.settings;
        } else {
            added.push_back({next++, point.id, point.settings});
        }
    }
    if (!added.empty()) {
        points.insert(points.end(), added.begin(), added.end());
        for (StoredPoint& point : points)
            point.settings = with_keys_of(held_by_whole, held_by_part, point.settings);
    }
    whole.set_points(points);
    copy_runs(part, whole);
}

}  // namespace rovernet
