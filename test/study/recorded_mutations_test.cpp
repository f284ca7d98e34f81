// SPDX-License-Identifier: MIT
// Whatever is wrong with a recorded trace, all that reads one ends with a result or with an
// InputError: no other exception, and no index beyond an array, which sanitizers would tell.
#include "experiment/replay/capture.hpp"
#include "experiment/replay/message_at_robot.hpp"
#include "experiment/replay/recorded_day.hpp"
#include "experiment/replay/replay.hpp"
#include "experiment/replay/trace_input.hpp"
#include "experiment/run.hpp"
#include "scenario/scenario_file.hpp"
#include "sim/error.hpp"
#include "test/traces/record_stream.hpp"
#include "traces/recorded/mcap_reader.hpp"
#include "traces/recorded/record_code.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace recorded_mutations_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

const char* const small = R"([scenario]
duration = "600 ms"
[access]
model = "csma"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["30 m", "0 m"]
move = { model = "waypoints", path = [["30 m", "2 m"], ["31 m", "0 m"]], speed = "9 m/s" }
off = ["200 ms"]
on = ["300 ms"]
[[traffic]]
from = "A"
every = "150 ms"
size = "64 B"
[[traffic]]
kind = "unicast"
from = "B"
to = "A"
every = "200 ms"
payload = "F"
)";

void put(ByteWriter& to, McapOpcode opcode, std::string_view content) {
    to.fixed(static_cast<std::uint8_t>(opcode));
    to.fixed(std::uint64_t{content.size()});
    to.bytes(content);
}

std::string attachment(std::string_view name, std::string_view text) {
    ByteWriter content, file;
    for (int i = 0; i < 2; ++i) content.fixed(std::uint64_t{0});
    content.text(name);
    content.text("text/plain");
    content.fixed(std::uint64_t{text.size()});
    content.bytes(text);
    content.fixed(mcap_crc(content.view()));
    put(file, McapOpcode::attachment, content.view());
    return std::string(file.view());
}

/// A small recorded trace in its parts.
struct Sample {
    TempFolder folder;
    std::string path = folder / "trace.mcap";
    std::string whole, head, metadata, names, chunk, plain_chunk;
    std::size_t records_at = 0;  // in plain_chunk, whose records have no checksum
    std::string records;

    Sample() {
        testing::write_file(folder / "s.toml", small);
        RunOptions to;
        to.folder = folder / ".";
        run_scenario(load_scenario(folder / "s.toml", {.set = {"trace.record=true"}}), to);
        whole = content(path);
        McapReader file(path);
        while (const auto record = file.next()) {
            const std::string bytes =
                whole.substr(record->offset, mcap_record_head + record->content.size());
            if (record->opcode == McapOpcode::header) head = whole.substr(0, 8) + bytes;
            if (record->opcode == McapOpcode::metadata) metadata = bytes;
            if (record->opcode == McapOpcode::attachment) names = bytes;
            if (record->opcode != McapOpcode::chunk) continue;
            chunk = bytes;
            take_plain(std::string(file.unpack(*record)->records));
        }
    }

    void take_plain(std::string all) {
        records = std::move(all);
        ByteWriter content, file;
        for (int i = 0; i < 2; ++i) content.fixed(std::uint64_t{1});
        content.fixed(std::uint64_t{records.size()});
        content.fixed(std::uint32_t{0});
        content.text("");
        content.fixed(std::uint64_t{records.size()});
        records_at = mcap_record_head + content.size();
        content.bytes(records);
        put(file, McapOpcode::chunk, content.view());
        plain_chunk = file.view();
    }
};

/// How many mutants all readers took, and how many some reader refused.
struct Tally {
    int taken = 0, refused = 0;
    std::vector<std::string> faults;
};

using Reader = std::function<void(const std::string& path)>;

const std::vector<Reader>& readers() {
    static const std::vector<Reader> all = {
        [](const std::string& path) {
            const RecordedDay day(path);
            change_of(day.recorded(), day.play({"propagation.model=friis"}), day.robots().size());
        },
        [](const std::string& path) { capture_recorded(path, path + ".pcapng"); },
        [](const std::string& path) { message_at_robot(path, 0, NodeId{1}); },
        [](const std::string& path) { render_recorded(path, path + ".tr", {}); },
        [](const std::string& path) { verify_replay(path, {}); },
        [](const std::string& path) {
            std::vector<std::string> damage;
            recorded_metrics(path, damage);
        }};
    return all;
}

void judge(const Sample& sample, const std::string& name, const std::string& bytes,
           std::size_t readers_of_it, Tally& tally) {
    testing::write_file(sample.path, bytes);
    bool is_refused = false;
    for (std::size_t i = 0; i < readers_of_it; ++i) {
        try {
            readers()[i](sample.path);
        } catch (const InputError&) {
            is_refused = true;
        } catch (const std::exception& fault) {
            tally.faults.push_back(name + ": " + fault.what());
        }
    }
    ++(is_refused ? tally.refused : tally.taken);
}

/// Flips a bit of each of these bytes of `part`, another one from byte to byte. Two readers read
/// all of these files, the others every eighth.
Tally flip(const Sample& sample, const std::string& before, const std::string& part,
           const std::string& behind, const std::vector<std::size_t>& places) {
    Tally tally;
    for (std::size_t n = 0; n < places.size(); ++n) {
        constexpr int masks[] = {0x01, 0x80, 0x02, 0x40};
        std::string flipped = part;
        flipped[places[n]] = static_cast<char>(flipped[places[n]] ^ masks[n % 4]);
        judge(sample, "byte " + std::to_string(places[n]), before + flipped + behind,
              n % 8 == 0 ? readers().size() : 1, tally);
    }
    return tally;
}

/// Every so many places of a text.
std::vector<std::size_t> places_in(const std::string& text, std::size_t step = 1) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < text.size(); i += step) places.push_back(i);
    return places;
}

/// Places of the bytes that tell of a record or a message, without its times, which MCAP has.
std::vector<std::size_t> record_places(const std::string& records) {
    constexpr std::size_t head = mcap_record_head + 2 + 4 + 8 + 8;
    std::vector<std::size_t> places;
    for (ByteReader from(records); from.left() > 0;) {
        const std::size_t begin = records.size() - from.left();
        from.fixed<std::uint8_t>();
        from.take(from.fixed<std::uint64_t>());
        for (std::size_t i = begin + head; i < records.size() - from.left(); ++i)
            places.push_back(i);
    }
    return places;
}

std::string said(const std::vector<std::string>& faults) {
    return fmt::format("{}", fmt::join(faults, "; "));
}

}  // namespace

TEST_CASE("a flipped bit in the names of a recorded trace is reported by every reader") {
    const Sample s;
    const Tally tally = flip(s, s.head + s.metadata, s.names, s.chunk, places_in(s.names));
    CHECK(said(tally.faults) == "");
    CHECK(tally.refused + 2 >= static_cast<int>(s.names.size()));
}

TEST_CASE("a flipped bit in the scenario of a recorded trace changes the scenario or is reported") {
    const Sample s;
    const Tally tally = flip(s, s.head, s.metadata, s.names + s.chunk, places_in(s.metadata, 6));
    CHECK(said(tally.faults) == "");
    CHECK(tally.refused > 50);
    CHECK(tally.taken > 20);
}

TEST_CASE("a flipped bit in records without a checksum never causes an access outside an array") {
    const Sample s;
    std::vector<std::size_t> places = record_places(s.records);
    for (std::size_t& each : places) each += s.records_at;
    const Tally tally = flip(s, s.head + s.metadata + s.names, s.plain_chunk, "", places);
    CHECK(said(tally.faults) == "");
    CHECK(tally.refused > 20);
    CHECK(tally.taken > 100);
}

TEST_CASE("missing, short, doubled or wrong names in a recorded trace are reported") {
    const Sample s;
    const auto refusal = [&](const std::string& names) -> std::string {
        Tally tally;
        judge(s, "names", s.head + s.metadata + names + s.chunk, readers().size(), tally);
        CHECK(said(tally.faults) == "");
        try {
            readers()[0](s.path);
        } catch (const InputError& error) {
            return error.message();
        }
        return "";
    };
    const std::string right = attachment("robots.txt", "A\nB\n");
    CHECK(refusal(s.names) == "");
    CHECK(refusal(right) == "");
    CHECK(refusal(right + right) == "");
    const std::string missing =
        "the scenario of this trace has a robot \"A\" with number 0 (counted from 0), but the "
        "trace has no names of robots, because the file robots.txt in the trace is missing";
    CHECK(refusal("") == missing);
    CHECK(refusal(attachment("robot.txt", "A\nB\n")) == missing);
    CHECK(refusal(attachment("robots.txt", "A\n")) ==
          "the scenario of this trace has a robot \"B\" with number 1 (counted from 0), but the "
          "trace has the name of 1 robot");
    CHECK(refusal(attachment("robots.txt", "A\nB\nC\n")) ==
          "the scenario of this trace has 2 robots, but the trace has the names of 3 robots");
    CHECK(refusal(attachment("robots.txt", "B\nA\n")) ==
          "robot 0 is named \"B\" in the trace, but \"A\" in the scenario of the trace");
    CHECK(refusal(right + attachment("robots.txt", "A\nC\n")) ==
          "this trace contains two different files with the name robots.txt; expected one file of "
          "this name");
    CHECK(refusal(right + attachment("x/a", "1") + attachment("x/a", "2")) ==
          "this trace contains two different files with the name x/a; expected one file of this "
          "name");
    CHECK(refusal(right + attachment("x", "1") + attachment("x/a", "2")) ==
          "the file x/a, which this trace contains, cannot be stored in a temporary folder; check "
          "the space on the disk, or record the run again");
}

TEST_CASE(
    "some flipped bits in a recorded trace give records of robots that have no name in the trace") {
    const Sample s;
    int beyond = 0;
    for (std::size_t i = 0; i < s.records.size(); ++i) {
        std::string mutant = s.records;
        mutant[i] = static_cast<char>(mutant[i] ^ 0x01);
        for (ByteReader from(mutant); from.left() > 0;) {
            const auto opcode = static_cast<McapOpcode>(from.fixed<std::uint8_t>());
            ByteReader message(from.take(from.fixed<std::uint64_t>()));
            if (opcode != McapOpcode::message) continue;
            const auto channel = message.fixed<std::uint16_t>();
            message.take(4 + 8 + 8);
            std::vector<Reception> receptions;
            Record record;
            const Time time = start_of_run + std::chrono::seconds(1);
            const std::string_view bytes = message.take(message.left());
            if (!decode(channel, time, bytes, receptions, record)) continue;
            const auto* switched = std::get_if<Switched>(&record);
            if (switched && switched->node.index() >= 2) ++beyond;
            for (const Reception& each : receptions) beyond += each.node.index() >= 2 ? 1 : 0;
        }
    }
    CHECK(beyond >= 3);
}

}  // namespace recorded_mutations_test
