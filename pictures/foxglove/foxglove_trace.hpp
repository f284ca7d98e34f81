// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace rovernet {

/// Writes a recorded trace as an MCAP file that Foxglove draws. Its messages are JSON.
///
/// | topic     | messages                 | content                                             |
/// |-----------|--------------------------|-----------------------------------------------------|
/// | /map      | foxglove.Grid            | cells of the map: 1 a wall, 0 free; at the start    |
/// | /tf       | foxglove.FrameTransforms | coordinate frames of the robots in that of the map, |
/// |           |                          | every 100 ms while they move                        |
/// | /robots   | foxglove.SceneUpdate     | bodies, headings and names; grey if switched off    |
/// | /frames   | foxglove.SceneUpdate     | for each frame lines to its receivers, for 200 ms   |
/// | /messages | foxglove.Log             | messages that robots send, and their deliveries     |
///
/// Colours of lines: green for a delivered message, grey for another copy, red for a lost frame.
///
/// @return sentences about broken and missing parts of the trace
/// @throws InputError if `in` is no recorded trace or has no scenario; RunError if `out` cannot be
///         written
std::vector<std::string> convert_to_foxglove(const std::string& in, const std::string& out);

}  // namespace rovernet
