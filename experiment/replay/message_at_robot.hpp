// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Explanation why a robot got a message or did not, from the records of a trace and from levels
// that are computed with the trace's scenario.

namespace rovernet {

/// Outcome of a frame at a robot other than its sender.
enum class Outcome : std::uint8_t {
    received,       ///< received, for the first time
    duplicate,      ///< received; the robot already had the message
    too_weak,       ///< lost: level below the robot's sensitivity
    off,            ///< lost: the robot was switched off
    other_network,  ///< frequency, channel or essid of the radios differ
    for_another,    ///< ignored: a unicast to another robot
    collided,       ///< lost: other frames were on air
    busy,           ///< lost: the robot was sending
    garbled,        ///< lost: bit errors
    not_told,       ///< unknown: strong enough, but the trace has no record of the frame's end
};
/// Names of the outcomes in reports, in the order of the enumeration.
inline constexpr std::array<std::string_view, 10> names_of_outcome{
    "received",    "duplicate", "too weak", "off",     "other network",
    "for another", "collided",  "busy",     "garbled", "not told"};
constexpr std::string_view name_of(Outcome outcome) {
    return names_of_outcome[static_cast<std::size_t>(outcome)];
}

/// Frame that overlapped the examined frame at the robot.
struct OverlappingFrame {
    NodeId from;            ///< sender of the frame; may be the robot itself
    std::string_view kind;  ///< kind of frame, see AirFrame::kind
    Dbm level;              ///< level at the robot; infinite for the robot's own frame
    bool has_level = true;  ///< false: the propagation model has no levels (disc)
};

/// Frame of a message at one robot.
struct FrameAtRobot {
    NodeId from;
    Time begin;  ///< start of the frame at the sender
    Time end;    ///< end of the frame at the robot
    Dbm level;   ///< level of the frame at the robot, with shadowing and fading
    Db margin;   ///< level minus the robot's sensitivity [dB]
    std::size_t walls = 0;
    double wall_m = 0;  ///< length of the direct path inside walls [m]
    double distance_m = 0;
    /// Range of a model without levels (disc); level and margin are meaningless then.
    std::optional<Meters> range = {};
    Outcome outcome = Outcome::not_told;
    std::vector<OverlappingFrame> others;  ///< overlapping frames at the robot, strongest first
};

/// All frames of a message at one robot, without the robot's own frames, in the order of their
/// starts.
struct MessageAtRobot {
    std::string robot;  ///< name of the robot
    bool is_origin = false;
    bool has_walls = false;  ///< whether the scene has walls
    Time sent;               ///< time when the message was sent
    std::vector<FrameAtRobot> frames;
    std::vector<std::string> names;   ///< names of robots, by NodeId
    std::vector<std::string> damage;  ///< broken or missing parts of the trace, as sentences
};

/// Examines every frame of a message at a robot.
/// @param path  recorded trace
/// @param uid   uid of the message
/// @throws InputError if the trace has no scenario, the scenario cannot be loaded, or it has no
/// such robot
MessageAtRobot message_at_robot(const std::string& path, std::uint64_t uid, NodeId robot);

/// Explanation, in one sentence, why the robot has the message or not:
///
///   E never was within reach: the strongest of 7 frames came 12.3 dB below its sensitivity,
///   through 2 walls.
std::string sentence(const MessageAtRobot& message);

}  // namespace rovernet
