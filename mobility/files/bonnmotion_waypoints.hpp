// SPDX-License-Identifier: MIT
#pragma once

#include "files/text_source.hpp"
#include "files/word.hpp"
#include "sim/geometry.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {

/// Numbers of a BonnMotion file, read one by one.
class BonnMotionNumbers {
  public:
    /// Largest length of a line [bytes]; enough for about 500,000 positions.
    static constexpr std::uint64_t longest_line = 16U << 20;
    enum class Item { number, end_of_line, end_of_file };

    explicit BonnMotionNumbers(TextSource source)
        : source_(std::move(source)), where_{.source = source_.name(), .line = 1, .column = 1} {}

    /// Reads the next number or end of line. Comment lines are skipped; every other line, also the
    /// last, ends with an end_of_line.
    /// @throws InputError for text that is not a finite number, and for a line longer than
    ///         `longest_line`
    Item next();
    void rewind();

    double value() const { return value_; }
    /// Text of the number, or of the end of the line; valid until the next call of next().
    Word word() const { return word_; }
    /// Place of word() in the file.
    const Location& line() const { return where_; }
    const std::string& source() const { return source_.name(); }

  private:
    void begin_line();
    bool skip_blanks();
    void skip_comment();
    void check_length() const;
    int column() const;
    Item end_line(std::size_t bytes);

    TextSource source_;
    Location where_;
    std::uint64_t line_start_ = 0;
    bool line_ended_ = false;  ///< true if word() is the end of the line
    bool in_line_ = false;     ///< true if a number of the current line was read
    double value_ = 0;
    Word word_;
};

/// Columns of a waypoint in a line of a BonnMotion file: time, x, y, then z if `z` is true, then a
/// status if `status` is true.
struct PlaceColumns {
    bool z = false;
    bool status = false;

    int width() const { return 3 + (z ? 1 : 0) + (status ? 1 : 0); }
};

/// Position of a node at a time.
struct Waypoint {
    Time time = {};
    Vec3 place = {};     ///< position [m]
    bool first = false;  ///< true for the first waypoint of the node
    int column = 1;      ///< column of the waypoint's time in its line, from 1
};

/// First layout of `candidates` that fits the whole file, and the number of waypoints in the file.
/// @throws InputError if none fits, with the error of the candidate that fits longest
std::pair<PlaceColumns, std::uint64_t> columns_of(BonnMotionNumbers& numbers,
                                                  const std::vector<PlaceColumns>& candidates);

/// Calls take(waypoint) for each waypoint of the file. A waypoint that repeats time and position of
/// the previous one is skipped.
/// @throws InputError if a line is not a list of waypoints with ascending times
void read_waypoints(BonnMotionNumbers& numbers, PlaceColumns columns,
                    const std::function<void(const Waypoint&)>& take);

}  // namespace rovernet
