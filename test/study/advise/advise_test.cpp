// SPDX-License-Identifier: MIT
#include "study/advise/advise.hpp"

#include "models/propagation/list.hpp"
#include "scenario/document/toml.hpp"
#include "study/advise/advise_chart.hpp"
#include "study/advise/advise_cost.hpp"
#include "study/sweep.hpp"
#include "test/scene/temporary_folder.hpp"
#include "test/study/small_scenarios.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace advise_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

AdviceCandidates candidates_of(const std::string& text, const CandidateQuestion& question) {
    const TemporaryFolder folder;
    return candidates_for(folder.write("s.toml", text), {}, question);
}

const CandidateQuestion as_given{.models = {}, .reference = {}, .as_given = true};

std::vector<std::string> names_of(const std::vector<CandidateModel>& models) {
    std::vector<std::string> names;
    for (const CandidateModel& each : models) names.push_back(each.name);
    return names;
}

std::string error_of(const CandidateQuestion& question) {
    try {
        candidates_of(talkers, question);
    } catch (const InputError& error) {
        return error.what();
    }
    return "none";
}

/// Metric of a combination in a replication, for a study that nobody simulates.
using Metric = std::function<double(std::size_t path_loss, std::size_t reception, std::uint32_t r)>;

/// A grid of 3 path losses and 2 receptions, the last of each the reference, whose runs are made
/// up.
struct MadeUp {
    explicit MadeUp(Metric metric) : metric_(std::move(metric)) {
        for (const char* name : {"a", "b", "top"})
            grid.path_losses.push_back({name, name, {}, "", ""});
        for (const char* name : {"some", "all"})
            grid.receptions.push_back({name, name, {}, "", ""});
        grid.points = {{0, 1}, {2, 3}, {4, 5}};
    }

    Advice advice(const DecisionRule& rule) {
        return advise(grid, store, "delivery_ratio", rule, [&](const auto& wanted) {
            if (blocks >= most_blocks) return false;
            make(wanted);
            return true;
        });
    }
    void make(const std::vector<std::uint32_t>& wanted) {
        ++blocks;
        for (std::uint32_t point = 0; point < wanted.size(); ++point) {
            for (std::uint32_t r = made[point]; r < wanted[point]; ++r) {
                const double value = metric_(point / 2, point % 2, r);
                store.record({.id = std::to_string(point) + "/" + std::to_string(r),
                              .point = point,
                              .replication = r,
                              .error = {},
                              .measurement = {.metrics = {{"delivery_ratio", value}},
                                              .fingerprint = "",
                                              .started = "",
                                              .host = ""}});
            }
            made[point] = std::max(made[point], wanted[point]);
        }
    }

    AdviceCandidates grid;
    TemporaryFolder folder;
    Store store = new_store(folder.path("made_up.db"));
    std::map<std::uint32_t, std::uint32_t> made;
    int blocks = 0, most_blocks = 1000;

  private:
    static Store new_store(const std::string& path) {
        Store store = Store::open_to_write(path);
        std::vector<StoredPoint> points;
        for (std::uint32_t i = 0; i < 6; ++i) {
            Table settings;
            settings.set("point", i);
            points.push_back({i, std::to_string(i), settings});
        }
        store.set_points(points);
        return store;
    }
    Metric metric_;
};

DecisionRule rule_of(double tolerance) {
    return {
        .tolerance = tolerance, .bounds = bounds_of("delivery_ratio"), .family = 5, .most = 150};
}

const JudgedCandidate& judged(const Advice& advice, std::string_view name) {
    const auto at = std::find_if(advice.judged.begin(), advice.judged.end(),
                                 [&](const JudgedCandidate& each) { return each.name == name; });
    REQUIRE(at != advice.judged.end());
    return *at;
}

}  // namespace

TEST_CASE(
    "advise: on an open field, the reference is the exact form of `two_ray` with the reception "
    "model `sinr`") {
    const AdviceCandidates c = candidates_of(talkers, as_given);
    CHECK_FALSE(c.on_map);
    const CandidateModel& reference = c.path_losses.back();
    CHECK(reference.model == "two_ray");
    CHECK(plain_text(*reference.table.find("form")) == "exact");
    CHECK(names_of(c.receptions) == std::vector<std::string>{"threshold", "collision", "sinr"});
    const auto names = names_of(c.path_losses);
    // Disc needs a range, which the file does not give; walls are none to be seen.
    CHECK(names ==
          std::vector<std::string>{"friis", "two_ray form=ns2", "log_distance", "two_ray"});
    REQUIRE(c.left_out.size() == 1);
    CHECK(c.left_out[0].starts_with("disc: propagation model \"disc\" needs the key \"range\""));
    CHECK(c.family() == 4 * 3 - 1);
}

TEST_CASE(
    "advise: the model `disc` is tested with the most detailed reception model that works with "
    "it") {
    const AdviceCandidates c =
        candidates_of(talkers + "[propagation]\nrange = \"20 m\"\n", as_given);
    REQUIRE(c.path_losses.front().name == "disc");
    CHECK(c.receptions[c.reception_of(0)].name == "collision");
    CHECK(c.receptions[c.reception_of(1)].name == "sinr");
    CHECK(c.family() == 5 * 3 - 2);
    // Points are numbered without the combination that cannot run.
    CHECK(c.points[0][2] == std::nullopt);
    CHECK(c.points[1][0] == 2U);
    CHECK(c.exclude().size() == 1);
}

TEST_CASE("advise: on a map the reference is the most detailed model, the others are candidates") {
    const AdviceCandidates c =
        candidates_for(std::string(ROVERNET_EXAMPLES) + "/rescue/rescue.toml", {}, as_given);
    CHECK(c.on_map);
    std::vector<std::string> listed;
    for_each_model([&]<class Model>() { listed.emplace_back(Model::name); });
    const bool rays = std::find(listed.begin(), listed.end(), "rays") != listed.end();
    CHECK(c.path_losses.back().model == (rays ? "rays" : listed.back()));
    for (const CandidateModel& each : c.path_losses) {
        CHECK(std::find(listed.begin(), listed.end(), each.model) <=
              std::find(listed.begin(), listed.end(), c.path_losses.back().model));
    }
    CHECK(c.path_losses.size() > 5);
}

TEST_CASE(
    "advise: with the model `rays` as the reference, the simpler forms of `rays` are cheaper "
    "candidates") {
    const auto forms_below = [](const std::string& order, const std::string& diffraction) {
        const AdviceCandidates c =
            candidates_for(std::string(ROVERNET_EXAMPLES) + "/rescue/rescue.toml", {},
                           {.models = {"rays"},
                            .reference = {"propagation.model=rays", "propagation.order=" + order,
                                          "propagation.diffraction=" + diffraction},
                            .as_given = true});
        return names_of(c.path_losses);
    };
    using Names = std::vector<std::string>;
    CHECK(forms_below("3", "utd") == Names{"rays order=1 diffraction=none",
                                           "rays order=2 diffraction=knife_edge",
                                           "rays order=2 diffraction=utd", "rays"});
    CHECK(forms_below("2", "utd") ==
          Names{"rays order=1 diffraction=none", "rays order=2 diffraction=knife_edge", "rays"});
    CHECK(forms_below("2", "knife_edge") == Names{"rays order=1 diffraction=none", "rays"});
    CHECK(forms_below("1", "utd") == Names{"rays diffraction=none", "rays"});
    CHECK(forms_below("3", "none") == Names{"rays order=1", "rays"});
    CHECK(forms_below("1", "none") == Names{"rays"});
}

TEST_CASE("advise: candidates can be selected by their printed names") {
    const auto candidates = [](std::vector<std::string> models) {
        return names_of(
            candidates_for(std::string(ROVERNET_EXAMPLES) + "/rescue/rescue.toml", {},
                           {.models = std::move(models), .reference = {}, .as_given = true})
                .path_losses);
    };
    using Names = std::vector<std::string>;
    CHECK(candidates({"rays order=2 diffraction=utd", "friis"}) ==
          Names{"friis", "rays order=2 diffraction=utd", "rays"});
    CHECK(candidates({"rays"}).size() == 4);
    CHECK_THROWS_WITH(candidates({"rays order=2 diffraction=udt"}),
                      doctest::Contains("did you mean \"rays order=2 diffraction=utd\"?"));
}

TEST_CASE("advise: options select the reference and the candidates") {
    CandidateQuestion question = as_given;
    question.models = {"friis", "multi_wall"};
    question.reference = {"propagation.model=log_distance", "propagation.exponent=3",
                          "reception.model=collision"};
    const AdviceCandidates c = candidates_of(talkers, question);
    CHECK(names_of(c.path_losses) ==
          std::vector<std::string>{"friis", "multi_wall", "log_distance"});
    CHECK(plain_text(*c.path_losses.back().table.find("exponent")) == "3");
    CHECK(plain_text(*c.path_losses[1].table.find("exponent")) == "2.0");
    CHECK(names_of(c.receptions) == std::vector<std::string>{"threshold", "collision"});
}

TEST_CASE(
    "advise: an error in the reference or in a candidate is reported with the option that selects "
    "it") {
    const auto reference = [](const std::string& text) {
        return error_of({.models = {}, .reference = {text}, .as_given = true});
    };
    CHECK(reference("radio.power=3")
              .starts_with("--reference radio.power=3: expected "
                           "propagation.KEY=VALUE or reception.KEY=VALUE"));
    CHECK(reference("propagation.model=raays").find("unknown propagation model \"raays\"") !=
          std::string::npos);
    CHECK(reference("propagation.model=raays").starts_with("--reference propagation.model=raays:"));
    CHECK(reference("propagation.from=exact").find("did you mean \"form\"?") != std::string::npos);
    CHECK(reference("propagation.from=exact").starts_with("--reference propagation.from=exact:"));
    CHECK(reference("propagation.model=disc")
              .starts_with("--reference propagation.model=disc: the "
                           "reference model cannot run:"));
    CHECK(error_of({.models = {"fris"}, .reference = {}, .as_given = true})
              .starts_with("--models fris: unknown propagation model \"fris\""));
}

TEST_CASE(
    "advise: if the scenario has a shadowing model, candidates have no shadowing of their own") {
    const AdviceCandidates c =
        candidates_of(talkers + "[shadowing]\nmodel = \"link\"\nsigma = \"6 dB\"\n",
                      {.models = {"log_distance"}, .reference = {}, .as_given = false});
    REQUIRE(c.path_losses.front().name == "log_distance");
    CHECK(plain_text(*c.path_losses.front().table.find("sigma")) == "0 dB");
}

TEST_CASE(
    "advise: a candidate that is fitted to a reference of the same formula gets the reference's "
    "parameters") {
    CandidateQuestion question{
        .models = {"friis", "multi_wall"},
        .reference = {"propagation.model=log_distance", "propagation.exponent=3",
                      "propagation.sigma=0 dB", "propagation.excess=2 dB"},
        .as_given = false};
    const AdviceCandidates c = candidates_of(talkers, question);
    const CandidateModel& fitted = c.path_losses[1];
    CAPTURE(fitted.note);
    CHECK(fitted.fitted == "exponent 3.0, excess 2 dB");
    CHECK(c.path_losses[0].fitted.empty());
}

TEST_CASE("advise: a simulated study selects the candidate model that equals the reference") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", talkers);
    const AdviceCandidates c =
        candidates_for(file, {},
                       {.models = {"friis", "multi_wall"},
                        .reference = {"propagation.model=log_distance", "propagation.exponent=3.5",
                                      "propagation.sigma=0 dB", "reception.model=collision"},
                        .as_given = false});
    Study study(file, {}, c.vary(), c.exclude());
    CHECK(study.points().size() == c.family() + 1);
    Store store = open_store(folder.path("s.db"), study);
    DecisionRule rule = rule_of(0.1);
    rule.family = c.family();
    rule.most = 400;
    Advice advice = advise(c, store, "delivery_ratio", rule, [&](const auto& wanted) {
        SweepOptions options{.workers = 1};
        options.replications = wanted;
        CHECK(sweep(study, store, options).progress.failed == 0);
        return true;
    });
    CHECK(judged(advice, "friis + collision").decision.verdict() == Equivalence::outside);
    const JudgedCandidate& equal = judged(advice, "multi_wall + collision");
    CHECK(equal.decision.verdict() == Equivalence::within);
    CHECK(equal.run_error < 0.01);  // a fitted exponent has six digits
    CHECK(c.path_losses[advice.path_loss].name == "multi_wall");
    add_costs(advice, study, [] { return false; });
    CHECK(advice.reference_cost.run_s > 0);
    REQUIRE(equal.cost.transmission_s);
    CHECK(*equal.cost.transmission_s > 0);
    CHECK(advice_text(advice).find("multi_wall + ") != std::string::npos);
    // Where radio is a small part of a run, a cheap model saves nothing.
    advice.reference_cost.share = 0.03;
    CHECK(advice.saves_nothing());
    CHECK(
        advice_text(advice).starts_with("Take the reference, log_distance + collision. A run "
                                        "takes "));
    CHECK(advice_text(advice).find("the radio takes only 3 % of this time") != std::string::npos);
    advice.reference_cost.share = 0.5;
    advice.reference_cost.run_s = 2 * advice.chosen()->cost.run_s;
    CHECK_FALSE(advice.saves_nothing());
    CHECK(advice_text(advice).starts_with("Take multi_wall + "));
    CHECK(advice_charts(advice).size() == 2);
}

TEST_CASE(
    "advise: the cheapest sufficient propagation and reception models are also tested together") {
    // `a` is wrong by 0.5, `b` by 0.01, and the reception `some` by 0.01: together by 0.02.
    MadeUp study([](std::size_t p, std::size_t r, std::uint32_t) {
        return 0.9 - (p == 0 ? 0.5 : p == 1 ? 0.01 : 0) - (r == 0 ? 0.01 : 0);
    });
    const Advice advice = study.advice(rule_of(0.2));
    CHECK(judged(advice, "a + all").decision.verdict() == Equivalence::outside);
    CHECK(judged(advice, "b + all").decision.verdict() == Equivalence::within);
    CHECK(judged(advice, "top + some").decision.verdict() == Equivalence::within);
    const JudgedCandidate& both = judged(advice, "b + some");
    CHECK(both.step == AdviceStep::both);
    CHECK(std::abs(both.bias + 0.02) < 1e-12);
    CHECK(advice.chosen() == &both);
    CHECK(study.made[0] == 0);  // a + some: nobody asked
}

TEST_CASE(
    "advise: two models with small errors of their own can exceed the tolerance when used "
    "together") {
    MadeUp study([](std::size_t p, std::size_t r, std::uint32_t) {
        return 0.9 - (p == 0 ? 0.6 : p == 1 ? 0.15 : 0) - (r == 0 ? 0.15 : 0);
    });
    const Advice advice = study.advice(rule_of(0.2));
    CHECK(judged(advice, "b + some").decision.verdict() == Equivalence::outside);
    REQUIRE(advice.chosen());
    CHECK(advice.chosen()->name == "b + all");
}

TEST_CASE("advise: if no cheaper model is sufficient, the reference is advised") {
    MadeUp study(
        [](std::size_t p, std::size_t r, std::uint32_t) { return p == 2 && r == 1 ? 0.9 : 0.4; });
    const Advice advice = study.advice(rule_of(0.2));
    CHECK_FALSE(advice.chosen());
    CHECK(advice.path_loss == 2);
    CHECK(advice.reception == 1);
    CHECK(advice_text(advice).starts_with("Take the reference, top + all:"));
}

TEST_CASE("advise: an undecided candidate counts as insufficient, and the advice names it") {
    // The tolerance itself, with much noise: 150 replications do not tell.
    MadeUp study([](std::size_t p, std::size_t, std::uint32_t r) {
        return p == 0 ? (r % 2 == 0 ? 1.0 : 0.4) : 0.5;
    });
    const Advice advice = study.advice(rule_of(0.2));
    const JudgedCandidate& a = judged(advice, "a + all");
    CHECK(a.decision.verdict() == Equivalence::undecided);
    CHECK(a.decision.n() == 120);  // then the forecast is beyond 150
    CHECK(advice.chosen()->name == "b + some");
    CHECK(advice_text(advice).find(
              "These models are undecided after 150 replications, and count as insufficient: "
              "a + all") != std::string::npos);
}

TEST_CASE(
    "advise: a candidate gets no more runs after its verdict, nor after a cheaper candidate is "
    "chosen") {
    // `a` is the reference at once; `b` is noisy, and never decided.
    MadeUp study([](std::size_t p, std::size_t, std::uint32_t r) {
        return p == 1 ? (r % 2 == 0 ? 1.0 : 0.0) : 0.5;
    });
    const Advice advice = study.advice(rule_of(0.2));
    const std::size_t decided = *judged(advice, "a + all").decision.decided_at();
    CHECK_FALSE(judged(advice, "b + all").needed);
    CHECK(study.made[3] == study.made[1]);
    CHECK(study.made[1] >= decided);
    CHECK(study.made[1] < decided + std::max<std::size_t>(10, decided / 4) + 1);
    CHECK(advice.replications == study.made[5]);
}

TEST_CASE("advise: existing runs in the store do not change the advice") {
    const auto metric = [](std::size_t p, std::size_t r, std::uint32_t i) {
        const double noise = 0.1 * static_cast<double>((i * 7 + p * 3 + r) % 10) / 10;
        return 0.5 + noise + (p == 0 ? 0.3 : 0);
    };
    MadeUp fresh(metric), resumed(metric);
    resumed.make({90, 90, 90, 90, 90, 90});
    const Advice a = fresh.advice(rule_of(0.2)), b = resumed.advice(rule_of(0.2));
    REQUIRE(a.judged.size() == b.judged.size());
    for (std::size_t i = 0; i < a.judged.size(); ++i) {
        CHECK(a.judged[i].name == b.judged[i].name);
        CHECK(a.judged[i].decision.decided_at() == b.judged[i].decision.decided_at());
        CHECK(a.judged[i].decision.differences() == b.judged[i].decision.differences());
    }
    CHECK(a.chosen()->name == b.chosen()->name);
}

TEST_CASE(
    "advise: a candidate whose error is near the tolerance is not tested with all replications") {
    // `a` is 0.2 away on average, which is the tolerance; `b` is the reference.
    MadeUp study([](std::size_t p, std::size_t, std::uint32_t r) {
        return p == 0 ? (r % 2 == 0 ? 0.5 : 0.9) : 0.5;
    });
    DecisionRule rule = rule_of(0.2);
    rule.most = 4000;
    const Advice advice = study.advice(rule);
    CHECK(advice.chosen()->name == "b + some");
    CHECK(judged(advice, "a + all").decision.verdict() == Equivalence::undecided);
    CHECK(study.made[1] >= 100);
    CHECK(study.made[1] < 200);
    CHECK_FALSE(advice.stopped);
}

TEST_CASE(
    "advise: if the command is stopped, its advice is preliminary and lists undecided candidates") {
    const auto metric = [](std::size_t p, std::size_t, std::uint32_t r) {
        return p == 0 ? (r % 2 == 0 ? 0.5 : 1.0) : p == 1 ? 0.0 : 0.5;
    };
    MadeUp whole(metric), cut(metric);
    cut.most_blocks = 3;
    CHECK_FALSE(whole.advice(rule_of(0.2)).stopped);
    const Advice advice = cut.advice(rule_of(0.2));
    CHECK(advice.stopped);
    CHECK(advice.replications == 30);
    CHECK(judged(advice, "a + all").decision.n() == 30);
    CHECK(advice_text(advice).starts_with("Interim: Take the reference, top + all"));
    CHECK(advice_text(advice).find(
              "undecided when the command was stopped, and count as insufficient so far: ") !=
          std::string::npos);
    CHECK(advice_text(advice).find("would decide") != std::string::npos);
}

TEST_CASE(
    "advise: if the command is stopped before any run, its advice states that nothing is known") {
    MadeUp study([](std::size_t, std::size_t, std::uint32_t) { return 0.5; });
    study.most_blocks = 0;
    const Advice advice = study.advice(rule_of(0.2));
    CHECK(advice.knows_nothing());
    CHECK(advice_text(advice).starts_with(
        "Interim: nothing is known yet, because no candidate was compared with top + all."));
    CHECK(advice_text(advice).find("tolerance") == std::string::npos);
}

TEST_CASE(
    "advise: replications are added in blocks of 10, or of a quarter of the existing ones if that "
    "is more") {
    CHECK(next_block(0, 4000) == 10);
    CHECK(next_block(10, 4000) == 20);
    CHECK(next_block(80, 4000) == 100);
    CHECK(next_block(3900, 4000) == 4000);
    CHECK(next_block(0, 3) == 3);
}

}  // namespace advise_test
