// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace rovernet {

/// Wireless trace formats of ns-2.35: the CMU extension's, and `use-newtrace`.
enum class Ns2Format { old_format, new_format };

/// Switch for the lines of the MAC layer: `-macTrace` of ns-2, which is also OFF by default.
enum class MacTrace { off, on };

/// Packet type of a message in an ns-2 trace: "cbr" for a message that a routing protocol delivers
/// to one robot, "message" for any other message, the protocol's name for a control packet.
std::string_view ns2_type(const Message& message);

/// Sink that writes the run as a wireless trace of ns-2.35, for tools that read such traces.
///
/// | record             | lines                                                               |
/// |--------------------|---------------------------------------------------------------------|
/// | Sent               | `s AGT`, `r RTR` (the node's own packet on its way down)            |
/// | Sent.reachable     | before these: `v T eval {set sim_annotation {reachable UID N}}`     |
/// | Transmitted        | `s RTR` by the message's origin, `f RTR` by any other robot         |
/// | Received           | per decoded reception `r RTR`, then `r AGT` if delivered, then      |
/// |                    | `D RTR TTL` or `D RTR DUP` by its fate                              |
/// | Dropped            | `D` with layer and code of the reason, see sim/fate.hpp             |
/// | Moved              | `M`                                                                 |
///
/// With MacTrace::on these lines are added; the other lines are the same:
///
/// | record             | lines                                                               |
/// |--------------------|---------------------------------------------------------------------|
/// | AirSent            | `s MAC`; of a message after its `s RTR` or `f RTR`                  |
/// | Received           | per decoded reception `r MAC` before the `r RTR`; otherwise only    |
/// |                    | `D MAC` with the reason                                             |
/// | Dropped            | `D MAC RET` of a unicast at its retry limit                         |
/// | ControlReceived    | `r MAC`, or `D MAC` with the reason                                 |
///
/// Times are exact [ns], with 9 decimals; 5 decimals in an `M` line. The id of a packet is the
/// message's uid, its type is `message`, its size [bytes] is the message's, except on air (see
/// below); ports are 0. The ttl is the one transmitted, also in a `D RTR TTL` line (ns-2 has 0
/// there); in a line of the reason END it is the one with which the message was sent.
///
/// At the destination of a routed unicast, a protocol with headers (Frame::header: DSR) has `r
/// RTR`, and an `r AGT` without the header; another one has `r AGT` alone, of the size of the
/// frame. A drop after an attempt to send the copy on has the TTL and the MAC header of this
/// attempt.
///
/// The size in an `s MAC` line, and of a frame lost on air, is the size on air. A frame with a
/// header of the access model has 24 bytes more, those of the PLCP (802.11-2020, 15.2.2: 144 + 48
/// bits), as ns-2 adds them at any rate and standard. Control frames have these bytes also when
/// received: the size is 44 for RTS, 38 for CTS and ACK. The id of control frames is 0, and their
/// lines have no network part. Lines of CTS and ACK have no transmitter, because these frames do
/// not contain it, and in the new format neither type nor size.
///
/// Source: the output of ns-2.35, and its cmu-trace.cc.
/// Example: examples/trace.cpp.
class Ns2Trace {
  public:
    /// Opens the trace file under a temporary name. close() renames it to `path`, see PartFile.
    /// @throws RunError if the file cannot be written
    explicit Ns2Trace(const std::string& path, Ns2Format format = Ns2Format::new_format,
                      MacTrace mac = MacTrace::off);
    /// Passes the trace to `out` in pieces of whole lines, instead of writing a file.
    explicit Ns2Trace(std::function<void(std::string_view)> out,
                      Ns2Format format = Ns2Format::new_format, MacTrace mac = MacTrace::off);
    Ns2Trace(Ns2Trace&&) noexcept;
    Ns2Trace& operator=(Ns2Trace&&) noexcept;
    /// Closes the trace like close(), but throws no exception. If the destructor runs because of an
    /// exception, it removes the file instead.
    ~Ns2Trace();

    KindMask kinds() const {
        const KindMask of_mac = kind_of<AirSent>() | kind_of<ControlReceived>();
        return kind_of<Sent>() | kind_of<Transmitted>() | kind_of<Received>() | kind_of<Dropped>() |
               kind_of<Moved>() | kind_of<Routed>() | (mac_ == MacTrace::on ? of_mac : 0);
    }
    /// @throws RunError if the file cannot be written (disk full, say); the file is then removed
    void on(const Record& record, const RecordContext& context);

    /// Completes the trace, which keeps its temporary name. @throws RunError as close()
    void finish();
    /// Completes the trace and gives it its final name. A second call does nothing.
    /// @throws RunError if the file cannot be written
    void close();

  private:
    class Writer;
    std::unique_ptr<Writer> writer_;
    MacTrace mac_;
    int exceptions_ = 0;  // number of exceptions in flight at construction
};

}  // namespace rovernet
