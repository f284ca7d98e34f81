// SPDX-License-Identifier: MIT
#include "traces/recorded/recorded_reader.hpp"

#include "sim/error.hpp"
#include "sim/legs.hpp"
#include "traces/record_walk.hpp"
#include "traces/recorded/record_code.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
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

constexpr std::string_view names_file = "robots.txt";

}  // namespace

bool is_recorded_trace(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return false;
    std::ifstream file(path, std::ios::binary);
    std::string begin(mcap_magic.size(), '\0');
    if (file.read(begin.data(), static_cast<std::streamsize>(begin.size())) &&
        begin == mcap_magic) {
        return true;
    }
    if (std::filesystem::path(path).extension() != ".mcap") return false;
    if (file.gcount() == 0)
        throw InputError({.source = path}, "the file is empty, expected a recorded trace");
    const McapReader says_why(path);
    return false;
}

std::string RecordedRun::names_in_words() const {
    const bool is_broken = std::find(broken.begin(), broken.end(), names_file) != broken.end();
    const std::string_view why = is_broken ? "is broken" : "is missing";
    std::string names = fmt::format("the names of {} robots", robots.size());
    if (robots.empty()) names = "no names of robots";
    if (robots.size() == 1) names = "the name of 1 robot";
    return "the trace has " + names +
           (has_names ? "" : fmt::format(", because the file {} in the trace {}", names_file, why));
}

RecordedReader::RecordedReader(const std::string& path) : path_(path), file_(path) {
    run_.has_names = false;
    bool has_header = false, has_profile = false, has_metadata = false, has_data = false;
    while (const auto record = file_.next()) {
        if (record->opcode == McapOpcode::header) {
            has_header = true;
            has_profile = ByteReader(record->content).text() == "rovernet";
        } else if (record->opcode == McapOpcode::metadata && has_profile) {
            read_metadata(record->content);
            has_metadata = true;
        } else if (record->opcode == McapOpcode::attachment) {
            read_attachment(record->content);
        } else if (record->opcode == McapOpcode::channel) {
            read_channel(record->content);
        } else if (record->opcode == McapOpcode::chunk || record->opcode == McapOpcode::data_end) {
            file_.go_to(*record);
            has_data = true;
            break;
        }
    }
    const bool is_cut = !has_data && (!has_header || has_profile);
    if (!has_metadata && is_cut) {
        fail(fmt::format("this {} is cut off before its first data; record the run again",
                         has_profile ? "recorded trace" : "MCAP file"));
    }
    if (!has_metadata)
        fail(
            "this MCAP file was not recorded by rovernet; expected a trace of \"rovernet run "
            "--record\"");
    for (std::size_t i = 0; i < run_.robots.size(); ++i) legs_.add({});
}

void RecordedReader::fail(const std::string& message) const {
    throw InputError({.source = path_}, message);
}

void RecordedReader::read_metadata(std::string_view content) {
    ByteReader from(content);
    if (from.text() != "rovernet") return;
    const std::string before = run_.scenario;
    ByteReader entries(from.text());
    while (entries.left() > 0) {
        const std::string_view key = entries.text(), value = entries.text();
        if (key == "version") run_.version = value;
        if (key == "scenario") run_.scenario = value;
        if (key == "walls") run_.walls = value;
        if (key == "seed") run_.seed = number_in<std::uint64_t>(value);
        if (key == "replication") run_.replication = number_in<std::uint32_t>(value);
        if (key != "format") continue;
        format_ = number_in<std::uint32_t>(value);
        if (format_ == 0 || format_ > recorded_format) {
            fail(
                fmt::format("this recorded trace has format {}, but this version of rovernet reads "
                            "formats up to {}; use a newer version, or record the run again",
                            value, recorded_format));
        }
    }
    if (!before.empty() && before != run_.scenario) {
        fail("this trace contains two different scenarios; expected one scenario");
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
        file_.tell(fmt::format("the file {}, which this trace contains, is damaged", file.name));
        run_.broken.push_back(std::move(file.name));
        return;
    }
    const auto differ = [&](bool is_so) {
        if (is_so)
            fail(
                fmt::format("this trace contains two different files with the name {}; expected "
                            "one file of this name",
                            file.name));
    };
    if (file.name == names_file) {
        std::vector<std::string> names = lines_of(file.content);
        differ(std::exchange(run_.has_names, true) && names != run_.robots);
        run_.robots = std::move(names);
        return;
    }
    for (const AttachedFile& other : run_.files) {
        if (other.name != file.name) continue;
        return differ(other.content != file.content);
    }
    run_.files.push_back(std::move(file));
}

/// Remembers the kind of a channel if this version does not know it.
void RecordedReader::read_channel(std::string_view content) {
    ByteReader from(content);
    const auto number = from.fixed<std::uint16_t>();
    from.fixed<std::uint16_t>();  // its schema
    const std::string_view topic = from.text();
    constexpr std::uint16_t end = channel_of(std::variant_size_v<Record>);
    if (number == header_channel) return;
    if (!from.failed() && number >= end) later_kinds_.emplace(number, topic);
}

/// Reports, once, that the records of a kind are left out.
void RecordedReader::leave_out(std::string& kind) {
    if (kind.empty()) return;
    file_.tell(
        fmt::format("the records of kind {} are left out, because this version of rovernet does "
                    "not know this kind",
                    std::exchange(kind, {})));
}

/// Unpacks the next complete chunk. @return false at the end of the file
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

void RecordedReader::go_to_chunk(std::uint32_t chunk) {
    chunk_ = ByteReader({});
    next_header_ = {};
    while (chunks_ < chunk) {
        const auto record = file_.next();
        if (!record) return;
        if (record->opcode == McapOpcode::chunk) ++chunks_;
    }
}

/// Reports chunks that were damaged beyond recognition and skipped.
void RecordedReader::tell_missing_chunks(std::string_view statistics) {
    ByteReader from(statistics);
    from.take(8 + 2 + 4 + 4 + 4);  // messages, schemas, channels, attachments, metadata
    const auto chunks = from.fixed<std::uint32_t>();
    if (!from.failed() && chunks > chunks_ && damage().empty()) {
        file_.tell(fmt::format("{} of {} chunks (parts of the trace) are missing", chunks - chunks_,
                               chunks));
    }
}

const Record* RecordedReader::next() {
    for (;;) {
        while (chunk_.left() > 0) {
            const auto opcode = static_cast<McapOpcode>(chunk_.fixed<std::uint8_t>());
            const std::string_view content = chunk_.take(chunk_.fixed<std::uint64_t>());
            if (chunk_.failed() || (opcode == McapOpcode::message && !take_message(content))) {
                file_.tell(
                    fmt::format("the chunk of the trace at byte {} has a damaged message after "
                                "{:.6f} s: the rest of the chunk is left out",
                                chunk_offset_, seconds(now_)));
                chunk_ = ByteReader({});
                next_header_ = {};
                break;
            }
            if (opcode == McapOpcode::message && has_record_) return &record_;
        }
        if (!begin_chunk()) return nullptr;
    }
}

/// Handles a definition or a record. @return whether it is one
bool RecordedReader::take_message(std::string_view content) {
    ByteReader from(content);
    const auto channel = from.fixed<std::uint16_t>();
    from.fixed<std::uint32_t>();  // sequence
    const auto ns = from.fixed<std::uint64_t>();
    from.fixed<std::uint64_t>();  // the same time again
    constexpr auto last = std::uint64_t{1}
                          << 62;  // [ns], 146 years: later times can be added to it
    if (from.failed() || ns > last) return false;
    now_ = Time{Duration{static_cast<std::int64_t>(ns)}};
    const std::string_view bytes = from.take(from.left());
    const auto later = later_kinds_.find(channel);
    has_record_ =
        channel != message_channel && channel != header_channel && later == later_kinds_.end();
    if (channel == message_channel) return define(bytes);
    if (channel == header_channel) return take_header(bytes);
    if (!has_record_) return leave_out(later->second), true;
    if (!decode(channel, now_, bytes, receptions_, record_, format_) || !has_message(record_))
        return false;
    meet(record_);
    ++records_;
    header_ = std::exchange(next_header_, {});
    if (const auto* moved = std::get_if<Moved>(&record_)) {
        if (moved->leg.start < legs_.leg(moved->node).start) return false;
        legs_.replace(moved->node, moved->leg);
    }
    std::visit(
        [&](auto& r) {
            for_each_in<MessageId>(r, [&](MessageId& slot) { slot = *slots_[slot.index()]; });
        },
        record_);
    complete(record_);
    return true;
}

bool RecordedReader::take_header(std::string_view bytes) {
    std::string_view protocol;
    if (!decode(bytes, next_header_, protocol)) return false;
    next_header_.protocol = *kinds_.emplace(protocol).first;
    return true;
}

bool RecordedReader::define(std::string_view bytes) {
    Message message;
    MessageId slot;
    std::string_view kind;
    if (!decode(now_, bytes, slot, message, kind, format_)) return false;
    // A run reuses a slot before it creates a new one, so slots are small numbers.
    constexpr std::uint32_t most = 1 << 22;
    constexpr std::size_t longest_kind = 1024;  // a run has words; a line of ns-2 has to hold it
    if (slot.value >= most || kind.size() > longest_kind ||
        (kind.empty() && message.to == message.origin))
        return false;
    for (const NodeId end : {message.origin, message.to}) meet(end);
    constexpr std::uint32_t most_flows = 1 << 20;
    if (message.flow > most_flows) {
        fail(fmt::format("record {} belongs to flow number {}; expected a number of at most {}",
                         records_ + 1, message.flow, most_flows));
    }
    if (slot.index() >= slots_.size()) slots_.resize(slot.index() + 1);
    message.kind = *kinds_.emplace(kind).first;
    auto& ours = slots_[slot.index()];
    if (ours && messages_[*ours].uid == message.uid) return true;
    if (ours) messages_.release(*ours);
    ours = messages_.add(std::move(message));
    if (ours->index() >= has_header_.size()) has_header_.resize(ours->index() + 1);
    has_header_[ours->index()] = false;
    return true;
}

/// Checks that the trace names the robot, and allocates its state; ignores `everyone`.
void RecordedReader::meet(NodeId robot) {
    if (robot == everyone) return;
    // Robots added later to a network built by a C++ program have no names; the leg that introduced
    // one may have been in a broken chunk.
    constexpr std::size_t most_more = 1 << 20;
    const std::size_t named = run_.robots.size();
    if (robot.index() >= named + (run_.scenario.empty() && run_.has_names ? most_more : 0)) {
        fail(fmt::format("record {} belongs to robot number {} (counted from 0), but {}",
                         records_ + 1, robot.value, run_.names_in_words()));
    }
    while (legs_.size() <= robot.index()) legs_.add({});
}

/// Marks the frames of messages that have a header. Completes a record of format 1, which has only
/// the size of a frame with its header.
void RecordedReader::complete(Record& record) {
    if (auto* received = std::get_if<Received>(&record)) {
        received->frame.header = has_header_[received->frame.message.index()] ? 1 : 0;
    }
    auto* sent = std::get_if<AirSent>(&record);
    if (!sent || sent->air.control) return;
    if (!header_.bytes.empty()) has_header_[sent->air.frame.message.index()] = true;
    if (format_ > 1) return;
    const std::uint32_t size = messages_[sent->air.frame.message].size;
    sent->header = sent->bytes - std::min(size, sent->bytes);
}

void RecordedReader::meet(const Record& record) {
    std::visit([&](const auto& r) { for_each_in<NodeId>(r, [&](NodeId robot) { meet(robot); }); },
               record);
}

/// Whether all messages of the record were defined.
bool RecordedReader::has_message(const Record& record) const {
    bool has_all = true;
    const auto look_for = [&](MessageId slot) {
        has_all = has_all && slot.index() < slots_.size() && slots_[slot.index()];
    };
    std::visit([&](const auto& r) { for_each_in<MessageId>(r, look_for); }, record);
    return has_all;
}

void RecordedReader::read(const Sink& sink) {
    const auto name = [this](NodeId node) -> std::string_view {
        return node.index() < run_.robots.size() ? std::string_view(run_.robots[node.index()]) : "";
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
