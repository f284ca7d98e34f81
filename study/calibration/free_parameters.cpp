// SPDX-License-Identifier: MIT
#include "study/calibration/free_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace rovernet {
namespace {

constexpr double far_from_zero = 500;  // [dB]

constexpr std::array all_free{
    FreeParameter{.model = "disc", .key = "range", .unit = "m"},
    FreeParameter{.model = "itu_indoor", .key = "coefficient", .base = 30},
    FreeParameter{.model = "log_distance", .key = "exponent", .base = 2},
    FreeParameter{.model = "log_distance", .key = "excess", .unit = "dB", .base = far_from_zero},
    FreeParameter{.model = "multi_wall", .key = "exponent", .base = 2},
    FreeParameter{.model = "multi_wall", .key = "excess", .unit = "dB", .base = far_from_zero},
    FreeParameter{.model = "multi_wall", .key = "light_wall", .unit = "dB", .non_negative = true},
    FreeParameter{.model = "multi_wall", .key = "heavy_wall", .unit = "dB", .non_negative = true},
    FreeParameter{.model = "raytrace_2007", .key = "coefficient", .base = 30},
    FreeParameter{.model = "raytrace_2007", .key = "wall_factor", .unit = "", .non_negative = true},
    FreeParameter{.model = "rays",
                  .key = "wall_loss",
                  .unit = "dB",
                  .base = 10,
                  .non_negative = true,
                  .searched = true},
    FreeParameter{.model = "rays",
                  .key = "reflection_loss",
                  .unit = "dB",
                  .base = 6,
                  .non_negative = true,
                  .searched = true},
};

std::map<std::string, double> bases_of(std::span<const FreeParameter> free) {
    std::map<std::string, double> out;
    for (const FreeParameter& p : free) out[std::string(p.key)] = p.base;
    return out;
}

/// Mean squared error [dB^2] of the model on some of the links.
class SearchedError {
  public:
    SearchedError(const KnownLinks& known, const Scenario& scenario)
        : known_(known), scenario_(scenario), every_(1 + known.links.size() / most_links) {}

    double operator()(std::span<const FreeParameter> free) const {
        const Propagation model = model_with(scenario_, free.front().model, bases_of(free));
        std::vector<std::pair<double, bool>> errors;  // [dB], and whether the link was seen
        double mean = 0, seen = 0;
        for (std::size_t i = 0; i < known_.links.size(); i += every_) {
            const KnownLink& link = known_.links[i];
            model.check_frequency(link.frequency);
            errors.emplace_back(known_.loss_by(model, link) - link.loss, !link.unseen);
            if (link.unseen) continue;
            mean += errors.back().first;
            ++seen;
        }
        mean = known_.measured && seen > 0 ? mean / seen : 0;
        double sum = 0;
        for (const auto& [error, was_seen] : errors) {
            const double off = was_seen ? error - mean : std::min(0.0, error - mean);
            sum += off * off;
        }
        return sum / static_cast<double>(errors.size());
    }

  private:
    static constexpr std::size_t most_links = 200;
    const KnownLinks& known_;
    const Scenario& scenario_;
    std::size_t every_;
};

}  // namespace

std::vector<FreeParameter> free_parameters(std::string_view model) {
    std::vector<FreeParameter> out;
    std::copy_if(all_free.begin(), all_free.end(), std::back_inserter(out),
                 [&](const FreeParameter& p) { return p.model == model; });
    return out;
}

std::vector<FreeParameter> with_bases(std::vector<FreeParameter> free, const KnownLinks& known,
                                      const Scenario& scenario) {
    constexpr double first_step = 8, last_step = 0.25;
    const bool searched =
        std::any_of(free.begin(), free.end(), [](const FreeParameter& p) { return p.searched; });
    if (!searched || known.scene->open_field()) return free;
    const SearchedError error(known, scenario);
    double least = error(free);
    for (double step = first_step; step >= last_step;) {
        bool better = false;
        for (FreeParameter& p : free) {
            if (!p.searched) continue;
            const double here = p.base;
            double best = here;
            for (const double there : {here - step, here + step}) {
                if (there < 0) continue;
                p.base = there;
                const double found = error(free);
                if (found < least) {
                    least = found;
                    best = there;
                }
            }
            p.base = best;
            better = better || best != here;
        }
        if (!better) step /= 2;
    }
    return free;
}

Propagation model_with(const Scenario& scenario, std::string_view model,
                       const std::map<std::string, double>& values) {
    Table table;
    table.set("model", model);
    for (const FreeParameter& p : free_parameters(model)) {
        const auto value = values.find(std::string(p.key));
        if (value == values.end()) continue;
        table.set(p.key, p.unit.empty() ? Value(value->second)
                                        : Value(fmt::format("{} {}", value->second, p.unit)));
    }
    PropagationTable propagation = scenario.propagation;
    Value document(std::move(table));
    document.where = scenario.propagation_where;
    read_propagation(document, propagation);
    return propagation.make().median();
}

std::vector<LinearLoss> linear_losses(const KnownLinks& known, const Scenario& scenario,
                                      std::string_view model, std::span<const FreeParameter> free) {
    const std::map<std::string, double> bases = bases_of(free);
    const Propagation at_base = model_with(scenario, model, bases);
    std::vector<Propagation> moved;
    for (const FreeParameter& p : free) {
        auto values = bases;
        values[std::string(p.key)] += 1;
        moved.push_back(model_with(scenario, model, values));
    }
    std::vector<LinearLoss> out;
    for (const KnownLink& link : known.links) {
        at_base.check_frequency(link.frequency);
        LinearLoss loss{.offset = known.loss_by(at_base, link), .columns = {}};
        const double there = loss.offset;
        for (std::size_t j = 0; j < free.size(); ++j) {
            loss.columns.push_back(known.loss_by(moved[j], link) - there);
            loss.offset -= free[j].base * loss.columns[j];
        }
        out.push_back(std::move(loss));
    }
    return out;
}

}  // namespace rovernet
