// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ports.hpp"
#include "sim/record.hpp"

#include <memory>
#include <string>

namespace rovernet {

/// The two wireless trace formats of ns-2.35: the CMU extension's, and that of `use-newtrace`.
enum class Ns2Format { old_format, new_format };

/// Writes the run as a wireless trace of ns-2.35, for the tools that read such traces.
///
/// | record             | lines                                                               |
/// |--------------------|---------------------------------------------------------------------|
/// | Sent               | `s AGT`, `r RTR` (the own packet on its way down)                   |
/// | Sent.reachable     | before these: `v T eval {set sim_annotation {reachable UID N}}`     |
/// | Transmitted        | `s RTR` by the message's origin, `f RTR` by anybody else            |
/// | Received           | per reception `r RTR`, then `r AGT` if delivered, then              |
/// |                    | `D RTR TTL` or `D RTR DUP` by its fate; fate off: only `D MAC SLP`  |
/// | Dropped            | `D RTR SLP`                                                         |
/// | Moved              | `M`                                                                 |
///
/// Times are exact [ns], 9 decimals; 5 in an `M` line. The id of a packet is the message's uid, its
/// type `message`, its size [bytes] the same at every layer; ports are 0. The ttl is that carried
/// on air, in a `D RTR TTL` line too (ns-2 shows 0 there).
///
/// Source: the output of ns-2.35, and its cmu-trace.cc.
class Ns2Trace {
  public:
    /// Opens `path` + ".part"; `path` itself appears at the end, whole or not at all.
    /// @throws RunError if it cannot be written
    explicit Ns2Trace(const std::string& path, Ns2Format format = Ns2Format::new_format);
    Ns2Trace(Ns2Trace&&) noexcept;
    Ns2Trace& operator=(Ns2Trace&&) noexcept;
    /// As close(), but silent; if an exception is on its way, removes what has been written.
    ~Ns2Trace();

    KindMask kinds() const {
        return kind_of<Sent>() | kind_of<Transmitted>() | kind_of<Received>() | kind_of<Dropped>() |
               kind_of<Moved>();
    }
    /// @throws RunError if the file cannot be written (disk full, say); it is removed then
    void on(const Record& record, const RecordContext& context);

    /// Ends the trace and gives it its final name. A second call does nothing.
    /// @throws RunError if it cannot be written
    void close();

  private:
    class Writer;
    std::unique_ptr<Writer> writer_;
    int exceptions_ = 0;  // on their way when this was made
};

}  // namespace rovernet
