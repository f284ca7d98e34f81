// SPDX-License-Identifier: MIT
#include "scenario/document/quantity.hpp"

#include "sim/power_of_ten.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace rovernet {
namespace {

/// Unit: number x 10^exponent x factor / divisor in the base unit; in milliwatts for the unit of a
/// level. A power of ten moves the decimal point, so that "3730.3 cm" is "37.303 m" to the last
/// bit.
struct Unit {
    std::string_view name;
    int exponent = 0;
    double factor = 1;
    double divisor = 1;
    bool level = false;

    double in_base(double number) const {
        return times_power_of_ten(number, exponent) * factor / divisor;
    }
    double of_base(double value) const {
        return times_power_of_ten(value * divisor / factor, -exponent);
    }
    bool is_base() const { return exponent == 0 && factor == 1 && divisor == 1 && !level; }
};

// The first unit is the one that a suggestion uses; those before `others` print, largest first.
struct QuantityKind {
    std::string_view what;  // with its article
    std::string_view example;
    std::span<const Unit> units;
    double largest;  // magnitude in the base unit: beyond it sums and products may overflow
    std::string_view largest_text;
};

constexpr Unit milliwatts(std::string_view name, int exponent) {
    return {name, exponent, 1, 1, true};
}

constexpr Unit power_units[] = {
    {"dBm"}, milliwatts("mW", 0), milliwatts("W", 3), milliwatts("uW", -3)};
constexpr Unit gain_units[] = {{"dB"}, {"dBi"}};
constexpr Unit frequency_units[] = {{"MHz", 6}, {"GHz", 9}, {"kHz", 3}, {"Hz"}};
constexpr Unit length_units[] = {{"m"}, {"km", 3}, {"cm", -2}, {"mm", -3}};
constexpr Unit speed_units[] = {{"m/s"}, {"km/h", 1, 1, 36}};
constexpr Unit time_units[] = {{"s"},      {"ms", -3},     {"us", -6},
                               {"ns", -9}, {"min", 0, 60}, {"h", 0, 3600}};
constexpr Unit rate_units[] = {{"Mb/s", 6}, {"kb/s", 3},   {"Gb/s", 9},  {"b/s"},
                               {"bit/s"},   {"kbit/s", 3}, {"Mbit/s", 6}};
constexpr Unit size_units[] = {{"B"},
                               {"kB", 3},
                               {"KiB", 0, 1024},
                               {"MB", 6},
                               {"MiB", 0, 1 << 20},
                               {"GB", 9},
                               {"GiB", 0, 1024.0 * (1 << 20)}};

constexpr double degree = 3.14159265358979323846 / 180;
constexpr Unit angle_units[] = {{"deg", 0, degree}, {"rad"}};
constexpr Unit turn_rate_units[] = {{"deg/s", 0, degree}, {"rad/s"}};
constexpr Unit attenuation_units[] = {{"dB/m"}, {"dB/cm", 2}};

constexpr QuantityKind quantity_kinds[] = {
    {"a power", "15 dBm", power_units, 1e4, "10000 dBm"},
    {"a ratio", "2 dB", gain_units, 1e4, "10000 dB"},
    {"a frequency", "2450 MHz", frequency_units, 1e15, "1e6 GHz"},
    {"a length", "5 m", length_units, 1e9, "1e6 km"},
    {"a speed", "0.5 m/s", speed_units, 1e9, "1e9 m/s"},
    {"a time", "10 s", time_units, 1e9, "1e9 s (31 years)"},
    {"a bit rate", "11 Mb/s", rate_units, 1e15, "1e6 Gb/s"},
    {"a size", "64 B", size_units, 1e15, "1e6 GB"},
    {"an angle", "90 deg", angle_units, 1e6, "1e6 rad"},
    {"a turn rate", "45 deg/s", turn_rate_units, 1e9, "1e9 rad/s"},
    {"an attenuation", "75 dB/m", attenuation_units, 1e6, "1e6 dB/m"},
};

const QuantityKind& kind(Dimension dimension) {
    return quantity_kinds[static_cast<std::size_t>(dimension)];
}

std::string unit_names(const QuantityKind& kind) {
    std::string names;
    for (const auto& unit : kind.units) {
        names += names.empty() ? "" : ", ";
        names += unit.name;
    }
    return names;
}

[[noreturn]] void reject(const Value& value, std::string_view key, const QuantityKind& kind,
                         const std::string& found, const std::string& suggestion) {
    throw InputError(value.where, fmt::format("{}: {}; expected {} with a unit ({}); {}", key,
                                              found, kind.what, unit_names(kind), suggestion));
}

/// Unit for a name in full or a variant spelling.
std::string_view usual_unit(std::string_view name) {
    constexpr std::pair<std::string_view, std::string_view> others[] = {
        {"sec", "s"},       {"secs", "s"},     {"second", "s"},    {"seconds", "s"},
        {"mins", "min"},    {"minute", "min"}, {"minutes", "min"}, {"hr", "h"},
        {"hour", "h"},      {"hours", "h"},    {"msec", "ms"},     {"usec", "us"},
        {"meter", "m"},     {"meters", "m"},   {"metre", "m"},     {"metres", "m"},
        {"mps", "m/s"},     {"kph", "km/h"},   {"degree", "deg"},  {"degrees", "deg"},
        {"radians", "rad"}, {"byte", "B"},     {"bytes", "B"},     {"bps", "b/s"},
        {"kbps", "kb/s"},   {"Mbps", "Mb/s"},  {"Gbps", "Gb/s"},
    };
    const auto found = std::find_if(std::begin(others), std::end(others),
                                    [&](const auto& other) { return other.first == name; });
    return found == std::end(others) ? name : found->second;
}

/// Suggestion "did you mean ...?" for a unit that is misspelt, first of all in its capitals.
std::string nearest_unit(const QuantityKind& kind, std::string_view name) {
    const auto same_letter = [](char a, char b) { return (a | 0x20) == (b | 0x20); };
    std::vector<std::string> names;
    for (const auto& unit : kind.units) {
        if (std::equal(name.begin(), name.end(), unit.name.begin(), unit.name.end(), same_letter)) {
            return fmt::format("did you mean \"{}\"?", unit.name);
        }
        names.emplace_back(unit.name);
    }
    return did_you_mean(name, names);
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t";
    const auto first = text.find_first_not_of(blanks);
    if (first == text.npos) return "";
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Quantity in its base unit. @throws InputError if it is not finite or too large to compute with
double within(const Value& value, std::string_view key, const QuantityKind& kind, double number) {
    if (std::abs(number) <= kind.largest) return number;
    throw InputError(value.where, fmt::format("{}: found {}; expected {} of at most {}", key,
                                              value.description(), kind.what, kind.largest_text));
}

double in_base_unit(const Value& value, std::string_view key, const QuantityKind& kind,
                    double number, const Unit& unit) {
    const double scaled = unit.in_base(number);
    if (!unit.level) return within(value, key, kind, scaled);
    if (!(scaled > 0)) {
        reject(value, key, kind,
               fmt::format("found {} {}, which has no level in dBm", number, unit.name),
               fmt::format("did you mean \"{} dBm\"?", number));
    }
    return within(value, key, kind, to_dbm({scaled}).value);
}

std::string example_of(const QuantityKind& kind) {
    return fmt::format("for example \"{}\"", kind.example);
}

/// Number without a unit: allowed on the command line only, where it is in SI units.
double bare(const Value& value, std::string_view key, Dimension dimension, double number) {
    const QuantityKind& k = kind(dimension);
    if (std::isnan(number)) reject(value, key, k, "found " + value.description(), example_of(k));
    if (value.where.is_option) {
        constexpr Unit watts = power_units[2];
        return dimension == Dimension::power ? in_base_unit(value, key, k, number, watts)
                                             : within(value, key, k, number);
    }
    within(value, key, k, number);
    // Guess of the unit: a number such as 2.4 means gigahertz, 2400 megahertz.
    const bool small = dimension == Dimension::frequency && std::abs(number) < 100;
    reject(value, key, k, fmt::format("found the number {} without a unit", number),
           fmt::format("did you mean \"{} {}\"?", number, k.units[small ? 1 : 0].name));
}

}  // namespace

double read_quantity(const Value& value, std::string_view key, Dimension dimension) {
    const QuantityKind& k = kind(dimension);
    if (const auto* number = std::get_if<double>(&value.data)) {
        return bare(value, key, dimension, *number);
    }
    if (const auto* number = std::get_if<std::int64_t>(&value.data)) {
        return bare(value, key, dimension, static_cast<double>(*number));
    }
    const std::string example = example_of(k);
    if (!value.string()) reject(value, key, k, "found " + value.description(), example);

    std::string_view text = trimmed(*value.string());
    if (text.starts_with('+')) text.remove_prefix(1);
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || !std::isfinite(number)) {
        reject(value, key, k, "found " + value.description(), example);
    }
    const std::string_view unit_name =
        trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
    if (unit_name.empty()) return bare(value, key, dimension, number);
    for (const auto& unit : k.units) {
        if (unit.name == unit_name) return in_base_unit(value, key, k, number, unit);
    }
    if (unit_name.starts_with(',')) {
        reject(value, key, k, "found " + value.description(), "write the decimal point as \".\"");
    }
    const bool decibel_watts = dimension == Dimension::power && unit_name == "dBW";
    const std::string near =
        decibel_watts
            ? fmt::format("dBW is a different unit: {} dBW is \"{} dBm\"", number, number + 30)
            : nearest_unit(k, usual_unit(unit_name));
    reject(value, key, k, fmt::format("found the unit \"{}\"", unit_name),
           near.empty() ? example : near);
}

std::string quantity_pattern(Dimension dimension, bool any_sign) {
    constexpr const char* any_number = "([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][+-]?[0-9]+)?";
    constexpr const char* not_zero =
        "([0-9]*[1-9][0-9]*[.]?[0-9]*|[0-9]*[.][0-9]*[1-9][0-9]*)([eE][+-]?[0-9]+)?";
    constexpr const char* whole_number = "[0-9]+([.]0*)?([eE][+]?[0-9]+)?";
    const std::string sign = any_sign ? "-?" : "";
    std::vector<std::string> forms;
    std::vector<std::string_view> names;
    for (const Unit& unit : kind(dimension).units) {
        if (unit.level)
            forms.push_back(fmt::format("{}[ \t]*{}", not_zero, unit.name));
        else if (dimension == Dimension::size && unit.is_base())
            forms.push_back(fmt::format("{}[ \t]*{}", whole_number, unit.name));
        else
            names.push_back(unit.name);
    }
    forms.push_back(fmt::format("{}{}[ \t]*({})", sign, any_number, fmt::join(names, "|")));
    return fmt::format("^[ \t]*[+]?({})[ \t]*$", fmt::join(forms, "|"));
}

std::string quantity_text(double value, Dimension dimension) {
    const QuantityKind& k = kind(dimension);
    for (const auto& unit : k.units) {
        if (unit.level) continue;
        const double number = unit.of_base(value);
        const bool whole = number == std::floor(number) && std::abs(number) < 1e15;
        if (whole && unit.in_base(number) == value) return fmt::format("{} {}", number, unit.name);
    }
    const auto base = std::find_if(k.units.begin(), k.units.end(),
                                   [](const Unit& unit) { return unit.is_base(); });
    return fmt::format("{} {}", value, base->name);
}

std::string_view base_unit(Dimension dimension) {
    constexpr std::string_view names[] = {"dBm",   "dB", "Hz",  "m",     "m/s", "s",
                                          "bit/s", "B",  "rad", "rad/s", "dB/m"};
    return names[static_cast<std::size_t>(dimension)];
}

std::optional<Dimension> shared_dimension(const std::vector<std::string>& texts) {
    for (std::size_t i = 0; i < std::size(quantity_kinds); ++i) {
        const auto dimension = static_cast<Dimension>(i);
        try {
            for (const std::string& text : texts) read_quantity(Value(text), "", dimension);
            return dimension;
        } catch (const InputError&) {
            // Not a quantity of this dimension; the texts may have the next one.
        }
    }
    return std::nullopt;
}

std::string megabits_text(std::span<const BitRate> rates) {
    std::vector<double> numbers;
    for (const BitRate rate : rates) numbers.push_back(rate.value / 1e6);
    return fmt::format("{}", fmt::join(numbers, ", "));
}

}  // namespace rovernet
