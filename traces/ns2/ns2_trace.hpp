// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace rovernet {

/// The two wireless trace formats of ns-2.35: the CMU extension's, and that of `use-newtrace`.
enum class Ns2Format { old_format, new_format };

/// Whether the lines of the MAC layer are written: `-macTrace` of ns-2, which has it OFF, too.
enum class MacTrace { off, on };

/// Writes the run as a wireless trace of ns-2.35, for the tools that read such traces.
///
/// | record             | lines                                                               |
/// |--------------------|---------------------------------------------------------------------|
/// | Sent               | `s AGT`, `r RTR` (the own packet on its way down)                   |
/// | Sent.reachable     | before these: `v T eval {set sim_annotation {reachable UID N}}`     |
/// | Transmitted        | `s RTR` by the message's origin, `f RTR` by anybody else            |
/// | Received           | per decoded reception `r RTR`, then `r AGT` if delivered, then      |
/// |                    | `D RTR TTL` or `D RTR DUP` by its fate                              |
/// | Dropped            | `D` with layer and code of the reason, see sim/fate.hpp             |
/// | Moved              | `M`                                                                 |
///
/// With MacTrace::on also, and else the same lines:
///
/// | record             | lines                                                               |
/// |--------------------|---------------------------------------------------------------------|
/// | AirSent            | `s MAC`, that of a message behind its `s RTR` or `f RTR`            |
/// | Received           | per decoded reception `r MAC` before the `r RTR`; of any other only |
/// |                    | `D MAC` with the reason                                             |
/// | Dropped            | `D MAC RET` of a unicast that was given up                          |
/// | ControlReceived    | `r MAC`, or `D MAC` with the reason                                 |
///
/// Times are exact [ns], 9 decimals; 5 in an `M` line. The id of a packet is the message's uid, its
/// type `message`, its size [bytes] the message's but on air (see below); ports are 0. The ttl is
/// that carried on air, in a `D RTR TTL` line too (ns-2 shows 0 there).
///
/// The size in an `s MAC` line, and of a frame that is lost on air, is that on air. A frame with a
/// header of the access model counts 24 bytes more, the PLCP's (802.11-2020, 15.2.2: 144 + 48
/// bits), as ns-2 counts them at any rate and standard; those that control access do so when they
/// are received, too: RTS 44, CTS and ACK 38, id 0. Their lines have no network part; they show no
/// transmitter of a CTS or an ACK, which do not carry it, and in the new format no type and size.
///
/// Source: the output of ns-2.35, and its cmu-trace.cc.
class Ns2Trace {
  public:
    /// Begins the file; `path` itself appears at the end, whole or not at all, see PartFile.
    /// @throws RunError if it cannot be written
    explicit Ns2Trace(const std::string& path, Ns2Format format = Ns2Format::new_format,
                      MacTrace mac = MacTrace::off);
    /// Gives the text away piece by piece instead, whole lines each.
    explicit Ns2Trace(std::function<void(std::string_view)> out,
                      Ns2Format format = Ns2Format::new_format, MacTrace mac = MacTrace::off);
    Ns2Trace(Ns2Trace&&) noexcept;
    Ns2Trace& operator=(Ns2Trace&&) noexcept;
    /// Closes the trace as close(), but silently; if an exception is on its way, removes what has
    /// been written.
    ~Ns2Trace();

    KindMask kinds() const {
        const KindMask of_mac = kind_of<AirSent>() | kind_of<ControlReceived>();
        return kind_of<Sent>() | kind_of<Transmitted>() | kind_of<Received>() | kind_of<Dropped>() |
               kind_of<Moved>() | (mac_ == MacTrace::on ? of_mac : 0);
    }
    /// @throws RunError if the file cannot be written (disk full, say); it is removed then
    void on(const Record& record, const RecordContext& context);

    /// Ends the writing: the trace is whole, but has no name yet. @throws RunError as close()
    void finish();
    /// Ends the trace and gives it its final name. A second call does nothing.
    /// @throws RunError if it cannot be written
    void close();

  private:
    class Writer;
    std::unique_ptr<Writer> writer_;
    MacTrace mac_;
    int exceptions_ = 0;  // on their way when this was made
};

}  // namespace rovernet
