// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// Why a robot got a message, or did not: what a recorded trace tells of it, and the levels that
// follow from the scenario inside.

namespace rovernet {

/// What became of a frame at a robot that did not send it.
enum class Outcome : std::uint8_t {
    received,       ///< the robot has the message by it
    duplicate,      ///< received; the robot had the message already
    too_weak,       ///< below the robot's sensitivity
    off,            ///< the robot was switched off
    other_network,  ///< the radios may have no link: frequency, channel or essid differ
    for_another,    ///< a unicast to another robot
    collided,       ///< lost: other frames were on air
    busy,           ///< lost: the robot was sending
    garbled,        ///< lost: bits were wrong
    not_told,       ///< strong enough, but no record tells of its end
};
/// Words of outcomes, in this order.
inline constexpr std::array<std::string_view, 10> names_of_outcome{
    "received",    "duplicate", "too weak", "off",     "other network",
    "for another", "collided",  "busy",     "garbled", "not told"};
constexpr std::string_view name_of(Outcome outcome) {
    return names_of_outcome[static_cast<std::size_t>(outcome)];
}

/// Frame on air at a robot while another came there.
struct OverlappingFrame {
    NodeId from;  ///< the robot itself, perhaps
    AirFrame::Kind kind;
    Dbm level;  ///< at the robot; infinite if it is its own
};

/// Frame of a message, as it came to one robot.
struct FrameAtRobot {
    NodeId from;
    Time begin;  ///< at the sender
    Time end;    ///< at the robot
    Dbm level;   ///< at the robot, with shadowing and fading
    Db margin;   ///< level over the robot's sensitivity
    std::size_t walls = 0;
    double wall_m = 0;  ///< length of the way within walls [m]
    Outcome outcome = Outcome::not_told;
    std::vector<OverlappingFrame> others;  ///< the strongest first
};

/// All frames of a message at one robot: those of other robots, in the order of their begins.
struct MessageAtRobot {
    std::string robot;  ///< its name
    bool is_origin = false;
    bool has_walls = false;  ///< the scene has some
    Time sent;               ///< of the message
    std::vector<FrameAtRobot> frames;
    std::vector<std::string> names;   ///< of the robots, by NodeId
    std::vector<std::string> damage;  ///< what is broken or missing in the trace
};

/// Looks at every frame of a message as it came to a robot.
/// @param path  recorded trace
/// @param uid   id of the message
/// @throws InputError if there is no scenario in the trace, it cannot be loaded, or has no such
/// robot
MessageAtRobot message_at_robot(const std::string& path, std::uint64_t uid, NodeId robot);

/// One sentence that says why the robot has the message, or has not:
///
///   E never was within reach: the strongest of 7 frames came 12.3 dB below its sensitivity,
///   through 2 walls.
std::string sentence(const MessageAtRobot& message);

}  // namespace rovernet
