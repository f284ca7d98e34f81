// SPDX-License-Identifier: MIT
#include "experiment/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>

namespace rovernet {
namespace {

struct Unit {
    std::string_view name;
    double factor;  // to the base unit; 0: milliwatts times `milliwatts`, as a level
    double milliwatts = 0;
};

// The first unit is the one that a suggestion uses; those before `others` print, largest first.
struct Kind {
    std::string_view what;  // with its article
    std::string_view example;
    std::span<const Unit> units;
};

constexpr Unit powers[] = {{"dBm", 1}, {"mW", 0, 1}, {"W", 0, 1e3}, {"uW", 0, 1e-3}};
constexpr Unit gains[] = {{"dB", 1}, {"dBi", 1}};
constexpr Unit frequencies[] = {{"MHz", 1e6}, {"GHz", 1e9}, {"kHz", 1e3}, {"Hz", 1}};
constexpr Unit lengths[] = {{"m", 1}, {"km", 1e3}, {"cm", 0.01}, {"mm", 0.001}};
constexpr Unit speeds[] = {{"m/s", 1}, {"km/h", 1 / 3.6}};
constexpr Unit times[] = {{"s", 1},     {"ms", 1e-3}, {"us", 1e-6},
                          {"ns", 1e-9}, {"min", 60},  {"h", 3600}};
constexpr Unit rates[] = {{"Mb/s", 1e6}, {"kb/s", 1e3},   {"Gb/s", 1e9},  {"b/s", 1},
                          {"bit/s", 1},  {"kbit/s", 1e3}, {"Mbit/s", 1e6}};
constexpr Unit sizes[] = {{"B", 1}, {"kB", 1e3}, {"KiB", 1024}, {"MB", 1e6}};

constexpr double degree = 3.14159265358979323846 / 180;
constexpr Unit angles[] = {{"deg", degree}, {"rad", 1}};
constexpr Unit turn_rates[] = {{"deg/s", degree}, {"rad/s", 1}};
constexpr Unit attenuations[] = {{"dB/m", 1}, {"dB/cm", 100}};

constexpr Kind kinds[] = {
    {"a power", "15 dBm", powers},
    {"a ratio", "2 dB", gains},
    {"a frequency", "2450 MHz", frequencies},
    {"a length", "5 m", lengths},
    {"a speed", "0.5 m/s", speeds},
    {"a time", "10 s", times},
    {"a bit rate", "11 Mb/s", rates},
    {"a size", "64 B", sizes},
    {"an angle", "90 deg", angles},
    {"a turn rate", "45 deg/s", turn_rates},
    {"an attenuation", "75 dB/m", attenuations},
};

const Kind& kind(Dimension dimension) { return kinds[static_cast<std::size_t>(dimension)]; }

std::string unit_names(const Kind& kind) {
    std::string names;
    for (const auto& unit : kind.units) {
        names += names.empty() ? "" : ", ";
        names += unit.name;
    }
    return names;
}

[[noreturn]] void reject(const Value& value, std::string_view key, const Kind& kind,
                         const std::string& found, const std::string& suggestion) {
    throw InputError(value.where, fmt::format("{}: {}; expected {} with a unit ({}); {}", key,
                                              found, kind.what, unit_names(kind), suggestion));
}

/// "did you mean ...?" for a unit that is misspelt, in its capitals above all.
std::string nearest_unit(const Kind& kind, std::string_view name) {
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

double finite(const Value& value, std::string_view key, const Kind& kind, double number) {
    if (std::isfinite(number)) return number;
    throw InputError(value.where, fmt::format("{}: found {}; expected {} that is finite", key,
                                              value.description(), kind.what));
}

double in_base_unit(const Value& value, std::string_view key, const Kind& kind, double number,
                    const Unit& unit) {
    if (unit.factor != 0) return finite(value, key, kind, number * unit.factor);
    if (finite(value, key, kind, number) <= 0) {
        reject(value, key, kind, fmt::format("found {} {}, which has no level", number, unit.name),
               fmt::format("did you mean \"{} dBm\"?", number));
    }
    return finite(value, key, kind, to_dbm({number * unit.milliwatts}).value);
}

/// A number without a unit: fine on the command line only, where it is in SI units.
double bare(const Value& value, std::string_view key, Dimension dimension, double number) {
    const Kind& k = kind(dimension);
    if (value.where.is_option) {
        constexpr Unit watts = powers[2];
        return dimension == Dimension::power ? in_base_unit(value, key, k, number, watts)
                                             : finite(value, key, k, number);
    }
    finite(value, key, k, number);
    reject(value, key, k, fmt::format("found the number {} without a unit", number),
           fmt::format("did you mean \"{} {}\"?", number, k.units.front().name));
}

}  // namespace

double read_quantity(const Value& value, std::string_view key, Dimension dimension) {
    const Kind& k = kind(dimension);
    if (const auto* number = std::get_if<double>(&value.data)) {
        return bare(value, key, dimension, *number);
    }
    if (const auto* number = std::get_if<std::int64_t>(&value.data)) {
        return bare(value, key, dimension, static_cast<double>(*number));
    }
    const std::string example = fmt::format("for example \"{}\"", k.example);
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
    const std::string near = nearest_unit(k, unit_name);
    reject(value, key, k, fmt::format("found the unit \"{}\"", unit_name),
           near.empty() ? example : near);
}

std::string quantity_text(double value, Dimension dimension) {
    const Kind& k = kind(dimension);
    for (const auto& unit : k.units) {
        if (unit.factor == 0) continue;
        const double number = value / unit.factor;
        const bool whole = number == std::floor(number) && std::abs(number) < 1e15;
        if (whole && number * unit.factor == value) {
            return fmt::format("{} {}", number, unit.name);
        }
    }
    for (const auto& unit : k.units) {
        if (unit.factor == 1) return fmt::format("{} {}", value, unit.name);
    }
    return fmt::format("{} {}", value / k.units.front().factor, k.units.front().name);
}

std::string_view base_unit(Dimension dimension) {
    constexpr std::string_view names[] = {"dBm",   "dB", "Hz",  "m",     "m/s", "s",
                                          "bit/s", "B",  "rad", "rad/s", "dB/m"};
    return names[static_cast<std::size_t>(dimension)];
}

std::optional<Dimension> shared_dimension(const std::vector<std::string>& texts) {
    for (std::size_t i = 0; i < std::size(kinds); ++i) {
        const auto dimension = static_cast<Dimension>(i);
        try {
            for (const std::string& text : texts) read_quantity(Value(text), "", dimension);
            return dimension;
        } catch (const InputError&) {
            // In another, perhaps.
        }
    }
    return std::nullopt;
}

}  // namespace rovernet
