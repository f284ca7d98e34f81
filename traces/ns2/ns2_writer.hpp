// SPDX-License-Identifier: MIT
#pragma once

#include "files/part_file.hpp"
#include "sim/message.hpp"
#include "sim/record.hpp"
#include "traces/ns2/decimal.hpp"
#include "traces/ns2/ns2_trace.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

// Lines of an ns-2 trace: ns2_trace.cpp has the lines of each record, ns2_packet_lines.cpp the
// fields of a line in both formats.

namespace rovernet {

/// Size of PLCP preamble and header at 1 Mb/s, which ns-2 includes in a frame's size.
inline constexpr std::uint32_t plcp_bytes = 24;

/// MAC header fields of a packet; zeros before a MAC has sent the packet.
struct Ns2MacFields {
    std::uint32_t reserved_us = 0;
    NodeId to{0}, from{0};
    std::string_view ethertype = "0";
};

/// Common fields of all packet lines.
struct Ns2LineFields {
    char op;
    Time time;
    NodeId node;
    std::string_view layer;
    std::string_view reason = "---";
    Ns2MacFields mac = {};
};

/// Fields of lines about a message's packets.
struct Ns2PacketFields : Ns2LineFields {
    Ns2PacketFields(Ns2LineFields common, MessageId id, unsigned hops)
        : Ns2LineFields(common), message(id), ttl(hops) {}
    Ns2PacketFields(Ns2LineFields common, const Frame& its_frame, std::uint32_t below_router = 0)
        : Ns2LineFields(common),
          message(its_frame.message),
          ttl(its_frame.ttl),
          added(below_router),
          frame(&its_frame) {}

    MessageId message;
    unsigned ttl;
    std::uint32_t added = 0;       ///< size of the headers added below the router [bytes]
    const Frame* frame = nullptr;  ///< frame of the packet; null before the packet has a frame

    std::uint32_t size(const Message& m) const {
        return (frame ? frame->size_of(m) : m.size) + added;
    }
    /// Source in the IP header: for a control packet to everyone the robot that sends this copy,
    /// for any other packet the origin.
    NodeId source(const Message& m) const {
        return frame && !m.kind.empty() && m.to == everyone ? frame->sender : m.origin;
    }
    /// Hops that the packet has made so far.
    unsigned hops() const {
        if (!frame) return 0;
        return frame->sender == node && frame->hops > 0 ? frame->hops - 1U : frame->hops;
    }
    /// Next hop that the routing protocol has chosen; empty if it has not chosen a next hop.
    std::optional<NodeId> next_hop(const Message& m) const {
        const bool is_chosen =
            frame && frame->next_hop != everyone && (!m.kind.empty() || m.is_routed_unicast());
        return is_chosen ? std::optional(frame->next_hop) : std::nullopt;
    }
};

class Ns2Trace::Writer {
  public:
    using Out = std::function<void(std::string_view)>;

    Writer(const std::string& path, Ns2Format format, MacTrace mac)
        : Writer([this](std::string_view text) { file_->write(text); }, format, mac) {
        file_.emplace(path);
    }
    Writer(Out out, Ns2Format format, MacTrace mac)
        : out_(std::move(out)),
          format_(format),
          mac_(mac),
          buffer_(std::make_unique<char[]>(size + longest_line)) {}

    void write(const Record& record, const RecordContext& context) {
        std::visit([&](const auto& r) { lines(r, context); }, record);
    }
    void finish() {
        if (std::exchange(finished_, true)) return;
        flush();
        if (file_) file_->close();
    }
    void close() {
        if (closed_) return;
        finish();
        if (file_) file_->give_name();
        closed_ = true;
    }

  private:
    static constexpr std::size_t size = 64 * 1024;
    // enough for five numbers of longest_decimal, and more
    static constexpr std::size_t longest_line = 4096;

    void lines(const Sent&, const RecordContext&);
    void lines(const Transmitted&, const RecordContext&);
    void lines(const Routed&, const RecordContext&);
    void router_line(Time, const Frame&, std::optional<NodeId> heard_from, const RecordContext&);
    void lines(const Received&, const RecordContext&);
    void lines(const Dropped&, const RecordContext&);
    Frame lost_frame(const Dropped&, const Message&) const;
    void lines(const Moved&, const RecordContext&);
    void lines(const AirSent&, const RecordContext&);
    void lines(const ControlReceived&, const RecordContext&);
    template <class Other>
    void lines(const Other&, const RecordContext&) {}

    void packet(const Ns2PacketFields&, const RecordContext&);
    void arp_packet(Ns2PacketFields, const Message&, const RecordContext&);
    void describe(const Ns2PacketFields&, const Message&, const RecordContext&);
    void old_packet(const Ns2PacketFields&, const Message&);
    void new_packet(const Ns2PacketFields&, const Message&, Vec3 position);
    void control(const Ns2LineFields&, const AirFrame&, std::uint32_t bytes, const RecordContext&);
    void old_start(const Ns2LineFields&, std::uint64_t uid, std::string_view type,
                   std::uint32_t bytes);
    void new_start(const Ns2LineFields&, Vec3 position, std::optional<NodeId> next_hop = {});

    // Inlining turns a literal into a few store instructions, and saves a fifth of a run's
    // instructions.
    [[gnu::always_inline]] void text(std::string_view s) { at_ = write_text(at_, s); }
    void integer(std::uint64_t value) { at_ = write_integer(at_, value); }
    void destination(NodeId node) {
        if (node == everyone) return text("-1");
        integer(node.value);
    }
    void hex(std::uint32_t value) { at_ = write_hex(at_, value); }
    void fixed2(double value) { at_ = write_fixed2(at_, value); }
    void begin_line() { at_ = buffer_.get() + used_; }
    void end_line() {
        *at_++ = '\n';
        used_ = static_cast<std::size_t>(at_ - buffer_.get());
        if (used_ >= size) flush();
    }
    void flush() {
        const std::size_t n = std::exchange(used_, 0);
        if (n > 0) out_({buffer_.get(), n});
    }

    std::optional<PartFile> file_;
    Out out_;
    Ns2Format format_;
    MacTrace mac_;
    std::unique_ptr<char[]> buffer_;
    std::size_t used_ = 0;
    char* at_ = nullptr;  ///< end of the current line so far
    bool finished_ = false, closed_ = false;
    std::string description_;  ///< description of a control packet; kept to reuse its memory
    /// TTL of each application's message when it was sent, by MessageId.
    std::vector<Hops> ttls_;
    /// Time reserved by the last unicast that was received, and by the last one on air [ns]. The
    /// latter is known only if the MAC is traced.
    Duration reserved_{0}, sent_reserved_{0};
};

}  // namespace rovernet
