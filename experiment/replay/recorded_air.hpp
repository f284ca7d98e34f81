// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/replay/loaded_run.hpp"
#include "models/access/access.hpp"
#include "models/arrival.hpp"
#include "models/link_gain.hpp"
#include "models/medium/medium.hpp"
#include "models/variation/fades.hpp"
#include "scene/scene.hpp"
#include "scene/scene_change.hpp"
#include "sim/record.hpp"

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace rovernet {

/// Frame that was on air in a recorded run.
struct RecordedFrame {
    AirFrame air;
    /// Uid of the frame's message; 0 for a control frame.
    std::uint64_t uid = 0;
    /// Header of the routing protocol before the message; a header without bytes stands for none.
    FrameHeader header = {};
    /// Size of the frame on air [bytes].
    std::uint32_t bytes = 0;
    /// Bit rate of the frame's payload [bit/s].
    BitRate rate;
    /// Start and end of the frame at the sender [ns].
    Time begin, end;
    /// Number of records that precede the record of the frame's transmission in the trace.
    std::uint64_t record = 0;
};

/// Frames on air in a recorded run, and their levels at every robot.
///
/// A recorded trace does not store received power levels. RecordedAir computes the levels from the
/// scenario in the trace and the recorded legs (pieces of movement), with the shadowing and fading
/// of the run:
///
///   level = power + gains - max(0, L - g)   [dBm]
///
/// where L is the path loss with shadowing [dB] and g the fading gain of the frame [dB].
///
///     RecordedReader trace(path);
///     RecordedAir air(LoadedRun(trace.run(), path));
///     while (const Record* record = trace.next()) air.take(*record, trace.context());
class RecordedAir {
  public:
    explicit RecordedAir(const LoadedRun& run);
    /// Copies are forbidden: the member `medium_` refers to the scene.
    RecordedAir(const RecordedAir&) = delete;
    RecordedAir& operator=(const RecordedAir&) = delete;

    /// Processes the next record of the trace. Every record must be given, in order.
    void take(const Record& record, const RecordContext& context);

    /// Frames that are on air at the time of the last record, or ended at most 10 ms before, in the
    /// order of their starts.
    const std::deque<RecordedFrame>& frames() const { return frames_; }
    /// Transmitted frame to which a reception belongs. Must be called when take() has processed the
    /// record of the reception, and no later record.
    /// @param uid  uid of the message; 0 for a control frame
    /// @return null if the record of the frame's start is missing
    const RecordedFrame* frame_of(const AirFrame& air, std::uint64_t uid,
                                  const Reception& reception) const;

    /// Arrival of a frame at a robot, even if it is too weak to be received. A robot's own frame
    /// arrives without delay.
    Arrival arrival(const RecordedFrame& frame, NodeId to) const;
    /// Walls between the antennas of sender and receiver at the start of the frame.
    std::vector<Wall> walls(const RecordedFrame& frame, NodeId to) const;

    /// Number of robots of the scenario.
    std::size_t robots() const { return names_.size(); }
    /// Medium with the radios of all robots, switched on or off as the records so far state.
    const Medium& medium() const { return medium_; }
    /// Scene of the run with all doors open.
    const Scene& scene() const { return *scene_; }
    const std::vector<std::string>& names() const { return names_; }

  private:
    /// Leg (piece of movement) of a robot, and number of the first record for which the leg is
    /// valid.
    struct Placed {
        std::uint64_t record;
        Leg leg;
    };

    void add(const RecordedFrame& frame, Time now);
    void place(NodeId node, const Leg& leg);
    BitRate rate_of(const AirFrame& air) const;
    Pose pose(NodeId node, const RecordedFrame& frame) const;
    Duration delay(const RecordedFrame& frame, NodeId to) const;
    // Path loss of a frame [dB], from the position `here` to the position `there`.
    Db loss(const RecordedFrame& frame, NodeId to, Vec3 here, Vec3 there) const;

    std::vector<std::string> names_;
    std::shared_ptr<const Scene> scene_;
    std::vector<SceneChange> scene_changes_;
    Medium medium_;
    std::unique_ptr<Access> access_;
    Phy phy_;
    // Fading of frames; null: no fading.
    std::unique_ptr<const Fades> fades_;
    std::uint64_t records_ = 0;
    std::deque<RecordedFrame> frames_;
    // Legs (pieces of movement) of each node in order of time, from the leg that is valid at the
    // start of the first frame of frames_.
    std::vector<std::deque<Placed>> legs_;
};

}  // namespace rovernet
