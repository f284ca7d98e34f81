// SPDX-License-Identifier: MIT
#pragma once

#include "sim/message.hpp"
#include "sim/sink.hpp"
#include "traces/metrics.hpp"
#include "traces/ns2/ns2_file.hpp"

#include <functional>

namespace rovernet {

/// Callback for each packet line, called after the records of the line (a reception that the next
/// line may continue is recorded later). Second argument: the application's message in the packet;
/// null if the message is unknown, or if a MAC sends or receives the packet in this line.
using OnNs2Packet = std::function<void(const Ns2Packet&, const Message*)>;

/// Reads an ns-2 trace of rovernet or of ns-2, in any format, and passes its records to `sink`.
///
/// Reconstructed from the file:
/// * Messages from the `s AGT` lines of any type but `ack`, which TCP sends by itself. A message is
///   identified by type and id, because ids repeat between types. A flow is identified by type,
///   addresses and ports.
/// * `robots` of a Sent = number of robots in the file so far; 2 if the line has a destination.
///   `reachable` from the annotation before it.
/// * Hops = ttl of the first `s RTR` of the message - current ttl + 1, because some routing agents
///   of ns-2 set their own ttl.
/// * A delivery from the first `r AGT` of a message at a robot other than its sender; later ones do
///   not count. The `r AGT` belongs to the `r RTR` directly before it; if the routing agent writes
///   no `r RTR` at the destination, it is a separate reception.
///
/// Each Received record has one reception. All values of Metrics are exact for traces of rovernet.
/// Positions are those of the `M` lines: rounded to 1 cm, speeds to 1 cm/s, times to 10 us, and
/// without vertical motion. These lines have no record: control frames of the MAC, ARP, packets of
/// routing agents, copies of messages whose `s AGT` is not in the file, and drops for reasons that
/// are not in sim/fate.hpp.
///
/// The file is streamed: memory grows with robots and messages, not with lines.
///
/// @throws InputError with file:line:column, and found and expected text: if the file cannot be
///         read, has no ns-2 trace line, or, if strict, at the first refused line
Ns2Counts read_ns2_trace(Ns2Source source, Sink sink,
                         Ns2Strictness strictness = Ns2Strictness::tolerant,
                         const OnNs2Packet& on_packet = {});

}  // namespace rovernet
