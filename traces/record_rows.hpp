// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"

#include <string_view>

// Columns of the tables of records. Each kind of record has a table with a row for each record, or
// for each of its receptions. A row has a cell for each field:
//
//   Time, Duration  NAME_ns [ns], and t_ns for the time of the record; -1: never
//   NodeId          NAME, and robot for `node`: the index of its name; -1: none, or everyone
//   MessageId       uid, origin, to, size [bytes], flow of the message
//   Vec3            NAME_x, NAME_y, NAME_z
//   Leg             its start_ns, end_ns, and x, y, z, vx, vy, vz, heading, turning at the time of
//                   the record
//   Fate, DropReason  reason: the code of the loss, of up to four letters; empty: none
//   number, bool, quantity  NAME
//
// A part of a record, such as a Frame, has the cells of its fields.

namespace rovernet {

/// Columns of the table of a kind of record, in their order, as words "NAME" or "NAME=CELL"; empty:
/// all cells of the record. Only a kind of record with other columns needs a specialization.
template <class R>
inline constexpr std::string_view row_columns = "";
template <>
inline constexpr std::string_view row_columns<Sent> = "t_ns robot uid to size flow ttl";
template <>
inline constexpr std::string_view row_columns<Transmitted> =
    "t_ns robot=sender uid origin heard_from next_hop ttl hops";
template <>
inline constexpr std::string_view row_columns<Routed> = row_columns<Transmitted>;
template <>
inline constexpr std::string_view row_columns<Received> =
    "t_ns robot uid origin sender ttl hops level reason delivered";
template <>
inline constexpr std::string_view row_columns<Dropped> =
    "t_ns robot uid origin sender ttl hops reason";
template <>
inline constexpr std::string_view row_columns<Moved> =
    "t_ns end_ns robot x y z vx vy vz heading turning";
template <>
inline constexpr std::string_view row_columns<NoWay> = "t_ns robot x=goal_x y=goal_y z=goal_z";
template <>
inline constexpr std::string_view row_columns<LinkUp> = "t_ns robot=to sender=from";
template <>
inline constexpr std::string_view row_columns<LinkDown> = row_columns<LinkUp>;
template <>
inline constexpr std::string_view row_columns<AirSent> =
    "t_ns robot=sender next_hop kind attempt bytes reserved_ns";
template <>
inline constexpr std::string_view row_columns<ControlReceived> =
    "t_ns robot sender kind bytes reason";

}  // namespace rovernet
