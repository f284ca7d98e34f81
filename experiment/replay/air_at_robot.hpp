// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {

class RecordedIndex;

/// Use of the air at a robot during the second before a time, from a recorded trace.
///
/// A frame of another robot is counted while it is at the robot with at least its carrier-sense
/// threshold (without one, its sensitivity), or within the range of the model disc.
struct AirAtRobot {
    Time begin, end;                  ///< one second, or less at the begin of the run
    Duration busy{0};                 ///< time with a frame on air, of the robot or of others
    Duration sending{0};              ///< time with a frame of the robot on air
    std::size_t sent = 0, heard = 0;  ///< number of frames of the robot, and of others
    /// Time of the others' frames by sender, the longest first; together more than `busy` where
    /// they overlap.
    std::vector<std::pair<NodeId, Duration>> senders;
    std::vector<std::string> names;  ///< names of robots, by NodeId
};

/// Examines the second before a time.
/// @param path   recorded trace
/// @param index  index of the trace, with which only some of its chunks are read; null: none, or
///               the trace is damaged
/// @throws InputError if the trace has no scenario, or no such robot
AirAtRobot air_at_robot(const std::string& path, NodeId robot, Time at,
                        const RecordedIndex* index = nullptr);

/// The same as a document: shares of the time, counts, and the five senders with most time.
Table document_of(const AirAtRobot& air);

}  // namespace rovernet
