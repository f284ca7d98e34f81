// SPDX-License-Identifier: MIT
#include "scenario/tables/read_value.hpp"

#include "scenario/document/choice.hpp"
#include "scenario/document/simulator_names.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace rovernet {
namespace {

[[noreturn]] void wrong_type(const Value& value, std::string_view key, std::string_view expected) {
    throw InputError(value.where,
                     fmt::format("{}: found {}; expected {}", key, value.description(), expected));
}

template <class T>
T as(const Value& value, std::string_view key, std::string_view expected) {
    if (const T* found = std::get_if<T>(&value.data)) return *found;
    wrong_type(value, key, expected);
}

std::string in_small_letters(std::string_view word) {
    std::string out(word);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
}

/// Version part of a word: letters and digits from the first digit on, up to a blank. "80211g" of
/// "802.11g"; empty for a word without digits.
std::string designation(std::string_view word) {
    std::string out;
    for (const char c : in_small_letters(word)) {
        const bool is_digit = c >= '0' && c <= '9', is_letter = c >= 'a' && c <= 'z';
        if (c == ' ' && !out.empty()) break;
        if (is_digit || (is_letter && !out.empty())) out += c;
    }
    return out;
}

/// Whether one version part may be a misspelling of the other: one is empty, both have the same
/// letters and digits in a different order, or one lacks a digit. A different digit or letter means
/// a different version.
bool may_be_one(std::string a, std::string b) {
    if (a.empty() || b.empty()) return true;
    if (a.size() > b.size()) std::swap(a, b);
    for (std::size_t i = 0; b.size() == a.size() + 1 && i < b.size(); ++i) {
        const bool is_digit = b[i] >= '0' && b[i] <= '9';
        if (is_digit && b.substr(0, i) + b.substr(i + 1) == a) return true;
    }
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    return a == b;
}

/// Suggestion "did you mean ...?"; empty if no word is similar.
std::string choice_meant(std::string_view word, const std::vector<std::string>& choices,
                         const ChoiceHelp& help) {
    if (const auto truth = truth_in(word)) {
        const std::string_view meant = *truth ? help.yes : help.no;
        const bool is_listed = std::find(choices.begin(), choices.end(), meant) != choices.end();
        if (is_listed) return fmt::format("did you mean \"{}\"?", meant);
    }
    const std::string known = simulator_name_hint(word, choices);
    if (!known.empty()) return known;
    const std::string number = designation(word);
    std::vector<std::string> possible;
    for (const std::string& choice : choices)
        if (may_be_one(number, designation(choice))) possible.push_back(choice);
    return did_you_mean(word, possible);
}

/// "one of "a", "b"", each with its meaning if it has one.
std::string expected_choices(const std::vector<std::string>& choices, const ChoiceHelp& help) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        const bool has_meaning = i < help.meanings.size();
        texts.push_back(has_meaning ? fmt::format("\"{}\" ({})", choices[i], help.meanings[i])
                                    : fmt::format("\"{}\"", choices[i]));
    }
    return fmt::format("{}{}", choices.size() > 1 ? "one of " : "", fmt::join(texts, ", "));
}

}  // namespace

std::optional<bool> truth_in(std::string_view word) {
    const std::string small = in_small_letters(word);
    for (const char* yes : {"true", "yes", "on"})
        if (small == yes) return true;
    for (const char* no : {"false", "no", "off"})
        if (small == no) return false;
    return std::nullopt;
}

void read_value(const Value& value, std::string_view key, bool& out) {
    const auto truth = value.string() ? truth_in(*value.string()) : std::nullopt;
    if (truth) {
        wrong_type(value, key,
                   fmt::format("true or false; did you mean {}, without quotes?", *truth));
    }
    out = as<bool>(value, key, "true or false");
}

void read_value(const Value& value, std::string_view key, int& out) {
    const auto number = as<std::int64_t>(value, key, "a whole number without a unit");
    if (number < std::numeric_limits<int>::min() || number > std::numeric_limits<int>::max()) {
        wrong_type(value, key, "a whole number from -2147483648 to 2147483647");
    }
    out = static_cast<int>(number);
}

void read_value(const Value& value, std::string_view key, std::uint64_t& out) {
    const auto number = as<std::int64_t>(value, key, "a whole number >= 0 without a unit");
    if (number < 0) wrong_type(value, key, "a whole number >= 0");
    out = static_cast<std::uint64_t>(number);
}

void read_value(const Value& value, std::string_view key, double& out) {
    if (const auto* whole = std::get_if<std::int64_t>(&value.data)) {
        out = static_cast<double>(*whole);
    } else {
        out = as<double>(value, key, "a number without a unit");
    }
    constexpr double largest = 1e9;  // factors and exponents: their products stay finite
    if (!(std::abs(out) <= largest)) wrong_type(value, key, "a number from -1e9 to 1e9");
}

void read_value(const Value& value, std::string_view key, std::string& out) {
    out = as<std::string>(value, key, "a text in quotes");
}

void read_value(const Value& value, std::string_view key, BitRate& out) {
    constexpr double slowest = 1;  // [bit/s]: the largest message takes 93 days
    out = {read_quantity(value, key, Dimension::bit_rate)};
    if (out.value > 0 && out.value < slowest) wrong_type(value, key, "a bit rate >= 1 bit/s");
}

void read_value(const Value& value, std::string_view key, Duration& out) {
    const double s = read_quantity(value, key, Dimension::time);
    out = from_seconds(s);
    if (s != 0 && out == Duration{0})
        wrong_type(value, key, "at least 1 ns, which is the resolution of times");
}

void read_value(const Value& value, std::string_view key, Bytes& out) {
    constexpr double largest = 1e6;
    const double bytes = read_quantity(value, key, Dimension::size);
    if (!(bytes >= 0 && bytes <= largest && bytes == std::floor(bytes))) {
        wrong_type(value, key, "a whole number of bytes from 0 B to 1 MB");
    }
    out = {static_cast<std::uint32_t>(bytes)};
}

void read_value(const Value& value, std::string_view key, Vec3& out) {
    const Array* list = value.array();
    if (!list || list->size() < 2 || list->size() > 3) {
        wrong_type(value, key,
                   "a position of two or three lengths (x, y, z), such as [\"2 m\", \"3 m\"]");
    }
    double* const axes[] = {&out.x, &out.y, &out.z};
    out.z = 0;
    for (std::size_t i = 0; i < list->size(); ++i) {
        *axes[i] = read_quantity((*list)[i], key, Dimension::length);
    }
}

void read_value(const Value& value, std::string_view key, PatternPoint& out) {
    const Array* pair = value.array();
    if (!pair || pair->size() != 2) {
        wrong_type(value, key, "a list of points [degrees, dB], such as [[0, 0], [180, -20]]");
    }
    const auto number = [&](const Value& each, Dimension dimension, double unit) {
        double plain = 0;
        if (each.string()) return read_quantity(each, key, dimension) / unit;
        read_value(each, key, plain);
        return plain;
    };
    constexpr double degree = std::numbers::pi / 180;
    out = {number((*pair)[0], Dimension::angle, degree), number((*pair)[1], Dimension::gain, 1)};
}

void check_printable(const Value& value, std::string_view key, std::string_view text) {
    const auto control = [](char c) {
        return static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) == 0x7f;
    };
    const auto found = std::find_if(text.begin(), text.end(), control);
    if (found == text.end()) return;
    throw InputError(value.where, fmt::format("{}: found the control character 0x{:02x} in the "
                                              "text; expected a text without control characters",
                                              key, static_cast<unsigned char>(*found)));
}

std::size_t read_choice(const Value& value, std::string_view key,
                        const std::vector<std::string>& choices, const ChoiceHelp& help) {
    const std::string expected = expected_choices(choices, help);
    const bool* truth = std::get_if<bool>(&value.data);
    const auto word = truth ? *truth ? "true" : "false" : as<std::string>(value, key, expected);
    const auto found = std::find(choices.begin(), choices.end(), word);
    if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
    const std::string near = choice_meant(word, choices, help),
                      end = near.empty() ? "" : "; " + near;
    if (truth) wrong_type(value, key, expected + end);
    throw InputError(value.where,
                     fmt::format("unknown {} \"{}\"; expected {}{}", key, word, expected, end));
}

std::size_t read_choice(const Value& value, std::string_view key,
                        const std::vector<std::string>& choices) {
    return read_choice(value, key, choices, ChoiceHelp{});
}

Value to_value(bool v) { return v; }
Value to_value(int v) { return v; }
Value to_value(std::uint64_t v) { return v; }
Value to_value(double v) { return v; }
Value to_value(const std::string& v) { return v; }
Value to_value(Bytes v) { return quantity_text(v.value, Dimension::size); }

Value to_value(Duration v) {
    struct Unit {
        std::int64_t ns;
        std::string_view name;
    };
    for (const auto& [ns, name] :
         {Unit{1'000'000'000, "s"}, Unit{1'000'000, "ms"}, Unit{1'000, "us"}}) {
        if (v.count() % ns == 0) return fmt::format("{} {}", v.count() / ns, name);
    }
    return fmt::format("{} ns", v.count());
}

Value to_value(Vec3 v) {
    Array list{to_value(Meters{v.x}), to_value(Meters{v.y})};
    if (v.z != 0) list.push_back(to_value(Meters{v.z}));
    return list;
}

Value to_value(const PatternPoint& v) { return Array{v.degrees, v.db}; }

}  // namespace rovernet
