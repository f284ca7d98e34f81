// SPDX-License-Identifier: MIT
#pragma once

#include "models/radio.hpp"
#include "scenario/tables/move_table.hpp"
#include "scenario/tables/propagation_table.hpp"
#include "scenario/tables/reader.hpp"
#include "scene/scanner.hpp"
#include "sim/error.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Robots as a scenario file gives them:
//
//     [[robot]]
//     name = "A"
//     at = ["2 m", "3 m"]
//     radio = { power = "20 dBm" }
//     move = { model = "goal", to = ["9 m", "3 m"] }
//     on_receive = { payload = "stop", stop = true }

namespace rovernet {

/// place = { ... }: a start that is drawn anew in each replication, from the robot's name.
struct PlaceTable {
    /// Word of the model: uniform in an area, or a choice of points.
    enum class Model { uniform, choice };

    Model model = Model::uniform;
    /// Lower-left and upper-right corner [m], for uniform.
    std::vector<Vec3> area;
    /// Places of which one is drawn [m], for choice; at least one.
    std::vector<Vec3> points;
    Location where = {};

    static constexpr auto fields() {
        return describe(
            field("model", &PlaceTable::model, "uniform in an area, or a choice of points"),
            field("area", &PlaceTable::area, "uniform: lower-left and upper-right corner"),
            field("points", &PlaceTable::points, "choice: one of these places"));
    }
};
/// Words of the model in files.
template <>
struct EnumNames<PlaceTable::Model> {
    static constexpr std::array<std::string_view, 2> values = {"uniform", "choice"};
};

/// Trigger of a reaction: what the robot reacts to. The names are those of the robot's keys.
enum class Trigger {
    /// It is handed a message.
    on_receive,
    /// It comes to rest at the end of a movement.
    on_arrival,
    /// It cannot hear another robot any more.
    on_link_lost,
    /// A time of the run has come.
    on_time
};
/// Keys of the robot, in the order in which they are printed.
template <>
struct EnumNames<Trigger> {
    static constexpr std::array<std::string_view, 4> values = {"on_receive", "on_arrival",
                                                               "on_link_lost", "on_time"};
};

/// on_receive = { ... }, on_arrival, on_link_lost or on_time; a list of such tables stands for
/// several reactions. At least one of `move`, `send` and `stop` is given.
struct ReactionTable {
    Trigger trigger{};
    /// Text that the message begins with; empty: any. Of on_receive.
    std::string payload = {};
    /// Robot that sends the message, or whose link is lost; none: any. Of on_receive and
    /// on_link_lost.
    std::optional<std::string> from = {};
    /// Hops that the message crossed at most; none: any number. Of on_receive.
    std::optional<int> hops = {};
    /// Time since the start of the run [ns]. Of on_time.
    Duration time{0};
    /// The robot reacts the first time only. Not of on_time, which is once.
    bool once = true;
    /// Movement that it begins.
    std::optional<MoveTable> move = {};
    /// Payload of the message that it sends.
    std::optional<std::string> send = {};
    /// Robot that the message is for, or "sender"; none: everyone.
    std::optional<std::string> to = {};
    /// Size of the message; none: the length of its payload.
    std::optional<Bytes> size = {};
    /// The robot stops where it is; not with `move`.
    bool stop = false;
    /// Places of the table, and of its keys `from` and `to`.
    Location where = {}, from_where = {}, to_where = {};

    /// Word for the robot that sent the message first; it is no name.
    static constexpr std::string_view sender = "sender";
};

/// Places of a radio's keys in the file, for what is found wrong once everything is read. A robot
/// has those of [radio] for the keys that it does not give.
struct RadioPlaces {
    Location sensitivity = {}, frequency = {}, rate = {};
    Location ip = {}, netmask = {}, mac = {};
};
/// Reads [radio], or a robot's own table, over `out`; places of keys that are not there stay as
/// they are.
/// @param name  of the table, for errors
/// @throws InputError for an unknown key, a wrong type and a value out of its range
void read_radio(const Value& value, const std::string& name, Radio& out, RadioPlaces& places);

/// [[robot]]: one robot, or `count` of a kind.
struct RobotTable {
    std::string name;
    /// Number of robots name0, name1, ...; none: one, with the name as it is.
    std::optional<int> count;
    /// Start [m]; either this or `place` is given, or the movement draws the start.
    std::optional<Vec3> at;
    std::optional<PlaceTable> place;
    /// Heading at the start [rad].
    Radians heading{0};
    /// Radius of the body [m], for ways around walls.
    Meters radius{0.2};
    /// Speed that no movement exceeds [m/s]; none: any.
    std::optional<MetersPerSecond> top_speed;
    /// Rate at which it turns in place before it moves off [rad/s]; none: it turns at once.
    std::optional<RadiansPerSecond> turn_rate;
    /// Radio: [radio] with the robot's own keys over it.
    Radio radio;
    RadioPlaces radio_places;
    /// Propagation of what it sends: its own keys over [propagation]; none: [propagation].
    std::optional<PropagationTable> propagation;
    /// The robot's `propagation` chooses a model, and then nothing of [propagation] counts.
    bool own_model = false;
    /// Movement; by default it stays where it is.
    MoveTable move;
    /// Range finders, for programs outside.
    std::vector<Scanner> scan;
    std::vector<ReactionTable> reactions;
    /// Times at which the robot is switched off and on [ns]; it starts switched on.
    std::vector<Duration> off, on;
    /// Places of the table and of its keys; of the table for keys that are not there.
    Location where, at_where, radio_where, propagation_where, on_where, off_where;

    /// Name of the i-th robot, i from 0.
    std::string name_of(int i) const { return count ? name + std::to_string(i) : name; }
};

struct Scenario;

/// Reads a [[robot]], over the defaults of the scenario's other tables, which are read before it.
/// @param needs_place  false for a robot that a movement file places
/// @throws InputError at the first mistake
RobotTable read_robot(const Value& value, const Scenario& scenario, bool needs_place);

/// Table that reads back as the same robot: what differs from the scenario's defaults.
Table robot_document(const RobotTable& robot, const Scenario& scenario);

}  // namespace rovernet
