// SPDX-License-Identifier: MIT
#pragma once

#include "models/radio.hpp"
#include "scenario/tables/move_table.hpp"
#include "scenario/tables/propagation_table.hpp"
#include "scene/scanner.hpp"
#include "sim/error.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"

#include <array>
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
            field("model", &PlaceTable::model, "uniform in an area, or a choice of points"),
            field("area", &PlaceTable::area, "uniform: lower-left and upper-right corner"),
            field("points", &PlaceTable::points, "choice: one of these places"));
    }
};
/// Names of PlaceTable::Model in scenario files.
template <>
struct EnumNames<PlaceTable::Model> {
    static constexpr std::array<std::string_view, 2> values = {"uniform", "choice"};
};

/// Trigger of a reaction: the event to which the robot reacts. Each enumerator has the name of its
/// key in [[robot]].
enum class Trigger {
    /// The robot receives a message.
    on_receive,
    /// The robot comes to rest at the end of a movement.
    on_arrival,
    /// The link from any other robot to the reacting robot is lost.
    on_link_lost,
    /// A given time of the run is reached.
    on_time
};
/// Key of a [[robot]] table for each Trigger, in the order of printing.
template <>
struct EnumNames<Trigger> {
    static constexpr std::array<std::string_view, 4> values = {"on_receive", "on_arrival",
                                                               "on_link_lost", "on_time"};
};

/// Reaction of a robot to an event: on_receive = { ... }, on_arrival, on_link_lost or on_time. A
/// list of tables stands for several reactions. At least one of `move`, `send` and `stop` is given.
struct ReactionTable {
    Trigger trigger{};
    /// Text with which the payload of the received message must begin; empty: any message. Used by
    /// on_receive.
    std::string payload = {};
    /// Robot that sent the message, or whose link is lost; none: any robot. Used by on_receive and
    /// on_link_lost.
    std::optional<std::string> from = {};
    /// Largest number of hops of the message; none: any number. Used by on_receive.
    std::optional<int> hops = {};
    /// Time of the reaction since the start of the run [ns]. Used by on_time.
    Duration time{0};
    /// True if the robot reacts only to the first event of the trigger; false: to all events. Not
    /// used by on_time, which happens once.
    bool once = true;
    /// Movement that the robot starts in reaction to the event `trigger`; none: no movement.
    std::optional<MoveTable> move = {};
    /// Payload of the message that the robot sends in reaction to the event `trigger`; none: no
    /// message is sent.
    std::optional<std::string> send = {};
    /// Destination of the message that the robot sends: a robot's name, or "sender"; none:
    /// everyone.
    std::optional<std::string> to = {};
    /// Size [bytes] of the message that the robot sends; none: the length of its payload.
    std::optional<Bytes> size = {};
    /// True if the robot stops at its current position; excludes `move`.
    bool stop = false;
    /// File positions of the reaction's table, and of its keys `from` and `to`.
    Location where = {}, from_where = {}, to_where = {};

    /// Value of `to` for the origin of the received message, even if a robot is named "sender".
    static constexpr std::string_view sender = "sender";
};

/// File positions of the keys of a robot's radio, for errors that are found after reading. A key
/// that the robot's table lacks has its position in [radio].
struct RadioPlaces {
    Location sensitivity = {}, frequency = {}, rate = {};
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

    /// Name of the i-th robot of this [[robot]] table, i from 0.
    std::string name_of(int i) const { return count ? name + std::to_string(i) : name; }
};

struct Scenario;

/// Reads a [[robot]]. Defaults come from the scenario's other tables, which must have been read
/// before.
/// @param needs_place  false for a robot whose position comes from a movement file
/// @throws InputError at the first mistake
RobotTable read_robot(const Value& value, const Scenario& scenario, bool needs_place);

/// Converts a robot to a table [[robot]]: the inverse of read_robot(). Values equal to the
/// scenario's defaults are omitted.
Table robot_document(const RobotTable& robot, const Scenario& scenario);

}  // namespace rovernet
