// SPDX-License-Identifier: MIT
#include "experiment/replay/trace_input.hpp"

#include "experiment/replay/packet_text.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/document/value.hpp"
#include "scenario/scenario.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <string_view>
#include <variant>

namespace rovernet {
namespace {

/// `[trace] mac` of the scenario inside.
MacTrace recorded_mac(const RecordedRun& run, const std::string& path) {
    if (run.scenario.empty()) return MacTrace::off;
    Value document = parse_toml(run.scenario, path);
    const Value* trace = document.table()->find("trace");
    const Value* mac = trace && trace->table() ? trace->table()->find("mac") : nullptr;
    const bool* is_on = mac ? std::get_if<bool>(&mac->data) : nullptr;
    return is_on && *is_on ? MacTrace::on : MacTrace::off;
}

MacTrace mac_of(const TraceInput::Lines& lines, const RecordedRun& run, const std::string& path) {
    return lines.mac ? *lines.mac : recorded_mac(run, path);
}

/// Takes the next record into the trace. @return false after the last one, with the trace whole
bool take_record(RecordedReader& reader, Ns2Trace& trace, KindMask kinds = kind_all) {
    const Record* record = reader.next();
    if (!record) {
        trace.finish();
        return false;
    }
    if ((kinds & trace.kinds() & (KindMask{1} << record->index())) == 0) return true;
    RecordContext context = reader.context();
    context.router = &packet_describer();
    trace.on(*record, context);
    return true;
}

}  // namespace

/// A recorded trace on its way to text.
struct TraceInput::Recorded {
    Recorded(const std::string& path, const Lines& lines)
        : reader(path),
          kinds(lines.motion ? kind_all : kind_all & ~kind_of<Moved>()),
          trace([this](std::string_view more) { text += more; }, lines.format,
                mac_of(lines, reader.run(), path)) {}

    std::string_view next() {
        text.clear();
        while (text.empty() && !has_ended) has_ended = !take_record(reader, trace, kinds);
        return text;
    }

    RecordedReader reader;
    KindMask kinds;  // kinds of the records whose lines are generated
    std::string text;
    Ns2Trace trace;
    bool has_ended = false;
};

TraceInput::TraceInput(const std::string& path, Lines lines) : path_(path) {
    if (is_recorded_trace(path)) recorded_ = std::make_shared<Recorded>(path, lines);
}

Ns2Source TraceInput::text() const {
    if (!recorded_) return Ns2Source(path_);
    return Ns2Source(path_, [recorded = recorded_] { return recorded->next(); });
}

const std::vector<std::string>& TraceInput::robots() const {
    static const std::vector<std::string> none;
    return recorded_ ? recorded_->reader.run().robots : none;
}

const std::vector<std::string>& TraceInput::damage() const {
    static const std::vector<std::string> none;
    return recorded_ ? recorded_->reader.damage() : none;
}

std::vector<std::string> render_recorded(const std::string& in, const std::string& out,
                                         TraceInput::Lines lines) {
    RecordedReader reader(in);
    Ns2Trace trace(out, lines.format, mac_of(lines, reader.run(), in));
    while (take_record(reader, trace)) continue;
    trace.close();
    return reader.damage();
}

}  // namespace rovernet
