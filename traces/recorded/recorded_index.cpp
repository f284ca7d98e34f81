// SPDX-License-Identifier: MIT
#include "traces/recorded/recorded_index.hpp"

#include "traces/record_walk.hpp"
#include "traces/recorded/record_code.hpp"

#include <algorithm>
#include <variant>

namespace rovernet {
namespace {

// Light travels 3,000 km in this time; a frame is not received later.
constexpr Duration longest_delay{10'000'000};

}  // namespace

template <class T>
void RecordedIndex::set(Values<T>& all, NodeId node, std::uint32_t chunk, const T& value) {
    auto& values = all[node];
    if (!values.empty() && values.back().chunk == chunk) {
        values.back().value = value;
    } else {
        values.push_back({chunk, value});
    }
}

/// Calls visit(node, value) with the values that hold at the begin of a chunk.
template <class T, class Visit>
void RecordedIndex::for_each(const Values<T>& all, std::uint32_t chunk, const Visit& visit) {
    for (const auto& [node, values] : all) {
        const auto later =
            std::lower_bound(values.begin(), values.end(), chunk,
                             [](const From<T>& each, std::uint32_t c) { return each.chunk < c; });
        if (later != values.begin()) visit(node, std::prev(later)->value);
    }
}

void RecordedIndex::add(std::uint32_t chunk, const Record& record, const RecordContext& context) {
    const Time now = time_of(record, chunks_.empty() ? start_of_run : chunks_.back().last);
    if (chunks_.empty() || chunks_.back().number != chunk) chunks_.push_back({chunk, now, now});
    chunks_.back().last = now;
    ++chunks_.back().records;
    if (const auto* moved = std::get_if<Moved>(&record)) {
        set(legs_, moved->node, chunk, moved->leg);
    } else if (const auto* switched = std::get_if<Switched>(&record)) {
        set(switched_, switched->node, chunk, switched->on);
    } else if (const auto* sent = std::get_if<AirSent>(&record)) {
        longest_airtime_ = std::max(longest_airtime_, sent->airtime);
        if (sent->airtime == Duration{0}) knows_airtimes_ = false;
    }
    std::visit(
        [&](const auto& r) {
            for_each_in<MessageId>(
                r, [&](MessageId slot) { mention(context.messages[slot].uid, slot); });
        },
        record);
}

void RecordedIndex::mention(std::uint64_t uid, MessageId slot) {
    if (slot.index() >= last_of_.size()) last_of_.resize(slot.index() + 1, mentions_.max_size());
    std::size_t& last = last_of_[slot.index()];
    const Time now = chunks_.back().last;
    const std::size_t chunk = chunks_.size() - 1;
    if (last < mentions_.size() && mentions_[last].uid == uid && mentions_[last].chunk == chunk) {
        mentions_[last].last = now;
        return;
    }
    last = mentions_.size();
    mentions_.push_back({uid, chunk, now, now});
}

Duration RecordedIndex::longest_on_air() const { return longest_airtime_ + longest_delay; }

/// Appends the chunks from `first` to before `last`, indices in chunks_, but for those up to `end`,
/// which the last range ends before.
void RecordedIndex::append(std::vector<Range>& ranges, std::size_t& end, std::size_t first,
                           std::size_t last) const {
    for (std::size_t chunk = std::max(first, end); chunk < last; ++chunk) {
        const Chunk& added = chunks_[chunk];
        if (ranges.empty() || chunk > end) ranges.push_back({added.number, 0, 0});
        ranges.back().end = added.number + 1;
        ranges.back().records += added.records;
        end = chunk + 1;
    }
}

bool RecordedIndex::has(std::uint64_t uid) const {
    return std::any_of(mentions_.begin(), mentions_.end(),
                       [&](const Mention& each) { return each.uid == uid; });
}

std::vector<RecordedIndex::Range> RecordedIndex::chunks_of(std::uint64_t uid) const {
    std::vector<Range> ranges;
    std::size_t end = 0;
    for (const Mention& mention : mentions_) {
        if (mention.uid != uid) continue;
        std::size_t first = mention.chunk, last = mention.chunk + 1;
        while (first > 0 && chunks_[first - 1].last >= mention.first - longest_on_air()) --first;
        while (last < chunks_.size() && chunks_[last].first <= mention.last + longest_on_air())
            ++last;
        append(ranges, end, first, last);
    }
    return ranges;
}

std::vector<RecordedIndex::Range> RecordedIndex::chunks_between(Time from, Time to) const {
    std::vector<Range> ranges;
    std::size_t end = 0;
    for (std::size_t chunk = 0; chunk < chunks_.size(); ++chunk) {
        if (chunks_[chunk].last >= from - longest_on_air() && chunks_[chunk].first <= to)
            append(ranges, end, chunk, chunk + 1);
    }
    return ranges;
}

void RecordedIndex::for_each_before(std::uint32_t chunk,
                                    const std::function<void(const Record&)>& visit) const {
    for_each(legs_, chunk, [&](NodeId node, const Leg& leg) {
        visit(Moved{leg.start, node, leg});
    });
    for_each(switched_, chunk, [&](NodeId node, bool on) {
        visit(Switched{start_of_run, node, on});
    });
}

}  // namespace rovernet
