// SPDX-License-Identifier: MIT
#include "traces/ns2_trace.hpp"

#include "sim/error.hpp"
#include "traces/decimal.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

namespace rovernet {
namespace {

/// A file that has its final name only once it is whole.
class PartFile {
  public:
    explicit PartFile(std::string path) : path_(std::move(path)), part_(path_ + ".part") {
        std::error_code ignored;
        const auto status = std::filesystem::status(path_, ignored);
        // A rename would replace a device by a file.
        if (exists(status) && !is_regular_file(status)) fail("it exists and is no regular file");
        file_ = std::fopen(part_.c_str(), "wb");
        if (!file_) fail(std::strerror(errno));
        std::setvbuf(file_, nullptr, _IONBF, 0);  // the writer has its own buffer
    }
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;
    ~PartFile() { discard(); }

    void write(std::string_view bytes) {
        if (!file_) fail("an earlier write has failed");
        if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) {
            fail(std::strerror(errno));
        }
    }

    void close() {
        if (!file_) fail("an earlier write has failed");
        const bool whole = std::fclose(file_) == 0;
        const int close_error = errno;
        file_ = nullptr;
        if (whole && std::rename(part_.c_str(), path_.c_str()) == 0) return;
        const int error = whole ? errno : close_error;
        std::remove(part_.c_str());
        fail(std::strerror(error));
    }

  private:
    void discard() {
        if (!file_) return;
        std::fclose(file_);
        file_ = nullptr;
        std::remove(part_.c_str());
    }
    [[noreturn]] void fail(std::string_view why) {
        const std::string message = fmt::format("{}: cannot write the trace: {}", path_, why);
        discard();
        throw RunError(message);
    }

    std::string path_;
    std::string part_;
    std::FILE* file_ = nullptr;
};

/// Where a copy that waits is lost: at the router, in the queue of its interface, or by its MAC.
std::string_view layer_of(DropReason reason) {
    switch (reason) {
        case DropReason::off: return "RTR";
        case DropReason::queue_full:
        case DropReason::end: return "IFQ";
        case DropReason::retries: return "MAC";
    }
    return {};
}

/// What the lines of packets have in common.
struct PacketLine {
    char op;
    Time time;
    NodeId node;
    std::string_view layer;
    std::string_view reason = "---";
    std::optional<NodeId> heard_from;  ///< the last hop; nothing: the MAC has not seen the packet
    MessageId message;
    unsigned ttl;
};

}  // namespace

class Ns2Trace::Writer {
  public:
    Writer(const std::string& path, Ns2Format format)
        : file_(path), format_(format), buffer_(std::make_unique<char[]>(size + longest_line)) {}

    void write(const Record& record, const RecordContext& context) {
        std::visit([&](const auto& r) { lines(r, context); }, record);
    }
    void close() {
        if (closed_) return;
        flush();
        file_.close();
        closed_ = true;
    }

  private:
    static constexpr std::size_t size = 64 * 1024;
    static constexpr std::size_t longest_line = 4096;  // five doubles of longest_decimal, and room

    void lines(const Sent&, const RecordContext&);
    void lines(const Transmitted&, const RecordContext&);
    void lines(const Received&, const RecordContext&);
    void lines(const Dropped&, const RecordContext&);
    void lines(const Moved&, const RecordContext&);
    void lines(const Arrived&, const RecordContext&) {}
    void lines(const NoWay&, const RecordContext&) {}
    void lines(const Switched&, const RecordContext&) {}
    void lines(const LinkUp&, const RecordContext&) {}
    void lines(const LinkDown&, const RecordContext&) {}

    void packet(const PacketLine&, const RecordContext&);
    void old_packet(const PacketLine&, const Message&);
    void new_packet(const PacketLine&, const Message&, Vec3 position);

    void text(std::string_view s) { at_ = write_text(at_, s); }
    void integer(std::uint64_t value) { at_ = write_integer(at_, value); }
    void fixed2(double value) { at_ = write_fixed2(at_, value); }
    void begin_line() { at_ = buffer_.get() + used_; }
    void end_line() {
        *at_++ = '\n';
        used_ = static_cast<std::size_t>(at_ - buffer_.get());
        if (used_ >= size) flush();
    }
    void flush() {
        const std::size_t n = std::exchange(used_, 0);
        file_.write({buffer_.get(), n});
    }

    PartFile file_;
    Ns2Format format_;
    std::unique_ptr<char[]> buffer_;
    std::size_t used_ = 0;
    char* at_ = nullptr;  ///< where the current line goes on
    bool closed_ = false;
};

void Ns2Trace::Writer::lines(const Sent& r, const RecordContext& context) {
    if (r.reachable) {
        begin_line();
        text("v "), at_ = write_seconds_short(at_, r.time);
        text(" eval {set sim_annotation {reachable "), integer(context.messages[r.message].uid);
        text(" "), integer(*r.reachable);
        text("}}");
        end_line();
    }
    PacketLine line{'s', r.time, r.node, "AGT", "---", {}, r.message, r.ttl};
    packet(line, context);
    line.op = 'r';
    line.layer = "RTR";
    packet(line, context);
}

void Ns2Trace::Writer::lines(const Transmitted& r, const RecordContext& context) {
    const NodeId origin = context.messages[r.frame.message].origin;
    const char op = r.frame.sender == origin ? 's' : 'f';
    packet({op, r.time, r.frame.sender, "RTR", "---", r.heard_from, r.frame.message, r.frame.ttl},
           context);
}

void Ns2Trace::Writer::lines(const Received& r, const RecordContext& context) {
    const Frame& frame = r.frame;
    for (const Reception& rx : r.receptions) {
        PacketLine line{'r',   rx.time,      rx.node,       "RTR",
                        "---", frame.sender, frame.message, frame.ttl};
        if (!is_decoded(rx.fate)) {
            line.op = 'D', line.layer = "MAC";
            line.reason = reason_of_loss(rx.fate);
            packet(line, context);
            continue;
        }
        packet(line, context);
        if (rx.delivered) {
            line.layer = "AGT";
            packet(line, context);
        }
        if (rx.fate == Fate::waiting || rx.fate == Fate::arrived) continue;
        line.op = 'D', line.layer = "RTR";
        line.reason = rx.fate == Fate::ttl ? "TTL" : "DUP";
        packet(line, context);
    }
}

void Ns2Trace::Writer::lines(const Dropped& r, const RecordContext& context) {
    std::optional<NodeId> heard_from;
    if (r.frame.sender != r.node) heard_from = r.frame.sender;
    packet({'D', r.time, r.node, layer_of(r.reason), reason_of(r.reason), heard_from,
            r.frame.message, r.frame.ttl},
           context);
}

void Ns2Trace::Writer::lines(const Moved& r, const RecordContext&) {
    const Vec3& v = r.leg.velocity;
    begin_line();
    text("M "), at_ = write_seconds5(at_, r.time);
    text(" "), integer(r.node.value);
    text(" ("), fixed2(r.leg.from.x);
    text(", "), fixed2(r.leg.from.y);
    text(", "), fixed2(r.leg.from.z);
    text("), ("), fixed2(r.leg.to.x);
    text(", "), fixed2(r.leg.to.y);
    text("), "), fixed2(std::sqrt(v.x * v.x + v.y * v.y));
    end_line();
}

void Ns2Trace::Writer::packet(const PacketLine& line, const RecordContext& context) {
    const Message& message = context.messages[line.message];
    begin_line();
    if (format_ == Ns2Format::old_format) {
        old_packet(line, message);
    } else {
        new_packet(line, message, context.legs.position(line.node, line.time));
    }
    end_line();
}

// A packet of type `message` shows no payload: the line ends with the blank before it.
void Ns2Trace::Writer::old_packet(const PacketLine& line, const Message& message) {
    *at_++ = line.op;
    *at_++ = ' ', at_ = write_seconds(at_, line.time);
    text(" _"), integer(line.node.value);
    text("_ "), text(line.layer);
    text("  "), text(line.reason);  // printed as %4s
    *at_++ = ' ', integer(message.uid);
    text(" message "), integer(message.size);
    if (line.heard_from) {
        text(" [0 ffffffff "), at_ = write_hex(at_, line.heard_from->value);
        text(" 800] ------- [");
    } else {
        text(" [0 0 0 0] ------- [");
    }
    integer(message.origin.value);
    text(":0 -1:0 "), integer(line.ttl);
    text(" 0] ");
}

// -Hd, the next hop, is -2 (not set) for broadcasts of DumbAgent and of AODV alike.
void Ns2Trace::Writer::new_packet(const PacketLine& line, const Message& message, Vec3 position) {
    *at_++ = line.op == 'D' ? 'd' : line.op;
    text(" -t "), at_ = write_seconds(at_, line.time);
    text(" -Hs "), integer(line.node.value);
    text(" -Hd -2 -Ni "), integer(line.node.value);
    text(" -Nx "), fixed2(position.x);
    text(" -Ny "), fixed2(position.y);
    text(" -Nz "), fixed2(position.z);
    text(" -Ne -1.000000 -Nl "), text(line.layer);
    text(" -Nw "), text(line.reason);
    if (line.heard_from) {
        text(" -Ma 0 -Md ffffffff -Ms "), at_ = write_hex(at_, line.heard_from->value);
        text(" -Mt 800 -Is ");
    } else {
        text(" -Ma 0 -Md 0 -Ms 0 -Mt 0 -Is ");
    }
    integer(message.origin.value);
    text(".0 -Id -1.0 -It message -Il "), integer(message.size);
    text(" -If 0 -Ii "), integer(message.uid);
    text(" -Iv "), integer(line.ttl);
    *at_++ = ' ';
}

Ns2Trace::Ns2Trace(const std::string& path, Ns2Format format)
    : writer_(std::make_unique<Writer>(path, format)), exceptions_(std::uncaught_exceptions()) {}
Ns2Trace::Ns2Trace(Ns2Trace&&) noexcept = default;
Ns2Trace& Ns2Trace::operator=(Ns2Trace&&) noexcept = default;

Ns2Trace::~Ns2Trace() {
    if (!writer_ || std::uncaught_exceptions() > exceptions_) return;
    try {
        close();
    } catch (const RunError&) {
        // The file is gone; who wants to know why calls close().
    }
}

void Ns2Trace::on(const Record& record, const RecordContext& context) {
    writer_->write(record, context);
}
void Ns2Trace::close() { writer_->close(); }

}  // namespace rovernet
