// SPDX-License-Identifier: MIT
#pragma once

#include "traces/ns2/ns2_follow.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace rovernet {

/// Path of a message through the network, from a recorded trace.
struct RecordedWay {
    FollowedMessage way;
    /// Names of the robots, by robot number.
    std::vector<std::string> robots;
    /// Sentences about broken or missing parts of the trace.
    std::vector<std::string> damage;
};

/// Follows a message through a recorded trace. The result equals the result of follow_ns2() on the
/// ns-2 text of the run. Only records of this message are converted to ns-2 lines, or all records
/// if some line would be rejected. `way.counts` contains only the number of rejected lines.
/// @throws InputError as follow_ns2()
RecordedWay follow_recorded(const std::string& path, std::uint64_t uid,
                            Ns2Strictness strictness = Ns2Strictness::tolerant);

/// Follows a message in the whole ns-2 text of a recorded trace. This slow function is the
/// reference for follow_recorded() in tests.
RecordedWay follow_recorded_text(const std::string& path, std::uint64_t uid,
                                 Ns2Strictness strictness);

}  // namespace rovernet
