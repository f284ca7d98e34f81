// SPDX-License-Identifier: MIT
#include "study/calibration/free_parameters.hpp"

#include "scenario/tables/read_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rovernet {
namespace {

/// Calls visit(field, member of a default model) for each field of the model with this name.
template <class Visitor>
void for_each_field_of(std::string_view model, Visitor&& visit) {
    for_each_model([&]<class M>() {
        if (M::name != model) return;
        for_each_field<M>([&](const auto& f) { visit(f, M{}.*f.member); });
    });
}

/// Unit in which number_in() returns a parameter; empty for a bare number.
template <class T>
std::string_view unit_of(const T& v) {
    if constexpr (requires { v.has_value(); }) {
        return unit_of(typename T::value_type{});
    } else if constexpr (IsQuantity<T>) {
        return base_unit(dimension_of(v));
    } else {
        return "";
    }
}

bool is_free(const Fit& fit) { return fit.way != Fit::Way::none && fit.way != Fit::Way::spread; }

/// Sets a parameter. @throws InputError at `where` if the value is out of its range
template <class T>
void set_parameter(const auto& f, T& member, double value, const Location& where) {
    set_number(member, value);
    if (f.range.contains(value)) return;
    const std::string_view unit = unit_of(member);
    Value text = unit.empty() ? Value(value) : Value(fmt::format("{} {}", value, unit));
    text.where = where;
    throw_outside(text, f.name, f.range);
}

std::map<std::string, double> bases_of(std::span<const FreeParameter> free) {
    std::map<std::string, double> out;
    for (const FreeParameter& p : free) out[std::string(p.key)] = p.fit.base;
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
    for_each_field_of(model, [&](const auto& f, const auto& member) {
        if (!is_free(f.fit)) return;
        out.push_back(
            {model, f.name, unit_of(member), f.fit, f.range.low == 0 && f.range.low_included});
    });
    return out;
}

std::string_view key_determined(std::string_view model, Fit::Way way) {
    std::string_view key;
    for_each_field_of(model, [&](const auto& f, const auto&) {
        if (f.fit.way == way) key = f.name;
    });
    return key;
}

std::vector<FreeParameter> with_bases(std::vector<FreeParameter> free, const KnownLinks& known,
                                      const Scenario& scenario) {
    constexpr double first_step = 8, last_step = 0.25;
    const auto is_searched = [](const FreeParameter& p) { return p.fit.way == Fit::Way::searched; };
    if (std::none_of(free.begin(), free.end(), is_searched) || known.scene->open_field())
        return free;
    const SearchedError error(known, scenario);
    double least = error(free);
    for (double step = first_step; step >= last_step;) {
        bool better = false;
        for (FreeParameter& p : free) {
            if (!is_searched(p)) continue;
            const double here = p.fit.base;
            double best = here;
            for (const double there : {here - step, here + step}) {
                if (there < 0) continue;
                p.fit.base = there;
                const double found = error(free);
                if (found < least) {
                    least = found;
                    best = there;
                }
            }
            p.fit.base = best;
            better = better || best != here;
        }
        if (!better) step /= 2;
    }
    return free;
}

Propagation model_with(const Scenario& scenario, std::string_view model,
                       const std::map<std::string, double>& values) {
    PropagationTable propagation = scenario.propagation;
    const auto names = PropagationTable::names();
    propagation.model =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), model) - names.begin());
    propagation.for_each([&]<class M>(M& each, bool chosen) {
        for_each_field<M>([&](const auto& f) {
            const auto value = chosen ? values.find(std::string(f.name)) : values.end();
            if (value != values.end() && is_free(f.fit))
                set_parameter(f, each.*f.member, value->second, scenario.propagation_where);
        });
    });
    check_given(propagation, "propagation model", scenario.propagation_where);
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
            loss.offset -= free[j].fit.base * loss.columns[j];
        }
        out.push_back(std::move(loss));
    }
    return out;
}

}  // namespace rovernet
