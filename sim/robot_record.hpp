// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/leg.hpp"
#include "sim/record_field.hpp"
#include "sim/time.hpp"

#include <string_view>

// Records of robots: their motion, their links, and whether their radios are on. sim/record.hpp has
// the records of frames, and the variant Record of all.

namespace rovernet {

/// Record that a node starts a new leg, which gives the node's position from `time` on. The first
/// leg starts with the run, or when the robot is added. A robot that is switched off or on, or put
/// to another place, also starts a leg.
struct Moved {
    Time time;
    NodeId node;
    /// Leg that begins at `time`.
    Leg leg;

    static constexpr std::string_view name = "Moved";
    static constexpr auto fields() {
        return describe(field("time", &Moved::time), field("node", &Moved::node),
                        field("leg", &Moved::leg));
    }
};

/// Record that a node has reached the end of its movement, and rests until the node gets a new
/// movement. Motion emits the record when the movement model returns AtRest.
struct Arrived {
    Time time;
    NodeId node;

    static constexpr std::string_view name = "Arrived";
    static constexpr auto fields() {
        return describe(field("time", &Arrived::time), field("node", &Arrived::node));
    }
};

/// Record that a node found no path around the walls to its goal, and stops. Motion emits the
/// record when the movement model returns Blocked.
struct NoWay {
    Time time;
    NodeId node;
    /// Goal that could not be reached [m].
    Vec3 goal;

    static constexpr std::string_view name = "NoWay";
    static constexpr auto fields() {
        return describe(field("time", &NoWay::time), field("node", &NoWay::node),
                        field("goal", &NoWay::goal));
    }
};

/// Record that node `to` can hear node `from` from now on. Links are directed: the opposite
/// direction is a second link. LinkMonitor emits LinkUp and LinkDown at the instant of the change,
/// if a sink wants them.
struct LinkUp {
    Time time;
    /// Robot that is heard (transmitter).
    NodeId from;
    /// Robot that hears (receiver).
    NodeId to;

    static constexpr std::string_view name = "LinkUp";
    static constexpr auto fields() {
        return describe(field("time", &LinkUp::time), field("from", &LinkUp::from),
                        field("to", &LinkUp::to));
    }
};

/// Record that node `to` cannot hear node `from` any more: the directed link is down.
struct LinkDown {
    Time time;
    NodeId from;
    NodeId to;

    static constexpr std::string_view name = "LinkDown";
    static constexpr auto fields() {
        return describe(field("time", &LinkDown::time), field("from", &LinkDown::from),
                        field("to", &LinkDown::to));
    }
};

/// Record that a node's radio is switched on or off. Robots are on when they are added, without a
/// record. Engine::switch_robot emits the record, before the records of its consequences.
struct Switched {
    Time time;
    NodeId node;
    /// True if the radio is on from now on.
    bool on;

    static constexpr std::string_view name = "Switched";
    static constexpr auto fields() {
        return describe(field("time", &Switched::time), field("node", &Switched::node),
                        field("on", &Switched::on));
    }
};

}  // namespace rovernet
