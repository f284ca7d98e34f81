// SPDX-License-Identifier: MIT
// Fits of two measured buildings, on another drive or day: the vectors field_*_fits.csv. The
// measurements are read from the folder that ROVERNET_FIELD names.
#include "study/statistics/least_squares.hpp"
#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace field_fit_test {
using namespace rovernet;
using test::near;
using test::Vectors;

namespace {

constexpr double tolerance = 1e-6;  // as the vectors' README states

std::optional<Vectors> measured(const std::string& file) {
    const char* folder = std::getenv("ROVERNET_FIELD");
    if (!folder) {
        MESSAGE("skipped: ROVERNET_FIELD is not set");
        return std::nullopt;
    }
    return Vectors(std::string(folder) + "/", file);
}

/// A mean level, and what a model may say of it.
struct Place {
    double x;       ///< 10 log10 of the distance
    double walls;   ///< crossed
    double metres;  ///< inside of walls
    double level;   ///< [dBm]
    std::uint32_t receiver;
};

double x_of(double d) { return 10 * std::log10(std::max(d, 1.0)); }

/// Level = P0 - exponent x - loss walls - rate metres: those that are given are not fitted.
struct Model {
    std::string name;
    std::optional<double> exponent, wall, metre;
};

Observations observations(const Model& model, const std::vector<Place>& places) {
    Observations out;
    for (const Place& p : places) {
        std::vector<double> row{1};
        double known = 0;
        const auto add = [&](const std::optional<double>& given, double column) {
            if (given) {
                known -= *given * column;
            } else {
                row.push_back(-column);
            }
        };
        add(model.exponent, p.x);
        add(model.wall, p.walls);
        add(model.metre, p.metres);
        out.columns = row.size();
        out.add(row, p.level - known, p.receiver);
    }
    return out;
}

double rmse(const LinearFit& fit, const Observations& all) {
    double sse = 0;
    for (std::size_t i = 0; i < all.rows(); ++i) {
        const double error = all.y[i] - fit.predict(all.row(i));
        sse += error * error;
    }
    return std::sqrt(sse / static_cast<double>(all.rows()));
}

/// Root mean square error at the places of each receiver, by the fit of the others' first set.
double left_out(const Model& model, const std::vector<Place>& first,
                const std::vector<Place>& second) {
    std::map<std::uint32_t, LinearFit> fits;
    for (const Place& place : second) {
        if (fits.contains(place.receiver)) continue;
        std::vector<Place> others;
        std::copy_if(first.begin(), first.end(), std::back_inserter(others),
                     [&](const Place& p) { return p.receiver != place.receiver; });
        fits[place.receiver] = least_squares(observations(model, others));
    }
    double sse = 0;
    for (const Place& place : second) {
        const Observations own = observations(model, {place});
        const double error = own.y[0] - fits[place.receiver].predict(own.row(0));
        sse += error * error;
    }
    return std::sqrt(sse / static_cast<double>(second.size()));
}

/// Compares with a row of the expected values, by their columns.
void compare(const Model& model, const std::vector<Place>& first, const std::vector<Place>& second,
             const Vectors& expected, std::size_t row, const std::vector<std::string>& fitted,
             const std::string& own, const std::string& other, const std::string& without) {
    CAPTURE(model.name);
    const LinearFit fit = least_squares(observations(model, first));
    for (std::size_t j = 0; j < fitted.size(); ++j) {
        if (expected.text(row, fitted[j]).empty()) continue;
        CHECK(near(fit.coefficients[j]->value, expected.number(row, fitted[j]), tolerance));
    }
    CHECK(near(rmse(fit, observations(model, first)), expected.number(row, own), tolerance));
    CHECK(near(rmse(fit, observations(model, second)), expected.number(row, other), tolerance));
    CHECK(near(left_out(model, first, second), expected.number(row, without), tolerance));
}

}  // namespace

TEST_CASE(
    "field data: nine models fitted to levels in a flat have the coefficients and errors of the "
    "test vectors") {
    const auto cells = measured("flat/cells.csv");
    if (!cells) return;
    std::vector<Place> first, second;
    for (std::size_t i = 0; i < cells->size(); ++i) {
        const bool is_first = cells->text(i, "set") == "calibration";
        (is_first ? first : second)
            .push_back({x_of(cells->number(i, "distance_m")), cells->number(i, "crossings"),
                        cells->number(i, "wall_m"), cells->number(i, "mean_rssi_dbm"),
                        static_cast<std::uint32_t>(cells->number(i, "anchor"))});
    }
    const std::vector<Model> models{
        {"constant", 0, 0, 0},       {"friis", 2, 0, 0},         {"itu_indoor_28", 2.8, 0, 0},
        {"log_distance", {}, 0, 0},  {"cost231_3.4", 2, 3.4, 0}, {"cost231_6.9", 2, 6.9, 0},
        {"multi_wall_n2", 2, {}, 0}, {"multi_wall", {}, {}, 0},  {"per_metre", {}, 0, {}}};
    const Vectors expected("field_flat_fits.csv");
    REQUIRE(expected.size() == models.size());
    for (std::size_t row = 0; row < models.size(); ++row) {
        REQUIRE(expected.text(row, "model") == models[row].name);
        compare(models[row], first, second, expected, row,
                {"p0_dbm", "exponent_or_wall", "wall_db"}, "rmse_calibration_db", "rmse_robot_db",
                "rmse_left_out_anchor_db");
    }
}

TEST_CASE(
    "field data: five models fitted to levels in a laboratory have the coefficients and errors of "
    "the test vectors") {
    const auto links = measured("lab/links.csv"), sensors = measured("lab/sensors.csv");
    if (!links || !sensors) return;
    std::map<std::string, std::pair<std::uint32_t, Vec3>> receivers;
    for (std::size_t i = 0; i < sensors->size(); ++i) {
        receivers[sensors->text(i, "sensor")] = {
            static_cast<std::uint32_t>(i),
            {sensors->number(i, "x_m"), sensors->number(i, "y_m"), sensors->number(i, "z_m")}};
    }
    std::vector<Place> first, second;
    for (std::size_t i = 0; i < links->size(); ++i) {
        const auto& [number, at] = receivers.at(links->text(i, "sensor"));
        const Vec3 from{links->number(i, "x_m"), links->number(i, "y_m"), links->number(i, "z_m")};
        (links->text(i, "set") == "1" ? first : second)
            .push_back({x_of(distance(from, at)), 0, 0, links->number(i, "median_dbm"), number});
    }
    const std::vector<Model> models{{"constant", 0, 0, 0},
                                    {"friis", 2, 0, 0},
                                    {"itu_indoor_30", 3, 0, 0},
                                    {"itu_site_general_office_los", 1.46, 0, 0},
                                    {"log_distance", {}, 0, 0}};
    const Vectors expected("field_lab_fits.csv");
    for (std::size_t row = 0; row < models.size(); ++row) {
        REQUIRE(expected.text(row, "model") == models[row].name);
        compare(models[row], first, second, expected, row, {"p0_dbm", "exponent"}, "rmse_set1_db",
                "rmse_set2_db", "rmse_left_out_sensor_db");
    }
}

}  // namespace field_fit_test
