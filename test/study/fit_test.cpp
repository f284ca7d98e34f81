// SPDX-License-Identifier: MIT
// Fits against numpy and scipy: the vectors fit_*.csv.
#include "models/propagation/friis.hpp"
#include "study/calibration/disc_fit.hpp"
#include "study/statistics/least_squares.hpp"
#include "study/statistics/tobit.hpp"
#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace fit_test {
using namespace rovernet;
using test::near;
using test::Vectors;

namespace {

constexpr double tolerance = 1e-8;        // as the vectors' README states
constexpr double tobit_tolerance = 1e-4;  // likewise: the peer's optimiser stops there
const double free_space_1m = free_space_db(1, {2450e6});  // [dB]

double x_of(double d) { return 10 * std::log10(std::max(d, 1.0)); }

struct Link {
    double x, light, heavy, loss;
};

/// The links of fit_links.csv for a model: columns(link) are its row, offset(link) what is not
/// fitted.
Observations observations(const std::function<std::vector<double>(const Link&)>& columns,
                          const std::function<double(const Link&)>& offset) {
    const Vectors links("fit_links.csv");
    Observations out;
    for (std::size_t i = 0; i < links.size(); ++i) {
        const Link link{x_of(links.number(i, "distance_m")), links.number(i, "light"),
                        links.number(i, "heavy"), links.number(i, "loss_db")};
        const auto row = columns(link);
        out.columns = row.size();
        out.add(row, link.loss - offset(link),
                static_cast<std::uint32_t>(links.number(i, "group")));
    }
    return out;
}

struct Case {
    std::string model;
    std::vector<std::string> parameters;
    Observations data;
};

std::vector<Case> cases() {
    const auto at_1m = [](const Link&) { return free_space_1m; };
    const auto itu = [](const Link&) { return 20 * std::log10(2450.0) - 28; };
    const auto free_space = [](const Link& l) { return free_space_1m + 2 * l.x; };
    return {
        {"log_distance",
         {"exponent"},
         observations([](const Link& l) { return std::vector{l.x}; }, at_1m)},
        {"log_distance+excess",
         {"exponent", "excess_db"},
         observations(
             [](const Link& l) {
                 return std::vector{l.x, 1.0};
             },
             at_1m)},
        {"itu_indoor",
         {"coefficient"},
         observations([](const Link& l) { return std::vector{l.x / 10}; }, itu)},
        {"multi_wall",
         {"light_db", "heavy_db"},
         observations(
             [](const Link& l) {
                 return std::vector{l.light, l.heavy};
             },
             free_space)},
        {"multi_wall+excess+exponent",
         {"exponent", "excess_db", "light_db", "heavy_db"},
         observations(
             [](const Link& l) {
                 return std::vector{l.x, 1.0, l.light, l.heavy};
             },
             at_1m)},
    };
}

}  // namespace

TEST_CASE("least squares: coefficients and their errors equal those of numpy") {
    const Vectors expected("fit_least_squares.csv");
    int compared = 0;
    for (const Case& each : cases()) {
        const LinearFit fit = least_squares(each.data);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            if (expected.text(i, "model") != each.model) continue;
            const std::string name = expected.text(i, "parameter");
            CAPTURE(each.model);
            CAPTURE(name);
            const auto j = std::find(each.parameters.begin(), each.parameters.end(), name) -
                           each.parameters.begin();
            const auto& c = fit.coefficients[static_cast<std::size_t>(j)];
            REQUIRE(c);
            CHECK(near(c->value, expected.number(i, "value"), tolerance));
            CHECK(near(c->se_plain, expected.number(i, "se_plain"), tolerance));
            CHECK(near(c->se_by_group, expected.number(i, "se_by_group"), tolerance));
            CHECK(near(fit.rmse, expected.number(i, "rmse_db"), tolerance));
            CHECK(near(fit.sigma, expected.number(i, "sigma_db"), tolerance));
            ++compared;
        }
    }
    CHECK(compared == 10);
}

TEST_CASE(
    "least squares: a negative wall loss is fixed at 0, and the other coefficients are fitted "
    "again") {
    const Vectors expected("fit_nonnegative.csv");
    const Observations data = observations(
        [](const Link& l) {
            return std::vector{l.x, 1.0, l.light, l.heavy};
        },
        [](const Link& l) { return free_space_1m + 4 * l.light; });
    const auto compare = [&](const LinearFit& fit, std::size_t row) {
        std::size_t j = 0;
        for (const char* name : {"exponent", "excess_db", "light_db", "heavy_db"}) {
            CHECK(near(fit.coefficients[j++]->value, expected.number(row, name), tolerance));
        }
    };
    compare(least_squares(data), 0);
    const LinearFit held = least_squares(data, {false, false, true, true});
    compare(held, 1);
    CHECK(held.at_bound == std::vector<bool>{false, false, true, false});
}

TEST_CASE("least squares: a coefficient that the data do not determine is omitted and marked") {
    Observations data{.columns = 3};
    for (int i = 0; i < 20; ++i) {
        const double x = i;
        data.add(std::vector{1.0, x, 0.0}, 3 + 2 * x);
    }
    const LinearFit fit = least_squares(data);
    CHECK(!fit.coefficients[2]);
    CHECK(near(fit.coefficients[0]->value, 3, 1e-12));
    CHECK(near(fit.coefficients[1]->value, 2, 1e-12));
    CHECK(std::isnan(fit.coefficients[1]->se_by_group));  // one group
    for (std::size_t i = 0; i < 20; ++i) data.x[3 * i + 2] = 5 * data.x[3 * i + 1];
    const LinearFit twin = least_squares(data);
    CHECK(twin.coefficients[1].has_value() != twin.coefficients[2].has_value());
}

TEST_CASE("least squares: invalid input is refused") {
    CHECK_THROWS_AS(least_squares({.columns = 1}), std::invalid_argument);
    Observations data{.columns = 1};
    data.add(std::vector{1.0}, std::numeric_limits<double>::infinity());
    CHECK_THROWS_AS(least_squares(data), std::invalid_argument);
    data.y[0] = 1;
    CHECK_THROWS_AS(least_squares(data, {true, false}), std::invalid_argument);
}

TEST_CASE(
    "tobit: if far links are too weak to be seen, fits with and without them equal those of "
    "another program") {
    const Vectors links("fit_censored_links.csv"), expected("fit_censored.csv");
    constexpr double floor = -88;  // [dBm]
    Observations data{.columns = 2}, seen{.columns = 2};
    std::vector<bool> unseen;
    for (std::size_t i = 0; i < links.size(); ++i) {
        const std::vector row{1.0, -x_of(links.number(i, "distance_m"))};
        unseen.push_back(links.text(i, "level_dbm").empty());
        data.add(row, unseen.back() ? floor : links.number(i, "level_dbm"));
        if (!unseen.back()) seen.add(row, data.y.back());
    }
    const TobitFit fit = tobit(data, unseen);
    CHECK(near(fit.coefficients[0], expected.number(0, "level_at_1m_dbm"), tobit_tolerance));
    CHECK(near(fit.coefficients[1], expected.number(0, "exponent"), tobit_tolerance));
    CHECK(near(fit.sigma, expected.number(0, "sigma_db"), tobit_tolerance));
    CHECK(near(fit.negative_log_likelihood, 571.774002648, 1e-6));
    const LinearFit plain = least_squares(seen);
    CHECK(near(plain.coefficients[1]->value, expected.number(1, "exponent"), 1e-6));
}

TEST_CASE("tobit: if no value is too weak to be seen, the fit equals least squares") {
    Observations data{.columns = 2};
    std::vector<bool> unseen;
    for (int i = 0; i < 30; ++i) {
        const double x = i;
        data.add(std::vector{1.0, x}, 7 - 0.5 * x + (i * 7 % 5));
        unseen.push_back(false);
    }
    const TobitFit fit = tobit(data, unseen);
    const LinearFit plain = least_squares(data);
    CHECK(near(fit.coefficients[0], plain.coefficients[0]->value, 1e-8));
    CHECK(near(fit.coefficients[1], plain.coefficients[1]->value, 1e-8));
    CHECK(near(fit.sigma, plain.rmse, 1e-8));
    CHECK_THROWS_AS(tobit(data, {}), std::invalid_argument);
}

TEST_CASE(
    "disc fit: the range with the fewest wrong link decisions (up or down) equals that of the test "
    "vectors") {
    const Vectors links("fit_links.csv"), expected("fit_disc.csv");
    std::vector<DiscLink> all;
    for (std::size_t i = 0; i < links.size(); ++i) {
        all.push_back({links.number(i, "distance_m"),
                       links.number(i, "loss_db") <= expected.number(0, "budget_db")});
    }
    const DiscFit fit = fit_disc(all);
    CHECK(fit.wrong == static_cast<std::size_t>(expected.number(0, "best_errors")));
    CHECK(near(fit.range.value, expected.number(0, "range_m"), 1e-9));
}

TEST_CASE("disc fit: samples in which all links are up, or no link is up, can be fitted") {
    CHECK(fit_disc({{2, true}, {8, true}}).range.value == 8);
    CHECK(fit_disc({{2, false}, {8, false}}).range.value == 1);
    CHECK(fit_disc({{2, true}, {8, false}}).range.value == 4);
    CHECK_THROWS_AS(fit_disc({}), std::invalid_argument);
    CHECK_THROWS_AS(fit_disc({{0, true}}), std::invalid_argument);
}

}  // namespace fit_test
