// SPDX-License-Identifier: MIT
#include "files/word.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace rovernet {
namespace {

constexpr std::string_view a_coordinate = "a coordinate from -1e9 to 1e9 [m]";
constexpr std::string_view a_moment = "a time from 0 to 9e9 [s]";
constexpr std::string_view a_pace = "a speed from 0 to 1e9 [m/s]";

}  // namespace

std::string printable(std::string_view text, std::size_t longest) {
    std::string shown(text.substr(0, longest));
    for (char& c : shown) {
        if (c < ' ' || c > '~') c = '?';
    }
    if (text.size() > longest) shown += "...";
    return shown;
}

void fail_at(Location line, Word word, std::string_view expected) {
    constexpr std::size_t longest = 40;
    line.column = word.column;
    const auto found = word.text.empty()
                           ? "found the end of the line"
                           : fmt::format("found \"{}\"", printable(word.text, longest));
    throw InputError(std::move(line), fmt::format("{}, expected {}", found, expected));
}

double any_number(Word word, const Location& line, std::string_view expected) {
    std::string_view text = word.text;
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    double v = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, v);
    if (error != std::errc{} || stop != end || !std::isfinite(v)) fail_at(line, word, expected);
    return v;
}

double coordinate(double v, Word word, const Location& line) {
    if (!(std::abs(v) <= largest_coordinate)) fail_at(line, word, a_coordinate);
    return v;
}

Time moment(double v, Word word, const Location& line) {
    if (!(v >= 0 && v <= latest)) fail_at(line, word, a_moment);
    return start_of_run + from_seconds(v);
}

double coordinate(Word word, const Location& line) {
    return coordinate(any_number(word, line, a_coordinate), word, line);
}

Time moment(Word word, const Location& line) {
    return moment(any_number(word, line, a_moment), word, line);
}

double pace(Word word, const Location& line) {
    const double v = any_number(word, line, a_pace);
    if (!(v >= 0 && v <= fastest)) fail_at(line, word, a_pace);
    return v;
}

std::uint32_t node_number(Word word, const Location& line) {
    constexpr std::string_view expected = "a node as in $node_(0), its number below 10000000";
    const std::size_t open = word.text.find('(');
    if (open == word.text.npos || word.text.back() != ')') fail_at(line, word, expected);
    const char* begin = word.text.data() + open + 1;
    const char* end = word.text.data() + word.text.size() - 1;
    std::uint32_t node = 0;
    const auto [stop, error] = std::from_chars(begin, end, node);
    if (error != std::errc{} || stop != end || node >= most_file_robots) {
        fail_at(line, word, expected);
    }
    return node;
}

}  // namespace rovernet
