// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "models/radio.hpp"
#include "scenario/reaction_table.hpp"
#include "scenario/tables/move_table.hpp"
#include "scenario/tables/propagation_table.hpp"
#include "scene/scanner.hpp"
#include "sim/error.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Robots in a scenario file:
//
//     [[robot]]
//     name = "A"
//     at = ["2 m", "3 m"]
//     radio = { power = "20 dBm" }
//     move = { model = "goal", to = ["9 m", "3 m"] }
//     on_receive = { payload = "stop", stop = true }

namespace rovernet {

/// place = { ... }: a random start position of a robot, drawn in each replication. The key of its
/// random stream includes the robot's name.
struct PlaceTable {
    /// Distribution of the start: uniform in an area, or one of several points.
    enum class Model { uniform, choice };

    Model model = Model::uniform;
    /// Lower-left and upper-right corner of the area [m]; used by the model uniform.
    std::vector<Vec3> area;
    /// Possible start positions [m], at least one; used by the model choice.
    std::vector<Vec3> points;
    Location where = {};

    static constexpr auto fields() {
        return describe(
            field("model", &PlaceTable::model,
                  "uniform: the place is drawn uniformly from an area; choice: the place is drawn "
                  "from a list of points"),
            field("area", &PlaceTable::area,
                  "for uniform: lower-left and upper-right corner of the area"),
            field("points", &PlaceTable::points, "for choice: the points, one of which is drawn"));
    }
};
/// Names of PlaceTable::Model in scenario files.
template <>
struct EnumNames<PlaceTable::Model> {
    static constexpr std::array<std::string_view, 2> values = {"uniform", "choice"};
};

/// File positions of the keys of a robot's radio, for errors that are found after reading. A key
/// that the robot's table lacks has its position in [radio].
struct RadioPlaces {
    Location power = {}, sensitivity = {}, frequency = {}, rate = {};
    Location ip = {}, netmask = {}, mac = {};
};
/// Reads [radio], or the `radio` table of a robot, into `out` and `places`. A missing key changes
/// neither its value in `out` nor its file position in `places`.
/// @param name  name of the table, for error messages
/// @throws InputError for an unknown key, a wrong type or a value out of range
void read_radio(const Value& value, const std::string& name, Radio& out, RadioPlaces& places);

/// [[robot]]: one robot, or `count` equal robots.
struct RobotTable {
    std::string name;
    /// Number of robots of the table, which are called name0, name1, ...; none: one robot, called
    /// `name`.
    std::optional<int> count;
    /// Start position [m], fixed (`at`) or random (`place`). If neither is given, the movement
    /// model draws the position.
    std::optional<Vec3> at;
    std::optional<PlaceTable> place;
    /// Heading at the start [rad].
    Radians heading{0};
    /// Radius of the robot's body [m], for paths around walls.
    Meters radius{0.2};
    /// Speed that no movement of the robot exceeds [m/s]; none: no limit.
    std::optional<MetersPerSecond> top_speed;
    /// Rate at which the robot turns in place before it drives [rad/s]; none: turns take no time.
    std::optional<RadiansPerSecond> turn_rate;
    /// Role in the routing protocol; none: the protocol's default role. Protocols without roles
    /// ignore the role.
    std::optional<std::string> role;
    /// Radio of the robot: [radio], overridden by the keys of the robot's `radio` table.
    Radio radio;
    RadioPlaces radio_places;
    /// Propagation model of the frames that this robot sends: [propagation], overridden by the
    /// robot's keys; none: [propagation] unchanged.
    std::optional<PropagationTable> propagation;
    /// True if the robot's `propagation` names a model; then [propagation] is ignored.
    bool own_model = false;
    /// Movement of the robot; by default the robot stays at its start position.
    MoveTable move;
    /// Range finders of the robot; external programs read their distances (`rovernet live`).
    std::vector<Scanner> scan;
    std::vector<ReactionTable> reactions;
    /// Times since the start of the run [ns] at which the robot is switched off and on. The robot
    /// is on at the start.
    std::vector<Duration> off, on;
    /// File positions of the [[robot]] table and of its keys. A missing key has the table's
    /// position.
    Location where, at_where, radio_where, propagation_where, on_where, off_where;

    /// Keys of the table that are plain values. Tables in it: place, move, scan, radio,
    /// propagation, and a reaction to each Trigger; the key `role` is a word of all_roles().
    static constexpr auto fields() {
        constexpr Range counts{.low = 1, .high = 10e6, .text = "from 1 to 10,000,000"};
        using R = RobotTable;
        return describe(
            field("name", &R::name, "name of the robot"),
            field("count", &R::count, counts,
                  "number of robots with these keys; the robots are named NAME0, NAME1, ..., where "
                  "NAME is the value of `name`"),
            field("at", &R::at, "place at which the robot starts"),
            field("heading", &R::heading, "heading of the robot at the start"),
            field("radius", &R::radius, non_negative, "radius of the robot's body"),
            field("top_speed", &R::top_speed, positive, "speed that the robot never exceeds"),
            field("turn_rate", &R::turn_rate, turn_rates,
                  "rate at which the robot turns in place; if not given, the robot turns at once"),
            field("off", &R::off, "times at which the robot is switched off"),
            field("on", &R::on, "times at which the robot is switched on"));
    }
    /// Name of the i-th robot of this [[robot]] table, i from 0.
    std::string name_of(int i) const { return count ? name + std::to_string(i) : name; }
};

struct Scenario;

/// Reads a [[robot]]. Defaults come from the scenario's other tables, which must have been read
/// before.
/// @param needs_place  returns false for robots, known by name and count, whose positions all come
///                     from a movement file; their names may have dots
/// @param placed       names of robots that a world or a movement file places, for suggestions
/// @throws InputError at the first mistake
RobotTable read_robot(const Value& value, const Scenario& scenario,
                      const std::function<bool(const RobotTable&)>& needs_place,
                      const std::vector<std::string>& placed = {});

/// Converts a robot to a table [[robot]]: the inverse of read_robot(). Values equal to the
/// scenario's defaults are omitted.
Table robot_document(const RobotTable& robot, const Scenario& scenario);

}  // namespace rovernet
