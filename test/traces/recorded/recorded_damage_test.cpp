// SPDX-License-Identifier: MIT
#include "sim/error.hpp"
#include "test/sanitizer.hpp"
#include "test/traces/record_stream.hpp"
#include "traces/metrics.hpp"
#include "traces/recorded/mcap_reader.hpp"
#include "traces/recorded/record_code.hpp"
#include "traces/recorded/record_text.hpp"
#include "traces/recorded/recorded_reader.hpp"
#include "traces/recorded/recorded_trace.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace recorded_damage_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

/// Where a record of the container begins, and how long it is with its head.
struct Part {
    McapOpcode opcode;
    std::size_t begin, size;
    std::size_t end() const { return begin + size; }
};

using Texts = std::vector<std::string>;

/// What a reader makes of a file.
struct Reading {
    bool is_refused = false;
    Texts records, damage;
};

Reading read(const std::string& path) {
    Reading reading;
    try {
        RecordedReader(path).read(std::make_shared<Metrics>());
        RecordedReader reader(path);
        while (const Record* record = reader.next()) {
            reading.records.emplace_back();
            append_text(*record, reader.context(), reading.records.back());
        }
        reading.damage = reader.damage();
    } catch (const InputError&) {
        reading.is_refused = true;
    }
    return reading;
}

/// A recorded trace of several chunks, and the records of each.
struct Sample {
    TempFolder folder;
    std::string path = folder / "trace.mcap", bytes;
    std::vector<Part> parts, chunks;
    std::vector<Texts> records;  // by chunk

    Sample() {
        Stream stream;
        const auto trace = std::make_shared<RecordedTrace>(
            path, RecordedTrace::Contents{.version = "1",
                                          .files = {{"map/a.yaml", "text/yaml", "image: a.png"}},
                                          .chunk = 4'000});
        trace->begin({.scenario = [] { return std::string("[scenario]\n"); },
                      .robots = 400,
                      .name = [](NodeId) -> std::string_view { return "r"; },
                      .seed = 1,
                      .replication = 0});
        stream.sinks = {Sink(trace)};
        RandomRecords(stream, 3).run(20, 1500);
        trace->finish();
        trace->close();
        bytes = content(path);
        McapReader file(path);
        std::vector<std::size_t> counts;
        while (const auto record = file.next()) {
            const Part part{record->opcode, record->offset,
                            record->content.size() + mcap_record_head};
            parts.push_back(part);
            if (part.opcode != McapOpcode::chunk) continue;
            chunks.push_back(part);
            counts.push_back(records_in(file.unpack(*record)->records));
        }
        const Reading whole = read(path);
        auto next = whole.records.begin();
        for (const std::size_t count : counts) {
            REQUIRE(count <= static_cast<std::size_t>(whole.records.end() - next));
            records.emplace_back(next, next + static_cast<std::ptrdiff_t>(count));
            next += static_cast<std::ptrdiff_t>(count);
        }
        REQUIRE(next == whole.records.end());
        REQUIRE(chunks.size() >= 4);
        REQUIRE(whole.damage.empty());
    }

    static std::size_t records_in(std::string_view plain) {
        std::size_t count = 0;
        for (ByteReader from(plain); from.left() > 0;) {
            from.fixed<std::uint8_t>();
            ByteReader message(from.take(from.fixed<std::uint64_t>()));
            if (message.fixed<std::uint16_t>() != message_channel) ++count;
        }
        return count;
    }
    const Part& first(McapOpcode opcode) const {
        for (const Part& part : parts) {
            if (part.opcode == opcode) return part;
        }
        throw std::logic_error("no such record");
    }
    /// Records of all chunks but these.
    Texts without(const std::vector<std::size_t>& lost) const {
        Texts all;
        for (std::size_t i = 0; i < records.size(); ++i) {
            if (std::find(lost.begin(), lost.end(), i) != lost.end()) continue;
            all.insert(all.end(), records[i].begin(), records[i].end());
        }
        return all;
    }
    /// Chunks from this one on.
    std::vector<std::size_t> from(std::size_t first_lost) const {
        std::vector<std::size_t> lost;
        for (std::size_t i = first_lost; i < chunks.size(); ++i) lost.push_back(i);
        return lost;
    }
};

/// A damaged file, and what a reader has to make of it.
struct Variant {
    std::string name, bytes;
    bool is_refused = false, is_told = true;
    std::vector<std::size_t> lost = {};  // chunks
};

/// The names that the trace needs are not known any more.
Variant nameless(const std::string& name, const std::string& bytes) {
    return {.name = name, .bytes = bytes, .is_refused = true};
}

std::string flipped(std::string bytes, std::size_t at, int mask = 0x10) {
    bytes[at] = static_cast<char>(bytes[at] ^ mask);
    return bytes;
}
std::string with_number(std::string bytes, std::size_t at, std::uint64_t number) {
    for (std::size_t i = 0; i < 8; ++i) bytes[at + i] = static_cast<char>(number >> (8 * i));
    return bytes;
}
std::string with_text(std::string bytes, std::size_t at, const std::string& text) {
    return bytes.insert(at, text);
}

constexpr std::uint64_t huge = std::uint64_t{1} << 63;
// Places in a chunk, behind its opcode.
constexpr std::size_t length_at = 1, plain_size_at = 25, crc_at = 33, compression_at = 37,
                      packed_size_at = 45, packed_at = 53;

std::vector<Variant> truncated(const Sample& s) {
    const auto to = [&](const std::string& name, std::size_t size) {
        return Variant{"cut " + name, s.bytes.substr(0, size)};
    };
    std::vector<Variant> all;
    const Part &header = s.parts[0], &metadata = s.first(McapOpcode::metadata),
               &attachment = s.first(McapOpcode::attachment), &chunk = s.chunks[2];
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{1}, std::size_t{5}, mcap_magic.size(), header.begin + 4,
          header.end(), metadata.begin + 1, metadata.end() - 1}) {
        all.push_back(to("at byte " + std::to_string(size), size));
        all.back().is_refused = true;
    }
    for (const std::size_t size : {metadata.end(), attachment.begin + 9, attachment.end() - 2,
                                   s.chunks[0].begin, s.chunks[0].begin + 1}) {
        all.push_back(to("before the chunks, at byte " + std::to_string(size), size));
        all.back().lost = s.from(0);
    }
    for (const std::size_t size : {chunk.begin + 1, chunk.begin + 8, chunk.begin + crc_at,
                                   chunk.begin + packed_at + 7, chunk.end() - 1}) {
        all.push_back(to("in a chunk, at byte " + std::to_string(size), size));
        all.back().lost = s.from(2);
    }
    all.push_back(to("behind a chunk", chunk.end()));
    all.back().lost = s.from(3);
    all.push_back(to("in the summary", s.first(McapOpcode::statistics).begin + 20));
    for (const std::size_t missing : {20, 9, 8, 1})
        all.push_back(to("before the end", s.bytes.size() - missing));
    return all;
}

/// One thing wrong with the second chunk: its records are lost, and no others.
std::vector<Variant> broken_chunks(const Sample& s) {
    const std::size_t at = s.chunks[1].begin, length = s.chunks[1].size - mcap_record_head;
    std::string zeros = s.bytes, many = s.bytes;
    for (std::size_t i = at; i < s.chunks[1].end(); ++i) zeros[i] = '\0';
    for (std::size_t i = at + 60; i < s.chunks[1].end(); i += 97) many = flipped(many, i, 1);
    std::vector<Variant> all = {
        {"opcode of no record", flipped(s.bytes, at, 0x80)},
        {"opcode of another record", flipped(s.bytes, at, 0x01)},
        {"length one less", with_number(s.bytes, at + length_at, length - 1)},
        {"length one more", with_number(s.bytes, at + length_at, length + 1)},
        {"length up to the midst of another chunk",
         with_number(s.bytes, at + length_at, s.chunks[3].begin + 20 - at)},
        {"length 2^63", with_number(s.bytes, at + length_at, huge)},
        {"length 2^64 - 1", with_number(s.bytes, at + length_at, ~std::uint64_t{0})},
        {"plain size 2^63", with_number(s.bytes, at + plain_size_at, huge)},
        {"plain size 60 MB", with_number(s.bytes, at + plain_size_at, 60 << 20)},
        {"plain size 0", with_number(s.bytes, at + plain_size_at, 0)},
        {"CRC", flipped(s.bytes, at + crc_at)},
        {"compression's length", flipped(s.bytes, at + compression_at + 3, 0x40)},
        {"compression's name", flipped(s.bytes, at + compression_at + 5)},
        {"packed size 2^63", with_number(s.bytes, at + packed_size_at, huge)},
        {"packed bytes, their begin", flipped(s.bytes, at + packed_at)},
        {"packed bytes, their middle", flipped(s.bytes, at + s.chunks[1].size / 2)},
        {"packed bytes, many bits", many},
        {"NUL bytes", zeros}};
    for (Variant& each : all) each.lost = {1};
    return all;
}

/// A chunk whose length leads to what looks like records: the bytes of its indexes. No other is
/// lost.
std::vector<Variant> misled(const Sample& s) {
    const std::size_t at = s.chunks[1].begin, length = s.chunks[1].size - mcap_record_head;
    std::vector<Variant> all;
    for (std::size_t more = 2; more < 90; ++more) {
        all.push_back({fmt::format("length {} more", more),
                       with_number(s.bytes, at + length_at, length + more)});
        all.back().lost = {1};
    }
    for (const char opcode : {'\x02', '\x07', '\x0f'}) {  // the end, an index, the end of the data
        std::string looks = with_number(s.bytes, at + length_at, length + 40);
        looks.replace(at + mcap_record_head + length + 40, 9,
                      std::string(1, opcode) + std::string(8, '\0'));
        all.push_back({fmt::format("length 40 more, then opcode {}", int{opcode}), looks});
        all.back().lost = {1};
    }
    return all;
}

/// Lengths of indexes of messages: nothing is lost.
std::vector<Variant> broken_indexes(const Sample& s) {
    std::vector<Variant> all;
    for (const Part& part : s.parts) {
        if (part.opcode != McapOpcode::message_index || part.begin > s.chunks[2].begin) continue;
        const std::size_t length = part.size - mcap_record_head;
        for (const std::uint64_t wrong :
             {std::uint64_t{0}, std::uint64_t{6}, length - 16, length + 16, length + 30, huge}) {
            all.push_back({fmt::format("index at {}: length {}", part.begin, wrong),
                           with_number(s.bytes, part.begin + 1, wrong)});
        }
    }
    return all;
}

/// Damage beside the chunks: no record is lost.
std::vector<Variant> broken_elsewhere(const Sample& s) {
    const std::size_t metadata = s.first(McapOpcode::metadata).begin,
                      attachment = s.first(McapOpcode::attachment).begin, chunk = s.chunks[1].begin;
    const std::string junk(10'000'000, 'x'), nothing(1'000'000, '\0');
    std::vector<Variant> all = {
        nameless("an attachment", flipped(s.bytes, attachment + mcap_record_head + 60)),
        nameless("length of an attachment 2^63", with_number(s.bytes, attachment + 1, huge)),
        {"10 MB of letters between chunks", with_text(s.bytes, chunk, junk)},
        {"1 MB of NUL bytes between chunks", with_text(s.bytes, chunk, nothing)},
        {"a record of no known kind",
         with_text(s.bytes, chunk, std::string("\x7f\0\0\0\0\0\0\0\0", 9))},
        {"a chunk of nothing", with_text(s.bytes, chunk, std::string("\x06\0\0\0\0\0\0\0\0", 9))}};
    all.push_back({"the scenario", flipped(s.bytes, metadata + mcap_record_head + 60)});
    all.back().is_told = false;  // it has no checksum
    for (const auto& [name, at] :
         {std::pair{"magic", std::size_t{1}}, std::pair{"profile", std::size_t{8 + 9 + 5}}}) {
        all.push_back({name, flipped(s.bytes, at)});
        all.back().is_refused = true;
    }
    return all;
}

void put(ByteWriter& to, McapOpcode opcode, std::string_view content) {
    to.fixed(static_cast<std::uint8_t>(opcode));
    to.fixed(std::uint64_t{content.size()});
    to.bytes(content);
}

/// A chunk with a true checksum and one message, of these bytes.
std::string chunk_of(std::uint16_t channel, std::string_view bytes, std::uint64_t time = 1) {
    ByteWriter message, records, chunk, file;
    message.fixed(channel);
    message.fixed(std::uint32_t{0});
    message.fixed(time);
    message.fixed(time);
    message.bytes(bytes);
    put(records, McapOpcode::message, message.view());
    chunk.fixed(time);
    chunk.fixed(time);
    chunk.fixed(std::uint64_t{records.size()});
    chunk.fixed(mcap_crc(records.view()));
    chunk.text("");
    chunk.fixed(std::uint64_t{records.size()});
    chunk.bytes(records.view());
    put(file, McapOpcode::chunk, chunk.view());
    return std::string(file.view());
}

std::string varints(const std::vector<std::uint64_t>& numbers, std::size_t zeros = 0) {
    ByteWriter bytes;
    for (const std::uint64_t each : numbers) bytes.varint(each);
    bytes.bytes(std::string(zeros, '\0'));
    return std::string(bytes.view());
}

/// Chunks whose checksum is right and whose messages are nonsense, before the second one.
std::vector<Variant> nonsense(const Sample& s) {
    const std::uint64_t most = ~std::uint64_t{0};
    const std::vector<std::pair<const char*, std::string>> nameless_robots = {
        {"a message of robot 2^31", chunk_of(1, varints({0, 0, huge >> 32, 0, 0, 0, 0, 0}, 4))},
        {"a message for robot 400", chunk_of(1, varints({0, 0, 1, 0, 401, 0, 0, 0}, 4))},
        {"a message of flow 2^30", chunk_of(1, varints({0, 0, 1, 0, 0, 0, 0, 1 << 30}, 4))},
        {"a robot 400", chunk_of(7, varints({400}))},
        {"a robot 2^32 - 2", chunk_of(7, varints({0xfffffffe}))},
        {"a link to robot 400", chunk_of(10, varints({1, 400}))}};
    const std::vector<std::pair<const char*, std::string>> chunks = {
        {"a message in slot 2^63", chunk_of(1, varints({huge, 0, 0, 0, 0, 0, 0, 0}, 4))},
        {"a kind of 5,000 letters", chunk_of(1, varints({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 5000}) +
                                                    std::string(5000, 'x') + varints({0}))},
        {"a payload of 2^64 - 1 bytes",
         chunk_of(1, varints({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, most}))},
        {"2^63 receptions", chunk_of(4, varints({0, 0, 1, 1, 0, 0, 0, huge}, 50))},
        {"2^30 receptions", chunk_of(4, varints({0, 0, 1, 1, 0, 0, 0, 1 << 30}, 50))},
        {"a reception at robot -1", chunk_of(4, varints({0, 0, 1, 1, 0, 0, 0, 1, 0, 1, 0}))},
        {"a fate that is none", chunk_of(4, varints({0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 99}))},
        {"a channel that is none", chunk_of(999, varints({0}))},
        {"an empty message", chunk_of(2, "")},
        {"a time of 2^63 ns", chunk_of(7, varints({0}), huge)},
        {"a varint without end", chunk_of(2, std::string(40, '\xff'))}};
    std::vector<Variant> all;
    for (const auto& [name, chunk] : chunks) {
        all.push_back({name, with_text(s.bytes, s.chunks[1].begin, chunk)});
    }
    for (const auto& [name, chunk] : nameless_robots) {
        all.push_back(nameless(name, with_text(s.bytes, s.chunks[1].begin, chunk)));
    }
    return all;
}

/// Peak of this process's memory since it was set back [MB]; 0 where nobody tells.
[[maybe_unused]] std::size_t peak_memory_mb() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("VmHWM:")) return std::stoul(line.substr(6)) / 1024;
    }
    return 0;
}
[[maybe_unused]] void set_peak_memory_back() { std::ofstream("/proc/self/clear_refs") << 5; }

void check(const Sample& sample, const Variant& variant) {
    CAPTURE(variant.name);
    write_file(sample.path, variant.bytes);
    const Reading reading = read(sample.path);
    CHECK(reading.is_refused == variant.is_refused);
    if (variant.is_refused) return;
    const Texts expected = sample.without(variant.lost);
    CHECK(reading.records.size() == expected.size());
    CHECK((reading.records == expected));
    CHECK(reading.damage.empty() == !variant.is_told);
}

}  // namespace

TEST_CASE("damaged recorded trace: a record is either read, or lost with its chunk and reported") {
    const Sample sample;
    for (const auto& make :
         {truncated, broken_chunks, misled, broken_indexes, broken_elsewhere, nonsense}) {
        const std::vector<Variant> variants = make(sample);
        CHECK(variants.size() >= 9);
        for (const Variant& variant : variants) check(sample, variant);
    }
}

TEST_CASE(
    "recorded trace: after each chunk, an index lists the position of each message in the chunk") {
    const Sample s;
    std::size_t chunk = 0, messages = 0;
    std::string plain;
    for (const Part& part : s.parts) {
        ByteReader content(std::string_view(s.bytes).substr(part.begin + mcap_record_head,
                                                            part.size - mcap_record_head));
        if (part.opcode == McapOpcode::chunk) {
            McapReader file(s.path);
            std::optional<McapRecord> record = file.next();
            while (record->offset != part.begin) record = file.next();
            plain = file.unpack(*record)->records;
            CHECK(messages == 0);  // of the chunk before
            messages = 0;
            for (ByteReader from(plain); from.left() > 0; ++messages) {
                from.fixed<std::uint8_t>();
                from.take(from.fixed<std::uint64_t>());
            }
            ++chunk;
        } else if (part.opcode == McapOpcode::message_index) {
            const auto channel = content.fixed<std::uint16_t>();
            for (ByteReader entries(content.text()); entries.left() > 0; --messages) {
                const auto time = entries.fixed<std::uint64_t>();
                const auto place = entries.fixed<std::uint64_t>();
                REQUIRE(place < plain.size());
                ByteReader message(std::string_view(plain).substr(place));
                CHECK(message.fixed<std::uint8_t>() == 5);  // opcode
                message.fixed<std::uint64_t>();
                CHECK(message.fixed<std::uint16_t>() == channel);
                message.fixed<std::uint32_t>();
                CHECK(message.fixed<std::uint64_t>() == time);
            }
            CHECK(content.is_done());
        }
    }
    CHECK(chunk == s.chunks.size());
    CHECK(messages == 0);
}

TEST_CASE(
    "damaged recorded trace: if sizes in the file are wrong, the reader needs at most 256 MB") {
    if (test::has_address_sanitizer) {
        MESSAGE("memory is not measured: what is freed stays for a while");
        return;
    }
    const Sample sample;
    for (const auto& make : {broken_chunks, nonsense}) {
        for (const Variant& variant : make(sample)) {
            CAPTURE(variant.name);
            write_file(sample.path, variant.bytes);
            set_peak_memory_back();
            read(sample.path);
            CHECK(peak_memory_mb() < 256);
        }
    }
}

}  // namespace recorded_damage_test
