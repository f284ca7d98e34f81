// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"

#include <array>
#include <cstdint>

// Records as rows of tables, one kind of row for each kind of record: only numbers and codes.
// Robots are numbers, too: the index of their name, -1 for none or everyone. Times are in
// nanoseconds.

namespace rovernet {

/// Code of up to four letters, such as a loss reason, padded with zeros.
using CodeCell = std::array<char32_t, 4>;

/// Row of the table of Sent records: message that an application sends.
struct SentRow {
    std::int64_t t_ns, uid;
    std::int32_t robot, to, size, flow, ttl;

    static constexpr auto fields() {
        return describe(
            field("t_ns", &SentRow::t_ns, "time"), field("robot", &SentRow::robot, "that sends"),
            field("uid", &SentRow::uid, "number of the message in the run"),
            field("to", &SentRow::to, "destination"), field("size", &SentRow::size, "[bytes]"),
            field("flow", &SentRow::flow, "from 1; 0: none"),
            field("ttl", &SentRow::ttl, "hops that it may cross"));
    }
};
/// Row of the table of Transmitted records: frame at the start of its transmission.
struct TransmittedRow {
    std::int64_t t_ns, uid;
    std::int32_t robot, origin, heard_from, next_hop, ttl, hops;

    static constexpr auto fields() {
        return describe(
            field("t_ns", &TransmittedRow::t_ns, "begin"),
            field("robot", &TransmittedRow::robot, "that transmits"),
            field("uid", &TransmittedRow::uid, "of the message"),
            field("origin", &TransmittedRow::origin, "that sent the message"),
            field("heard_from", &TransmittedRow::heard_from, "that it is forwarded from"),
            field("next_hop", &TransmittedRow::next_hop, "receiver of this hop"),
            field("ttl", &TransmittedRow::ttl, "hops that are left, this one included"),
            field("hops", &TransmittedRow::hops, "hops once it is received"));
    }
};
/// Row of the table of Received records: one for each robot that could have decoded the
/// transmission.
struct ReceivedRow {
    std::int64_t t_ns, uid;
    std::int32_t robot, origin, sender, ttl, hops;
    double level;
    CodeCell reason;
    bool delivered;

    static constexpr auto fields() {
        return describe(
            field("t_ns", &ReceivedRow::t_ns, "end"),
            field("robot", &ReceivedRow::robot, "that receives"),
            field("uid", &ReceivedRow::uid, "of the message"),
            field("origin", &ReceivedRow::origin, "that sent the message"),
            field("sender", &ReceivedRow::sender, "that transmitted the frame"),
            field("ttl", &ReceivedRow::ttl, "hops that were left"),
            field("hops", &ReceivedRow::hops, "that it has crossed"),
            field("level", &ReceivedRow::level, "[dBm]; not a number if it is not known"),
            field("reason", &ReceivedRow::reason,
                  "for which the copy goes no further; empty: none"),
            field("delivered", &ReceivedRow::delivered, "the application gets the message"));
    }
};
/// Row of the table of Dropped records: copy lost outside a reception.
struct DroppedRow {
    std::int64_t t_ns, uid;
    std::int32_t robot, origin, sender, ttl, hops;
    CodeCell reason;

    static constexpr auto fields() {
        return describe(field("t_ns", &DroppedRow::t_ns, "time"),
                        field("robot", &DroppedRow::robot, "that loses it"),
                        field("uid", &DroppedRow::uid, "of the message"),
                        field("origin", &DroppedRow::origin, "that sent the message"),
                        field("sender", &DroppedRow::sender, "that transmitted the frame"),
                        field("ttl", &DroppedRow::ttl, "hops that were left"),
                        field("hops", &DroppedRow::hops, "that it has crossed"),
                        field("reason", &DroppedRow::reason, "for which it is lost"));
    }
};
/// Row of the table of Moved records: leg that begins.
struct MovedRow {
    std::int64_t t_ns, end_ns;
    std::int32_t robot;
    double x, y, z, vx, vy, vz, heading, turning;

    static constexpr auto fields() {
        return describe(field("t_ns", &MovedRow::t_ns, "begin"),
                        field("end_ns", &MovedRow::end_ns, "end; -1: none"),
                        field("robot", &MovedRow::robot, "that moves"),
                        field("x", &MovedRow::x, "at the begin [m]"),
                        field("y", &MovedRow::y, "at the begin [m]"),
                        field("z", &MovedRow::z, "at the begin [m]"),
                        field("vx", &MovedRow::vx, "velocity [m/s]"),
                        field("vy", &MovedRow::vy, "velocity [m/s]"),
                        field("vz", &MovedRow::vz, "velocity [m/s]"),
                        field("heading", &MovedRow::heading, "at the begin [rad]"),
                        field("turning", &MovedRow::turning, "[rad/s]"));
    }
};
/// Row of the table of Arrived records: robot that rests at the end of its movement.
struct ArrivedRow {
    std::int64_t t_ns;
    std::int32_t robot;

    static constexpr auto fields() {
        return describe(field("t_ns", &ArrivedRow::t_ns, "time"),
                        field("robot", &ArrivedRow::robot, "that arrives"));
    }
};
/// Row of the table of NoWay records: robot that finds no path to its goal.
struct NoWayRow {
    std::int64_t t_ns;
    std::int32_t robot;
    double x, y, z;

    static constexpr auto fields() {
        return describe(field("t_ns", &NoWayRow::t_ns, "time"),
                        field("robot", &NoWayRow::robot, "that stays"),
                        field("x", &NoWayRow::x, "of the goal [m]"),
                        field("y", &NoWayRow::y, "of the goal [m]"),
                        field("z", &NoWayRow::z, "of the goal [m]"));
    }
};
/// Row of the table of Switched records: radio that is switched on or off.
struct SwitchedRow {
    std::int64_t t_ns;
    std::int32_t robot;
    bool on;

    static constexpr auto fields() {
        return describe(field("t_ns", &SwitchedRow::t_ns, "time"),
                        field("robot", &SwitchedRow::robot, "whose radio it is"),
                        field("on", &SwitchedRow::on, "from now on"));
    }
};
/// Row of the table of LinkUp or LinkDown records.
struct LinkRow {
    std::int64_t t_ns;
    std::int32_t robot, sender;

    static constexpr auto fields() {
        return describe(field("t_ns", &LinkRow::t_ns, "time"),
                        field("robot", &LinkRow::robot, "that hears"),
                        field("sender", &LinkRow::sender, "that is heard"));
    }
};
struct LinkUpRow : LinkRow {};
struct LinkDownRow : LinkRow {};
/// Row of the table of AirSent records: frame on air, including control frames.
struct AirSentRow {
    std::int64_t t_ns, reserved_ns;
    std::int32_t robot, next_hop, attempt, bytes;
    CodeCell kind;

    static constexpr auto fields() {
        return describe(
            field("t_ns", &AirSentRow::t_ns, "begin"),
            field("robot", &AirSentRow::robot, "that transmits"),
            field("next_hop", &AirSentRow::next_hop, "receiver"),
            field("kind", &AirSentRow::kind, "DATA, RTS, CTS or ACK"),
            field("attempt", &AirSentRow::attempt, "times that it was sent before"),
            field("bytes", &AirSentRow::bytes, "size on air"),
            field("reserved_ns", &AirSentRow::reserved_ns, "time after its end that it reserves"));
    }
};
/// Row of the table of ControlReceived records: control frame at its destination.
struct ControlReceivedRow {
    std::int64_t t_ns;
    std::int32_t robot, sender, bytes;
    CodeCell kind, reason;

    static constexpr auto fields() {
        return describe(
            field("t_ns", &ControlReceivedRow::t_ns, "end"),
            field("robot", &ControlReceivedRow::robot, "that receives"),
            field("sender", &ControlReceivedRow::sender, "that transmitted it"),
            field("kind", &ControlReceivedRow::kind, "RTS, CTS or ACK"),
            field("bytes", &ControlReceivedRow::bytes, "size on air"),
            field("reason", &ControlReceivedRow::reason, "for which it is lost; empty: it is not"));
    }
};

}  // namespace rovernet
