// SPDX-License-Identifier: MIT
#include "experiment/replay/recorded_stats.hpp"

#include "experiment/replay/plain_records.hpp"
#include "experiment/replay/replay.hpp"
#include "experiment/replay/trace_input.hpp"
#include "traces/ns2/trace_counter.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <unordered_map>  // order never observed
#include <utility>
#include <variant>

namespace rovernet {
namespace {

/// Message whose sending is in the trace, as the reader of its lines knows it.
struct Known {
    TraceCounter::Sending sending;
    NodeId origin;
    std::uint32_t others = 0;  ///< robots that it is for
    std::vector<bool> got;     ///< robots that it was delivered to
};

/// Number of receptions by fate, of broadcasts and of unicasts.
using FateCounts =
    std::array<std::array<std::uint64_t, static_cast<std::size_t>(last_fate) + 1>, 2>;

/// Whether the MAC of the receiver drops the copy, as the lines tell it.
bool is_lost_on_air(Fate fate, bool is_unicast) {
    return !is_decoded(fate) || (is_unicast && fate == Fate::duplicate);
}

/// Counts records as the lines that are made of them would be counted.
class RecordedCounter {
  public:
    explicit RecordedCounter(TraceRows by) : counter_(by) {}

    /// @return false if a line of the record would be refused
    bool take(const Record& record, const RecordContext& context) {
        if (!plain_.take(record, context)) return false;
        context_ = &context;
        return std::visit([&](const auto& r) { return count(r); }, record);
    }
    void tell(RecordedStats& told);

  private:
    bool count(const Sent&);
    bool count(const Transmitted&);
    bool count(const Routed& r) { return count_routed(r.frame, r.time); }
    bool count_routed(const Frame&, Time);
    bool count(const Received&);
    bool count(const Dropped&);
    bool count(const Moved&) { return add_lines(1); }
    bool count(const AirSent&) { return add_packets(1); }
    bool count(const ControlReceived&);
    template <class Other>
    bool count(const Other&) {
        return true;  // it has no line
    }
    void receive(const Reception& rx, bool is_unicast, Known& message);
    Known* known(MessageId id);
    std::uint32_t flow_of(const Message& message);
    bool add_lines(std::uint64_t count) {
        lines_ += count;
        return true;
    }
    bool add_packets(std::uint64_t count) {
        has_packets_ = true;
        return add_lines(count);
    }

    TraceCounter counter_;
    PlainRecords plain_;
    const RecordContext* context_ = nullptr;  // of the record that is counted
    /// Message that a slot had when it was looked up last.
    struct Slot {
        std::uint64_t uid = ~std::uint64_t{0};
        const char* kind = nullptr;
        Known* known = nullptr;
    };
    std::vector<Slot> slots_;  // by MessageId
    std::unordered_map<std::uint64_t, Known> by_uid_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> flows_;  // by origin and goal
    std::vector<PartValues> flow_values_;                                     // by flow - 1
    std::uint64_t lines_ = 0, deliveries_ = 0;
    bool has_packets_ = false;
    FateCounts receptions_{};
    std::array<std::uint64_t, static_cast<std::size_t>(last_fate) + 1> control_{};
    std::array<std::uint64_t, static_cast<std::size_t>(last_drop_reason) + 1> drops_{};
};

/// The message in a slot, if its sending was told; packets of protocols have none.
Known* RecordedCounter::known(MessageId id) {
    const Message& message = context_->messages[id];
    if (id.index() >= slots_.size()) slots_.resize(id.index() + 1);
    Slot& slot = slots_[id.index()];
    if (slot.uid == message.uid && slot.kind == message.kind.data() && slot.known) {
        return slot.known;
    }
    slot = {message.uid, message.kind.data(), nullptr};
    if (!message.kind.empty()) return nullptr;
    const auto found = by_uid_.find(message.uid);
    if (found != by_uid_.end()) slot.known = &found->second;
    return slot.known;
}

std::uint32_t RecordedCounter::flow_of(const Message& message) {
    const auto next = static_cast<std::uint32_t>(flows_.size() + 1);
    const auto [entry, is_new] = flows_.try_emplace({message.origin.value, message.to.value}, next);
    if (is_new) flow_values_.emplace_back();
    if (is_new && counter_.by() == TraceRows::flow) {
        const std::string to = message.to == everyone ? "-1" : std::to_string(message.to.value);
        counter_.name_flow(
            next, fmt::format("{} {}:0 -> {}:0", ns2_type(message), message.origin.value, to));
    }
    return entry->second;
}

bool RecordedCounter::count(const Sent& r) {
    const Message& message = context_->messages[r.message];
    const auto [entry, is_new] = by_uid_.try_emplace(message.uid);
    if (!is_new) return false;  // sent a second time
    Known& known = entry->second;
    known.sending = {.flow = flow_of(message), .size = message.size, .time = r.time};
    known.origin = r.node;
    known.others = message.to == everyone ? plain_.robots() - 1 : 1;
    flow_values_[known.sending.flow - 1].expected += known.others;
    counter_.sent(r.node, known.sending);
    return add_packets(r.reachable ? 3 : 2);
}

/// A unicast of the routing protocol has the line of its Routed.
bool RecordedCounter::count(const Transmitted& r) {
    const Message& message = context_->messages[r.frame.message];
    const bool has_no_line =
        message.is_link_packet() || (message.is_routed && r.frame.next_hop != everyone);
    return has_no_line || count_routed(r.frame, r.time);
}

bool RecordedCounter::count_routed(const Frame& frame, Time time) {
    if (const Known* message = known(frame.message)) {
        counter_.transmitted(frame.sender, message->sending.flow, time);
        if (context_->messages[frame.message].is_routed_unicast()) counter_.forwarded();
    } else if (const Message& packet = context_->messages[frame.message];
               packet.is_routing_packet()) {
        counter_.routed(frame.size_of(packet));
    }
    return add_packets(1);
}

bool RecordedCounter::count(const Received& r) {
    if (context_->messages[r.frame.message].is_link_packet()) {
        for (const Reception& rx : r.receptions) ++control_[static_cast<std::size_t>(rx.fate)];
        return add_packets(r.receptions.size());
    }
    Known* message = known(r.frame.message);
    const bool is_unicast = r.frame.next_hop != everyone;
    const bool is_routed = context_->messages[r.frame.message].is_routed_unicast();
    auto& fates = receptions_[is_unicast];
    const bool has_rows = counter_.by() != TraceRows::none;
    for (const Reception& rx : r.receptions) {
        ++fates[static_cast<std::size_t>(rx.fate)];
        if (!rx.delivered && !has_rows) continue;
        const bool has_line = rx.delivered && !is_lost_on_air(rx.fate, is_unicast);
        // r AGT, which a routed unicast without a header has in place of its r RTR.
        if (has_line && (!is_routed || r.frame.header != 0)) ++deliveries_;
        if (message) receive(rx, is_unicast, *message);
    }
    return true;  // tell() adds the lines
}

void RecordedCounter::receive(const Reception& rx, bool is_unicast, Known& message) {
    Reception counted = rx;
    const bool is_lost = is_lost_on_air(rx.fate, is_unicast);
    counted.delivered = rx.delivered && !is_lost && rx.node != message.origin;
    if (counted.delivered) {
        if (rx.node.index() >= message.got.size()) message.got.resize(rx.node.index() + 1);
        counted.delivered = !message.got[rx.node.index()];
        message.got[rx.node.index()] = true;
    }
    counter_.received(counted, message.sending);
    const bool goes_on = rx.fate == Fate::waiting || rx.fate == Fate::arrived;
    if (!goes_on) counter_.lost(rx.node, message.sending.flow, rx.time);
}

bool RecordedCounter::count(const Dropped& r) {
    // The protocol's own drop follows; what the MAC gives up has a line nevertheless.
    if (r.protocol_decides) return r.loss().layer != "MAC" || add_packets(1);
    ++drops_[static_cast<std::size_t>(r.reason)];
    if (const Known* message = known(r.frame.message)) {
        counter_.lost(r.node, message->sending.flow, r.time);
        if (r.reason == DropReason::cut_off) {
            flow_values_[message->sending.flow - 1].expected -= message->others;
        }
    }
    return add_packets(1);
}

bool RecordedCounter::count(const ControlReceived& r) {
    ++control_[static_cast<std::size_t>(r.reception.fate)];
    return add_packets(1);
}

/// Adds what was counted by fate and by reason, and the metrics of `told`.
void RecordedCounter::tell(RecordedStats& told) {
    for_each_reason([&](auto reason) {
        const auto [code, layer] = reason_of(reason);
        const auto place = static_cast<std::size_t>(reason);
        if constexpr (std::is_same_v<decltype(reason), Fate>) {
            for (const bool is_unicast : {false, true}) {
                const std::uint64_t count = receptions_[is_unicast][place];
                const bool is_lost = is_lost_on_air(reason, is_unicast);
                // r MAC and r RTR, then D RTR; or D MAC alone.
                lines_ += count * (is_lost || code.empty() ? (is_lost ? 1 : 2) : 3);
                if (count > 0) has_packets_ = true;
                if (is_decoded(reason)) told.receptions += count;
                if (!code.empty()) counter_.add_drops(is_lost ? "MAC" : layer, code, count);
            }
            if (!is_decoded(reason)) counter_.add_drops("MAC", code, control_[place]);
        } else {
            counter_.add_drops(layer, code, drops_[place]);
        }
    });
    for (std::uint32_t i = 0; i < plain_.seen().size(); ++i)
        if (plain_.seen()[i]) counter_.know(NodeId{i});
    TraceStats& stats = told.stats;
    stats.counts.lines = stats.counts.events = lines_ + deliveries_;
    stats.counts.dialects[static_cast<std::size_t>(Ns2Dialect::old_format)] = has_packets_;
    counter_.tell(stats, flow_values_);
}

/// Sets the drops to those of the metrics.
void take_drops(TraceStats& stats) {
    stats.drops.clear();
    for (const auto& drop : stats.metrics.drops) {
        if (drop.count > 0) stats.drops.emplace_back(drop.reason, drop.count);
    }
}

}  // namespace

RecordedStats recorded_stats_of_text(const std::string& path, Ns2Strictness strictness,
                                     TraceRows rows) {
    const TraceInput trace(path, {.format = Ns2Format::old_format, .mac = MacTrace::on});
    RecordedStats told;
    told.stats = ns2_stats(trace.text(), strictness, rows);
    told.damage = trace.damage();
    told.file_bytes = std::filesystem::file_size(path);
    std::vector<std::string> same_again;
    told.stats.metrics = recorded_metrics(path, same_again);
    take_drops(told.stats);
    RecordedReader reader(path);
    while (const Record* record = reader.next()) {
        const auto* received = std::get_if<Received>(record);
        if (!received) continue;
        for (const Reception& rx : received->receptions) told.receptions += is_decoded(rx.fate);
    }
    return told;
}

RecordedStats recorded_stats(const std::string& path, Ns2Strictness strictness, TraceRows rows) {
    RecordedReader trace(path);
    Metrics metrics = metrics_of(trace.run(), path);
    RecordedCounter counter(rows);
    while (const Record* record = trace.next()) {
        if (!counter.take(*record, trace.context())) {
            return recorded_stats_of_text(path, strictness, rows);
        }
        metrics.on(*record, trace.context());
    }
    RecordedStats told;
    told.stats.metrics = metrics.values();
    told.damage = trace.damage();
    told.file_bytes = std::filesystem::file_size(path);
    counter.tell(told);
    take_drops(told.stats);
    return told;
}

}  // namespace rovernet
