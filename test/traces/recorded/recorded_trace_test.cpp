// SPDX-License-Identifier: MIT
#include "traces/recorded/recorded_trace.hpp"

#include "sim/error.hpp"
#include "test/traces/record_stream.hpp"
#include "traces/fingerprint.hpp"
#include "traces/metrics.hpp"
#include "traces/ns2/ns2_trace.hpp"
#include "traces/record_walk.hpp"
#include "traces/recorded/mcap_writer.hpp"
#include "traces/recorded/record_code.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstring>
#include <memory>

namespace recorded_trace_test {
using namespace rovernet;
namespace {

using namespace testing;

/// Remembers the bytes of all records, messages by their uid.
struct Everything {
    std::vector<std::string> records;
    KindMask kinds() const { return kind_all; }
    void on(Record record, const RecordContext& context) {
        const auto by_uid = [&](MessageId& id) {
            id.value = static_cast<std::uint32_t>(context.messages[id].uid);
        };
        std::visit([&](auto& r) { for_each_in<MessageId>(r, by_uid); }, record);
        ByteWriter bytes;
        const Time time = time_of(record, start_of_run);
        bytes.signed_varint(time.time_since_epoch().count());
        bytes.fixed(static_cast<std::uint8_t>(record.index()));
        encode(record, time, bytes);
        records.emplace_back(bytes.view());
    }
};

RunInfo info(std::size_t robots = 0) {
    return {.scenario = [] { return std::string("[scenario]\nname = \"x\"\n"); },
            .robots = robots,
            .name = [](NodeId) -> std::string_view { return "r"; },
            .seed = 42,
            .replication = 3};
}

/// A recorded trace of records made at random, and what other sinks made of the same records.
struct Recorded {
    TempFolder folder;
    std::shared_ptr<Everything> all = std::make_shared<Everything>();
    std::shared_ptr<Fingerprint> fingerprint = std::make_shared<Fingerprint>();
    std::string path = folder / "trace.mcap";

    explicit Recorded(int records, unsigned seed = 1, bool links = false) {
        Stream stream;
        const auto trace = std::make_shared<RecordedTrace>(
            path, RecordedTrace::Contents{.version = "1", .links = links, .chunk = 10'000});
        const auto old_text =
            std::make_shared<Ns2Trace>(folder / "old.tr", Ns2Format::old_format, MacTrace::on);
        const auto new_text = std::make_shared<Ns2Trace>(folder / "new.tr");
        trace->begin(info(400));
        stream.sinks = {Sink(trace), Sink(all), Sink(fingerprint), Sink(old_text), Sink(new_text)};
        RandomRecords(stream, seed).run(20, records);
        for (const Sink& sink : stream.sinks) sink.finish();
        trace->close();
    }
    /// The records of the file, and what a reader said of it.
    std::vector<std::string> read_back(std::vector<std::string>* damage = nullptr) const {
        const auto read = std::make_shared<Everything>();
        RecordedReader reader(path);
        reader.read(Sink(read));
        if (damage) *damage = reader.damage();
        return read->records;
    }
};

void render(const std::string& trace, const std::string& to, Ns2Format format, MacTrace mac) {
    const auto text = std::make_shared<Ns2Trace>(to, format, mac);
    RecordedReader(trace).read(Sink(text));
    text->close();
}

TEST_CASE("a recorded trace returns the records of the run in order") {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const Recorded recorded(2000, seed);
        std::vector<std::string> damage;
        CHECK(recorded.read_back(&damage) == recorded.all->records);
        CHECK(damage.empty());
    }
}

/// What a reader says of a trace of `named` robots in which robot `last` arrives.
std::string said_of(std::size_t named, std::uint32_t last, const std::string& scenario) {
    TempFolder folder;
    RecordedTrace trace(folder / "t.mcap", {.version = "1", .scenario = scenario});
    RunInfo run = info(named);
    run.scenario = {};
    trace.begin(run);
    trace.on(Arrived{at(5), NodeId{0}}, {Legs(), MessageTable()});
    trace.on(Arrived{at(7), NodeId{last}}, {Legs(), MessageTable()});
    trace.finish();
    trace.close();
    try {
        RecordedReader reader(folder / "t.mcap");
        while (reader.next()) continue;
        return reader.damage().empty() ? "nothing" : reader.damage().front();
    } catch (const InputError& error) {
        return error.message();
    }
}

TEST_CASE("in a recorded trace with a scenario, a record of a robot without a name is reported") {
    CHECK(said_of(3, 2, "[scenario]\n") == "nothing");
    CHECK(said_of(3, 3, "[scenario]\n") ==
          "record 2 belongs to robot number 3 (counted from 0), but the trace has the names of 3 "
          "robots");
    // Robots may have been added later to a network that was made in code.
    CHECK(said_of(3, 3, "") == "nothing");
    CHECK(said_of(3, 4'000'000, "") ==
          "record 2 belongs to robot number 4000000 (counted from 0), but the trace has the names "
          "of 3 robots");
}

TEST_CASE("record kinds of later versions are skipped, with one notice") {
    TempFolder folder;
    McapWriter file(folder / "t.mcap", "rovernet", "a later version");
    file.metadata("rovernet", {{"format", "1"}, {"scenario", ""}});
    file.attach({"robots.txt", "text/plain", "a\nb\n"});
    const std::uint16_t arrived = channel_of(5), later = channel_of(std::variant_size_v<Record>);
    file.declare(arrived, "Arrived", "node:v");
    bool is_declared = false;
    SUBCASE("the file declares the record kind of a later version") { is_declared = true; }
    SUBCASE("the file does not declare the record kind of a later version") {}
    if (is_declared) file.declare(later, "Later", "node:v");
    McapChunk chunk;
    for (const std::uint16_t channel : {arrived, later, later, arrived}) {
        chunk.begin_message(channel, 7);
        chunk.bytes().varint(1);
        chunk.end_message();
    }
    file.write(chunk);
    file.finish();
    file.give_name();
    RecordedReader reader(folder / "t.mcap");
    int records = 0;
    while (reader.next()) ++records;
    REQUIRE(reader.damage().size() == 1);
    if (is_declared) {
        CHECK(records == 2);
        CHECK(reader.damage()[0] ==
              "the records of kind Later are left out, because this version of rovernet does not "
              "know this kind");
    } else {
        CHECK(records == 1);  // the control: a channel of nothing is damage
    }
}

TEST_CASE("a recorded trace keeps the header of a frame with its record") {
    TempFolder folder;
    RecordedTrace trace(folder / "t.mcap", {.version = "1"});
    trace.begin(info(2));
    Stream stream;
    const Frame frame{
        .message = stream.messages.add({.origin = {0}, .payload = {}}), .sender = {0}, .hops = 1};
    const FrameHeader header{"DSR", std::string("a\0b", 3)};
    const auto emit = [&](const Record& record, const FrameHeader* its_header) {
        trace.on(record, {stream.legs, stream.messages, nullptr, its_header});
    };
    emit(AirSent{at(5), {.frame = frame}, 10}, nullptr);
    emit(AirSent{at(6), {.frame = frame}, 10}, &header);
    emit(Arrived{at(7), NodeId{1}}, nullptr);
    emit(AirSent{at(8), {.frame = frame}, 10}, nullptr);
    trace.finish();
    trace.close();
    RecordedReader reader(folder / "t.mcap");
    std::string found;
    while (reader.next()) {
        const FrameHeader* its = reader.context().header;
        found += its ? fmt::format("{} {};", its->protocol, its->bytes.size()) : "none;";
        if (its) CHECK(its->bytes == header.bytes);
    }
    CHECK(found == "none;DSR 3;none;none;");
    CHECK(reader.damage().empty());
}

TEST_CASE("a recorded trace stores version, scenario, seed, robots and files of its run") {
    TempFolder folder;
    RecordedTrace trace(folder / "t.mcap",
                        {.version = "9.9 (abc)", .files = {{"map.yaml", "text/yaml", "image: x"}}});
    trace.begin(info(2));
    trace.finish();
    CHECK_FALSE(folder.has("t.mcap"));
    trace.close();
    const RecordedReader reader(folder / "t.mcap");
    const RecordedRun& run = reader.run();
    CHECK(run.version == "9.9 (abc)");
    CHECK(run.scenario == "[scenario]\nname = \"x\"\n");
    CHECK(run.seed == 42);
    CHECK(run.replication == 3);
    CHECK(run.robots == std::vector<std::string>{"r", "r"});
    REQUIRE(run.files.size() == 1);
    CHECK(run.files[0].name == "map.yaml");
    CHECK(run.files[0].content == "image: x");
}

TEST_CASE("the fingerprint of a recorded trace equals that of the run") {
    const Recorded recorded(3000);
    const auto again = std::make_shared<Fingerprint>();
    RecordedReader(recorded.path).read(Sink(again));
    CHECK(again->text() == recorded.fingerprint->text());
}

TEST_CASE("an ns-2 trace made from a recorded trace equals that of the run, byte by byte") {
    const Recorded recorded(3000);
    render(recorded.path, recorded.folder / "old2.tr", Ns2Format::old_format, MacTrace::on);
    render(recorded.path, recorded.folder / "new2.tr", Ns2Format::new_format, MacTrace::off);
    CHECK(content(recorded.folder / "old2.tr") == content(recorded.folder / "old.tr"));
    CHECK(content(recorded.folder / "new2.tr") == content(recorded.folder / "new.tr"));
}

TEST_CASE("equal runs give recorded traces with equal bytes") {
    CHECK(content(Recorded(5000).path) == content(Recorded(5000).path));
}

TEST_CASE("links are recorded only on request") {
    TempFolder folder;
    const RecordedTrace without(folder / "a", {.version = "1"});
    const RecordedTrace with(folder / "b", {.version = "1", .links = true});
    CHECK((without.kinds() & kind_links) == 0);
    CHECK((with.kinds() & kind_links) == kind_links);
    CHECK((with.kinds() & (kind_reachable | kind_levels)) == 0);
}

TEST_CASE("an incomplete recorded trace is read up to its last complete chunk") {
    const Recorded recorded(5000);
    const std::string whole = content(recorded.path);
    std::vector<std::string> damage;
    std::size_t before = recorded.all->records.size();
    for (const std::size_t cut : {whole.size() - 30, whole.size() * 3 / 4, whole.size() / 3}) {
        write_file(recorded.path, whole.substr(0, cut));
        const auto records = recorded.read_back(&damage);
        CHECK(records.size() <= before);
        CHECK(std::equal(records.begin(), records.end(), recorded.all->records.begin()));
        REQUIRE(damage.size() == 1);
        CHECK(damage[0] == "the end is missing");
        before = records.size();
    }
    CHECK(before > 0);
    CHECK(before < recorded.all->records.size());
}

TEST_CASE(
    "a recorded trace that is cut off before its first data is not reported as a file of another "
    "program") {
    const Recorded recorded(200);
    const std::string whole = content(recorded.path);
    const std::string rest = " is cut off before its first data; record the run again";
    int refused = 0, of_rovernet = 0;
    for (std::size_t cut = mcap_magic.size(); cut < whole.size(); ++cut) {
        write_file(recorded.path, whole.substr(0, cut));
        try {
            RecordedReader reader(recorded.path);
            break;  // what follows can be read
        } catch (const InputError& error) {
            ++refused;
            const bool is_known = error.message() == "this recorded trace" + rest;
            of_rovernet += is_known;
            if (!is_known) CHECK(error.message() == "this MCAP file" + rest);
        }
    }
    CHECK(refused > 100);
    CHECK(of_rovernet > 50);
}

TEST_CASE("in a damaged recorded trace, a broken chunk affects only the records of this chunk") {
    const Recorded recorded(8000);
    std::string bytes = content(recorded.path);
    std::vector<std::uint64_t> chunks;
    {
        McapReader file(recorded.path);
        while (const auto record = file.next()) {
            if (record->opcode == McapOpcode::chunk) chunks.push_back(record->offset);
        }
    }
    REQUIRE(chunks.size() >= 4);
    SUBCASE("the content of the chunk is damaged") { bytes[chunks[1] + 2000] ^= 4; }
    SUBCASE("the length of the chunk is damaged") { bytes[chunks[1] + 3] ^= 64; }
    write_file(recorded.path, bytes);
    std::vector<std::string> damage;
    const auto records = recorded.read_back(&damage);
    CHECK(damage.size() == 1);
    const auto& all = recorded.all->records;
    // What is left is the begin and the end of the whole.
    CHECK(records.size() < all.size());
    CHECK(records.size() > all.size() / 2);
    const auto same = std::mismatch(records.begin(), records.end(), all.begin());
    const auto rest = records.end() - same.first;
    CHECK(rest > 0);
    CHECK(std::equal(same.first, records.end(), all.end() - rest));
}

TEST_CASE("a file that is not a recorded trace is refused with the reason") {
    TempFolder folder;
    const auto refused = [&](const std::string& text) {
        write_file(folder / "x", text);
        try {
            RecordedReader reader(folder / "x");
        } catch (const InputError& error) {
            return error.message();
        }
        return std::string("read");
    };
    CHECK(refused("\x1f\x8b\x08 and more") ==
          "the file is compressed by gzip; expected a recorded trace (.mcap), not compressed");
    CHECK(refused("") ==
          "this file is not a recorded trace; expected a file in the format MCAP, as \"rovernet "
          "run --record\" writes it");
    CHECK(refused("s 1.0 _0_ AGT") ==
          "this file is not a recorded trace; expected a file in the format MCAP, as \"rovernet "
          "run --record\" writes it");
    CHECK(refused(std::string(mcap_magic)) ==
          "this MCAP file is cut off before its first data; record the run again");
    CHECK_THROWS_AS(RecordedReader("/nowhere/at/all"), InputError);
    CHECK_THROWS_AS(RecordedReader("/tmp"), InputError);
}

}  // namespace

}  // namespace recorded_trace_test
