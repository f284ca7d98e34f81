// SPDX-License-Identifier: MIT
#include "models/medium/link_range.hpp"
#include "models/medium/loss_bounds.hpp"
#include "models/propagation/friis.hpp"
#include "models/propagation/log_distance.hpp"
#include "models/propagation/shadowed_range.hpp"
#include "sim/math.hpp"
#include "sim/random.hpp"
#include "study/validation/validation_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {
namespace {

constexpr Hertz frequency_of_decisions{2450e6};
constexpr Db budget_of_decisions{90};

/// Logarithm to base 10 from a table over the mantissa, as simulators make it for speed.
class LogTable {
  public:
    /// @param bits  of the mantissa that find the entry  @param linear  interpolates between two
    LogTable(int bits, bool linear) : entries_(1 << bits), linear_(linear) {
        for (int i = 0; i <= entries_; ++i) {
            const double shift = linear ? 0 : 0.5;
            table_.push_back(math::log10(1 + (i + shift) / entries_));
        }
    }
    double operator()(double x) const {
        constexpr double log10_of_2 = 0.30102999566398119521;
        int exponent = 0;
        const double mantissa = 2 * std::frexp(x, &exponent) - 1;
        const double place = mantissa * entries_;
        const auto i = static_cast<std::size_t>(place);
        const double within = place - static_cast<double>(i);
        const double log = linear_ ? table_[i] + within * (table_[i + 1] - table_[i]) : table_[i];
        return log + (exponent - 1) * log10_of_2;
    }

  private:
    int entries_;
    bool linear_;
    std::vector<double> table_;
};

/// A way to decide cases by number. @tparam Case  what is decided
template <class Case>
struct DecisionMethod {
    std::string label;
    std::function<double(const std::vector<Case>&)> count;  // all of them, to be timed
    std::function<bool(const Case&)> decide;
};

/// A method whose decision is inlined into its loop, so that the calls cost nothing.
template <class Case, class Decide>
DecisionMethod<Case> method(std::string label, Decide decide) {
    return {std::move(label),
            [decide](const std::vector<Case>& cases) mutable {
                double up = 0;
                for (const Case& each : cases) up += decide(each);
                return up;
            },
            [decide](const Case& each) mutable { return decide(each); }};
}

/// Panel of methods; the first of them is the truth.
template <class Case>
ValidationPanel decided(std::string title, const std::vector<Case>& cases,
                        const std::vector<DecisionMethod<Case>>& methods,
                        const ValidationSize& size) {
    ValidationPanel panel{.title = std::move(title),
                          .cost_label = "CPU per decision [ns]",
                          .error_label = "share of wrong decisions [-]"};
    std::vector<TimedMethod> timed;
    const auto n = static_cast<double>(cases.size());
    for (const auto& each : methods) {
        double flipped = 0;
        for (const Case& one : cases) flipped += each.decide(one) != methods.front().decide(one);
        panel.points.push_back(
            {.label = each.label, .error = flipped / n, .details = {{"flipped", flipped}}});
        timed.push_back({[&] { return each.count(cases); }, n});
    }
    set_costs(panel, timed, size.turns());
    return panel;
}

/// Squared distances [m^2] within a share of a range.
std::vector<double> near_range(double range, double share, std::size_t n) {
    std::vector<double> out;
    for (std::uint64_t i = 0; i < n; ++i) {
        const double d = range * (1 + share * (2 * validation_draw("decisions", i, 0) - 1));
        out.push_back(d * d);
    }
    return out;
}

ValidationPanel by_distance(const ValidationSize& size) {
    const double squared =
        largest_squared_distance(Friis{}, frequency_of_decisions, budget_of_decisions);
    const double at_metre = free_space_db(1, frequency_of_decisions);
    const auto tabled = [&](const LogTable& log) {
        return [log, at_metre](double d2) {
            return at_metre + 10 * log(d2) <= budget_of_decisions.value;
        };
    };
    return decided<double>(
        "in range of friis?", near_range(std::sqrt(squared), 0.01, size.of(200'000, 5'000)),
        {method<double>("logarithm",
                        [](double d2) {
                            return free_space_db(std::sqrt(d2), frequency_of_decisions) <=
                                   budget_of_decisions.value;
                        }),
         method<double>("squared range (rovernet)", [squared](double d2) { return d2 <= squared; }),
         method<double>("table of 256, linear", tabled(LogTable(8, true))),
         method<double>("table of 256, nearest", tabled(LogTable(8, false))),
         method<double>("table of 16, linear", tabled(LogTable(4, true)))},
        size);
}

/// Pair of robots under shadowing.
struct ShadowedPair {
    double squared_distance;  // [m^2]
    std::uint64_t bits;
};

ValidationPanel by_pair(const ValidationSize& size) {
    const ShadowedLoss loss =
        LogDistance{.exponent = 3, .sigma = Db{6}}.shadowed_loss(frequency_of_decisions);
    const ShadowedRange range(loss, budget_of_decisions);
    const PairDraws draws = shadowing_draws(1, 0);
    std::vector<ShadowedPair> pairs;
    const double median = loss.distance(budget_of_decisions.value);
    std::uint64_t i = 0;
    for (const double d2 : near_range(median, 0.9, size.of(200'000, 5'000))) {
        pairs.push_back({d2, draws.bits(i, i + 1)});
        ++i;
    }
    const LogTable log(8, true);
    return decided<ShadowedPair>(
        "up under shadowing?", pairs,
        {method<ShadowedPair>("logarithm and normal draw",
                              [loss](const ShadowedPair& p) {
                                  return loss(std::sqrt(p.squared_distance),
                                              PairDraws::normal_of(p.bits)) <=
                                         budget_of_decisions.value;
                              }),
         method<ShadowedPair>(
             "ShadowedRange (rovernet)",
             [range](const ShadowedPair& p) { return range.in_range(p.squared_distance, p.bits); }),
         method<ShadowedPair>("table of 256 and normal draw",
                              [loss, log](const ShadowedPair& p) {
                                  const double l = loss.at_reference +
                                                   loss.per_decade / 2 * log(p.squared_distance);
                                  return l + loss.sigma * PairDraws::normal_of(p.bits) <=
                                         budget_of_decisions.value;
                              })},
        size);
}

/// Two frames at one receiver: is the first stronger by 10 dB?
struct TwoFrames {
    double first, second;  // squared distances [m^2]
};

ValidationPanel by_level(const ValidationSize& size) {
    constexpr double capture = 10;  // [dB]
    const auto loss = [](double d) {
        return std::max(0.0, free_space_db(d, frequency_of_decisions));
    };
    std::vector<TwoFrames> pairs;
    for (std::uint64_t i = 0; i < size.of(200'000, 5'000); ++i) {
        const double a = 300 * validation_draw("levels", i, 0),
                     b = 300 * validation_draw("levels", i, 1);
        pairs.push_back({a * a, b * b});
    }
    const auto by_logarithm = [loss](const TwoFrames& f) {
        return loss(std::sqrt(f.second)) - loss(std::sqrt(f.first)) >= capture;
    };
    return decided<TwoFrames>(
        "stronger by 10 dB?", pairs,
        {method<TwoFrames>("two logarithms", by_logarithm),
         method<TwoFrames>("LossBounds (rovernet)",
                           [bounds = LossBounds{}, loss, by_logarithm](const TwoFrames& f) mutable {
                               const auto first = bounds.at(f.first, loss);
                               const auto second = bounds.at(f.second, loss);
                               if (second.low - first.high >= capture) return true;
                               if (second.high - first.low < capture) return false;
                               return by_logarithm(f);
                           })},
        size);
}

std::string decision_sentence(const ValidationPanel& panel) {
    const ValidationPoint &truth = panel.points[0], &ours = panel.points[1];
    const double flipped = detail_of(ours, "flipped");
    std::string out = fmt::format(
        "\"{}\": the method \"{}\" makes the same decisions as the exact method in {}, and takes "
        "{:.2g} times the CPU time of the exact method.",
        panel.title, ours.label,
        flipped == 0 ? "every case" : fmt::format("all but {:g} cases", flipped),
        ours.cost.median / truth.cost.median);
    for (std::size_t i = 2; i < panel.points.size(); ++i) {
        const ValidationPoint& p = panel.points[i];
        if (p.error > 0 && p.cost.median >= ours.cost.median) {
            return out + fmt::format(
                             " The method \"{}\" takes more CPU time than \"{}\", and "
                             "decides {:.2g} % of the cases wrongly.",
                             p.label, ours.label, 100 * p.error);
        }
    }
    return out;
}

}  // namespace

ValidationChart decisions_chart(const ValidationSize& size, Promises& promises) {
    ValidationChart chart{
        .name = "decisions",
        .title = "Is the link up? Decisions without computing the loss",
        .truth =
            "The reference computes path losses with logarithms, at 2450 MHz. \"in range of "
            "friis?\": the decision is whether the loss of friis is within a link budget of 90 dB, "
            "at distances that differ from the range of friis by at most 1 %. \"up under "
            "shadowing?\": the same decision for log_distance with 6 dB of shadowing, at distances "
            "of 0.1 to 1.9 times the median range of this model. \"stronger by 10 dB?\": the "
            "decision is whether one of two frames is at least 10 dB stronger than the other; the "
            "senders of the frames are up to 300 m from the receiver. A method whose name begins "
            "with \"table of N\" looks up logarithms in a table with N entries.",
        .panels = {by_distance(size), by_pair(size), by_level(size)},
        .for_contributors = true};
    for (const ValidationPanel& panel : chart.panels) {
        const ValidationPoint& ours = panel.points[1];
        promises.push_back(
            {fmt::format("wrong decisions of {} in the panel \"{}\"", ours.label, panel.title), "",
             0, detail_of(ours, "flipped"), size.of(200'000, 5'000)});
        chart.sentences.push_back(decision_sentence(panel));
    }
    return chart;
}

}  // namespace rovernet
