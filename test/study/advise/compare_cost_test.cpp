// SPDX-License-Identifier: MIT
#include "study/advise/compare_cost.hpp"

#include "study/advise/study_chart.hpp"
#include "study/sweep.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <string>

namespace compare_cost_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

const std::string scenario = R"([scenario]
duration = "2 s"
[[robot]]
name = "A"
at = ["50 m", "50 m"]
OFF
[[robot]]
name = "r"
count = 20
place = { model = "uniform", area = [["0 m", "0 m"], ["100 m", "100 m"]] }
[propagation]
range = "30 m"
[[traffic]]
from = "A"
payload = "F"
every = "100 ms"
[study]
replications = 2
vary.propagation.model = ["disc", "friis"]
)";

struct Compared {
    explicit Compared(const std::string& off) {
        std::string text = scenario;
        text.replace(text.find("OFF"), 3, off);
        Study study(folder.write("s.toml", text), {});
        Store store = open_store(folder.path("s.db"), study);
        sweep(study, store, {});
        comparison = compare_models(store, "transmissions", "");
        without = comparison_charts(comparison)[1].x_label;
        add_costs(comparison, study, store, [] { return false; });
    }
    TemporaryFolder folder;
    Comparison comparison;
    std::string without;  // label of the axis of costs before they were measured
};

}  // namespace

TEST_CASE("costs of models: each model has a CPU cost, and a share of the CPU time of a run") {
    const Compared c("");
    for (const ComparedModel& model : c.comparison.models) {
        REQUIRE(model.cost);
        CHECK(model.cost->low_s > 0);
        CHECK(model.cost->low_s <= model.cost->median_s);
        CHECK(model.cost->median_s <= model.cost->high_s);
        REQUIRE(model.radio_share);
        CHECK(*model.radio_share > 0);
        CHECK(*model.radio_share <= 1);
    }
    CHECK(c.comparison.cost_text.find("median of 5 measurements, each of 0.05 s") !=
          std::string::npos);
    CHECK(c.comparison.cost_text.find("of a run's CPU time") != std::string::npos);
    CHECK(c.without.find("per run") != std::string::npos);
    const Chart chart = comparison_charts(c.comparison)[1];
    CHECK(chart.x_label.find("to find receivers per frame") != std::string::npos);
    CHECK(chart.series[0].points[0].x == 1e6 * c.comparison.models[0].cost->median_s);
}

TEST_CASE(
    "costs of models: if no frames are sent, no costs are given, and the chart shows the CPU time "
    "of runs") {
    const Compared c("off = [\"0 s\"]");
    for (const ComparedModel& model : c.comparison.models) CHECK_FALSE(model.cost);
    CHECK(c.comparison.cost_text.empty());
    CHECK(comparison_charts(c.comparison)[1].x_label == c.without);
}

}  // namespace compare_cost_test
