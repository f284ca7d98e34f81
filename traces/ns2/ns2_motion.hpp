// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"
#include "traces/ns2/ns2_line.hpp"

#include <vector>

namespace rovernet {

/// Leg (piece of movement) that an `M` line begins: straight to the goal at constant speed, then a
/// rest. An `M` line without speed, or whose goal is its position, is a rest.
Leg leg_of(const Ns2Move& move);

/// Motion of the robots of an ns-2 trace as legs, reconstructed from the positions in the trace.
///
/// `M` lines have a position, a goal and a speed; packet lines of the new and the tagged format
/// have a position. Positions are rounded to 1 cm, speeds to 1 cm/s. The motion of a robot is
/// reconstructed as follows:
///
/// * The robot rests at its first position in the trace until the time of this position.
/// * A leg ends at its goal, at the time that follows from its speed, or at the next position in
///   the trace: the robot then moves straight there, if rounding explains the deviation from the
///   leg.
/// * If rounding does not explain a position in a packet line, there was no `M` line (ns-2's
///   -movementTrace OFF), and the robot moved straight there from its last position in the trace.
///   If rounding does not explain a position in an `M` line, the robot was put there.
///
/// Positions in packet lines less than `apart` after the last used position are ignored: for two
/// rounded positions close in time, the speed between them would be noise.
///
///     Ns2Motion motion;
///     motion.begins(node, leg_of(move));              // M line
///     motion.is_at(node, packet.time, *packet.position);
///     robot.move = RecordedLegs(motion.legs(node));
class Ns2Motion {
  public:
    /// Smallest time between two positions of packet lines that are used [ns].
    static constexpr Duration apart = std::chrono::milliseconds{100};

    /// Adds an `M` line, given as its leg, see leg_of(). Lines are added in the order of the file.
    void begins(NodeId node, const Leg& leg);
    /// Adds the position `place` [m] of a robot at `time`, which a packet line gives.
    void is_at(NodeId node, Time time, Vec3 place);

    /// Whether the trace has contained a position of the robot so far.
    bool knows(NodeId node) const {
        return node.index() < tracks_.size() && tracks_[node.index()].is_known;
    }
    /// Legs (pieces of movement) of the robot from the start of the run, in order; the last leg
    /// lasts to the end. Empty if the trace has no position of the robot.
    std::vector<Leg> legs(NodeId node) const;

  private:
    /// Reconstructed motion of one robot.
    struct Track {
        std::vector<Leg> past;
        Leg plan;          ///< current leg, from the last used position
        double speed = 0;  ///< speed of the last `M` line [m/s], or 0
        Time told;  ///< time of the robot's last position in the trace; not before plan.start
        bool is_known = false;

        void begin(Vec3 place);
        bool rests_at(Vec3 place, Time time) const;
        bool explains(Vec3 place, Time time) const;
        void reach(Vec3 place, Time time);
        void appear(Vec3 place, Time time);
    };
    Track& track(NodeId node);

    std::vector<Track> tracks_;  // movements of the robots; index: NodeId
};

}  // namespace rovernet
