// SPDX-License-Identifier: MIT
#include "pictures/chart/chart_axis.hpp"

#include "pictures/draw/plot.hpp"
#include "sim/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rovernet {
namespace {

constexpr double slack = 1e-9;  // of a step or a number: less is rounding
constexpr double least_scientific = 1e6, most_scientific = 1e-4;

int decade(double v) { return static_cast<int>(std::floor(math::log10(v) + slack)); }

/// Text of a number as in "1.5e6", without needless zeros.
std::string scientific(double v, int digits) {
    const std::string text = fmt::format("{:.{}e}", v, digits);
    const auto e = text.find('e');
    const auto last_digit = text.find_last_not_of(digits > 0 ? "0." : "", e - 1);
    const auto exponent = std::min(text.find_first_not_of("+-0", e + 1), text.size() - 1);
    return text.substr(0, last_digit + 1) + (text[e + 1] == '-' ? "e-" : "e") +
           text.substr(exponent);
}

/// Groups of three digits from five digits on, with no-break spaces.
std::string grouped(const std::string& text) {
    const auto begin = static_cast<std::size_t>(text.starts_with('-'));
    const auto end = std::min(text.find('.'), text.size());
    if (end - begin < 5) return text;
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (i > begin && i < end && (end - i) % 3 == 0) out += "\xc2\xa0";
        out += text[i];
    }
    return out;
}

/// The text of a tick of an axis with ticks at multiples of `step`.
std::string tick_text(double v, double step, double largest) {
    if (std::abs(v) < 0.5 * step) return "0";
    if (largest >= least_scientific || step < most_scientific) {
        return scientific(v, std::clamp(decade(std::abs(v)) - decade(step), 0, 9));
    }
    return grouped(fmt::format("{:.{}f}", v, std::max(0, -decade(step))));
}

/// Range of the numbers, widened if all numbers are (nearly) equal.
ChartRange widened(const ChartRange& range) {
    constexpr double tiny = 1e-100;
    const double size = std::max(std::abs(range.low()), std::abs(range.high()));
    ChartRange out;
    if (size < tiny) {
        out.include(0);
        out.include(1);
        return out;
    }
    const bool same = range.high() - range.low() <= slack * size;
    out.include(range.low() - (same ? 0.1 * size : 0));
    out.include(range.high() + (same ? 0.1 * size : 0));
    return out;
}

/// End of an axis with ticks at multiples of a step: at a tick, or slightly beyond a tick if the
/// next one would leave much empty space.
struct TickEnds {
    TickEnds(double range_low, double range_high, double of_step) : step(of_step) {
        constexpr double little = 0.25, room = 0.05;  // of a step
        constexpr double fewest = 4;                  // steps, for some to be given up
        const double from = range_low / step, to = range_high / step;
        first = std::floor(from + slack);
        last = std::ceil(to - slack);
        low = first * step;
        high = last * step;
        if (last - first < fewest) return;
        if (const double over = first + 1 - from; over < little) {
            low = (from - room) * step;
            ++first;
        }
        if (const double over = to - (last - 1); over < little) {
            high = (to + room) * step;
            --last;
        }
    }

    double step;
    double first = 0, last = 0;  // [steps]
    double low = 0, high = 0;
};

/// Range of the numbers, or the range between the limits if the numbers use enough of it.
ChartRange with_limits(ChartRange range, const ChartLimits& limits) {
    constexpr double enough = 0.2;  // of the whole
    if (!limits.low || !limits.high || range.empty()) return range;
    const double whole = *limits.high - *limits.low;
    if (range.high() - range.low() < enough * whole - slack * whole) return range;
    range.include(*limits.low);
    range.include(*limits.high);
    return range;
}

/// Ends the axis at its limits, unless the numbers go beyond.
void cut(ChartAxis& axis, const ChartRange& range, const ChartLimits& limits) {
    if (limits.low && range.low() >= *limits.low) axis.low = std::max(axis.low, *limits.low);
    if (limits.high && range.high() <= *limits.high) axis.high = std::min(axis.high, *limits.high);
    const double little = slack * (axis.high - axis.low);
    std::erase_if(axis.ticks, [&](const ChartTick& tick) {
        return tick.value < axis.low - little || tick.value > axis.high + little;
    });
}

ChartAxis linear_axis(const ChartRange& shown, bool whole, int most) {
    const double low = shown.low(), high = shown.high();
    const double least_step = whole && shown.whole() ? 1.0 : 0.0;
    TickEnds ends(low, high, std::max(round_number((high - low) / most), least_step));
    while (ends.last - ends.first >= most)
        ends = TickEnds(low, high, round_number(2.5 * ends.step));
    ChartAxis axis{.low = ends.low, .high = ends.high};
    const double step = ends.step;
    const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
    for (double k = ends.first; k <= ends.last; ++k) {
        axis.ticks.push_back({k * step, tick_text(k * step, step, largest)});
    }
    return axis;
}

/// The least of 1, 2, 5, 10, 20 ... that is not below v > 0.
double round_above(double v) {
    const double below = round_number(v * (1 + slack));
    return below >= v * (1 - slack) ? below : round_number(2.5 * below);
}

/// Labels of the ticks, thinned to at most `most`: first labels at 2 and 5 are dropped, then some
/// of the powers of ten.
void thin(std::vector<ChartTick>& ticks, int most) {
    const auto texts =
        std::count_if(ticks.begin(), ticks.end(), [](const auto& t) { return !t.text.empty(); });
    if (texts <= most) return;
    const int decades = decade(ticks.back().value) - decade(ticks.front().value);
    int every = 1;
    while (decades / every + 1 > most) ++every;
    for (auto& tick : ticks) {
        const int power = decade(tick.value);
        const bool whole = tick.value < 1.5 * math::exp10(power);
        if (!whole || power % every != 0) tick.text.clear();
    }
}

ChartAxis log_axis(const ChartRange& range, int most) {
    constexpr int most_decades_with_small_ticks = 8;
    double low = round_number(range.low() * (1 + slack)), high = round_above(range.high());
    if (high <= low * (1 + slack)) {
        low = round_number(low * 0.5 * (1 + slack));
        high = round_above(high * 2);
    }
    ChartAxis axis{.low = low, .high = high, .log = true};
    const int first = decade(low), last = decade(high);
    for (int power = first; power <= last; ++power) {
        for (int digit = 1; digit < 10; ++digit) {
            const double v = power < 0 ? digit / math::exp10(-power) : digit * math::exp10(power);
            if (v < low * (1 - slack) || v > high * (1 + slack)) continue;
            const bool round = digit == 1 || digit == 2 || digit == 5;
            if (digit > 1 && last - first > most_decades_with_small_ticks) continue;
            axis.ticks.push_back({v, round ? number_text(v) : ""});
        }
    }
    thin(axis.ticks, most);
    return axis;
}

}  // namespace

void ChartRange::include(double v) {
    low_ = empty_ ? v : std::min(low_, v);
    high_ = empty_ ? v : std::max(high_, v);
    empty_ = false;
    whole_ = whole_ && v == std::floor(v);
}

double ChartAxis::share(double v) const {
    if (!log) return std::clamp((v - low) / (high - low), 0.0, 1.0);
    if (!(v > 0)) return 0;
    return std::clamp(math::log10(v / low) / math::log10(high / low), 0.0, 1.0);
}

std::string ChartAxis::text(double v) const {
    const double largest = std::max(std::abs(low), std::abs(high));
    return tick_text(v, (high - low) / 100, largest);
}

ChartAxis number_axis(const ChartRange& range, bool log, int most, const ChartLimits& limits) {
    const bool share = limits.low && limits.high;
    ChartAxis axis = log && range.low() > 0 ? log_axis(range, most)
                                            : linear_axis(widened(with_limits(range, limits)),
                                                          range.whole() && !share, most);
    cut(axis, range, limits);
    return axis;
}

ChartAxis word_axis(const std::vector<std::string>& words) {
    const auto count = static_cast<double>(words.size());
    ChartAxis axis{.low = -0.5, .high = std::max(count, 1.0) - 0.5};
    for (const auto& word : words) {
        axis.ticks.push_back({static_cast<double>(axis.ticks.size()), word});
    }
    return axis;
}

std::string number_text(double v) {
    constexpr int digits = 4;
    const double size = std::abs(v);
    if (!(size > 0)) return "0";
    if (size < most_scientific * (1 - slack) || size >= least_scientific) {
        return scientific(v, digits - 1);
    }
    std::string text = fmt::format("{:.{}f}", v, std::max(0, digits - 1 - decade(size)));
    if (text.find('.') != text.npos) text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return grouped(text);
}

}  // namespace rovernet
