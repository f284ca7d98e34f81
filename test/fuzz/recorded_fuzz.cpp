// SPDX-License-Identifier: MIT
// Any bytes are a recorded trace or an InputError: as a whole file, and as the records of a chunk
// without a checksum, which would keep all else out. Its metrics and its text can be computed, and
// whatever robot a record tells of has a name, as the trace holds a scenario.
#include "sim/error.hpp"
#include "sim/legs.hpp"
#include "test/fuzz/fuzz_file.hpp"
#include "traces/metrics.hpp"
#include "traces/recorded/record_text.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <cstdlib>
#include <memory>

namespace {

using rovernet::ByteWriter;

void put_record(ByteWriter& to, rovernet::McapOpcode opcode, const ByteWriter& content) {
    to.fixed(static_cast<std::uint8_t>(opcode));
    to.fixed(std::uint64_t{content.size()});
    to.bytes(content.view());
}

/// A file of four robots whose only chunk holds these records.
std::string file_of(std::string_view records) {
    ByteWriter header, entries, metadata, names, chunk, file;
    header.text("rovernet");
    header.text("");
    entries.text("scenario");
    entries.text("[scenario]");
    metadata.text("rovernet");
    metadata.text(entries.view());
    for (int i = 0; i < 2; ++i) names.fixed(std::uint64_t{0});
    names.text("robots.txt");
    names.text("text/plain");
    constexpr std::string_view four = "a\nb\nc\nd\n";
    names.fixed(std::uint64_t{four.size()});
    names.bytes(four);
    names.fixed(std::uint32_t{0});
    for (int i = 0; i < 3; ++i) chunk.fixed(std::uint64_t{0});
    chunk.fixed(std::uint32_t{0});
    chunk.text("");
    chunk.fixed(std::uint64_t{records.size()});
    chunk.bytes(records);
    file.bytes(rovernet::mcap_magic);
    put_record(file, rovernet::McapOpcode::header, header);
    put_record(file, rovernet::McapOpcode::metadata, metadata);
    put_record(file, rovernet::McapOpcode::attachment, names);
    put_record(file, rovernet::McapOpcode::chunk, chunk);
    return std::string(file.view());
}

void read(std::string_view bytes) {
    const rovernet::test::FuzzFile file(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                        bytes.size());
    try {
        rovernet::RecordedReader(file.path()).read(std::make_shared<rovernet::Metrics>());
        rovernet::RecordedReader reader(file.path());
        std::string text;
        while (const auto* record = reader.next()) {
            text.clear();
            rovernet::append_text(*record, reader.context(), text);
            const bool has_names = reader.context().legs.size() <= reader.run().robots.size();
            if (!reader.run().scenario.empty() && !has_names) std::abort();
        }
    } catch (const rovernet::InputError&) {
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const std::string_view input(reinterpret_cast<const char*>(bytes), size);
    read(input);
    read(file_of(input));
    return 0;
}
