// SPDX-License-Identifier: MIT
#include "experiment/replay/recorded_follow.hpp"

#include "experiment/replay/plain_records.hpp"
#include "experiment/replay/trace_input.hpp"
#include "traces/ns2/ns2_trace.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <algorithm>
#include <string_view>
#include <variant>

namespace rovernet {
namespace {

/// Whether lines of the record matter to who follows the message: they are about it, or send
/// another one.
bool matters(const Record& record, const RecordContext& context, std::uint64_t uid) {
    const auto is_it = [&](MessageId id) { return context.messages[id].uid == uid; };
    return std::visit(
        [&](const auto& r) {
            if constexpr (requires { r.message; }) return true;  // Sent
            if constexpr (requires { r.frame; }) return is_it(r.frame.message);
            if constexpr (requires { r.air; }) {
                return !r.air.control && is_it(r.air.frame.message);
            }
            return false;
        },
        record);
}

/// Gives each whole line of a text to the follower.
void take_lines(std::string_view text, Ns2Follower& follower) {
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        follower.take(parse_ns2_line(text.substr(0, end)));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

}  // namespace

RecordedWay follow_recorded_text(const std::string& path, std::uint64_t uid,
                                 Ns2Strictness strictness) {
    const TraceInput trace(path, {.format = Ns2Format::old_format, .mac = MacTrace::on});
    FollowedMessage way = follow_ns2(trace.text(), uid, strictness);
    return {std::move(way), trace.robots(), trace.damage()};
}

RecordedWay follow_recorded(const std::string& path, std::uint64_t uid, Ns2Strictness strictness) {
    RecordedReader trace(path);
    PlainRecords plain;
    Ns2Follower follower(uid);
    Ns2Trace lines([&](std::string_view text) { take_lines(text, follower); },
                   Ns2Format::old_format, MacTrace::on);
    while (const Record* record = trace.next()) {
        const RecordContext context = trace.context();
        if (!plain.take(*record, context)) return follow_recorded_text(path, uid, strictness);
        if (matters(*record, context, uid)) lines.on(*record, context);
    }
    lines.finish();
    for (std::uint32_t robot = 0; robot < plain.seen().size(); ++robot) {
        if (plain.seen()[robot]) follower.tell_of(NodeId{robot});
    }
    return {follower.way(path), trace.run().robots, trace.damage()};
}

}  // namespace rovernet
