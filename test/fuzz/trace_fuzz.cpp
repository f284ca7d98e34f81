// SPDX-License-Identifier: MIT
// Any file is an ns-2 trace or an InputError: its lines are counted once each, it is equal to
// itself, and its first message can be followed.
#include "sim/error.hpp"
#include "test/fuzz/fuzz_file.hpp"
#include "traces/ns2/ns2_diff.hpp"
#include "traces/ns2/ns2_follow.hpp"
#include "traces/ns2/ns2_stats.hpp"

#include <cstdlib>
#include <numeric>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace rovernet;
    const test::FuzzFile file(bytes, size);
    try {
        const Ns2Counts counts =
            ns2_stats(file.path(), Ns2Strictness::tolerant, TraceRows::second).counts;
        const auto skipped = std::accumulate(counts.skipped.begin(), counts.skipped.end(),
                                             counts.events + counts.refused);
        if (counts.lines != skipped) std::abort();
        if (!diff_ns2(file.path(), file.path(), Duration{0}).is_equal) std::abort();
        follow_ns2(file.path(), 0);
    } catch (const InputError&) {
    }
    return 0;
}
