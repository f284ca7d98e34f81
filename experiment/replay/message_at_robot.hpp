// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
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

// Explanation why a robot received a message or did not receive it. The explanation uses records of
// a trace, and received power levels that are computed with the trace's scenario.

namespace rovernet {

class RecordedIndex;
struct LoadedRun;

/// Outcome of a frame at a robot other than its sender.
enum class Outcome : std::uint8_t {
    received,       ///< frame received, the first one with this message at the robot
    duplicate,      ///< frame received, but the robot already had the message
    too_weak,       ///< frame lost: its level is below the robot's sensitivity
    off,            ///< frame lost: the robot was switched off
    other_network,  ///< frame ignored: frequency, channel or essid of the radios differ
    for_another,    ///< frame ignored: a unicast to another robot
    collided,       ///< frame lost in a collision with other frames on air
    busy,           ///< frame lost: the robot was sending
    garbled,        ///< frame lost by bit errors
    not_told,       ///< outcome unknown: frame strong enough, but the trace lacks its end
};
/// Names of the outcomes in reports, in the order of the enumeration.
inline constexpr std::array<std::string_view, 10> names_of_outcome{
    "received",    "duplicate", "too weak", "off",     "other network",
    "for another", "collided",  "busy",     "garbled", "not told"};
constexpr std::string_view name_of(Outcome outcome) {
    return names_of_outcome[static_cast<std::size_t>(outcome)];
}

/// Frame that overlapped the examined frame in time, at the robot whose receptions are examined.
struct OverlappingFrame {
    NodeId from;            ///< sender of the frame; may be the robot itself
    std::string_view kind;  ///< kind of frame, see AirFrame::kind
    Dbm level;              ///< received level at the robot; infinite for the robot's own frame
    bool has_level = true;  ///< false if the propagation model (disc) gives no levels
};

/// Frame of a message, as it arrived at one robot.
struct FrameAtRobot {
    NodeId from;
    NodeId next_hop = everyone;  ///< robot to which the frame was sent
    Time begin;                  ///< start of the frame at the sender
    Time end;                    ///< end of the frame at the robot
    Dbm level;                   ///< received level at the robot [dBm], with shadowing and fading
    Db margin;                   ///< received level minus the robot's sensitivity [dB]
    std::size_t walls = 0;
    double wall_m = 0;  ///< length of the direct path inside walls [m]
    double distance_m = 0;
    /// Range [m] of the propagation model, if the model is disc. This model gives no levels, so
    /// that `level` and `margin` are meaningless. None: another model.
    std::optional<Meters> range = {};
    Outcome outcome = Outcome::not_told;
    std::vector<OverlappingFrame> others;  ///< overlapping frames at the robot, strongest first
};

/// Drop of a copy of a message at a robot, outside a reception at the examined robot.
struct DroppedCopy {
    NodeId robot;
    Time time;
    std::string code;      ///< code of the reason, as in traces: "NRTE"
    std::string_view why;  ///< reason in words: "it had no route"
};

/// All frames of a message that other robots sent, as they arrived at one robot, in the order of
/// their starts.
struct MessageAtRobot {
    std::string robot;  ///< name of the robot
    bool is_origin = false;
    bool has_walls = false;   ///< whether the scene has walls
    bool tells_walls = true;  ///< false: the sentence and the document leave out the walls
    Time sent;                ///< time when the message was sent
    NodeId to = everyone;     ///< destination of the message
    /// Last copy of a unicast that its routing protocol or its access model dropped; none: the
    /// message is a broadcast, or no copy was dropped.
    std::optional<DroppedCopy> dropped = {};
    std::vector<FrameAtRobot> frames;
    std::vector<std::string> names;   ///< names of robots, by NodeId
    std::vector<std::string> damage;  ///< broken or missing parts of the trace, as sentences
};

/// Examines every frame of a message at a robot.
/// @param path   recorded trace
/// @param uid    uid of the message
/// @param index  index of the trace, used to read only the chunks with the message; null: the trace
///               has no index, or is damaged
/// @throws InputError if the trace has no scenario, the scenario cannot be loaded, or the trace has
/// no such robot
MessageAtRobot message_at_robot(const std::string& path, std::uint64_t uid, NodeId robot,
                                const RecordedIndex* index = nullptr);
/// Examination of one of many messages of a trace, whose scenario `run` is loaded once for all.
MessageAtRobot message_at_robot(const std::string& path, const LoadedRun& run, std::uint64_t uid,
                                NodeId robot, const RecordedIndex* index);

/// Sentence that explains why the robot received the message or did not receive it. Example:
///
///   E was never in range: the strongest of 7 frames came 12.3 dB below the sensitivity of the
///   receiver, through 2 walls.
std::string sentence(const MessageAtRobot& message);

/// Outcome of a frame in words: "collided"; "too far" if a range decided, not a level.
std::string outcome_text(const FrameAtRobot& frame);
/// Frames and sentence as a document, the entry `at_robot` of `rovernet trace follow --json`.
Table document_of(const MessageAtRobot& message);

}  // namespace rovernet
