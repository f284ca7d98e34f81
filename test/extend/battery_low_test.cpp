// SPDX-License-Identifier: MIT
// What a kind of record has that was added by its struct, its place among the kinds and its
// emission alone: this program is no test of the tree, but of a copy with that record.
#include "sim/legs.hpp"
#include "traces/fingerprint.hpp"
#include "traces/recorded/record_text.hpp"
#include "traces/recorded/recorded_reader.hpp"
#include "traces/recorded/recorded_trace.hpp"
#include "traces/row_sink.hpp"

#include <cstdio>
#include <cstring>
#include <string>

using namespace rovernet;

namespace {

int failures = 0;
void check(bool is_so, const char* what) {
    if (is_so) return;
    std::printf("BatteryLow: %s\n", what);
    ++failures;
}

const Legs legs;
const MessageTable messages;
const RecordContext context{legs, messages};
const BatteryLow low{Time{Duration{5}}, NodeId{1}, 0.25, 7};

/// The text of the record once it was written to a file and read back.
std::string read_back(const std::string& path) {
    RecordedTrace trace(path, {.version = "1"});
    trace.begin({.scenario = {},
                 .robots = 2,
                 .name = [](NodeId) -> std::string_view { return "r"; },
                 .seed = 1,
                 .replication = 0});
    trace.on(low, context);
    trace.finish();
    trace.close();
    RecordedReader reader(path);
    std::string text;
    while (const Record* record = reader.next()) append_text(*record, reader.context(), text);
    return text;
}

std::uint64_t fingerprint(const BatteryLow& record) {
    Fingerprint fingerprint;
    if (fingerprint.kinds() & kind_of<BatteryLow>()) fingerprint.on(record, context);
    return fingerprint.value();
}

std::string cells() {
    RowSink rows(record_named("battery_low"));
    rows.on(low, context);
    const RowSink::Table table = rows.table(kind_of<BatteryLow>());
    std::string text;
    for (const RowColumn& column : table.columns) {
        double number = 0;
        std::int64_t whole = 0;
        const std::byte* cell = table.bytes.data() + column.offset;
        if (column.format == "<f8") std::memcpy(&number, cell, 8);
        if (column.format != "<f8") std::memcpy(&whole, cell, column.format == "<i8" ? 8 : 4);
        text += column.name + '=' + std::to_string(number + static_cast<double>(whole)) + ' ';
    }
    return text;
}

}  // namespace

int main(int, char** arguments) {
    const std::string in_file = read_back(std::string(arguments[1]) + "/trace.mcap");
    check(in_file == "5 BatteryLow 1 0.25 7\n", "the recorded trace does not give it back as text");
    check(cells() == "t_ns=5.000000 robot=1.000000 charge=0.250000 messages=7.000000 ",
          "the row has other cells");
    BatteryLow other = low;
    other.charge = 0.5;
    check(fingerprint(low) != Fingerprint().value(), "the fingerprint is that of nothing");
    check(fingerprint(low) != fingerprint(other), "the fingerprint does not see its charge");
    return failures > 0;
}
