// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
#include "models/arrival.hpp"
#include "models/link_gain.hpp"
#include "models/medium/medium.hpp"
#include "models/variation/fading.hpp"
#include "scene/scene.hpp"
#include "scene/scene_change.hpp"
#include "sim/record.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Frame that was on air in a recorded run.
struct RecordedFrame {
    AirFrame air;
    /// Id of its message; of a data frame only.
    std::uint64_t uid = 0;
    /// Size on air [bytes].
    std::uint32_t bytes = 0;
    /// Bit rate of its payload [bit/s].
    BitRate rate;
    /// Begin and end at the sender.
    Time begin, end;
    /// Number of records before the one that put it on air.
    std::uint64_t record = 0;
};

/// Air of a recorded run: which frames were on air, and at what level they came to any robot.
///
/// A recorded trace keeps no levels. They are computed again here from the scenario inside and the
/// recorded legs, with the shadowing and the fading that the run had:
///
///   level = power + gains - max(0, L - g)   [dBm]
///
/// where L is the path loss with its shadowing and g the fade of the frame [dB].
///
///     RecordedReader trace(path);
///     RecordedAir air(trace.run(), path);
///     while (const Record* record = trace.next()) air.take(*record, trace.context());
class RecordedAir {
  public:
    /// @param path  of the trace, for errors
    /// @throws InputError if there is no scenario in the trace, or it cannot be loaded
    RecordedAir(const RecordedRun& run, const std::string& path);
    /// Copies are forbidden: the medium refers to the scene.
    RecordedAir(const RecordedAir&) = delete;
    RecordedAir& operator=(const RecordedAir&) = delete;

    /// Takes the next record of the trace: every record, in order.
    void take(const Record& record, const RecordContext& context);

    /// Frames on air now, by their begins, and those that ended within the last 10 ms.
    const std::deque<RecordedFrame>& frames() const { return frames_; }
    /// Frame on air that a reception tells of, at the time of its record.
    /// @param uid  id of its message; of a data frame only
    /// @return null if the record of its begin is missing
    const RecordedFrame* frame_of(const AirFrame& air, std::uint64_t uid,
                                  const Reception& reception) const;

    /// Frame as it arrives at a robot that may be too far away to notice it. A frame of the robot's
    /// own arrives without a delay.
    Arrival arrival(const RecordedFrame& frame, NodeId to) const;
    /// Walls between both antennas when the frame begins.
    std::vector<Wall> walls(const RecordedFrame& frame, NodeId to) const;

    /// Robots whose radios are known: those of the scenario.
    std::size_t robots() const { return names_.size(); }
    /// Medium with the radios of all robots, on or off as they are now.
    const Medium& medium() const { return medium_; }
    /// Scene with all doors open.
    const Scene& scene() const { return *scene_; }
    const std::vector<std::string>& names() const { return names_; }

  private:
    /// Leg that held from a record on.
    struct Placed {
        std::uint64_t record;
        Leg leg;
    };
    struct Loaded;

    explicit RecordedAir(Loaded loaded);
    void add(const RecordedFrame& frame, Time now);
    void place(NodeId node, const Leg& leg);
    BitRate rate_of(const AirFrame& air) const;
    Pose pose(NodeId node, const RecordedFrame& frame) const;
    Duration delay(const RecordedFrame& frame, NodeId to) const;
    // Path loss that a frame sees [dB].
    Db loss(const RecordedFrame& frame, NodeId to, Vec3 here, Vec3 there) const;

    std::vector<std::string> names_;
    std::shared_ptr<const Scene> scene_;
    std::vector<SceneChange> scene_changes_;
    Medium medium_;
    std::unique_ptr<Access> access_;
    Phy phy_;
    // Fades of frames; null: they do not fade.
    std::unique_ptr<const Fades> fades_;
    std::uint64_t records_ = 0;
    std::deque<RecordedFrame> frames_;
    // Legs by node, in their order: those that frames_ may ask for.
    std::vector<std::deque<Placed>> legs_;
};

}  // namespace rovernet
