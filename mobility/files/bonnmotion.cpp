// SPDX-License-Identifier: MIT
#include "mobility/files/bonnmotion.hpp"

#include "files/word.hpp"
#include "mobility/files/bonnmotion_waypoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <tuple>

namespace rovernet {
namespace {

/// Possible columns by NAME.params; if it is not clear, the waypoints decide.
std::vector<PlaceColumns> layouts_of(const std::string& movements) {
    std::string name = movements;
    if (name.ends_with(".gz")) name.resize(name.size() - 3);
    constexpr std::string_view extension = ".movements";
    if (name.ends_with(extension)) name.resize(name.size() - extension.size());
    name += ".params";
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(name, ignored)) return {{.z = false}, {.z = true}};

    TextLines lines((TextSource(name)));
    bool has_z = false;
    bool status = false;
    std::string_view output;
    while (const auto line = lines.next()) {
        if (*line == "model=DisasterArea") status = true;
        if (line->starts_with("z=")) has_z = true;
        if (*line == "J=2D" || *line == "J=2d") output = "2D";
        if (*line == "J=3D" || *line == "J=3d") output = "3D";
    }
    if (output.empty() && has_z)
        return {{.z = true, .status = status}, {.z = false, .status = status}};
    return {{.z = output == "3D", .status = status}};
}

class BonnMotionReader final : public MovementFile::Reader {
  public:
    explicit BonnMotionReader(TextSource source) : numbers_(std::move(source)) {
        const auto [columns, count] = columns_of(numbers_, layouts_of(numbers_.source()));
        keep(columns, count);
        if (layouts_of(numbers_.source()).size() > 1) refuse_track();
        const std::uint64_t legs = times_.size() - robots.size();
        if (legs > 0) notices.push_back(kept_notice(numbers_.source(), legs));
        line_up();
    }

    std::optional<MovementCommand> next() override;

  private:
    /// Next command of a robot.
    struct Turn {
        Time time;
        std::uint32_t robot;
        bool appears;
    };
    static bool later(const Turn& a, const Turn& b) {
        return std::tie(a.time, a.robot) > std::tie(b.time, b.robot);
    }

    void keep(PlaceColumns columns, std::uint64_t count);
    void refuse_track() const;
    void line_up();
    void wait(Turn turn) {
        turns_.push_back(turn);
        std::push_heap(turns_.begin(), turns_.end(), later);
    }
    Vec3 place(std::size_t waypoint) const {
        const double* p = coordinates_.data() + waypoint * width_;
        return {p[0], p[1], width_ == 3 ? p[2] : 0};
    }

    BonnMotionNumbers numbers_;
    std::size_t width_ = 2;            ///< coordinates of a place
    std::vector<Time> times_;          ///< of the waypoints of all robots, robot after robot
    std::vector<double> coordinates_;  ///< [m] of the waypoints
    std::vector<std::size_t> next_;    ///< by robot: the waypoint where its next leg starts
    std::vector<std::size_t> end_;     ///< by robot: past its last waypoint
    std::vector<Turn> turns_;          ///< a heap, the first on top
};

void BonnMotionReader::keep(PlaceColumns columns, std::uint64_t count) {
    width_ = columns.z ? 3 : 2;
    times_.reserve(count);
    coordinates_.reserve(count * width_);
    numbers_.rewind();
    read_waypoints(numbers_, columns, [&](const Waypoint& w) {
        if (w.first) {
            robots.push_back(
                {.name = fmt::format("n{}", robots.size()), .start = w.place, .appears = w.time});
            next_.push_back(times_.size());
            end_.push_back(times_.size());
        }
        times_.push_back(w.time);
        coordinates_.push_back(w.place.x);
        coordinates_.push_back(w.place.y);
        if (columns.z) coordinates_.push_back(w.place.z);
        ++end_.back();
        if (w.time > std::max(end, last_of_run)) {
            end_where = numbers_.line();
            end_where.column = w.column;
        }
        end = std::max(end, w.time);
    });
}

/// Refuses a file with the track of one robot in one line per time: it would give many standing
/// robots. In BonnMotion files robots have one line each, and hardly ever appear one after the
/// other and stand.
void BonnMotionReader::refuse_track() const {
    const bool are_single = times_.size() == robots.size();
    if (!are_single || !std::is_sorted(times_.begin(), times_.end())) return;
    if (times_.empty() || times_.front() == times_.back()) return;
    throw InputError(
        {.source = numbers_.source()},
        fmt::format("each of the {} lines of this file has only one place, at a later time than in "
                    "the line before: this is a track with one line for each time; expected one "
                    "line for each robot, with \"time x y\" once or more (to convert a track of "
                    "one robot: tr '\\n' ' ' < TRACK > FILE)",
                    robots.size()));
}

void BonnMotionReader::line_up() {
    turns_.reserve(robots.size());
    for (std::uint32_t robot = 0; robot < robots.size(); ++robot) {
        const Time first = robots[robot].appears;
        const bool appears = first > start_of_run;
        if (appears || end_[robot] - next_[robot] > 1) wait({first, robot, appears});
    }
}

std::optional<MovementCommand> BonnMotionReader::next() {
    if (turns_.empty()) return std::nullopt;
    std::pop_heap(turns_.begin(), turns_.end(), later);
    const Turn turn = turns_.back();
    turns_.pop_back();
    const std::uint32_t robot = turn.robot;
    MovementCommand command{.time = turn.time,
                            .robot = robot,
                            .kind = MovementCommand::Kind::appear,
                            .to = robots[robot].start};
    if (!turn.appears) {
        const std::size_t to = ++next_[robot];
        command.kind = MovementCommand::Kind::reach;
        command.to = place(to);
        command.arrival = times_[to];
    }
    if (end_[robot] - next_[robot] > 1) wait({times_[next_[robot]], robot, false});
    return command;
}

}  // namespace

std::unique_ptr<MovementFile::Reader> read_bonnmotion(TextSource source) {
    return std::make_unique<BonnMotionReader>(std::move(source));
}

}  // namespace rovernet
