// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"
#include "traces/ns2/ns2_line.hpp"

#include <cstddef>
#include <vector>

namespace rovernet {

/// Leg that an `M` line begins: straight to the goal at constant speed, and then a rest. A line
/// without speed, or whose goal is its place, is a rest.
Leg leg_of(const Ns2Move& move);

/// Motion of the robots of an ns-2 trace, as legs, made of the places that the trace tells.
///
/// `M` lines tell a place, a goal and a speed; packet lines of the new and the tagged format tell a
/// place. Places are rounded to 1 cm, speeds to 1 cm/s. From these the robot's way is:
///
/// * Before the first place that is told of a robot, it rests there.
/// * A leg ends at its goal, at the time that its speed gives, or at the next place that is told:
///   then it goes straight there, if rounding explains why its plan misses that place.
/// * A place that rounding does not explain, in a packet line: nobody wrote an `M` line (ns-2's
///   -movementTrace OFF), and the robot goes straight there from where it was told of last.
///   In an `M` line: it was put there.
///
/// Places in packet lines less than `apart` after the last place that was taken are left out: of
/// two rounded places that are close in time, the speed between them would be noise.
///
///     Ns2Motion motion;
///     motion.begins(node, leg_of(move));              // M line
///     motion.is_at(node, packet.time, *packet.position);
///     robot.move = RecordedLegs(motion.legs(node));
class Ns2Motion {
  public:
    static constexpr Duration apart = std::chrono::milliseconds{100};  ///< [ns]

    /// Takes an `M` line, as its leg. Lines come in the order of the file.
    void begins(NodeId node, const Leg& leg);
    /// Takes the place [m] that a packet line tells.
    void is_at(NodeId node, Time time, Vec3 place);

    /// Whether a place of the robot was told.
    bool knows(NodeId node) const {
        return node.index() < tracks_.size() && tracks_[node.index()].is_known;
    }
    /// Legs of the robot from the begin of the run, each later than the one before; the last one
    /// holds to the end. Empty if no place of it was told.
    std::vector<Leg> legs(NodeId node) const;

  private:
    /// What is known of one robot.
    struct Track {
        std::vector<Leg> past;
        Leg plan;          ///< from the last place that was taken
        double speed = 0;  ///< [m/s] of the last `M` line, or 0
        Time told;         ///< when its place was told last; not before plan.start
        bool is_known = false;

        void begin(Vec3 place);
        bool rests_at(Vec3 place, Time time) const;
        bool explains(Vec3 place, Time time) const;
        void reach(Vec3 place, Time time);
        void appear(Vec3 place, Time time);
    };
    Track& track(NodeId node);

    std::vector<Track> tracks_;  // by NodeId
};

}  // namespace rovernet
