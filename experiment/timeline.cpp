// SPDX-License-Identifier: MIT
#include "experiment/timeline.hpp"

#include "scenario/document/json.hpp"
#include "sim/legs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace rovernet {
namespace {

constexpr std::uint32_t no_text = ~std::uint32_t{0};  // number of a payload's words: there are none

/// Whether a payload is for people to read: frames of emulated programs are not, say.
bool is_text(std::string_view bytes) {
    return std::none_of(bytes.begin(), bytes.end(), [](unsigned char c) {
        const bool is_space = c == '\t' || c == '\n' || c == '\r';
        return (c < ' ' && !is_space) || c == '\x7f';
    });
}

}  // namespace

bool Timeline::Pairs::add(std::uint32_t words, NodeId node) {
    const auto place = [&](std::uint64_t pair) {
        // Fibonacci hashing: the high bits of a product with 2^64 / golden ratio.
        std::size_t i = (pair * 0x9e3779b97f4a7c15) >> 20 & (slots_.size() - 1);
        while (slots_[i] != none && slots_[i] != pair) i = (i + 1) & (slots_.size() - 1);
        return i;
    };
    if (3 * size_ >= 2 * slots_.size()) {
        const auto old = std::exchange(slots_, std::vector(2 * slots_.size(), none));
        for (const std::uint64_t pair : old) {
            if (pair != none) slots_[place(pair)] = pair;
        }
    }
    const std::uint64_t pair = std::uint64_t{words} << 32 | node.value;
    std::uint64_t& slot = slots_[place(pair)];
    if (slot == pair) return false;
    slot = pair;
    ++size_;
    return true;
}

void Timeline::on(const Record& record, const RecordContext& context) {
    std::visit([&](const auto& each) { tell(each, context); }, record);
}

std::uint32_t Timeline::words_of(MessageId id, const RecordContext& context) {
    const Message& message = context.messages[id];
    if (id.index() >= by_message_.size()) by_message_.resize(id.index() + 1, {~0ULL, 0});
    auto& [uid, words] = by_message_[id.index()];
    if (std::exchange(uid, message.uid) == message.uid) return words;
    if (message.payload.empty() || !is_text(message.payload)) return words = no_text;
    const auto found = word_index_.find({message.origin, message.payload});
    if (found != word_index_.end()) return words = found->second;
    words = static_cast<std::uint32_t>(words_.size());
    words_.push_back({message.origin, message.payload});
    word_index_.emplace(std::pair{message.origin, std::string_view(words_.back().payload)}, words);
    return words;
}

void Timeline::add(const Entry& entry) {
    if (entries_.size() < most) {
        entries_.push_back(entry);
    } else {
        ++left_out_;
    }
}

std::uint32_t Timeline::place(Vec3 p) {
    if (entries_.size() >= most) return 0;  // its entry is left out
    places_.emplace_back(p.x, p.y);
    return static_cast<std::uint32_t>(places_.size() - 1);
}

void Timeline::tell(const Sent& sent, const RecordContext& context) {
    const std::uint32_t words = words_of(sent.message, context);
    if (words == no_text || !known_.add(words, sent.node)) return;
    add({sent.time, sent.node, words, Event::says, 0});
}

/// A repeated text of the same robot gets no entry.
void Timeline::tell(const Received& received, const RecordContext& context) {
    for (const auto& r : received.receptions) {
        if (!r.delivered) continue;
        const std::uint32_t words = words_of(received.frame.message, context);
        if (words == no_text || !known_.add(words, r.node)) continue;
        add({r.time, r.node, words, Event::hears, received.frame.hops});
    }
}

void Timeline::tell(const Arrived& arrived, const RecordContext& context) {
    const Vec3 p = context.legs.position(arrived.node, arrived.time);
    add({arrived.time, arrived.node, place(p), Event::arrives, 0});
}

void Timeline::tell(const NoWay& blocked, const RecordContext&) {
    add({blocked.time, blocked.node, place(blocked.goal), Event::finds_no_way, 0});
}

void Timeline::tell(const Switched& switched, const RecordContext&) {
    const Event event = switched.on ? Event::goes_on : Event::fails;
    add({switched.time, switched.node, 0, event, 0});
}

std::string Timeline::text(const Entry& entry) const {
    switch (entry.event) {
        case Event::says: return fmt::format("says \"{}\"", words_[entry.about].payload);
        case Event::hears: {
            const auto& [origin, payload] = words_[entry.about];
            return fmt::format("hears \"{}\" from {} over {} hop{}", payload,
                               network_->name(origin), entry.hops, entry.hops == 1 ? "" : "s");
        }
        case Event::arrives:
        case Event::finds_no_way: {
            const auto [x, y] = places_[entry.about];
            const bool arrives = entry.event == Event::arrives;
            return fmt::format("{} ({:.2f}, {:.2f}) m", arrives ? "arrives at" : "finds no way to",
                               x, y);
        }
        case Event::fails: return "is switched off";
        case Event::goes_on: return "is switched on again";
    }
    return {};
}

Timeline::Happening Timeline::operator[](std::size_t i) const {
    const Entry& entry = entries_[i];
    return {entry.time, network_->name(entry.node), text(entry)};
}

void Timeline::append_json(std::size_t i, std::string& out) const {
    static constexpr std::string_view names[] = {"says",         "hears", "arrives",
                                                 "finds no way", "fails", "goes on"};
    const Entry& entry = entries_[i];
    const auto set = [&](std::string_view key, const Value& value) {
        fmt::format_to(std::back_inserter(out), ",\n      \"{}\": {}", key, to_json_line(value));
    };
    fmt::format_to(std::back_inserter(out), "{{\n      \"t_s\": {}",
                   to_json_line(seconds(entry.time)));
    set("robot", network_->name(entry.node));
    set("event", names[static_cast<std::size_t>(entry.event)]);
    switch (entry.event) {
        case Event::says: set("payload", words_[entry.about].payload); break;
        case Event::hears:
            set("payload", words_[entry.about].payload);
            set("from", network_->name(words_[entry.about].origin));
            set("hops", static_cast<int>(entry.hops));
            break;
        case Event::arrives:
        case Event::finds_no_way:
            set("x_m", places_[entry.about].first);
            set("y_m", places_[entry.about].second);
            break;
        case Event::fails:
        case Event::goes_on: break;
    }
    out += "\n    }";
}

}  // namespace rovernet
