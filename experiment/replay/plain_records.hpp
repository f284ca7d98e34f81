// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"

#include <cstdint>
#include <vector>

namespace rovernet {

/// Checker of records. A record is plain if ns-2 trace lines can represent it. Records of a run
/// always are plain. Records of a damaged or foreign file may have a time, a robot number or a
/// packet kind that no ns-2 line can represent. A reader would reject lines of such records.
///
/// The check also collects the robots that occur in the ns-2 trace lines so far.
class PlainRecords {
  public:
    /// Checks the next record of a trace. @return whether the record is plain
    bool take(const Record& record, const RecordContext& context);

    /// Flag for each robot number: true if the robot occurs in the ns-2 trace lines so far.
    const std::vector<bool>& seen() const { return seen_; }
    /// Number of robots that occur in ns-2 trace lines so far.
    std::uint32_t robots() const { return robots_; }

  private:
    bool take(Time time, NodeId node);
    bool takes_message(MessageId id, const RecordContext& context);

    std::vector<bool> seen_;
    std::uint32_t robots_ = 0;
    std::vector<const char*> kinds_;  ///< packet kinds that passed the check, by MessageId
};

}  // namespace rovernet
