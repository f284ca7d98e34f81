// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/run.hpp"
#include "experiment/session.hpp"
#include "experiment/summary.hpp"
#include "experiment/timeline.hpp"
#include "python/arguments.hpp"
#include "python/interruption.hpp"
#include "python/record_arrays.hpp"
#include "python/values.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rovernet::python {

/// Sink (observer of a run) that stores records of the kinds with the names `kinds`; null if
/// `kinds` is empty.
inline std::shared_ptr<RowSink> rows_of(const std::vector<std::string>& kinds) {
    KindMask mask = 0;
    for (const std::string& kind : kinds) mask |= record_named(kind);
    return mask == 0 ? nullptr : std::make_shared<RowSink>(mask);
}

inline py::value_error not_kept(const std::string& kind) {
    return py::value_error(fmt::format(
        "records \"{}\" were not kept; expected records=[\"{}\"] when the session begins", kind,
        kind));
}

inline py::tuple names_of(const Network& network) {
    py::tuple names(network.size());
    for (NodeId n{0}; n.index() < network.size(); ++n.value) names[n.index()] = network.name(n);
    return names;
}

/// Result of a run: the Python class `rovernet.Run`.
class RunObject {
  public:
    /// @param rows       records stored during the run; may be null
    /// @param is_driven  true: a program drove the robots, so that the run cannot be repeated to
    ///                   get further records
    RunObject(std::shared_ptr<const Scenario> scenario, RunResult result,
              std::shared_ptr<RowSink> rows, bool is_driven)
        : scenario_(std::move(scenario)),
          result_(std::move(result)),
          rows_{std::move(rows)},
          is_driven_(is_driven) {}

    py::dict metrics() const {
        Table table;
        append_metrics(table, result_.metrics);
        append_parts(table, *scenario_, result_);
        return to_python(table);
    }
    py::list timeline() const {
        py::list list;
        for (std::size_t i = 0; i < result_.timeline->size(); ++i) {
            const auto [time, robot, words] = (*result_.timeline)[i];
            py::dict happening;
            happening["t_ns"] = py::int_(time.time_since_epoch().count());
            happening["robot"] = robot;
            happening["text"] = words;
            list.append(std::move(happening));
        }
        return list;
    }
    py::array records(const std::string& name) {
        const KindMask kind = record_named(name);
        for (const auto& rows : rows_) {
            if (rows && (rows->kinds() & kind) != 0) return to_array(rows->table(kind));
        }
        if (is_driven_) throw not_kept(name);
        rows_.push_back(found_again(name));
        return to_array(rows_.back()->table(kind));
    }
    py::tuple names() const { return names_of(*result_.network); }
    const RunResult& result() const { return result_; }
    const Scenario& scenario() const { return *scenario_; }

  private:
    /// Runs the scenario again to get records of a kind that were not stored during the run.
    std::shared_ptr<RowSink> found_again(const std::string& kind) const {
        Interruption interruption;
        auto rows = rows_of({kind});
        {
            const py::gil_scoped_release others_run;
            ScenarioRun run(*scenario_);
            run.session().network().add_sink(rows);
            run.session().run({}, [&](double) { return interruption.go_on(); });
            run.session().network().finish();
        }
        interruption.raise();
        return rows;
    }

    std::shared_ptr<const Scenario> scenario_;
    RunResult result_;
    std::vector<std::shared_ptr<RowSink>> rows_;
    bool is_driven_;
};

/// Runs a scenario to its end: the Python function `rovernet.run`.
inline RunObject run(const py::object& given, const py::object& set, const py::object& seed,
                     const py::object& out, const KindsArgument& records,
                     const py::object& progress) {
    check_callable(progress, "progress");
    const auto scenario = std::make_shared<const Scenario>(to_scenario(given, set, seed));
    auto rows = rows_of(records.value);
    const auto folder = folder_in(out);
    Interruption interruption;
    std::optional<RunResult> result;
    {
        const py::gil_scoped_release others_run;
        ScenarioRun run(*scenario);
        if (folder) run.write_to(*folder);
        if (rows) run.session().network().add_sink(rows);
        const bool is_whole = run.session().run({}, [&](double share) {
            return interruption.go_on([&] {
                if (!progress.is_none()) progress(share);
            });
        });
        if (is_whole) result = run.finish();
    }
    interruption.raise();
    return {scenario, std::move(*result), std::move(rows), false};
}

}  // namespace rovernet::python
