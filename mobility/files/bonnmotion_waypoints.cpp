// SPDX-License-Identifier: MIT
#include "mobility/files/bonnmotion_waypoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace rovernet {
namespace {

using Item = BonnMotionNumbers::Item;

constexpr std::size_t longest_number = 400;  // [bytes]; "%f" of the largest double has 317
constexpr std::string_view between_numbers = " \t\r";

/// Combines numbers to waypoints, for one possible set of columns.
class WaypointLine {
  public:
    explicit WaypointLine(PlaceColumns columns) : columns_(columns) {}

    /// Waypoint completed by the number, unless it repeats the previous one.
    std::optional<Waypoint> number(const BonnMotionNumbers& n) {
        if (++in_line_ == 1 && empty_line_ > 0) fail_empty(n);
        const int column = column_;
        column_ = column_ + 1 == columns_.width() ? 0 : column_ + 1;
        if (column == 0) {
            begin(n);
        } else if (column == 1) {
            now_.place.x = coordinate(n.value(), n.word(), n.line());
        } else if (column == 2) {
            now_.place.y = coordinate(n.value(), n.word(), n.line());
        } else if (column == 3 && columns_.z) {
            now_.place.z = coordinate(n.value(), n.word(), n.line());
        }
        return column_ == 0 ? complete(n) : std::nullopt;
    }
    void end_of_line(const BonnMotionNumbers& n) {
        if (column_ != 0) fail_length(n);
        if (in_line_ == 0) {
            if (empty_line_ == 0) empty_line_ = n.line().line;
            return;
        }
        in_line_ = 0;
        before_.reset();
        if (++nodes_ > most_file_robots) {
            throw InputError(n.line(), fmt::format("found more than {} nodes; expected fewer",
                                                   most_file_robots));
        }
    }
    std::uint64_t waypoints() const { return waypoints_; }

  private:
    void begin(const BonnMotionNumbers& n) {
        now_ = {.time = moment(n.value(), n.word(), n.line()),
                .place = {},
                .first = !before_,
                .column = n.word().column};
        if (before_ && now_.time < before_->time) {
            fail_at(n.line(), n.word(), "a later time than the time of the previous waypoint");
        }
    }
    std::optional<Waypoint> complete(const BonnMotionNumbers& n) {
        if (before_ && now_.time == before_->time) {
            if (now_.place == before_->place) return std::nullopt;
            Location where = n.line();
            where.column = now_.column;
            throw InputError(where,
                             "found a different place at the time of the previous waypoint, "
                             "expected a time at least 1 ns later");
        }
        before_ = now_;
        ++waypoints_;
        return now_;
    }
    [[noreturn]] void fail_empty(const BonnMotionNumbers& n) const {
        Location where = n.line();
        where.line = empty_line_;
        throw InputError(where,
                         "found an empty line before the last node, expected a line with the "
                         "waypoints of a node");
    }
    [[noreturn]] void fail_length(const BonnMotionNumbers& n) const {
        Location where = n.line();
        where.column = n.word().column;
        const std::string_view z = columns_.z ? " z" : "";
        const std::string_view status = columns_.status ? " status" : "";
        throw InputError(
            where, fmt::format("found a line of {} number{}, expected \"time x y{}{}\" once or "
                               "more, so a multiple of {} numbers",
                               in_line_, in_line_ == 1 ? "" : "s", z, status, columns_.width()));
    }

    PlaceColumns columns_;
    int column_ = 0;               ///< of the next number
    std::uint64_t in_line_ = 0;    ///< numbers
    std::uint64_t waypoints_ = 0;  ///< so far
    std::uint32_t nodes_ = 0;
    int empty_line_ = 0;  ///< the first; 0 = none yet
    Waypoint now_ = {};
    std::optional<Waypoint> before_;  ///< of the same node
};

/// Possible sets of columns that the file has not contradicted yet.
class Readings {
  public:
    explicit Readings(const std::vector<PlaceColumns>& candidates) {
        for (const PlaceColumns& columns : candidates) {
            left_.push_back({columns, WaypointLine(columns)});
        }
    }
    /// @throws InputError if the item contradicts the last possible one
    void feed(const BonnMotionNumbers& numbers, Item item) {
        for (std::size_t i = 0; i < left_.size();) {
            try {
                if (item == Item::number) left_[i].line.number(numbers);
                if (item == Item::end_of_line) left_[i].line.end_of_line(numbers);
                ++i;
            } catch (const InputError& error) {
                failed_.push_back({static_cast<std::uint64_t>(left_[i].columns.width()), error});
                left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i));
            }
        }
        if (left_.empty()) fail(numbers.line().line, item == Item::end_of_line);
        length_ = item == Item::number ? length_ + 1 : 0;
    }
    std::pair<PlaceColumns, std::uint64_t> best() const {
        return {left_.front().columns, left_.front().line.waypoints()};
    }

  private:
    struct Reading {
        PlaceColumns columns;
        WaypointLine line;
    };
    struct Failure {
        std::uint64_t width;
        InputError error;
    };

    /// Throws the error of the possible set that failed last, or of the one that fits the length of
    /// the line.
    [[noreturn]] void fail(int line, bool at_end_of_line) const {
        const InputError& last = failed_.back().error;
        if (!at_end_of_line || failed_.size() == 1) throw last;
        const Failure& other = failed_.front();
        if (other.error.where().line != line) throw last;
        if (length_ % other.width == 0) throw other.error;
        throw InputError(last.where(),
                         fmt::format("{}, or of {} numbers", last.message(), other.width));
    }

    std::vector<Reading> left_;
    std::vector<Failure> failed_;
    std::uint64_t length_ = 0;  ///< numbers of the line so far
};

}  // namespace

int BonnMotionNumbers::column() const {
    constexpr std::uint64_t most = std::numeric_limits<int>::max();
    return static_cast<int>(std::min(source_.taken() - line_start_ + 1, most));
}

/// Limits the length of a line: a file of one endless line would otherwise be read completely
/// before an error.
void BonnMotionNumbers::check_length() const {
    if (source_.taken() - line_start_ <= longest_line) return;
    throw InputError(
        where_,
        fmt::format(
            "a line is longer than {} bytes, which is the limit; check that this is the right file",
            longest_line));
}

/// Skips to the next byte that is not blank. False at the end of the file.
bool BonnMotionNumbers::skip_blanks() {
    while (true) {
        const std::string_view text = source_.window();
        const std::size_t n = text.find_first_not_of(between_numbers);
        source_.take(std::min(n, text.size()));
        check_length();
        if (n != text.npos) return true;
        if (!source_.more()) return false;
    }
}

/// Skips to the end of the line.
void BonnMotionNumbers::skip_comment() {
    while (true) {
        const std::string_view text = source_.window();
        const std::size_t n = text.find('\n');
        source_.take(std::min(n, text.size()));
        check_length();
        if (n != text.npos || !source_.more()) return;
    }
}

Item BonnMotionNumbers::end_line(std::size_t bytes) {
    word_ = {{}, column()};
    source_.take(bytes);
    line_ended_ = true;
    in_line_ = false;
    return Item::end_of_line;
}

void BonnMotionNumbers::begin_line() {
    if (!line_ended_) return;
    line_ended_ = false;
    if (where_.line < std::numeric_limits<int>::max()) ++where_.line;
    line_start_ = source_.taken();
}

Item BonnMotionNumbers::next() {
    while (true) {
        begin_line();
        if (!skip_blanks()) return in_line_ ? end_line(0) : Item::end_of_file;
        if (in_line_ || source_.window().front() != '#') break;
        skip_comment();
        if (source_.window().empty()) return Item::end_of_file;
        end_line(1);
    }
    source_.ensure(longest_number + 2);
    const std::string_view text = source_.window();
    if (text.front() == '\n') return end_line(1);
    in_line_ = true;
    std::size_t n = 1;
    while (n < text.size() && n <= longest_number && text[n] > ' ') ++n;
    word_ = {text.substr(0, n), column()};
    value_ = any_number(word_, where_, "a number");
    source_.take(n);
    return Item::number;
}

void BonnMotionNumbers::rewind() {
    source_.rewind();
    where_.line = 1;
    line_start_ = 0;
    line_ended_ = in_line_ = false;
}

void read_waypoints(BonnMotionNumbers& numbers, PlaceColumns columns,
                    const std::function<void(const Waypoint&)>& take) {
    WaypointLine line(columns);
    for (Item item = numbers.next(); item != Item::end_of_file; item = numbers.next()) {
        if (item == Item::end_of_line) {
            line.end_of_line(numbers);
        } else if (const auto waypoint = line.number(numbers)) {
            take(*waypoint);
        }
    }
}

std::pair<PlaceColumns, std::uint64_t> columns_of(BonnMotionNumbers& numbers,
                                                  const std::vector<PlaceColumns>& candidates) {
    Readings readings(candidates);
    for (Item item = numbers.next(); item != Item::end_of_file; item = numbers.next()) {
        readings.feed(numbers, item);
    }
    return readings.best();
}

}  // namespace rovernet
