// SPDX-License-Identifier: MIT
#include "pictures/viewer/frame_columns.hpp"

#include "pictures/viewer/column.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <variant>

namespace rovernet {
namespace {

constexpr std::size_t outcomes = 2 * (static_cast<std::size_t>(last_fate) + 1);

/// Reason of a loss in the words of the page.
constexpr std::string_view words_of(DropReason reason) {
    switch (reason) {
        case DropReason::off: return "robot was switched off";
        case DropReason::queue_full: return "queue was full";
        case DropReason::retries: return "no acknowledgement";
        case DropReason::end: return "still in the queue when the robot was switched off";
        case DropReason::unheard: return "destination out of range";
        case DropReason::cut_off: return "the run ended";
        case DropReason::held: return "the run ended, before it was sent";
        case DropReason::no_route: return "no route";
        case DropReason::loop: return "came back to this robot";
        case DropReason::broken: return "route broke";
        case DropReason::buffer_full: return "too many messages waited for a route";
        case DropReason::timeout: return "waited too long for a route";
        case DropReason::salvaged: return "tried too many routes";
        case DropReason::own: return "dropped by the routing protocol";
        case DropReason::unresolved: return "address of the next hop not resolved";
    }
    return "";
}

std::uint8_t up_to_255(unsigned n) { return static_cast<std::uint8_t>(std::min(n, 255U)); }
// Longest propagation delay of a reception [ns]: light travels 3,000 km.
constexpr std::int64_t longest_delay = 10'000'000;

}  // namespace

std::uint8_t FrameColumns::Names::index_of(std::string_view name) {
    const auto index = std::find(list.begin(), list.end(), name) - list.begin();
    if (index == std::ssize(list)) list.emplace_back(name);
    return static_cast<std::uint8_t>(std::min<std::ptrdiff_t>(index, 255));
}

void FrameColumns::on(const Record& record, const RecordContext& context) {
    if (const auto* air = std::get_if<AirSent>(&record)) return take(*air, context);
    if (const auto* dropped = std::get_if<Dropped>(&record)) return take(*dropped, context);
    if (const auto* sent = std::get_if<Sent>(&record)) {
        index_of(sent->message, context);
    } else if (const auto* received = std::get_if<Received>(&record)) {
        const std::uint32_t message = index_of(received->frame.message, context);
        for (const Reception& each : received->receptions)
            take(flight_of(received->frame.sender, message, each.time), each);
    } else if (const auto* control = std::get_if<ControlReceived>(&record)) {
        const NodeId sender = control->air.frame.sender;
        take(flight_of(sender, no_index, control->reception.time), control->reception);
    }
}

std::size_t FrameColumns::messages() const {
    return static_cast<std::size_t>(std::count(messages_.kind.begin(), messages_.kind.end(), 0));
}

std::size_t FrameColumns::last_flow() const {
    const auto& flows = messages_.flow;
    return flows.empty() ? 0 : *std::max_element(flows.begin(), flows.end());
}

std::uint32_t FrameColumns::index_of(MessageId id, const RecordContext& context) {
    const Message& message = context.messages[id];
    if (id.index() >= known_.size()) known_.resize(id.index() + 1);
    Known& known = known_[id.index()];
    if (known.uid == message.uid) return known.index;
    auto& m = messages_;
    known = {message.uid, forgotten_ + static_cast<std::uint32_t>(m.uid.size())};
    m.uid.push_back(static_cast<double>(message.uid));
    m.created.push_back(static_cast<double>(whole_ns(message.created)));
    m.origin.push_back(message.origin.value);
    m.to.push_back(message.to.value);
    m.size.push_back(message.size);
    m.flow.push_back(static_cast<std::uint16_t>(std::min<std::uint32_t>(message.flow, 0xffff)));
    m.kind.push_back(message_kinds_.index_of(message.kind));
    m.payload.push_back(message.payload);
    m.name.push_back({message.origin.value, message.kind.empty() ? message.number : no_index});
    return known.index;
}

void FrameColumns::take(const AirSent& sent, const RecordContext& context) {
    const AirFrame& air = sent.air;
    const std::size_t sender = air.frame.sender.index();
    if (sender >= senders_.size()) senders_.resize(sender + 1);
    auto& [last_flight, longest] = senders_[sender];
    flights_.push_back({.start = whole_ns(sent.time),
                        .airtime = sent.airtime.count(),
                        .sender = air.frame.sender.value,
                        .to = air.frame.next_hop.value,
                        .message = air.control ? no_index : index_of(air.frame.message, context),
                        .before = last_flight,
                        .kind = frame_kinds_.index_of(air.kind()),
                        .ttl = air.control ? std::uint8_t{0} : up_to_255(air.frame.ttl),
                        .hops = air.control ? std::uint8_t{0} : up_to_255(air.frame.hops),
                        .queue = up_to_255(sent.queue)});
    has_queues_ |= sent.queue > 0;
    last_flight = static_cast<std::uint32_t>(flights_.size() - 1);
    longest = std::max(longest, sent.airtime.count());
}

/// Last flight of a sender with a message that was over when the message was received; no_index:
/// none, as in a damaged trace. Flights of one sender may overlap, and may end in another order
/// than they start.
std::uint32_t FrameColumns::flight_of(NodeId sender, std::uint32_t message, Time received) const {
    if (sender.index() >= senders_.size()) return no_index;
    const std::int64_t now = whole_ns(received);
    const std::int64_t earliest = now - longest_delay - senders_[sender.index()].longest;
    std::uint32_t i = senders_[sender.index()].last_flight;
    while (i != no_index && (flights_[i].message != message || flights_[i].end() > now))
        i = flights_[i].start < earliest ? no_index : flights_[i].before;
    return i;
}

void FrameColumns::take(std::uint32_t flight, const Reception& reception) {
    if (flight == no_index) return;
    const auto outcome = static_cast<std::uint8_t>(2 * static_cast<int>(reception.fate) +
                                                   static_cast<int>(reception.delivered));
    receptions_.push_back({flight, reception.node.value, outcome});
}

void FrameColumns::take(const Dropped& dropped, const RecordContext& context) {
    if (dropped.protocol_decides) return;
    const Reason why{dropped.reason, dropped.loss()};
    const auto reason = std::find(reasons_.begin(), reasons_.end(), why) - reasons_.begin();
    if (reason == std::ssize(reasons_)) reasons_.push_back(why);
    losses_.push_back({whole_ns(dropped.time), dropped.node.value,
                       index_of(dropped.frame.message, context),
                       static_cast<std::uint8_t>(reason)});
}

/// Sorts the receptions by flight. @return index of the first reception of each flight, and the
/// number of all
std::vector<std::uint32_t> FrameColumns::sort_receptions() {
    std::vector<std::uint32_t> first(flights_.size() + 1);
    for (const RobotReception& r : receptions_) ++first[r.flight + 1];
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    std::vector<RobotReception> sorted(receptions_.size());
    for (const RobotReception& r : receptions_) sorted[next[r.flight]++] = r;
    receptions_ = std::move(sorted);
    return first;
}

std::vector<FrameColumns::Missed> FrameColumns::missed(std::size_t robots, std::size_t most) const {
    const MessageColumns& m = messages_;
    std::vector<bool> got(m.uid.size() * robots);
    for (const RobotReception& r : receptions_) {
        const std::uint32_t message = flights_[r.flight].message;
        if (message != no_index && r.outcome % 2 == 1) got[message * robots + r.robot] = true;
    }
    std::vector<Missed> all;
    for (std::uint32_t message = 0; message < m.uid.size(); ++message) {
        for (std::uint32_t robot = 0; robot < robots && m.kind[message] == 0; ++robot) {
            const bool concerns =
                m.to[message] == robot || (m.to[message] == no_index && m.origin[message] != robot);
            if (!concerns || got[message * robots + robot]) continue;
            if (all.size() == most) return all;
            all.push_back({message, static_cast<std::uint64_t>(m.uid[message]), robot});
        }
    }
    return all;
}

void FrameColumns::write(ViewFile& file, Table& head, std::size_t robots, Time end,
                         const FrameChoice& choice) {
    const std::vector<std::uint32_t> first = sort_receptions();
    write_messages(file, robots, choice.payload_bytes);
    write_names(head);
    write_losses(file, head, robots);
    write_density(file, head, end, Bins::all);
    write_counts(head, flights_.size(), receptions_.size());
    write_frames(file, head, robots, choice, first);
}

std::size_t FrameColumns::write_part(ViewDraft& rest, ViewDraft& frames, std::size_t robots,
                                     Time end, Time now) {
    const std::int64_t past =
        now == never ? std::numeric_limits<std::int64_t>::max() : whole_ns(now) - longest_delay;
    const auto on_air = std::find_if(flights_.begin(), flights_.end(),
                                     [&](const Flight& f) { return f.end() >= past; });
    const auto flights = static_cast<std::size_t>(on_air - flights_.begin());
    const std::vector<std::uint32_t> first = sort_receptions();
    const std::size_t receptions = first[flights];
    std::vector<RobotReception> later(receptions_.begin() + static_cast<std::ptrdiff_t>(receptions),
                                      receptions_.end());
    receptions_.resize(receptions);
    write_messages(rest.file, robots, FrameChoice{}.payload_bytes);
    write_names(rest.head);
    write_losses(rest.file, rest.head, robots);
    write_density(rest.file, rest.head, end, Bins::used);
    write_counts(rest.head, flights, receptions);
    if (flights > 0) {
        const Table block = write_block(frames.file, "0/", {0, flights}, first, robots);
        frames.head.set("blocks", Array{block});
    }
    receptions_ = std::move(later);
    forget(flights);
    return flights;
}

/// Forgets the messages, the losses, and the first `flights` frames, whose receptions are gone.
void FrameColumns::forget(std::size_t flights) {
    const auto gone = static_cast<std::uint32_t>(flights);
    const auto shift = [&](std::uint32_t& flight) {
        if (flight != no_index) flight = flight < gone ? no_index : flight - gone;
    };
    flights_.erase(flights_.begin(), flights_.begin() + static_cast<std::ptrdiff_t>(flights));
    for (Flight& flight : flights_) shift(flight.before);
    for (Sender& each : senders_) shift(each.last_flight);
    for (RobotReception& reception : receptions_) shift(reception.flight);
    forgotten_ += static_cast<std::uint32_t>(messages_.uid.size());
    messages_ = {};
    losses_.clear();
}

void FrameColumns::write_names(Table& head) const {
    head.set("message_kinds", Array(message_kinds_.list.begin(), message_kinds_.list.end()));
    head.set("frame_kinds", Array(frame_kinds_.list.begin(), frame_kinds_.list.end()));
}

void FrameColumns::write_messages(ViewFile& file, std::size_t robots, std::size_t payload_bytes) {
    const MessageColumns& m = messages_;
    file.add("messages.uid", m.uid);
    file.add("messages.created", m.created);
    file.add_indices("messages.origin", m.origin, robots);
    file.add_indices("messages.to", m.to, robots);
    file.add("messages.size", m.size);
    file.add("messages.flow", m.flow);
    file.add("messages.kind", m.kind);
    std::vector<std::string> payloads;
    for (const std::string& payload : m.payload)
        payloads.push_back(payload.substr(0, payload_bytes));
    file.add_texts("messages.payload", payloads);
}

void FrameColumns::write_losses(ViewFile& file, Table& head, std::size_t robots) const {
    const auto of = [&](auto number, auto member) {
        return column<decltype(number)>(losses_, [&](const Loss& loss) { return loss.*member; });
    };
    file.add_times("drops.time", of(std::int64_t{}, &Loss::time));
    file.add_indices("drops.robot", of(std::uint32_t{}, &Loss::robot), robots);
    file.add("drops.message", of(std::uint32_t{}, &Loss::message));
    file.add("drops.reason", of(std::uint8_t{}, &Loss::reason));
    Array reasons;
    for (const Reason& each : reasons_) {
        Table reason;
        reason.set("code", each.loss.code);
        reason.set("layer", each.loss.layer);
        reason.set("text", words_of(each.reason));
        reasons.emplace_back(std::move(reason));
    }
    head.set("drops", std::move(reasons));
}

/// Writes the number of receptions of each outcome in each interval of time. The receptions must be
/// sorted by flight.
void FrameColumns::write_density(ViewFile& file, Table& head, Time end, Bins wanted) const {
    const bool is_part = wanted == Bins::used;
    Array levels;
    for (const std::size_t bins : {1U << 12U, 1U << 16U}) {
        const std::int64_t width = std::max<std::int64_t>(
            1, (whole_ns(end) + static_cast<std::int64_t>(bins)) / static_cast<std::int64_t>(bins));
        const auto bin_of = [&](std::uint32_t flight) {
            return std::min(static_cast<std::size_t>(flights_[flight].end() / width), bins - 1);
        };
        std::size_t begin = is_part ? bins : 0, after = is_part ? 0 : bins;
        const std::uint32_t flights =
            is_part && !receptions_.empty() ? receptions_.back().flight + 1 : 0;
        for (std::uint32_t f = 0; f < flights; ++f) {
            begin = std::min(begin, bin_of(f));
            after = std::max(after, bin_of(f) + 1);
        }
        begin = std::min(begin, after);
        std::vector<std::uint32_t> counts((after - begin) * outcomes);
        std::uint32_t flight = no_index;
        std::uint32_t* bin = nullptr;
        for (const RobotReception& r : receptions_) {
            if (r.flight != flight) bin = &counts[(bin_of(r.flight) - begin) * outcomes];
            flight = r.flight;
            ++bin[r.outcome];
        }
        file.add(fmt::format("density.{}", levels.size()), counts);
        Table level;
        level.set("bins", std::uint64_t{bins});
        level.set("width_ns", width);
        if (is_part) level.set("begin", std::uint64_t{begin});
        levels.emplace_back(std::move(level));
    }
    head.set("density", std::move(levels));
}

void FrameColumns::write_counts(Table& head, std::size_t flights, std::size_t receptions) const {
    std::array<std::uint64_t, outcomes> all{};
    for (const RobotReception& r : receptions_) ++all[r.outcome];
    Table counts;
    counts.set("flights", std::uint64_t{flights});
    counts.set("receptions", std::uint64_t{receptions});
    counts.set("messages", std::uint64_t{messages()});
    counts.set("outcomes", Array(all.begin(), all.end()));
    head.set("counts", std::move(counts));
}

/// Writes for each message the number of its frames in the run, and the block of its first frame.
void FrameColumns::write_places(ViewFile& file, const std::vector<Block>& blocks) const {
    std::vector<std::uint32_t> frames(messages_.uid.size()), block(frames.size(), no_index);
    for (const Flight& flight : flights_)
        if (flight.message != no_index) ++frames[flight.message];
    for (std::uint32_t number = 0; number < blocks.size(); ++number) {
        for (std::size_t f = blocks[number].begin; f < blocks[number].end; ++f) {
            const std::uint32_t message = flights_[f].message;
            if (message != no_index && block[message] == no_index) block[message] = number;
        }
    }
    file.add("messages.frames", frames);
    file.add("messages.block", block);
}

/// Writes the chosen frames as blocks, one behind the other.
void FrameColumns::write_frames(ViewFile& file, Table& head, std::size_t robots,
                                const FrameChoice& choice,
                                const std::vector<std::uint32_t>& first) {
    constexpr std::size_t block_size = 1U << 18U;  // [receptions]
    const auto starts_before = [](const Flight& f, std::int64_t t) { return f.start < t; };
    const auto place = [&](std::int64_t t) {
        const auto at = std::lower_bound(flights_.begin(), flights_.end(), t, starts_before);
        return static_cast<std::size_t>(at - flights_.begin());
    };
    const std::size_t from = place(whole_ns(choice.from));
    std::size_t to = choice.to == never ? flights_.size() : place(whole_ns(choice.to) + 1);
    to = std::max(from, to);
    if (to - from > choice.most_frames) to = from + choice.most_frames;
    Array blocks;
    std::vector<Block> ranges;
    for (std::size_t begin = from, end = from; begin < to; begin = end) {
        do ++end;
        while (end < to && first[end + 1] - first[begin] <= block_size);
        const std::string name = fmt::format("{}/", blocks.size());
        ranges.push_back({begin, end});
        blocks.emplace_back(write_block(file, name, ranges.back(), first, robots));
    }
    write_places(file, ranges);
    head.set("blocks", std::move(blocks));
    left_out_ = flights_.size() - (to - from);
}

/// @return the block's entry in the head
Table FrameColumns::write_block(ViewFile& file, const std::string& name, const Block& block,
                                const std::vector<std::uint32_t>& first, std::size_t robots) const {
    const std::span flights(flights_.begin() + static_cast<std::ptrdiff_t>(block.begin),
                            block.end - block.begin);
    const auto of = [&](auto number, auto member) {
        return column<decltype(number)>(flights, [&](const Flight& f) { return f.*member; });
    };
    constexpr std::uint32_t index = 0;
    constexpr std::uint8_t small = 0;
    file.add_times(name + "flights.start", of(std::int64_t{}, &Flight::start));
    file.add(name + "flights.airtime", of(0.0, &Flight::airtime));
    file.add_indices(name + "flights.sender", of(index, &Flight::sender), robots);
    file.add_indices(name + "flights.to", of(index, &Flight::to), robots);
    file.add(name + "flights.message", of(index, &Flight::message));
    file.add(name + "flights.kind", of(small, &Flight::kind));
    file.add(name + "flights.ttl", of(small, &Flight::ttl));
    file.add(name + "flights.hops", of(small, &Flight::hops));
    if (has_queues_) file.add(name + "flights.queue", of(small, &Flight::queue));
    std::vector<std::uint32_t> counts;
    for (std::size_t f = block.begin; f < block.end; ++f) counts.push_back(first[f + 1] - first[f]);
    file.add(name + "flights.count", counts);
    const std::span heard(receptions_.begin() + first[block.begin],
                          first[block.end] - first[block.begin]);
    file.add_indices(name + "receptions.robot",
                     column<std::uint32_t>(heard, [](const RobotReception& r) { return r.robot; }),
                     robots);
    file.add(name + "receptions.outcome",
             column<std::uint8_t>(heard, [](const RobotReception& r) { return r.outcome; }));
    Table entry;
    entry.set("begin_ns", flights_[block.begin].start);
    std::int64_t end = 0;
    for (const Flight& each : flights) end = std::max(end, each.end());
    entry.set("end_ns", end);
    entry.set("flights", std::uint64_t{block.end - block.begin});
    entry.set("receptions", std::uint64_t{heard.size()});
    return entry;
}

}  // namespace rovernet
