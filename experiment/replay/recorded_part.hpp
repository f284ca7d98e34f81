// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/replay/recorded_air.hpp"
#include "traces/recorded/recorded_index.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <cstdint>
#include <vector>

namespace rovernet {

/// Reads some chunks of a trace. At the start of each range, `air` gets the earlier records that
/// determine the robots' legs and states at that time. Then take(record) is called for each record
/// of the range.
template <class Take>
void read_part(RecordedReader& trace, const RecordedIndex& index,
               const std::vector<RecordedIndex::Range>& ranges, RecordedAir& air,
               const Take& take) {
    for (const RecordedIndex::Range& range : ranges) {
        trace.go_to_chunk(range.begin);
        index.for_each_before(range.begin,
                              [&](const Record& before) { air.take(before, trace.context()); });
        for (std::uint64_t i = 0; i < range.records; ++i) {
            if (const Record* record = trace.next()) take(*record);
        }
    }
}

}  // namespace rovernet
