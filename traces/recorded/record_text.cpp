// SPDX-License-Identifier: MIT
#include "traces/recorded/record_text.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>
#include <variant>

namespace rovernet {
namespace {

constexpr std::array<std::string_view, 8> fate_words = {
    "waiting", "ttl", "duplicate", "off", "garbled", "collided", "busy", "arrived"};
static_assert(fate_words.size() == static_cast<std::size_t>(last_fate) + 1);

/// Fields of records as words with a blank before each.
class TextWriter {
  public:
    TextWriter(const RecordContext& context, std::string& text) : context_(context), text_(text) {}

    void operator()(const Sent& r) {
        begin(r.time, "Sent");
        put(r.node), put_message(r.message), put(r.ttl), put(r.robots);
        if (r.reachable) put(*r.reachable);
        if (!r.reachable) put("-");
        end();
    }
    void operator()(const Transmitted& r) {
        begin(r.time, "Transmitted");
        put(r.frame), put(r.heard_from);
        end();
    }
    void operator()(const Received& r) {
        for (const Reception& rx : r.receptions) {
            begin(rx.time, "Received");
            put(r.frame), put(r.reserved.count()), put(r.header), put(rx.node), put_fate(rx);
            end();
        }
    }
    void operator()(const Dropped& r) {
        begin(r.time, "Dropped");
        put(r.node), put(r.frame), put(static_cast<unsigned>(r.reason));
        end();
    }
    void operator()(const Moved& r) {
        const Leg& leg = r.leg;
        begin(r.time, "Moved");
        put(r.node), put(leg.start.time_since_epoch().count());
        if (leg.end == never) put("-");
        if (leg.end != never) put(leg.end.time_since_epoch().count());
        put(leg.from), put(leg.velocity), put(leg.to), put(leg.heading), put(leg.turning);
        end();
    }
    void operator()(const Arrived& r) { begin(r.time, "Arrived"), put(r.node), end(); }
    void operator()(const NoWay& r) { begin(r.time, "NoWay"), put(r.node), put(r.goal), end(); }
    void operator()(const Switched& r) {
        begin(r.time, "Switched"), put(r.node), put(r.on ? 1 : 0), end();
    }
    void operator()(const LinkUp& r) { begin(r.time, "LinkUp"), put(r.from), put(r.to), end(); }
    void operator()(const LinkDown& r) { begin(r.time, "LinkDown"), put(r.from), put(r.to), end(); }
    void operator()(const AirSent& r) { begin(r.time, "AirSent"), put(r.air), put(r.bytes), end(); }
    void operator()(const ControlReceived& r) {
        begin(r.reception.time, "ControlReceived");
        put(r.air), put(r.reception.node), put_fate(r.reception), put(r.bytes);
        end();
    }

  private:
    void begin(Time time, std::string_view kind) {
        fmt::format_to(std::back_inserter(text_), "{} {}", time.time_since_epoch().count(), kind);
    }
    void end() { text_ += '\n'; }
    template <class Word>
    void put(const Word& word) {
        fmt::format_to(std::back_inserter(text_), " {}", word);
    }
    void put(NodeId node) {
        if (node == everyone) return put("-");
        put(node.value);
    }
    void put(const std::optional<NodeId>& node) { put(node.value_or(everyone)); }
    void put(Vec3 v) { put(v.x), put(v.y), put(v.z); }
    void put_message(MessageId id) { put(context_.messages[id].uid); }
    void put_hop(const Frame& frame) {
        put(frame.sender), put(frame.ttl), put(frame.hops), put(frame.next_hop);
    }
    void put(const Frame& frame) { put_message(frame.message), put_hop(frame); }
    void put(const AirFrame& air) {
        if (air.kind == AirFrame::data) put_message(air.frame.message);
        if (air.kind != AirFrame::data) put("-");
        put_hop(air.frame), put(air.heard_from);
        put(static_cast<unsigned>(air.kind)), put(unsigned{air.attempt}), put(air.number);
        put(air.reserved.count());
    }
    void put_fate(const Reception& rx) {
        put(fate_words[static_cast<std::size_t>(rx.fate)]);
        if (rx.delivered) text_ += '+';
    }

    const RecordContext& context_;
    std::string& text_;
};

}  // namespace

void append_text(const Record& record, const RecordContext& context, std::string& text) {
    std::visit(TextWriter(context, text), record);
}

}  // namespace rovernet
