// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace rovernet {

/// Word in a line of a movement file; empty at the end of the line.
struct Word {
    std::string_view text;
    int column = 1;  ///< column of the word in the line, from 1
};

// Limits of values in a movement file.
inline constexpr std::uint32_t most_file_robots = 10'000'000;
inline constexpr double largest_coordinate = 1e9;  ///< largest |coordinate| in a movement file [m]
inline constexpr double fastest = 1e9;             ///< largest speed in a movement file [m/s]
inline constexpr double latest = 9e9;              ///< latest time in a movement file [s]

/// First `longest` bytes of a text, for a message. Each byte that is not printable ASCII becomes
/// "?". If the text is longer, "..." is appended.
std::string printable(std::string_view text, std::size_t longest);

/// Throws the InputError "found WORD, expected EXPECTED", with the word's column in the line.
[[noreturn]] void fail_at(Location line, Word word, std::string_view expected);

/// Number in a word. @throws InputError unless the whole word is a finite decimal number
double any_number(Word word, const Location& line, std::string_view expected);

// Functions that check a value `v`, which was read from the word `word`, against the limits above.
/// Checks and returns the coordinate `v`, read from `word`.
/// @throws InputError unless |v| <= largest_coordinate [m]
double coordinate(double v, Word word, const Location& line);
/// Checks the time `v` [s], read from `word`. @return the time
/// @throws InputError unless 0 <= v <= latest [s]
Time moment(double v, Word word, const Location& line);

/// Number i in "$node_(i)"; any other name may stand before the bracket.
/// @throws InputError unless i < most_file_robots
std::uint32_t node_number(Word word, const Location& line);

double coordinate(Word word, const Location& line);
Time moment(Word word, const Location& line);
/// Speed in a word [m/s]. @throws InputError unless the speed is from 0 to `fastest` [m/s]
double pace(Word word, const Location& line);

}  // namespace rovernet
