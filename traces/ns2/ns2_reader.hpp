// SPDX-License-Identifier: MIT
#pragma once

#include "sim/message.hpp"
#include "sim/sink.hpp"
#include "traces/metrics.hpp"
#include "traces/ns2/ns2_file.hpp"

#include <functional>
#include <string>

namespace rovernet {

/// Called for each packet line, after its records but that of a reception that the next line may go
/// on with; with the application's message that the packet carries, if that is known and the line
/// is not of a frame that a MAC sends or receives.
using OnNs2Packet = std::function<void(const Ns2Packet&, const Message*)>;

/// Reads an ns-2 trace, ours or that of ns-2, in any format, and feeds its records to `sink`.
///
/// Rebuilt from the file:
/// * Messages from the `s AGT` lines of any type but `ack`, which TCP sends by itself. A message is
///   what has a type and an id, as ids repeat between types. A flow is what has type, addresses and
///   ports.
/// * `robots` of a Sent = robots that the file has told of so far; 2 if the line names a
///   destination. `reachable` from the annotation before it.
/// * Hops = ttl of the first `s RTR` of the message - ttl carried + 1: some routing agents of ns-2
///   set a ttl of their own.
/// * A delivery from the first `r AGT` of a message at a robot other than its sender; whatever
///   comes again is none. The `r AGT` goes on with the `r RTR` directly before it; where the
///   routing agent writes no `r RTR` for its own robot, it is a reception of its own.
///
/// A Received comes with one reception at a time. Everything that Metrics counts is exact for our
/// traces; positions are those of the `M` lines: rounded to 1 cm, speeds to 1 cm/s, times to 10 us,
/// and without the climb of a leg. Lines without a record are frames of the MAC's own, ARP, packets
/// of routing agents, copies of messages whose `s AGT` is not in the file, and drops for reasons
/// that are none of sim/fate.hpp.
///
/// The file is streamed: memory grows with robots and messages, not with lines.
///
/// @throws InputError naming file:line:column, what was found and what was expected: if the file
///         cannot be read, has no line of ns-2, or, if strict, at the first line that is refused
Ns2Counts read_ns2_trace(Ns2Source source, Sink sink,
                         Ns2Strictness strictness = Ns2Strictness::tolerant,
                         const OnNs2Packet& on_packet = {});

/// The metrics of a trace: equal to the last digit to those of the run that wrote it.
/// @throws InputError as read_ns2_trace()
MetricValues trace_metrics(Ns2Source source, Ns2Strictness strictness = Ns2Strictness::tolerant);

}  // namespace rovernet
