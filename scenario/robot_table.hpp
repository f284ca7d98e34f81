// SPDX-License-Identifier: MIT
#pragma once

#include "models/radio.hpp"
#include "scenario/move_table.hpp"
#include "scenario/propagation_table.hpp"
#include "scenario/reader.hpp"
#include "sim/error.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// place = { ... }: a start that is drawn anew in each replication.
struct PlaceTable {
    enum class Model { uniform, choice };

    Model model = Model::uniform;
    std::vector<Vec3> area;    ///< [m] uniform: lower-left and upper-right corner
    std::vector<Vec3> points;  ///< [m] choice: one of these
    Location where = {};

    static constexpr auto fields() {
        return describe(
            field("model", &PlaceTable::model, "uniform in an area, or a choice of points"),
            field("area", &PlaceTable::area, "uniform: lower-left and upper-right corner"),
            field("points", &PlaceTable::points, "choice: one of these places"));
    }
};
template <>
struct EnumNames<PlaceTable::Model> {
    static constexpr std::array<std::string_view, 2> values = {"uniform", "choice"};
};

/// What a robot reacts to; the names are those of the robot's keys.
enum class Trigger { on_receive, on_arrival, on_link_lost, on_time };
template <>
struct EnumNames<Trigger> {
    static constexpr std::array<std::string_view, 4> values = {"on_receive", "on_arrival",
                                                               "on_link_lost", "on_time"};
};

/// on_receive = { ... } and its kind; a list of such tables stands for several reactions.
struct ReactionTable {
    Trigger trigger{};
    std::string payload = {};              ///< on_receive: what the message begins with
    std::optional<std::string> from = {};  ///< on_receive, on_link_lost: only this robot
    std::optional<int> hops = {};          ///< on_receive: over at most so many hops
    Duration time{0};                      ///< on_time
    bool once = true;                      ///< the first time only
    std::optional<MoveTable> move = {};    ///< then it moves so,
    std::optional<std::string> send = {};  ///< sends this,
    std::optional<std::string> to = {};    ///< to this robot or the "sender"; none: to everyone
    std::optional<Bytes> size = {};        ///< of that many bytes, if not its length
    bool stop = false;                     ///< or stops
    Location where = {}, from_where = {}, to_where = {};

    /// `to` stands for the robot that sent the message first, and is no name.
    static constexpr std::string_view sender = "sender";
};

/// Places of a radio's keys in the file, for what is found wrong once everything is read.
struct RadioPlaces {
    Location sensitivity = {}, frequency = {}, rate = {};
};
/// Reads [radio], or a robot's own, over `out`; places of keys that are not there stay as they are.
/// @param name  of the table, for errors
void read_radio(const Value& value, const std::string& name, Radio& out, RadioPlaces& places);

/// [[robot]], one or `count` of a kind.
struct RobotTable {
    std::string name;
    std::optional<int> count;  ///< robots name0, name1, ...
    std::optional<Vec3> at;    ///< [m]
    std::optional<PlaceTable> place;
    Radians heading{0};
    Meters radius{0.2};
    std::optional<MetersPerSecond> top_speed;
    std::optional<RadiansPerSecond> turn_rate;
    Radio radio;  ///< [radio] with the robot's own keys over it
    RadioPlaces radio_places;
    std::optional<PropagationTable> propagation;
    bool own_model = false;  ///< `propagation` chooses a model
    MoveTable move;
    std::vector<ReactionTable> reactions;
    std::vector<Duration> off, on;  ///< when the robot is switched off and on
    Location where, at_where, radio_where, propagation_where, on_where, off_where;

    /// The i-th robot's name.
    std::string name_of(int i) const { return count ? name + std::to_string(i) : name; }
};

struct Scenario;

/// Reads a [[robot]], over the defaults of the scenario's other tables. @throws InputError
/// @param needs_place  false for a robot that something else places
RobotTable read_robot(const Value& value, const Scenario& scenario, bool needs_place);

/// The reverse: what differs from the scenario's defaults.
Table robot_document(const RobotTable& robot, const Scenario& scenario);

}  // namespace rovernet
