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

/// The numbers of a BonnMotion file.
class BonnMotionNumbers {
  public:
    static constexpr std::uint64_t longest_line = 16U << 20;  ///< [bytes]: 500,000 places or so
    enum class Item { number, end_of_line, end_of_file };

    explicit BonnMotionNumbers(TextSource source)
        : source_(std::move(source)), where_{.source = source_.name(), .line = 1, .column = 1} {}

    /// Comment lines are left out; every other line, also the last, has its end.
    /// @throws InputError for what is no finite number, and for a line longer than `longest_line`
    Item next();
    void rewind();

    double value() const { return value_; }
    /// The number, or the end of the line, as it is written; valid until the next call of next().
    Word word() const { return word_; }
    /// The line of word().
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
    bool line_ended_ = false;  ///< word() is the end of the line
    bool in_line_ = false;     ///< the line has begun
    double value_ = 0;
    Word word_;
};

/// Columns of a line for each waypoint: time x y, perhaps z, perhaps a status.
struct PlaceColumns {
    bool z = false;
    bool status = false;

    int width() const { return 3 + (z ? 1 : 0) + (status ? 1 : 0); }
};

/// A place of a node and the time when it is there.
struct Waypoint {
    Time time = {};
    Vec3 place = {};     ///< [m]
    bool first = false;  ///< the first of its node
    int column = 1;      ///< of the time in its line
};

/// The first of `candidates` that the whole file agrees with, and how many waypoints there are.
/// @throws InputError if it agrees with none: tells where the one that fits longest fails
std::pair<PlaceColumns, std::uint64_t> columns_of(BonnMotionNumbers& numbers,
                                                  const std::vector<PlaceColumns>& candidates);

/// Gives each waypoint of the file to `take`; a repeated one (same time, same place) once.
/// @throws InputError if a line is no list of waypoints at rising times
void read_waypoints(BonnMotionNumbers& numbers, PlaceColumns columns,
                    const std::function<void(const Waypoint&)>& take);

}  // namespace rovernet
