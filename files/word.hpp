// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <string_view>

namespace rovernet {

/// A piece of a movement file's line; empty: the line ends there.
struct Word {
    std::string_view text;
    int column = 1;  ///< column, from 1
};

// Limits of what a movement file may say.
inline constexpr std::uint32_t most_file_robots = 10'000'000;
inline constexpr double largest_coordinate = 1e9;  ///< |coordinate| [m]
inline constexpr double fastest = 1e9;             ///< [m/s]
inline constexpr double latest = 9e9;              ///< [s]

/// "found WORD, expected EXPECTED", with the word's column in the line.
/// @throws InputError, always
[[noreturn]] void fail_at(Location line, Word word, std::string_view expected);

/// @throws InputError unless the whole word is a finite number, by decimal digits
double any_number(Word word, const Location& line, std::string_view expected);

// The number `v` that `word` says, within its limits.
/// @throws InputError unless |v| <= largest_coordinate [m]
double coordinate(double v, Word word, const Location& line);
/// @throws InputError unless 0 <= v <= latest [s]
Time moment(double v, Word word, const Location& line);

/// i of "$node_(i)"; any other name may stand before the bracket.
/// @throws InputError unless i < most_file_robots
std::uint32_t node_number(Word word, const Location& line);

double coordinate(Word word, const Location& line);
Time moment(Word word, const Location& line);
/// @throws InputError unless it is a speed from 0 to `fastest` [m/s]
double pace(Word word, const Location& line);

}  // namespace rovernet
