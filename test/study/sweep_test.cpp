// SPDX-License-Identifier: MIT
#include "study/sweep.hpp"

#include "experiment/version.hpp"
#include "mobility/kept_planners.hpp"
#include "sim/error.hpp"
#include "study/explain.hpp"
#include "study/merge.hpp"
#include "study/results.hpp"
#include "study/results_csv.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <map>

namespace sweep_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

/// Robots in random places: replications differ.
const std::string scattered = R"([scenario]
name = "scattered"
duration = "2 s"
[propagation]
model = "disc"
range = "30 m"
[[robot]]
name = "A"
at = ["50 m", "50 m"]
[[robot]]
name = "r"
count = 20
place = { model = "uniform", area = [["0 m", "0 m"], ["100 m", "100 m"]] }
[[traffic]]
from = "A"
size = "20 B"
)";

const std::string study_keys = R"([study]
replications = 3
vary."propagation.range" = ["15 m", "30 m"]
)";

/// The store's file in a folder, and its study.
struct Bench {
    explicit Bench(const std::string& text) { folder.write("s.toml", text); }
    Study study(std::vector<std::string> set = {}) const {
        return Study(folder.path("s.toml"), {.set = std::move(set)});
    }
    std::string store() const { return folder.path("s.db"); }

    SweepResult sweep(SweepOptions options = {}, const std::vector<std::string>& set = {}) const {
        Study s = study(set);
        Store db = open_store(store(), s);
        return rovernet::sweep(s, db, options);
    }
    std::string csv() const {
        std::string text;
        write_csv(Store::open(store()), {}, [&](std::string_view piece) { text += piece; });
        return text;
    }
    TemporaryFolder folder;
};

std::string message_of(const Bench& bench, const std::vector<std::string>& set = {}) {
    try {
        Study study = bench.study(set);
        open_store(bench.store(), study);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("sweep: every replication of every point runs once, and a second sweep runs nothing") {
    const Bench bench(scattered + study_keys);
    const SweepResult first = bench.sweep();
    CHECK(first.progress.finished == 6);
    CHECK(first.progress.failed == 0);
    CHECK_FALSE(first.stopped);
    const std::string csv = bench.csv();
    const SweepResult again = bench.sweep();
    CHECK(again.progress.before == 6);
    CHECK(again.progress.finished == 0);
    CHECK(bench.csv() == csv);
}

TEST_CASE("sweep: a run of a sweep equals the same run made separately") {
    const Bench bench(scattered + study_keys);
    bench.sweep();
    const Store store = Store::open(bench.store());
    for (const StoredRun& run : store.runs()) {
        Study study = bench.study();
        KeptPlanners kept;
        const Measurement alone = measure(study.scenario(run.point, run.replication), kept);
        CHECK(alone.fingerprint == run.measurement.fingerprint);
        const FoundRun found = find_run(store, run.id);
        CHECK(found.run.measurement.metrics == alone.metrics);
    }
}

TEST_CASE(
    "sweep: the metrics of a run exclude its warm-up, and the length of the warm-up is stored") {
    const Bench bench(scattered + "every = \"500 ms\"\n");
    KeptPlanners kept;
    const auto value = [&](const std::vector<std::string>& set, const std::string& name) {
        const Measurement m = measure(bench.study(set).scenario(0, 0), kept);
        const auto found = std::find_if(m.metrics.begin(), m.metrics.end(),
                                        [&](const MetricValue& v) { return v.name == name; });
        return *found->value;
    };
    CHECK(value({}, "messages") == 5);  // at 0, 0.5 ... 2 s
    CHECK(value({"study.warmup=1"}, "messages") == 3);
    CHECK(value({"study.warmup=1"}, "warmup_s") == 1);
}

TEST_CASE("sweep: results have the same bytes from one worker and from five") {
    const Bench one(scattered + study_keys), five(scattered + study_keys);
    one.sweep({.workers = 1});
    five.sweep({.workers = 5});
    CHECK(one.csv() == five.csv());
}

TEST_CASE(
    "sweep: paths of robots in a replication are searched only once, with any number of workers") {
    const std::string walk = R"([scenario]
duration = "60 s"
[scene]
map = "wall.pgm"
size = ["20 m", "20 m"]
[[robot]]
name = "r"
count = 4
radius = "0.2 m"
place = { model = "uniform", area = [["1 m", "1 m"], ["19 m", "19 m"]] }
move = { model = "random_waypoint" }
[[traffic]]
from = "r0"
size = "20 B"
[study]
replications = 5
vary."propagation.model" = ["friis", "log_distance", "two_ray"]
)";
    const auto swept = [&](std::size_t workers, bool on_one) {
        const Bench bench(walk);
        std::string wall = "P1 20 20\n";
        for (int row = 0; row < 20; ++row)
            for (int column = 0; column < 20; ++column)
                wall += column == 10 && row > 1 ? "1 " : "0 ";
        bench.folder.write("wall.pgm", wall);
        const SweepResult result =
            bench.sweep({.workers = workers, .replication_on_one_worker = on_one});
        CHECK(result.progress.finished == 15);
        return std::pair(result.progress.searches, bench.csv());
    };
    const auto [once, csv] = swept(1, false);
    CHECK(once > 20);
    for (const std::size_t workers : {2U, 3U, 4U, 8U}) {
        const auto [searches, same_csv] = swept(workers, true);
        CHECK(searches == once);
        CHECK(same_csv == csv);
        CHECK(swept(workers, false).second == csv);
    }
}

TEST_CASE(
    "sweep: in a given replication, robots have the same positions for all points of the study") {
    // The larger range reaches at least those that the smaller one does.
    const Bench bench(scattered + study_keys);
    bench.sweep({}, {"study.replications=10"});
    std::map<std::uint32_t, std::vector<double>> deliveries;
    for (const auto& v : Store::open(bench.store()).values("deliveries")) {
        deliveries[v.replication].push_back(*v.value);
    }
    bool differ = false;
    for (const auto& [replication, values] : deliveries) {
        REQUIRE(values.size() == 2);
        CHECK(values[0] <= values[1]);
        differ = differ || values[0] != deliveries[0][0];
    }
    CHECK(differ);  // from one replication to the next
}

TEST_CASE("sweep: after values and replications are added, only the missing runs are made") {
    const Bench bench(scattered + study_keys);
    bench.sweep();
    const SweepResult more =
        bench.sweep({}, {"study.vary={ \"propagation.range\" = [\"5 m\", \"15 m\", \"30 m\"] }",
                         "study.replications=4"});
    CHECK(more.progress.before == 6);
    CHECK(more.progress.finished == 6);
    const Bench whole(scattered + study_keys);
    whole.sweep({}, {"study.vary={ \"propagation.range\" = [\"5 m\", \"15 m\", \"30 m\"] }",
                     "study.replications=4"});
    CHECK(bench.csv() == whole.csv());
}

TEST_CASE("sweep: runs of a different scenario or version are not mixed with existing runs") {
    const Bench bench(scattered + study_keys);
    bench.sweep();
    const std::string csv = bench.csv();
    const std::string text = message_of(bench, {"scenario.seed=2"});
    CHECK(text.find("scenario.seed was 1 and is now 2") != std::string::npos);
    CHECK(text.find("--fresh") != std::string::npos);
    CHECK(text.find("a different scenario") == std::string::npos);
    const std::string other =
        message_of(bench, {"scenario.seed=2", "scenario.duration=9 s", "radio.power=3 dBm",
                           "radio.sensitivity=-70 dBm", "radio.antenna_gain=1 dB", "routing.ttl=3",
                           "radio.noise_figure=5 dB"});
    CHECK(other.find(
              "5 more values are different: the store probably belongs to a different scenario") !=
          std::string::npos);
    CHECK(message_of(bench, {"study.warmup=1 s"})
              .find("the warmup of [study] was \"0 s\" and is "
                    "now \"1 s\"") != std::string::npos);
    // The scenario's own value of a varied key has no effect, and so is no reason.
    const std::string seed = message_of(bench, {"propagation.range=9 m", "scenario.seed=2"});
    CHECK(seed.find("this point (reason: scenario.seed was 1 and is now 2);") != std::string::npos);
    // A value that is varied no more is the reason, whatever else is the same.
    const std::string fewer =
        message_of(bench, {"study.vary={ \"propagation.range\" = [\"30 m\"] }"});
    CHECK(fewer.find(
              "the store has runs of propagation.range=15 m, but the study does not have "
              "this point (reason: [study] no longer contains this point); expected --fresh") !=
          std::string::npos);
    CHECK(fewer.find("the map or") == std::string::npos);
    { Store::open_to_write(bench.store()).set_property("version", "0.0.9 (abc)"); }
    CHECK(message_of(bench).find("0.0.9 (abc)") != std::string::npos);
    CHECK(bench.csv() == csv);
}

TEST_CASE("sweep: a failed run is stored with its reason, and repeated by the next sweep") {
    const Bench bench(scattered + study_keys);
    // The event limit is met by the larger range only.
    std::uint64_t most = 0, least = 1'000'000;
    bench.sweep();
    for (const auto& v : Store::open(bench.store()).values("events")) {
        (v.point == 0 ? least : most) = static_cast<std::uint64_t>(*v.value);
    }
    REQUIRE(least < most);
    const Bench limited(scattered + study_keys);
    const auto limit = "scenario.event_limit=" + std::to_string(least + 1);
    const SweepResult result = limited.sweep({}, {limit});
    CHECK(result.progress.failed > 0);
    CHECK(result.progress.failed + result.progress.finished == 6);
    REQUIRE(result.failure);
    CHECK(result.failure->error.find("event") != std::string::npos);
    const SweepResult again = limited.sweep({}, {limit});
    CHECK(again.progress.before == result.progress.finished);
    CHECK(again.progress.failed == result.progress.failed);
    const SweepResult fast = limited.sweep({.workers = 1, .fail_fast = true}, {limit});
    CHECK(fast.progress.failed == 1);
    CHECK(fast.stopped == (fast.progress.left > 0));
}

TEST_CASE("sweep: a run that takes too long fails, and does not affect other runs") {
    const Bench bench(scattered + "[[traffic]]\nfrom = \"r0\"\nsize = \"9 B\"\nevery = \"1 ms\"\n" +
                      "[study]\nvary.\"scenario.duration\" = [\"10 ms\", \"1e8 s\"]\n");
    const SweepResult result = bench.sweep({.workers = 2, .limits = {.timeout_s = 3, .memory = {}}},
                                           {"scenario.event_limit=1000000000000"});
    CHECK(result.progress.finished == 1);
    CHECK(result.progress.failed == 1);
    CHECK(result.failure->error.find("the run took longer than 3 s") != std::string::npos);
}

TEST_CASE(
    "sweep: a stopped sweep can be continued, and gives the same result as an uninterrupted "
    "sweep") {
    const Bench bench(scattered + study_keys), whole(scattered + study_keys);
    whole.sweep();
    SweepOptions options{.workers = 1};
    std::uint64_t over = 0;
    options.progress = [&](const SweepProgress& p) { over = p.finished; };
    options.stop = [&] { return over >= 2 ? Stop::when_idle : Stop::no; };
    const SweepResult result = bench.sweep(options);
    CHECK(result.stopped);
    CHECK(result.progress.finished == 2);
    CHECK(bench.sweep().progress.finished == 4);
    CHECK(bench.csv() == whole.csv());
    const Bench at_once(scattered + study_keys);
    options.stop = [&] { return over >= 2 ? Stop::at_once : Stop::no; };
    over = 0;
    CHECK(at_once.sweep(options).stopped);
    at_once.sweep();
    CHECK(at_once.csv() == whole.csv());
}

TEST_CASE("sweep: all shards (parts of a study) together give the whole study") {
    const Bench bench(scattered + study_keys);
    std::uint64_t finished = 0;
    for (std::uint64_t i = 0; i < 3; ++i) {
        finished += bench.sweep({.workers = 1, .shard = Shard{i, 2}}).progress.finished;
        CHECK(finished == 2 * (i + 1));
    }
    CHECK(bench.sweep({.shard = Shard{3, 2}}).progress.finished == 0);
    const Bench whole(scattered + study_keys);
    whole.sweep();
    CHECK(bench.csv() == whole.csv());
}

TEST_CASE(
    "sweep: states of runs are listed in the order in which runs are divided among shards (parts "
    "of a study)") {
    const Bench bench(scattered + study_keys);
    bench.sweep({.workers = 1, .shard = Shard{1, 2}});
    Study study = bench.study();
    Store store = open_store(bench.store(), study);
    store.record({.id = run_id(study.points()[1].id, 2, code_version()),
                  .point = 1,
                  .replication = 2,
                  .error = "it broke",
                  .measurement = {}});
    using enum RunState;
    CHECK(run_states(study, store) ==
          std::vector{missing, missing, finished, finished, missing, failed});
    CHECK(finished_runs(store).size() == 2);
}

TEST_CASE("sweep: runs that are already in another given store are not repeated") {
    const Bench bench(scattered + study_keys), other(scattered + study_keys);
    other.sweep({.workers = 1, .shard = Shard{0, 4}});
    const SweepResult rest = bench.sweep({.elsewhere = finished_runs(Store::open(other.store()))});
    CHECK(rest.progress.before == 4);
    CHECK(rest.progress.finished == 2);
    {
        Study study = bench.study();
        Store store = open_store(bench.store(), study);
        merge_and_remove(store, other.store());
    }
    const Bench whole(scattered + study_keys);
    whole.sweep();
    CHECK(bench.csv() == whole.csv());
}

TEST_CASE(
    "sweep: with study.precision, a point is repeated until its interval is narrow enough or "
    "max_replications is reached") {
    const Bench bench(scattered + study_keys);
    const std::vector<std::string> wanted = {"study.precision=0.1", "study.max_replications=40"};
    bench.sweep({.workers = 3}, wanted);
    const Store store = Store::open(bench.store());
    for (const Answer& answer : answers(store, {.metrics = {"delivery_ratio"}}).list) {
        const double half = (*answer.high - *answer.low) / 2;
        CHECK((half <= 0.1 || answer.values.size() == 40));
    }
    CHECK(bench.sweep({}, wanted).progress.finished == 0);
    const Bench one(scattered + study_keys);
    one.sweep({.workers = 1}, wanted);
    CHECK(one.csv() == bench.csv());
}

TEST_CASE("sweep: a point that does not reach its precision is reported with its interval") {
    const Bench bench(scattered + study_keys);
    const std::vector<std::string> wanted = {"study.precision=0.01", "study.max_replications=8"};
    const SweepResult result = bench.sweep({.workers = 3}, wanted);
    REQUIRE(result.imprecise.size() == 2);
    CHECK(result.imprecise[1].point == 1);
    CHECK(result.imprecise[1].values == 8);
    CHECK(*result.imprecise[1].half_width > 0.01);
    // A sweep with nothing left to run tells it again.
    CHECK(bench.sweep({}, wanted).imprecise.size() == 2);
    CHECK(bench.sweep({}, {"study.precision=0.9"}).imprecise.empty());
    CHECK(bench.sweep({}).imprecise.empty());
}

TEST_CASE("sweep: with study.precision, a point with a failed run gets no further replications") {
    const Bench bench(scattered + study_keys);
    const SweepResult result = bench.sweep(
        {}, {"study.precision=1e-9", "study.max_replications=50", "scenario.event_limit=1"});
    CHECK(result.progress.failed == 6);
    CHECK_FALSE(result.stopped);
}

TEST_CASE(
    "explain: the command that repeats a run sets the options of the sweep and the values of the "
    "run's point") {
    const Bench bench(scattered + study_keys);
    bench.sweep({}, {"scenario.name=it's"});
    const Store store = Store::open(bench.store());
    const FoundRun found = find_run(store, "1/2");
    const std::string command = run_command(store, found.point, found.run.replication);
    CHECK(command.starts_with("rovernet run "));
    CHECK(
        command.ends_with("s.toml --set 'scenario.name=it'\\''s' --set "
                          "'propagation.range=\"30 m\"' --replication 2"));
    CHECK(find_run(store, found.run.id.substr(0, 10)).run.id == found.run.id);
    CHECK_THROWS_AS(find_run(store, "7/0"), std::invalid_argument);
    CHECK_THROWS_AS(find_run(store, ""), std::invalid_argument);
}

}  // namespace sweep_test
