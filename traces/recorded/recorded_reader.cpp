// SPDX-License-Identifier: MIT
#include "traces/recorded/recorded_reader.hpp"

#include "sim/error.hpp"
#include "traces/recorded/record_code.hpp"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <limits>
#include <system_error>
#include <utility>
#include <variant>

namespace rovernet {
namespace {

template <class Integer>
Integer number_in(std::string_view text) {
    Integer value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

std::vector<std::string> lines_of(std::string_view text) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        lines.emplace_back(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    return lines;
}

}  // namespace

bool is_recorded_trace(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return false;
    std::ifstream file(path, std::ios::binary);
    std::string begin(mcap_magic.size(), '\0');
    return file.read(begin.data(), static_cast<std::streamsize>(begin.size())) &&
           begin == mcap_magic;
}

RecordedReader::RecordedReader(const std::string& path) : path_(path), file_(path) {
    bool has_profile = false, has_metadata = false;
    while (const auto record = file_.next()) {
        if (record->opcode == McapOpcode::header) {
            has_profile = ByteReader(record->content).text() == "rovernet";
        } else if (record->opcode == McapOpcode::metadata && has_profile) {
            read_metadata(record->content);
            has_metadata = true;
        } else if (record->opcode == McapOpcode::attachment) {
            read_attachment(record->content);
        } else if (record->opcode == McapOpcode::chunk || record->opcode == McapOpcode::data_end) {
            file_.go_to(*record);
            break;
        }
    }
    if (!has_metadata) {
        throw InputError({.source = path}, "this MCAP file was not recorded by rovernet");
    }
    for (std::size_t i = 0; i < run_.robots.size(); ++i) legs_.add({});
}

void RecordedReader::read_metadata(std::string_view content) {
    ByteReader from(content);
    if (from.text() != "rovernet") return;
    ByteReader entries(from.text());
    while (entries.left() > 0) {
        const std::string_view key = entries.text(), value = entries.text();
        if (key == "version") run_.version = value;
        if (key == "scenario") run_.scenario = value;
        if (key == "seed") run_.seed = number_in<std::uint64_t>(value);
        if (key == "replication") run_.replication = number_in<std::uint32_t>(value);
        if (key == "format" && number_in<std::uint32_t>(value) != recorded_format) {
            throw InputError({.source = path_},
                             fmt::format("a recorded trace of format {}; this version reads "
                                         "format {}",
                                         value, recorded_format));
        }
    }
}

void RecordedReader::read_attachment(std::string_view content) {
    ByteReader from(content);
    from.take(16);  // times
    AttachedFile file{.name = std::string(from.text()),
                      .type = std::string(from.text()),
                      .content = std::string(from.take(from.fixed<std::uint64_t>()))};
    const auto crc = from.fixed<std::uint32_t>();
    if (!from.is_done() ||
        (crc != 0 && mcap_crc(content.substr(0, content.size() - sizeof crc)) != crc)) {
        return file_.tell(fmt::format("the file {} inside is broken", file.name));
    }
    if (file.name == "robots.txt") {
        run_.robots = lines_of(file.content);
    } else {
        run_.files.push_back(std::move(file));
    }
}

/// Unpacks the next chunk that is whole. @return false at the end of the file
bool RecordedReader::begin_chunk() {
    while (const auto record = file_.next()) {
        if (record->opcode == McapOpcode::statistics) tell_missing_chunks(record->content);
        if (record->opcode != McapOpcode::chunk) continue;
        ++chunks_;
        const auto messages = file_.unpack(*record);
        if (!messages) continue;
        chunk_ = ByteReader(messages->records);
        chunk_offset_ = record->offset;
        return true;
    }
    return false;
}

/// Tells of chunks that look like something else, and so were passed over.
void RecordedReader::tell_missing_chunks(std::string_view statistics) {
    ByteReader from(statistics);
    from.take(8 + 2 + 4 + 4 + 4);  // messages, schemas, channels, attachments, metadata
    const auto chunks = from.fixed<std::uint32_t>();
    if (!from.failed() && chunks > chunks_ && damage().empty()) {
        file_.tell(fmt::format("{} of {} chunks are missing", chunks - chunks_, chunks));
    }
}

const Record* RecordedReader::next() {
    for (;;) {
        while (chunk_.left() > 0) {
            const auto opcode = static_cast<McapOpcode>(chunk_.fixed<std::uint8_t>());
            const std::string_view content = chunk_.take(chunk_.fixed<std::uint64_t>());
            if (chunk_.failed() || (opcode == McapOpcode::message && !take_message(content))) {
                file_.tell(
                    fmt::format("the chunk at byte {} has a message that is none after "
                                "{:.6f} s: the rest of the chunk is left out",
                                chunk_offset_, seconds(now_)));
                chunk_ = ByteReader({});
                break;
            }
            if (opcode == McapOpcode::message && has_record_) return &record_;
        }
        if (!begin_chunk()) return nullptr;
    }
}

/// Takes a definition, or a record. @return whether it is one
bool RecordedReader::take_message(std::string_view content) {
    ByteReader from(content);
    const auto channel = from.fixed<std::uint16_t>();
    from.fixed<std::uint32_t>();  // sequence
    const auto ns = from.fixed<std::uint64_t>();
    from.fixed<std::uint64_t>();  // the same time again
    constexpr auto last = std::numeric_limits<std::int64_t>::max();
    if (from.failed() || ns > static_cast<std::uint64_t>(last)) return false;
    now_ = Time{Duration{static_cast<std::int64_t>(ns)}};
    const std::string_view bytes = from.take(from.left());
    has_record_ = channel != message_channel;
    if (!has_record_) return define(bytes);
    if (!decode(channel, now_, bytes, receptions_, record_) || !meet(record_)) return false;
    if (const auto* moved = std::get_if<Moved>(&record_)) legs_.replace(moved->node, moved->leg);
    std::visit(
        [&](auto& r) {
            const auto ours = [&](MessageId& slot) { slot = *slots_[slot.index()]; };
            if constexpr (requires { r.message; }) ours(r.message);
            if constexpr (requires { r.frame; }) ours(r.frame.message);
            if constexpr (requires { r.air; }) {
                if (r.air.kind == AirFrame::data) ours(r.air.frame.message);
            }
        },
        record_);
    return true;
}

bool RecordedReader::define(std::string_view bytes) {
    Message message;
    MessageId slot;
    std::string_view kind;
    if (!decode(now_, bytes, slot, message, kind)) return false;
    // The run used a slot again before it made a new one, so that slots are small numbers.
    constexpr std::uint32_t most = 1 << 22;
    if (slot.value >= most || !meet(message.origin)) return false;
    if (slot.index() >= slots_.size()) slots_.resize(slot.index() + 1);
    message.kind = *kinds_.emplace(kind).first;
    auto& ours = slots_[slot.index()];
    if (ours && messages_[*ours].uid == message.uid) return true;
    if (ours) messages_.release(*ours);
    ours = messages_.add(std::move(message));
    return true;
}

/// Makes room for the robot. A leg that was in a broken chunk may have brought it, so that any
/// number that is not absurd is one. @return whether it can be one
bool RecordedReader::meet(NodeId robot) {
    constexpr std::size_t most_more = 1 << 20;
    if (robot.index() >= run_.robots.size() + most_more) return false;
    while (legs_.size() <= robot.index()) legs_.add({});
    return true;
}

/// Makes room for the robots of the record. @return whether they and its message can be
bool RecordedReader::meet(const Record& record) {
    const auto is_message = [&](MessageId slot) {
        return slot.index() < slots_.size() && slots_[slot.index()];
    };
    return std::visit(
        [&](const auto& r) {
            bool can_be = true;
            if constexpr (requires { r.node; }) can_be = meet(r.node);
            if constexpr (requires { r.to; }) can_be = meet(r.from) && meet(r.to);
            if constexpr (requires { r.message; }) can_be = can_be && is_message(r.message);
            if constexpr (requires { r.frame; }) {
                can_be = can_be && meet(r.frame.sender) && is_message(r.frame.message);
            }
            if constexpr (requires { r.air; }) {
                const bool has_message = r.air.kind == AirFrame::data;
                can_be =
                    meet(r.air.frame.sender) && (!has_message || is_message(r.air.frame.message));
            }
            if constexpr (requires { r.reception; }) can_be = can_be && meet(r.reception.node);
            if constexpr (requires { r.receptions; }) {
                for (const Reception& rx : r.receptions) can_be = can_be && meet(rx.node);
            }
            return can_be;
        },
        record);
}

void RecordedReader::read(const Sink& sink) {
    const auto name = [this](NodeId node) -> std::string_view {
        return run_.robots.at(node.index());
    };
    sink.begin({.scenario = [this] { return run_.scenario; },
                .robots = run_.robots.size(),
                .name = name,
                .seed = run_.seed,
                .replication = run_.replication});
    while (const Record* record = next()) {
        if (sink.kinds() & (KindMask{1} << record->index())) sink.on(*record, context());
    }
    sink.finish();
}

}  // namespace rovernet
