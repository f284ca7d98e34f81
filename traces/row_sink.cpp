// SPDX-License-Identifier: MIT
#include "traces/row_sink.hpp"

#include "sim/error.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace rovernet {
namespace {

std::int64_t ns(Time t) { return t.time_since_epoch().count(); }
/// Number of a robot; -1 for `everyone` and none.
std::int32_t number(NodeId robot) { return static_cast<std::int32_t>(robot.value); }
std::int32_t number(std::optional<NodeId> robot) { return number(robot.value_or(everyone)); }
std::int32_t count(std::uint32_t n) { return static_cast<std::int32_t>(n); }

CodeCell code(std::string_view letters) {
    CodeCell cell{};
    std::copy_n(letters.begin(), std::min(letters.size(), cell.size()), cell.begin());
    return cell;
}
CodeCell code(AirFrame::Kind kind) {
    constexpr std::string_view names[] = {"DATA", "RTS", "CTS", "ACK"};
    return code(names[kind]);
}

const Message& message_of(const Frame& frame, const RecordContext& context) {
    return context.messages[frame.message];
}
std::int64_t uid(const Message& message) { return static_cast<std::int64_t>(message.uid); }

void append(std::vector<SentRow>& rows, const Sent& sent, const RecordContext& context) {
    const Message& m = context.messages[sent.message];
    rows.push_back({ns(sent.time), uid(m), number(sent.node), number(m.to), count(m.size),
                    count(m.flow), sent.ttl});
}
void append(std::vector<TransmittedRow>& rows, const Transmitted& sent,
            const RecordContext& context) {
    const Message& m = message_of(sent.frame, context);
    rows.push_back({ns(sent.time), uid(m), number(sent.frame.sender), number(m.origin),
                    number(sent.heard_from), number(sent.frame.next_hop), sent.frame.ttl,
                    sent.frame.hops});
}
void append(std::vector<ReceivedRow>& rows, const Received& got, const RecordContext& context) {
    constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
    const Message& m = message_of(got.frame, context);
    for (std::size_t i = 0; i < got.receptions.size(); ++i) {
        const Reception& at = got.receptions[i];
        rows.push_back({ns(at.time), uid(m), number(at.node), number(m.origin),
                        number(got.frame.sender), got.frame.ttl, got.frame.hops,
                        got.levels.empty() ? not_known : got.levels[i].value,
                        code(reason_of(at.fate).code), at.delivered});
    }
}
void append(std::vector<DroppedRow>& rows, const Dropped& lost, const RecordContext& context) {
    const Message& m = message_of(lost.frame, context);
    rows.push_back({ns(lost.time), uid(m), number(lost.node), number(m.origin),
                    number(lost.frame.sender), lost.frame.ttl, lost.frame.hops,
                    code(reason_of(lost.reason).code)});
}
void append(std::vector<MovedRow>& rows, const Moved& moved, const RecordContext&) {
    const Leg& leg = moved.leg;
    const Vec3 at = leg.position(moved.time), v = leg.velocity;
    rows.push_back({ns(moved.time), leg.end == never ? -1 : ns(leg.end), number(moved.node), at.x,
                    at.y, at.z, v.x, v.y, v.z, leg.heading_at(moved.time), leg.turning});
}
void append(std::vector<ArrivedRow>& rows, const Arrived& arrived, const RecordContext&) {
    rows.push_back({ns(arrived.time), number(arrived.node)});
}
void append(std::vector<NoWayRow>& rows, const NoWay& blocked, const RecordContext&) {
    rows.push_back(
        {ns(blocked.time), number(blocked.node), blocked.goal.x, blocked.goal.y, blocked.goal.z});
}
void append(std::vector<SwitchedRow>& rows, const Switched& switched, const RecordContext&) {
    rows.push_back({ns(switched.time), number(switched.node), switched.on});
}
void append(std::vector<LinkUpRow>& rows, const LinkUp& link, const RecordContext&) {
    rows.push_back({{ns(link.time), number(link.to), number(link.from)}});
}
void append(std::vector<LinkDownRow>& rows, const LinkDown& link, const RecordContext&) {
    rows.push_back({{ns(link.time), number(link.to), number(link.from)}});
}
void append(std::vector<AirSentRow>& rows, const AirSent& sent, const RecordContext&) {
    rows.push_back({ns(sent.time), sent.air.reserved.count(), number(sent.air.frame.sender),
                    number(sent.air.frame.next_hop), sent.air.attempt, count(sent.bytes),
                    code(sent.air.kind)});
}
void append(std::vector<ControlReceivedRow>& rows, const ControlReceived& got,
            const RecordContext&) {
    rows.push_back({ns(got.reception.time), number(got.reception.node),
                    number(got.air.frame.sender), count(got.bytes), code(got.air.kind),
                    code(reason_of(got.reception.fate).code)});
}

template <class T>
constexpr std::string_view format_of() {
    if constexpr (std::is_same_v<T, std::int64_t>) return "<i8";
    if constexpr (std::is_same_v<T, std::int32_t>) return "<i4";
    if constexpr (std::is_same_v<T, double>) return "<f8";
    if constexpr (std::is_same_v<T, bool>) return "?";
    if constexpr (std::is_same_v<T, CodeCell>) return "<U4";
}

template <class Row>
const Row blank{};
template <class Row>
std::vector<RowColumn> columns_of() {
    const Row& row = blank<Row>;
    const auto place = [](const auto& it) { return reinterpret_cast<const std::byte*>(&it); };
    std::vector<RowColumn> columns;
    for_each_field<Row>([&](const auto& f) {
        const auto& cell = row.*f.member;
        columns.push_back({f.name, format_of<std::decay_t<decltype(cell)>>(),
                           static_cast<std::size_t>(place(cell) - place(row))});
    });
    return columns;
}

}  // namespace

const std::array<std::string_view, std::variant_size_v<Record>> record_names = {
    "sent",   "transmitted", "received", "dropped",   "moved",    "arrived",
    "no_way", "switched",    "link_up",  "link_down", "air_sent", "control_received"};

KindMask record_named(std::string_view name) {
    const auto found = std::find(record_names.begin(), record_names.end(), name);
    if (found != record_names.end()) return KindMask{1} << (found - record_names.begin());
    const std::vector<std::string> names(record_names.begin(), record_names.end());
    std::string all;
    for (const std::string& each : names) all += (all.empty() ? "" : ", ") + each;
    const std::string near = did_you_mean(name, names);
    throw std::invalid_argument("there is no record \"" + std::string(name) +
                                "\"; expected one of " + all + (near.empty() ? "" : "; " + near));
}

void RowSink::on(const Record& record, const RecordContext& context) {
    std::visit(
        [&]<class R>(const R& each) {
            constexpr auto place = static_cast<std::size_t>(std::countr_zero(kind_of<R>()));
            append(std::get<place>(rows_), each, context);
        },
        record);
}

RowSink::Table RowSink::table(KindMask kind) const {
    Table table{};
    const auto take = [&]<class Row>(const std::vector<Row>& rows) {
        static const std::vector<RowColumn> columns = columns_of<Row>();
        table = {columns, std::as_bytes(std::span(rows)), sizeof(Row)};
    };
    const auto wanted = static_cast<std::size_t>(std::countr_zero(kind));
    [&]<std::size_t... I>(std::index_sequence<I...>) {
        ((I == wanted ? take(std::get<I>(rows_)) : void()), ...);
    }
    (std::make_index_sequence<std::tuple_size_v<Rows>>());
    return table;
}

void RowSink::clear() {
    std::apply([](auto&... rows) { (rows.clear(), ...); }, rows_);
}

}  // namespace rovernet
