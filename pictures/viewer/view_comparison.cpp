// SPDX-License-Identifier: MIT
#include "pictures/viewer/view_comparison.hpp"

#include "pictures/viewer/column.hpp"
#include "pictures/viewer/view_file.hpp"

#include <cstdint>
#include <map>

namespace rovernet {
namespace {

constexpr std::uint8_t no_frame = 255;

/// Indices of messages by their names, without control packets.
std::map<MessageName, std::uint32_t> index_of(const std::vector<MessageName>& messages) {
    std::map<MessageName, std::uint32_t> index;
    for (std::size_t i = 0; i < messages.size(); ++i) {
        if (messages[i].number != no_index)
            index.emplace(messages[i], static_cast<std::uint32_t>(i));
    }
    return index;
}

std::uint32_t found(const std::map<MessageName, std::uint32_t>& index, const MessageName& name) {
    const auto at = index.find(name);
    return at == index.end() ? no_index : at->second;
}

/// Line of one trace at the first difference; null if the trace has ended before.
Value line_of(const std::vector<NumberedLine>& lines, std::size_t place) {
    return place < lines.size() ? Value(lines[place].text) : Value();
}

/// Entry `compare` of the head.
Table comparison_table(const ViewComparison& comparison) {
    const RunComparison& result = comparison.result;
    Table table;
    table.set("runs", Array{comparison.names[0], comparison.names[1]});
    table.set("gained", result.gained);
    table.set("lost", result.lost);
    table.set("same", result.same);
    if (result.first.is_equal) return table;
    Table first;
    first.set("field", result.first.field);
    first.set("a", line_of(result.first.a, result.first.place));
    first.set("b", line_of(result.first.b, result.first.place));
    table.set("first", std::move(first));
    return table;
}

}  // namespace

void write_comparison(const ViewComparison& comparison, const std::vector<MessageName>& messages,
                      std::size_t robots, ViewFile& file, Table& head) {
    head.set("compare", comparison_table(comparison));
    const auto in_first = index_of(comparison.messages), in_second = index_of(messages);
    const auto of = [&](auto number, auto value) {
        return column<decltype(number)>(comparison.result.changes, value);
    };
    const auto name_of = [](const ChangedDelivery& c) {
        return MessageName{c.delivery.origin.value, c.delivery.number};
    };
    constexpr std::uint32_t index = 0;
    constexpr std::uint8_t small = 0;
    file.add("compare.messages", column<std::uint32_t>(messages, [&](const auto& name) {
                 return name.number == no_index ? no_index : found(in_first, name);
             }));
    file.add_times("compare.time",
                   of(std::int64_t{}, [](const auto& c) { return whole_ns(c.time); }));
    file.add_indices("compare.robot", of(index, [](const auto& c) { return c.delivery.at.value; }),
                     robots);
    file.add("compare.first",
             of(index, [&](const auto& c) { return found(in_first, name_of(c)); }));
    file.add("compare.second",
             of(index, [&](const auto& c) { return found(in_second, name_of(c)); }));
    file.add("compare.gained", of(small, [](const auto& c) { return c.is_gained ? 1 : 0; }));
    file.add("compare.outcome", of(small, [](const auto& c) {
                 return c.other ? 2 * static_cast<int>(*c.other) : int{no_frame};
             }));
}

}  // namespace rovernet
