// SPDX-License-Identifier: MIT
#include "mobility/files/setdest.hpp"

#include "files/word.hpp"
#include "mobility/files/setdest_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rovernet {
namespace {

/// Motion of a node until its next command.
struct Course {
    Time start;
    Vec3 from;  ///< [m] at `start`
    double x;   ///< [m] where it stops
    double y;
    double speed;  ///< [m/s]

    double length() const {
        const double dx = x - from.x;
        const double dy = y - from.y;
        return std::sqrt(dx * dx + dy * dy);
    }
    Vec3 position(Time t) const {
        const double whole = length();
        const double done = speed * seconds(t - start);
        if (done >= whole) return {x, y, from.z};
        return {from.x + done / whole * (x - from.x), from.y + done / whole * (y - from.y), from.z};
    }
    Time arrival() const {
        const double duration = speed == 0 ? 0 : length() / speed;
        const Time last = start_of_run + from_seconds(latest);
        return duration < latest ? std::min(last, start + from_seconds(duration)) : last;
    }
};

Course standing(Time time, Vec3 at) { return {time, at, at.x, at.y, 0}; }

double& component(Vec3& v, std::uint8_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// Scheduled line stored in memory.
struct KeptLine {
    Time time;
    double x;
    double y;
    double speed;
    std::uint64_t key;  ///< its number in the file, then the robot (24 bits), then what it says (2)
};
static_assert(sizeof(KeptLine) == 40 && most_file_robots <= 1U << 24U);

class SetdestReader final : public MovementFile::Reader {
  public:
    SetdestReader(TextSource source, MovementSyntax syntax)
        : lines_(std::move(source)), tolerant_(syntax == MovementSyntax::tolerant) {
        scan();
        if (robots.empty() && no_brackets_) throw NoBracketsError(*no_brackets_);
        const std::uint64_t skipped = skipped_;  // reading again counts again
        sort_robots();
        if (!in_order_) keep();
        if (!in_order_ || places_late_) replay();
        note_end();
        if (end > last_of_run) find_end();
        start_over();
        if (skipped > 0) {
            notices.push_back(fmt::format("{} line{} left out; the first{}: {}", skipped,
                                          skipped == 1 ? " is" : "s are",
                                          no_brackets_ ? " that moves a robot" : "",
                                          no_brackets_ ? no_brackets_->what() : first_skipped_));
        }
    }

    std::optional<MovementCommand> next() override {
        if (!in_order_)
            return cursor_ < kept_.size() ? std::optional(unkept(kept_[cursor_++])) : std::nullopt;
        while (next_line()) {
            if (line_.kind == SetdestLine::Kind::place) continue;
            if (robot() == none || line_.time < last_) fail_changed(lines_.where().source);
            last_ = line_.time;
            return follow(robot(), line_);
        }
        return std::nullopt;
    }

  private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    bool next_line();
    void skip(const InputError& error);
    void scan();
    void sort_robots();
    void keep();
    void replay();
    void note_end();
    void find_end();
    void start_over();
    MovementCommand follow(std::uint32_t robot, const SetdestLine& line);
    MovementCommand unkept(const KeptLine& kept);

    /// Robot of the current line; empty if it is not known.
    std::uint32_t robot() const {
        return line_.node < robot_of_.size() ? robot_of_[line_.node] : none;
    }
    std::uint32_t known_robot();

    TextLines lines_;
    bool tolerant_;
    SetdestLine line_;
    std::uint64_t skipped_ = 0;
    std::string first_skipped_;
    std::optional<NoBracketsError> no_brackets_;  ///< the first; its line is skipped

    std::vector<std::uint32_t> robot_of_;  ///< by node
    std::vector<Course> courses_;          ///< by robot
    std::uint64_t scheduled_ = 0;          ///< lines
    bool in_order_ = true;
    bool places_late_ = false;
    Time last_ = start_of_run;

    std::vector<KeptLine> kept_;
    std::size_t cursor_ = 0;
};

void SetdestReader::skip(const InputError& error) {
    if (skipped_++ == 0) first_skipped_ = error.what();
}

/// Reads lines until one is not empty. False at the end.
bool SetdestReader::next_line() {
    while (const auto text = lines_.next()) {
        if (!tolerant_) {
            line_ = parse_setdest_line(*text, lines_.where());
        } else {
            try {
                line_ = parse_setdest_line(*text, lines_.where());
            } catch (const NoBracketsError& error) {
                if (!no_brackets_) no_brackets_ = error;
                skip(error);
                continue;
            } catch (const InputError& error) {
                skip(error);
                continue;
            }
        }
        if (line_.kind != SetdestLine::Kind::nothing) return true;
    }
    return false;
}

std::uint32_t SetdestReader::known_robot() {
    if (line_.node >= robot_of_.size()) robot_of_.resize(line_.node + 1, none);
    std::uint32_t& robot = robot_of_[line_.node];
    if (robot == none) {
        robot = static_cast<std::uint32_t>(courses_.size());
        robots.push_back({});
        courses_.push_back(standing(start_of_run, {}));
    }
    return robot;
}

/// Reads the file once; robots are in the order in which the file names them.
void SetdestReader::scan() {
    while (next_line()) {
        const std::uint32_t robot = known_robot();
        if (line_.kind == SetdestLine::Kind::place) {
            component(robots[robot].start, line_.axis) = line_.x;
            courses_[robot] = standing(start_of_run, robots[robot].start);
            places_late_ |= scheduled_ > 0;
            continue;
        }
        ++scheduled_;
        in_order_ &= line_.time >= last_;
        last_ = std::max(last_, line_.time);
        if (in_order_ && !places_late_) follow(robot, line_);
    }
}

void SetdestReader::sort_robots() {
    std::vector<FileRobot> named = std::move(robots);
    std::vector<Course> courses = std::move(courses_);
    robots.reserve(named.size());
    courses_.reserve(named.size());
    for (std::size_t node = 0; node < robot_of_.size(); ++node) {
        const std::uint32_t old = robot_of_[node];
        if (old == none) continue;
        robot_of_[node] = static_cast<std::uint32_t>(robots.size());
        robots.push_back({.name = fmt::format("n{}", node), .start = named[old].start});
        courses_.push_back(courses[old]);
    }
}

void SetdestReader::keep() {
    lines_.rewind();
    kept_.reserve(scheduled_);
    std::uint64_t number = 0;
    while (next_line()) {
        if (line_.kind == SetdestLine::Kind::place) continue;
        if (robot() == none || kept_.size() == scheduled_) fail_changed(lines_.where().source);
        const std::uint64_t what = line_.kind == SetdestLine::Kind::setdest ? 0 : line_.axis + 1U;
        kept_.push_back({line_.time, line_.x, line_.y, line_.speed,
                         number++ << 26U | std::uint64_t{robot()} << 2U | what});
    }
    std::sort(kept_.begin(), kept_.end(), [](const KeptLine& a, const KeptLine& b) {
        return a.time != b.time ? a.time < b.time : a.key < b.key;
    });
    notices.push_back(kept_notice(lines_.where().source, kept_.size()));
}

MovementCommand SetdestReader::unkept(const KeptLine& kept) {
    const auto what = static_cast<std::uint8_t>(kept.key & 3U);
    SetdestLine line{.kind = what == 0 ? SetdestLine::Kind::setdest : SetdestLine::Kind::jump,
                     .node = 0,
                     .time = kept.time,
                     .axis = static_cast<std::uint8_t>(what == 0 ? 0 : what - 1),
                     .x = kept.x,
                     .y = kept.y,
                     .speed = kept.speed};
    return follow(static_cast<std::uint32_t>(kept.key >> 2U) & 0xFFFFFFU, line);
}

MovementCommand SetdestReader::follow(std::uint32_t robot, const SetdestLine& line) {
    Course& course = courses_[robot];
    Vec3 here = course.position(line.time);
    if (line.kind == SetdestLine::Kind::jump) {
        component(here, line.axis) = line.x;
        course = standing(line.time, here);
        return {
            .time = line.time, .robot = robot, .kind = MovementCommand::Kind::appear, .to = here};
    }
    course = {line.time, here, line.x, line.y, line.speed};
    return {.time = line.time,
            .robot = robot,
            .kind = MovementCommand::Kind::go,
            .to = {line.x, line.y, here.z},
            .speed = line.speed};
}

/// Simulates all commands, to find their ends.
void SetdestReader::replay() {
    start_over();
    while (next()) continue;
}

void SetdestReader::note_end() {
    end = last_;
    for (const Course& course : courses_) end = std::max(end, course.arrival());
}

/// Finds the line of the command that ends last: the last command of the robot that arrives then,
/// or the last command of that time.
void SetdestReader::find_end() {
    lines_.rewind();
    Time latest_so_far = start_of_run;
    while (next_line()) {
        if (line_.kind == SetdestLine::Kind::place || line_.time < latest_so_far) continue;
        if (end != last_ && courses_[known_robot()].arrival() != end) continue;
        latest_so_far = line_.time;
        end_where = lines_.where();
    }
}

void SetdestReader::start_over() {
    for (std::size_t i = 0; i < robots.size(); ++i) {
        courses_[i] = standing(start_of_run, robots[i].start);
    }
    last_ = start_of_run;
    cursor_ = 0;
    if (in_order_) lines_.rewind();
}

}  // namespace

std::unique_ptr<MovementFile::Reader> read_setdest(TextSource source, MovementSyntax syntax) {
    return std::make_unique<SetdestReader>(std::move(source), syntax);
}

}  // namespace rovernet
