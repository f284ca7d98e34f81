// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"
#include "sim/sink.hpp"
#include "traces/metrics.hpp"

#include <optional>
#include <string>

namespace rovernet {

/// Reads a trace that Ns2Trace wrote, in either format, and feeds its records to `sink`.
///
/// Rebuilt from the file: the messages from the `s AGT` lines; `robots` of a Sent = robots with an
/// `M` line so far; `reachable` from the annotation before it; hops = ttl sent - ttl carried + 1.
/// A Received comes with one reception at a time. Everything that Metrics counts is exact;
/// positions are those of the `M` lines: rounded to 1 cm, speeds to 1 cm/s, times to 10 us, and
/// without the climb of a leg.
///
/// Skipped, as in traces of ns-2 itself: blank lines, comments, energy, annotations, statistics of
/// DSR, wired lines, layers below the router, packets of other types or of routing agents (port
/// 255), and drops for other reasons.
///
/// The file is streamed: memory grows with robots and messages, not with lines.
///
/// @return where the first line stands that was skipped, if one was
/// @throws InputError naming file:line:column, what was found and what was expected
std::optional<Location> read_ns2_trace(const std::string& path, Sink sink);

/// The metrics of a trace: equal to the last digit to those of the run that wrote it.
/// @throws InputError as read_ns2_trace(), and if it has no message and lines of somebody else's
MetricValues trace_metrics(const std::string& path);

}  // namespace rovernet
