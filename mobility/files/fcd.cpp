// SPDX-License-Identifier: MIT
#include "mobility/files/fcd.hpp"

#include "files/word.hpp"
#include "mobility/files/xml_tags.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <system_error>
#include <unordered_set>  // order never observed

namespace rovernet {
namespace {

using Kind = MovementCommand::Kind;

/// Robots by name. The set stores only their indices.
class RobotNames {
  public:
    explicit RobotNames(const std::vector<FileRobot>& robots)
        : indices_(16, Key{robots}, Key{robots}) {}

    std::optional<std::uint32_t> find(std::string_view name) const {
        const auto found = indices_.find(name);
        return found == indices_.end() ? std::nullopt : std::optional(*found);
    }
    void add(std::uint32_t robot) { indices_.insert(robot); }

  private:
    struct Key {
        using is_transparent = void;
        const std::vector<FileRobot>& robots;

        std::string_view name(std::uint32_t robot) const { return robots[robot].name; }
        std::string_view name(std::string_view text) const { return text; }
        template <class T>
        std::size_t operator()(const T& key) const {
            return XXH3_64bits(name(key).data(), name(key).size());
        }
        template <class A, class B>
        bool operator()(const A& a, const B& b) const {
            return name(a) == name(b);
        }
    };
    std::unordered_set<std::uint32_t, Key, Key> indices_;
};

/// Whether a name can be printed: UTF-8 without control characters.
bool is_text(std::string_view name) {
    for (std::size_t i = 0; i < name.size();) {
        const auto lead = static_cast<unsigned char>(name[i++]);
        if (lead < 0x20 || lead == 0x7F || (lead >= 0x80 && lead < 0xC2) || lead > 0xF4)
            return false;
        const int more = lead < 0x80 ? 0 : lead < 0xE0 ? 1 : lead < 0xF0 ? 2 : 3;
        for (int k = 0; k < more; ++k, ++i) {
            if (i == name.size() || (static_cast<unsigned char>(name[i]) & 0xC0U) != 0x80)
                return false;
        }
    }
    return !name.empty();
}

class FcdReader final : public MovementFile::Reader {
  public:
    FcdReader(TextSource source, MovementSyntax syntax)
        : tags_(std::move(source)), tolerant_(syntax == MovementSyntax::tolerant) {
        enter_root();
        while (read_step()) {
            end = time_;
            if (end > last_of_run) end_where = step_where_;
        }
        scanned_ = true;
        refuse_degrees();
        states_.shrink_to_fit();
        start_over();
        if (skipped_ > 0) {
            notices.push_back(fmt::format("{} element{} left out; the first: {}", skipped_,
                                          skipped_ == 1 ? " is" : "s are", first_skipped_));
        }
    }

    std::optional<MovementCommand> next() override;

  private:
    /// Robot in one timestep.
    struct Sighting {
        std::uint32_t robot;
        Vec3 at;
    };
    struct State {
        Vec3 at;                   ///< [m] in the last timestep that has it
        std::uint64_t step = 0;    ///< number of this timestep, from 1; 0 = none yet
        std::uint64_t before = 0;  ///< of the one before
    };

    void enter_root();
    void refuse_degrees() const;
    void compare_speed(const Sighting& now, const State& before);
    void start_over();
    bool read_step();
    void read_robots();
    void read_robot();
    Word needed(std::string_view attribute);
    double length(std::string_view attribute) {
        return coordinate(needed(attribute), tags_.where());
    }
    std::uint32_t robot_of(Word id);
    void skip_unknown();
    void skip(const InputError& error) {
        if (skipped_++ == 0) first_skipped_ = error.what();
    }
    std::optional<MovementCommand> goes_on(const Sighting& before) const;

    XmlTags tags_;
    bool tolerant_;
    bool scanned_ = false;
    std::uint64_t skipped_ = 0;
    std::string first_skipped_;
    RobotNames names_{robots};
    std::vector<State> states_;  ///< by robot
    // Sum of all path lengths by the positions, and by the speeds [m].
    double length_by_places_ = 0, length_by_speeds_ = 0;
    bool may_be_degrees_ = true;  ///< no place is beyond 180, 90

    std::uint64_t step_ = 0;  ///< number of the current timestep, from 1
    Location step_where_;     ///< its place, if it is later than the longest run
    Time time_ = start_of_run;
    Time time_before_ = start_of_run;
    std::vector<Sighting> now_;
    std::vector<Sighting> before_;
    std::size_t next_before_ = 0;  ///< of before_: what it does now is the next command
    std::size_t next_now_ = 0;     ///< of now_: its appearance is the next command
};

void FcdReader::enter_root() {
    tags_.next();
    if (tags_.name() != "fcd-export") {
        fail_at(tags_.where(), {tags_.name(), tags_.where().column + 1},
                "fcd-export, the only kind of XML file with movements that can be read");
    }
}

/// Whether the head of SUMO's file has the option switched on.
bool is_option_on(std::string_view head, std::string_view option) {
    const std::size_t found = head.find(option);
    if (found == head.npos) return false;
    constexpr std::string_view before = "value=\"";
    const std::size_t begin = head.find(before, found);
    const std::size_t end = head.find('>', found);
    if (begin == head.npos || begin > end) return false;
    const std::string_view rest = head.substr(begin + before.size());
    std::string value(rest.substr(0, rest.find('"')));
    for (char& c : value) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    constexpr std::string_view yes[] = {"true", "t", "1", "yes", "y", "on", "x"};
    return std::find(std::begin(yes), std::end(yes), value) != std::end(yes);
}

/// Refuses longitudes and latitudes, which would be read as metres.
void FcdReader::refuse_degrees() const {
    constexpr double factor = 1000;  // a degree has 111 km, or less along a parallel
    constexpr double enough = 1;     // [m]
    const bool is_told = is_option_on(tags_.head_comments(), "fcd-output.geo");
    const bool is_so = may_be_degrees_ && length_by_speeds_ > enough &&
                       factor * length_by_places_ < length_by_speeds_;
    if (!is_told && !is_so) return;
    throw InputError(
        {.source = tags_.source()},
        fmt::format(
            "the positions are in degrees: {}; expected metres, as SUMO writes them without "
            "--fcd-output.geo",
            is_told ? "the head of the file states that fcd-output.geo is on"
                    : "the paths computed from the speeds are more than a thousand times as long "
                      "as the paths between the positions"));
}

/// Adds the path from the previous position to both sums, if the speed is given.
void FcdReader::compare_speed(const Sighting& now, const State& before) {
    constexpr double most_x = 180, most_y = 90;
    if (!(std::abs(now.at.x) <= most_x && std::abs(now.at.y) <= most_y)) may_be_degrees_ = false;
    if (!may_be_degrees_ || before.step == 0 || before.step + 1 != step_) return;
    const auto speed = tags_.value("speed");
    if (!speed) return;
    double value = 0;
    const char* stop = speed->text.data() + speed->text.size();
    if (std::from_chars(speed->text.data(), stop, value).ec != std::errc{} || !(value > 0)) return;
    length_by_speeds_ += value * seconds(time_ - time_before_);
    length_by_places_ += distance(now.at, before.at);
}

void FcdReader::start_over() {
    tags_.rewind();
    enter_root();
    step_ = 0;
    time_ = time_before_ = start_of_run;
    now_.clear();
    before_.clear();
    next_before_ = next_now_ = 0;
    for (State& state : states_) state = {};
}

/// Reads a timestep; false at the end of the file.
bool FcdReader::read_step() {
    while (true) {
        const auto kind = tags_.next();
        if (kind == XmlTags::Kind::end_of_file) return false;
        if (kind == XmlTags::Kind::close) continue;
        if (tags_.name() == "timestep") break;
        skip_unknown();
    }
    std::swap(before_, now_);
    now_.clear();
    next_before_ = next_now_ = 0;
    const Word word = needed("time");
    time_before_ = time_;
    time_ = moment(word, tags_.where());
    if (time_ > last_of_run) {
        step_where_ = tags_.where();
        step_where_.column = word.column;
    }
    if (step_ > 0 && time_ <= time_before_) {
        fail_at(tags_.where(), word, "a later time than the time of the timestep before");
    }
    ++step_;
    read_robots();
    return true;
}

void FcdReader::read_robots() {
    while (tags_.next() == XmlTags::Kind::open) {
        if (tags_.name() != "vehicle" && tags_.name() != "person" && tags_.name() != "container") {
            skip_unknown();
            continue;
        }
        if (!tolerant_) {
            read_robot();
        } else {
            try {
                read_robot();
            } catch (const InputError& error) {
                skip(error);
            }
        }
        tags_.skip_element();
    }
}

void FcdReader::read_robot() {
    Sighting sighting{.robot = 0, .at = {length("x"), length("y"), 0}};
    if (tags_.value("z")) sighting.at.z = length("z");
    const Word id = needed("id");
    sighting.robot = robot_of(id);
    State& state = states_[sighting.robot];
    if (state.step == step_) fail_at(tags_.where(), id, "each id only once in a timestep");
    if (!scanned_ && state.step == 0) {
        robots[sighting.robot].start = sighting.at;
        robots[sighting.robot].appears = time_;
    }
    if (!scanned_) compare_speed(sighting, state);
    state.before = state.step;
    state.step = step_;
    state.at = sighting.at;
    now_.push_back(sighting);
}

Word FcdReader::needed(std::string_view attribute) {
    const auto word = tags_.value(attribute);
    if (word && !word->text.empty()) return *word;
    throw InputError(tags_.where(),
                     fmt::format("found <{}> without the attribute {}, expected {}=\"...\"",
                                 tags_.name(), attribute, attribute));
}

std::uint32_t FcdReader::robot_of(Word id) {
    if (const auto known = names_.find(id.text)) return *known;
    constexpr std::size_t longest_id = 256;
    if (!is_text(id.text) || id.text.size() > longest_id) {
        fail_at(tags_.where(), id, "an id of 1 to 256 bytes of UTF-8 without control characters");
    }
    if (scanned_) fail_changed(tags_.source());
    if (robots.size() == most_file_robots) fail_at(tags_.where(), id, "at most 10000000 robots");
    const auto robot = static_cast<std::uint32_t>(robots.size());
    robots.push_back({.name = std::string(id.text), .start = {}});
    states_.emplace_back();
    names_.add(robot);
    return robot;
}

/// Skips an element that FCD files do not have.
void FcdReader::skip_unknown() {
    const auto suggestion =
        did_you_mean(tags_.name(), {"timestep", "vehicle", "person", "container"});
    const InputError error(
        tags_.where(), fmt::format("found <{}>, expected <timestep> with <vehicle>, <person> or "
                                   "<container>{}{}",
                                   tags_.name(), suggestion.empty() ? "" : "; ", suggestion));
    if (!tolerant_) throw error;
    skip(error);
    tags_.skip_element();
}

/// Command of a robot between the previous timestep and this one.
std::optional<MovementCommand> FcdReader::goes_on(const Sighting& before) const {
    const State& state = states_[before.robot];
    MovementCommand command{
        .time = time_before_, .robot = before.robot, .kind = Kind::vanish, .to = before.at};
    if (state.step != step_) return command;
    if (state.at == before.at) return std::nullopt;
    command.kind = Kind::reach;
    command.to = state.at;
    command.arrival = time_;
    return command;
}

std::optional<MovementCommand> FcdReader::next() {
    while (true) {
        while (next_before_ < before_.size()) {
            if (const auto command = goes_on(before_[next_before_++])) return command;
        }
        while (next_now_ < now_.size()) {
            const Sighting& s = now_[next_now_++];
            const auto seen = states_[s.robot].before;  // the step; 0: in none
            const bool was_there = seen > 0 && seen + 1 == step_;
            if (was_there || time_ == start_of_run) continue;
            return MovementCommand{
                .time = time_, .robot = s.robot, .kind = Kind::appear, .to = s.at};
        }
        if (!read_step()) return std::nullopt;
    }
}

}  // namespace

std::unique_ptr<MovementFile::Reader> read_fcd(TextSource source, MovementSyntax syntax) {
    return std::make_unique<FcdReader>(std::move(source), syntax);
}

}  // namespace rovernet
