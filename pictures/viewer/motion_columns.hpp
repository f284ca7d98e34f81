// SPDX-License-Identifier: MIT
#pragma once

#include "network/robot.hpp"
#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace rovernet {

class ViewFile;

/// Sink that collects the robots' motion as columns of a view file (docs/formats/view-format.md):
/// legs, states and link changes. The records may come from a network, or from a recorded trace.
///
/// Memory: 104 bytes for each leg, 16 for each change of a state, 24 for each link change.
class MotionColumns {
  public:
    /// Function that tells whether a robot that is switched off at a time leaves the simulation
    /// (Presence::left).
    using Leaves = std::function<bool(NodeId robot, Time time)>;
    /// @param with_links  whether the sink wants link changes, which a network must search for
    /// @param leaves      empty: no robot leaves
    explicit MotionColumns(bool with_links = true, Leaves leaves = {})
        : with_links_(with_links), leaves_(std::move(leaves)) {}

    KindMask kinds() const {
        const KindMask motion =
            kind_of<Moved>() | kind_of<Switched>() | kind_of<Arrived>() | kind_of<NoWay>();
        return with_links_ ? motion | kind_of<LinkUp>() | kind_of<LinkDown>() : motion;
    }
    void on(const Record& record, const RecordContext& context);
    /// Adds the state of a robot at the start of the run, which no record tells. Must be called
    /// before on() gets a record of a later time. Does nothing for a robot that is on.
    void begin(NodeId robot, Presence presence);

    /// Writes the columns `legs`, `states` and `links`. @param robots  number of robots
    void write(ViewFile& file, std::size_t robots);
    /// Discards all records so far; the next call of write() writes only later records.
    void forget();

    /// Axis-parallel rectangle [m].
    struct Bounds {
        double left = 0, bottom = 0, right = 0, top = 0;
    };
    /// Rectangle around the start and end of all legs; zeros without legs.
    Bounds bounds() const;
    /// Robots below `robots` that have no leg, as in a trace that is cut off.
    std::vector<NodeId> without_leg(std::size_t robots) const;

  private:
    /// Leg of a robot.
    struct RobotLeg {
        std::uint32_t robot;
        Leg leg;
    };
    /// Change of a robot's state: 0 off, 1 on, 2 arrived at its goal, 3 found no path to its goal,
    /// 4 not yet departed, 5 has left.
    struct State {
        std::int64_t time;
        std::uint32_t robot;
        std::uint8_t what;
    };
    struct LinkChange {
        std::int64_t time;
        std::uint32_t from, to;
        bool up;
    };

    void write_legs(ViewFile& file, std::size_t robots);
    void write_states(ViewFile& file, std::size_t robots) const;
    void write_links(ViewFile& file, std::size_t robots) const;

    bool with_links_;
    Leaves leaves_;
    std::vector<RobotLeg> legs_;
    std::vector<State> states_;
    std::vector<LinkChange> links_;
};

}  // namespace rovernet
