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

/// Occupancy of the radio channel at a robot during the last second before a given time, from a
/// recorded trace.
///
/// A frame of a different robot is counted while the frame arrives with a level of at least the
/// carrier-sense threshold or the sensitivity of the receiving robot, whichever is lower. Under the
/// propagation model disc, which gives no levels, a frame from within the range is counted.
struct AirAtRobot {
    Time begin, end;                  ///< one second, or less at the start of the run
    Duration busy{0};                 ///< time with a counted frame, or a frame of the robot, on
                                      ///< air
    Duration sending{0};              ///< time with a frame of the robot on air
    std::size_t sent = 0, heard = 0;  ///< number of frames of the robot, and of counted frames
    /// Airtime of the counted frames by sender, the longest first. Overlapping frames make the sum
    /// larger than `busy`.
    std::vector<std::pair<NodeId, Duration>> senders;
    std::vector<std::string> names;  ///< names of robots, by NodeId
};

/// Examines the second before a time.
/// @param path   recorded trace
/// @param index  index of the trace, used to read only the necessary chunks; null: the trace has no
///               index, or is damaged
/// @throws InputError if the trace has no scenario, or no such robot
AirAtRobot air_at_robot(const std::string& path, NodeId robot, Time at,
                        const RecordedIndex* index = nullptr);

/// Occupancy as a document: shares of the time, counts, and the five senders with the most airtime.
Table document_of(const AirAtRobot& air);

}  // namespace rovernet
