// SPDX-License-Identifier: MIT
#include "study/inventory.hpp"

#include "sim/error.hpp"
#include "study/precision.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rovernet {
namespace {

std::uint32_t replications_asked_for(const Store& store, const StudyTable& study,
                                     std::uint32_t point, const std::vector<RunState>& made) {
    const auto first = static_cast<std::uint32_t>(study.replications);
    const auto count = static_cast<std::uint32_t>(made.size());
    const bool has_failed = std::find(made.begin(), made.end(), RunState::failed) != made.end();
    if (!study.precision || count < first || has_failed) return first;
    std::vector<double> values;
    for (const StoredValue& v : store.values(first_metric(study), point)) {
        if (v.value) values.push_back(*v.value);
    }
    return replications_for(study, values, count);
}

}  // namespace

void RunCounts::add(RunState state) {
    switch (state) {
        case RunState::finished: ++finished; break;
        case RunState::failed: ++failed; break;
        case RunState::missing: ++missing; break;
    }
}

StudyTable study_of(const Store& store) {
    const Value study = store.document("study");
    if (std::holds_alternative<std::monostate>(study.data)) return {};
    try {
        return read_study(study, Duration::max());
    } catch (const InputError& error) {
        throw InputError(
            {store.path()},
            fmt::format("the store is damaged: table \"study\", row with key \"study\", column "
                        "\"value\": {}; restore a copy of the store, or sweep again with --fresh, "
                        "which deletes the stored runs",
                        error.message()));
    }
}

Inventory inventory_of(const Store& store) {
    Inventory inventory;
    for (const StoredPoint& point : store.points()) inventory[point.number];
    for (const StoredRun& run : store.runs()) {
        std::vector<RunState>& states = inventory[run.point];
        if (run.replication >= states.size()) states.resize(run.replication + 1, RunState::missing);
        states[run.replication] = run.error.empty() ? RunState::finished : RunState::failed;
    }
    const StudyTable study = study_of(store);
    for (auto& [point, states] : inventory) {
        const std::uint32_t asked = replications_asked_for(store, study, point, states);
        if (asked > states.size()) states.resize(asked, RunState::missing);
    }
    return inventory;
}

RunCounts counts_of(const Inventory& inventory) {
    RunCounts counts;
    for (const auto& [point, states] : inventory) {
        for (const RunState state : states) counts.add(state);
    }
    return counts;
}

std::string runs_text(std::uint64_t runs) {
    return fmt::format("{} {}", runs, runs == 1 ? "run" : "runs");
}

std::string incompleteness(const RunCounts& counts) {
    std::string text;
    if (counts.missing > 0) {
        text = fmt::format("unfinished: {} of {} {} missing", counts.missing,
                           runs_text(counts.all()), counts.missing == 1 ? "is" : "are");
    }
    if (counts.failed > 0) {
        text += fmt::format("{}{} {}failed", text.empty() ? "" : "; ", counts.failed,
                            text.empty() ? (counts.failed == 1 ? "run " : "runs ") : "");
    }
    return text;
}

}  // namespace rovernet
