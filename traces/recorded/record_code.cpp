// SPDX-License-Identifier: MIT
#include "traces/recorded/record_code.hpp"

#include "traces/recorded/field_reader.hpp"
#include "traces/recorded/field_writer.hpp"

#include <limits>
#include <type_traits>
#include <variant>

namespace rovernet {

std::uint8_t number_of(const ControlFrame* control) {
    if (!control) return 0;
    std::uint8_t number = 1;
    while (number < control_frames.size() && control_frames[number - 1U].name != control->name)
        ++number;
    return number;
}

Time time_of(const Record& record, Time otherwise) {
    return std::visit(
        [&](const auto& r) -> Time {
            if constexpr (requires { r.receptions; }) {
                return r.receptions.empty() ? otherwise : r.receptions.front().time;
            } else if constexpr (requires { r.reception; }) {
                return r.reception.time;
            } else {
                return r.time;
            }
        },
        record);
}

void encode(const Record& record, Time time, ByteWriter& to) {
    std::visit([&](const auto& r) { FieldWriter(to, time).put(r); }, record);
}

void encode(const Message& message, MessageId slot, Time time, ByteWriter& to) {
    to.varint(slot.value);
    to.varint(message.uid);
    to.varint(message.origin.value);
    to.varint(message.number);
    to.varint(message.to.value + 1U);
    to.varint(message.size);
    to.signed_varint((time - message.created).count());
    to.varint(message.flow);
    to.fixed(static_cast<std::uint8_t>(message.is_routed));
    to.varint(message.port);
    for (const std::string_view text : {message.kind, std::string_view(message.payload)}) {
        to.varint(text.size());
        to.bytes(text);
    }
}

void encode(const FrameHeader& header, ByteWriter& to) {
    for (const std::string_view text : {header.protocol, std::string_view(header.bytes)}) {
        to.varint(text.size());
        to.bytes(text);
    }
}

bool decode(std::uint16_t channel, Time time, std::string_view bytes,
            std::vector<Reception>& receptions, Record& record, unsigned format) {
    FieldReader from(bytes, time, format, receptions);
    std::uint16_t its_channel = channel_of(0);
    const auto take = [&]<class R>(std::type_identity<R>) {
        if (channel == its_channel++) from.take(record.emplace<R>());
    };
    const auto take_any = [&]<class... R>(RecordList<R...>) {
        (take(std::type_identity<R>{}), ...);
    };
    take_any(RecordKinds{});
    return channel >= channel_of(0) && channel < its_channel && from.is_done();
}

bool decode(Time time, std::string_view bytes, MessageId& slot, Message& message,
            std::string_view& kind, unsigned format) {
    ByteReader from(bytes);
    bool in_range = true;
    const auto whole = [&] {
        const std::uint64_t value = from.varint();
        if (value > std::numeric_limits<std::uint32_t>::max()) in_range = false;
        return static_cast<std::uint32_t>(value);
    };
    slot = {whole()};
    message.uid = from.varint();
    message.origin = {whole()};
    message.number = whole();
    message.to = {whole() - 1U};
    message.size = whole();
    const std::int64_t age = from.signed_varint();
    const std::int64_t now = time.time_since_epoch().count();
    if (age < 0 || age > now) in_range = false;
    message.created = in_range ? time - Duration{age} : time;
    message.flow = whole();
    message.is_routed = from.fixed<std::uint8_t>() != 0;
    const std::uint32_t port = format >= 3 ? whole() : 0;
    message.port = static_cast<std::uint16_t>(port);
    if (port != message.port) in_range = false;
    kind = from.take(from.varint());
    message.payload = std::string(from.take(from.varint()));
    return from.is_done() && in_range;
}

bool decode(std::string_view bytes, FrameHeader& header, std::string_view& protocol) {
    ByteReader from(bytes);
    protocol = from.take(from.varint());
    header.bytes = std::string(from.take(from.varint()));
    return from.is_done();
}

}  // namespace rovernet
