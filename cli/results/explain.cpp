// SPDX-License-Identifier: MIT
#include "study/explain.hpp"

#include "cli/results/result_commands.hpp"
#include "cli/terminal/diagnostics.hpp"
#include "scenario/document/json.hpp"
#include "study/inventory.hpp"
#include "study/study.hpp"

#include <fmt/format.h>

namespace rovernet::cli {
void explain(const ExplainArguments& a) {
    const Store store = Store::open(a.store);
    const FoundRun found = find_run(store, a.run);
    const StoredRun& run = found.run;
    const Measurement& m = run.measurement;
    const std::string lacking = incompleteness(counts_of(inventory_of(store)));
    if (!lacking.empty()) notice(fmt::format("the study of this run is incomplete: {}", lacking));
    const std::string command = run_command(store, found.point, run.replication);
    Table table;
    table.set("run", run.id);
    table.set("point", std::uint64_t{run.point});
    table.set("replication", std::uint64_t{run.replication});
    table.set("settings", found.point.settings);
    table.set("command", command);
    table.set("version", store.property("version"));
    table.set("fingerprint", m.fingerprint);
    table.set("error", run.error.empty() ? Value() : Value(run.error));
    table.set("cpu_s", m.cpu_s);
    table.set("wall_s", m.wall_s);
    table.set("started", m.started);
    table.set("host", m.host);
    Table metrics;
    for (const MetricValue& metric : m.metrics) {
        metrics.set(metric.name, metric.value);
    }
    table.set("metrics", std::move(metrics));
    if (a.json) {
        fmt::print("{}", to_json(table));
        return;
    }
    fmt::print(
        "run {}: point {} ({}), replication {}\nmade by version {}, {} on {}, {:.3g} s of "
        "CPU\n{}\nto repeat this run: {}\n",
        run.id, run.point, settings_text(found.point.settings), run.replication,
        store.property("version"), m.started, m.host, m.cpu_s,
        run.error.empty() ? "fingerprint " + m.fingerprint : "failed: " + run.error, command);
    for (const MetricValue& metric : m.metrics) {
        fmt::print("{:<20} {}\n", metric.name,
                   metric.value ? fmt::format("{}", *metric.value) : "none");
    }
}

}  // namespace rovernet::cli
