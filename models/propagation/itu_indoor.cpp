// SPDX-License-Identifier: MIT
#include "models/propagation/itu_indoor.hpp"

#include "models/propagation/floors_between.hpp"
#include "sim/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rovernet {
namespace {

constexpr double default_coefficient = 30;
constexpr double widest_ratio = 1.5;  // of a frequency to that of a row of the tables

struct CoefficientRow {
    Environment environment;
    double mhz;
    double N;
};

// ITU-R P.1238, table 2; a range of frequencies is represented by its middle.
constexpr std::array coefficients{
    CoefficientRow{Environment::residential, 1900, 28},
    CoefficientRow{Environment::residential, 2400, 28},
    CoefficientRow{Environment::office, 900, 33},
    CoefficientRow{Environment::office, 1250, 32},
    CoefficientRow{Environment::office, 1900, 30},
    CoefficientRow{Environment::office, 2400, 30},
    CoefficientRow{Environment::office, 4000, 28},
    CoefficientRow{Environment::office, 5200, 31},
    CoefficientRow{Environment::office, 60000, 22},
    CoefficientRow{Environment::commercial, 900, 20},
    CoefficientRow{Environment::commercial, 1250, 22},
    CoefficientRow{Environment::commercial, 1900, 22},
    CoefficientRow{Environment::commercial, 4000, 22},
    CoefficientRow{Environment::commercial, 60000, 17},
};

struct FloorRow {
    Environment environment;
    double mhz;
    int most_floors;
    double first;          // [dB] of one floor
    double second, third;  // [dB] of two and three, where they are tabulated one by one
    double each_more;      // [dB] of every further floor, where the table gives a formula
};

constexpr int by_formula = 1000;

// ITU-R P.1238, table 3.
constexpr std::array floor_losses{
    FloorRow{Environment::residential, 1900, by_formula, 4, 0, 0, 4},
    FloorRow{Environment::residential, 2400, 1, 10, 0, 0, 0},
    FloorRow{Environment::residential, 5200, 1, 13, 0, 0, 0},
    FloorRow{Environment::office, 900, 3, 9, 19, 24, 0},
    FloorRow{Environment::office, 1900, by_formula, 15, 0, 0, 4},
    FloorRow{Environment::office, 2400, 1, 14, 0, 0, 0},
    FloorRow{Environment::office, 5200, 1, 16, 0, 0, 0},
    FloorRow{Environment::commercial, 1900, by_formula, 6, 0, 0, 3},
};

/// Row of the environment with the nearest frequency by ratio; null if none is within widest_ratio.
template <class Row, std::size_t n>
const Row* nearest_row(const std::array<Row, n>& rows, Environment environment, double mhz) {
    const Row* best = nullptr;
    double best_ratio = widest_ratio;
    for (const auto& row : rows) {
        if (row.environment != environment) continue;
        const double ratio = mhz > row.mhz ? mhz / row.mhz : row.mhz / mhz;
        if (ratio <= best_ratio) {
            best = &row;
            best_ratio = ratio;
        }
    }
    return best;
}

double floor_loss_db(const FloorRow& row, int floors) {
    const int n = std::min(floors, row.most_floors);
    if (n == 0) return 0;
    if (row.most_floors == by_formula) return row.first + (n - 1) * row.each_more;
    return n == 1 ? row.first : n == 2 ? row.second : row.third;
}

template <class Row, std::size_t n>
std::string frequencies(const std::array<Row, n>& rows, Environment environment) {
    std::string list;
    for (const auto& row : rows) {
        if (row.environment != environment) continue;
        list += fmt::format("{}{} MHz", list.empty() ? "" : ", ", row.mhz);
    }
    return list;
}

double coefficient_at(const ItuIndoor& model, double mhz) {
    if (model.coefficient) return *model.coefficient;
    if (!model.environment) return default_coefficient;
    return nearest_row(coefficients, *model.environment, mhz)->N;
}

}  // namespace

void ItuIndoor::check_frequency(Hertz f) const {
    const double mhz = f.value / 1e6;
    if (!environment) {
        if (floors.value_or(0) > 0) {
            throw std::invalid_argument(
                "itu_indoor: the key \"floors\" needs the key \"environment\", which determines "
                "the loss of a floor");
        }
        return;
    }
    const auto env = name_of(*environment);
    if (!coefficient && !nearest_row(coefficients, *environment, mhz)) {
        throw std::invalid_argument(fmt::format(
            "itu_indoor: for environment \"{}\", the model has no coefficient within a factor of "
            "{} of the frequency {} MHz, but only at {}; give the key \"coefficient\"",
            env, widest_ratio, mhz, frequencies(coefficients, *environment)));
    }
    if (floors.value_or(0) == 0) return;
    const auto* row = nearest_row(floor_losses, *environment, mhz);
    if (!row || *floors > row->most_floors) {
        throw std::invalid_argument(
            fmt::format("itu_indoor: the model has no loss of {} floors for environment \"{}\" at "
                        "{} MHz; the model has losses of floors only at {}{}; expected a different "
                        "frequency or number of floors",
                        *floors, env, mhz, frequencies(floor_losses, *environment),
                        row ? fmt::format(" (at the nearest of these frequencies: up to {} floors)",
                                          row->most_floors)
                            : ""));
    }
}

double itu_indoor_db(double d, Hertz f, double N, double Lf) {
    return 20 * math::log10(f.value / 1e6) + N * math::log10(std::max(d, 1.0)) + Lf - 28;
}

Meters itu_indoor_reach(Db loss, Hertz f, double N) {
    const double more = loss.value - itu_indoor_db(1, f, N, 0);
    return {more < 0 ? 0 : math::exp10(more / N)};
}

Meters ItuIndoor::reach(Db loss, Hertz f) const {
    return itu_indoor_reach(loss, f, coefficient_at(*this, f.value / 1e6));
}

void ItuIndoor::loss(const LinkBatch& links, Db /*cutoff*/, std::span<double> out_db) const {
    const double mhz = links.frequency.value / 1e6;
    const double N = coefficient_at(*this, mhz);
    const auto* row = environment ? nearest_row(floor_losses, *environment, mhz) : nullptr;
    const auto of_model = [&](int n) { return row ? floor_loss_db(*row, n) : 0; };
    const FloorCounter floor_counter(links);
    const auto of_floors = [&](std::size_t i) {
        if (!environment) return 0.0;
        if (floors) return of_model(*floors);
        const FloorsBetween between = floor_counter.between(i);
        return of_model(static_cast<int>(std::min(between.of_model, 100.0))) + between.loss_db;
    };
    for (std::size_t i = 0; i < out_db.size(); ++i) {
        const double Lf = of_floors(i);
        out_db[i] = std::max(0.0, itu_indoor_db(links.distance(i), links.frequency, N, Lf));
    }
}

}  // namespace rovernet
