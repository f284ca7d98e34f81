// SPDX-License-Identifier: MIT
#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/text_table.hpp"
#include "cli/traces/trace_commands.hpp"
#include "cli/traces/trace_notices.hpp"
#include "experiment/replay/recorded_stats.hpp"
#include "experiment/run.hpp"
#include "experiment/summary.hpp"
#include "scenario/document/json.hpp"
#include "traces/ns2/ns2_stats.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace rovernet::cli {

void tell_refused(const std::string& file, const Ns2Counts& counts) {
    if (counts.is_empty() && !is_recorded_trace(file)) {
        throw InputError({.source = file},
                         counts.lines == 0
                             ? "the file is empty, expected a trace"
                             : "the file has blank lines and comments only, expected a trace");
    }
    if (counts.refused == 0) return;
    const bool is_one = counts.refused == 1;
    notice(fmt::format("{}: {} of {} lines {} not in ns-2 format and {} not counted{}", file,
                       counts.refused, counts.lines, is_one ? "is" : "are", is_one ? "is" : "are",
                       counts.refused > counts.refused_lines.size()
                           ? fmt::format("; the first {}:", counts.refused_lines.size())
                           : ":"));
    for (const Ns2RefusedLine& line : counts.refused_lines) {
        notice(fmt::format("{}:{}:{}: {}: {}", file, line.line, line.column, line.why, line.text));
    }
}

void tell_damage(const std::string& file, const std::vector<std::string>& damage) {
    for (const std::string& what : damage) notice(file + ": " + what);
}

namespace {

/// Stats of a trace, its format, and what of it a recorded one alone has.
struct ToldStats : TraceStats {
    std::string format;
    std::optional<std::uint64_t> file_bytes, receptions_in_file;
};

Table counts_table(const Ns2Counts& counts, const std::string& format) {
    Table skipped;
    for (std::size_t i = 0; i < counts.skipped.size(); ++i) {
        if (counts.skipped[i] > 0) skipped.set(names_of_other[i], counts.skipped[i]);
    }
    Array refused_lines;
    for (const Ns2RefusedLine& line : counts.refused_lines) {
        Table one;
        one.set("line", line.line);
        one.set("column", line.column);
        one.set("why", line.why);
        one.set("text", line.text);
        refused_lines.emplace_back(std::move(one));
    }
    Table table;
    table.set("format", format);
    table.set("lines", counts.lines);
    table.set("event_lines", counts.events);
    table.set("skipped", std::move(skipped));
    table.set("refused", counts.refused);
    table.set("refused_lines", std::move(refused_lines));
    return table;
}

Value per(std::uint64_t part, std::uint64_t whole) {
    return whole > 0 ? Value(static_cast<double>(part) / static_cast<double>(whole)) : Value();
}

void append_drops(Table& table, const TraceStats& stats) {
    Table drops, by_layer;
    for (const auto& [reason, count] : stats.drops) drops.set(reason, count);
    for (const auto& [place, count] : stats.drops_by_layer) {
        const auto& [layer, reason] = place;
        if (!by_layer.find(layer)) by_layer.set(layer, Table{});
        by_layer.find(layer)->table()->set(reason, count);
    }
    table.set("drops", std::move(drops));
    table.set("drops_by_layer", std::move(by_layer));
}

Table stats_table(const TraceRow& row, const std::string& by) {
    Table table;
    table.set(by, row.name);
    table.set("messages", row.messages);
    table.set("deliveries", row.deliveries);
    if (by == "flow") table.set("delivery_ratio", per(row.deliveries, row.expected));
    table.set("delivered_bytes", row.bytes);
    const Value sum = per(row.delay_ns, row.deliveries);
    const double* mean_ns = std::get_if<double>(&sum.data);
    table.set("latency_mean_s", mean_ns ? Value(*mean_ns / 1e9) : Value());
    table.set("transmissions", row.transmissions);
    table.set("receptions", row.receptions);
    table.set("drops", row.drops);
    return table;
}

/// Removes the metrics of routing that only recorded traces have, if they are null.
void leave_out_unknown(Table& table) {
    constexpr std::array<std::string_view, 8> of_records = {
        "routing_requests", "routing_replies", "routing_errors", "routing_hellos",
        "routes_broken",    "path_stretch",    "delay_waiting",  "delay_travelling"};
    std::erase_if(table.entries, [&](const Entry& entry) {
        return std::holds_alternative<std::monostate>(entry.value.data) &&
               std::find(of_records.begin(), of_records.end(), entry.key) != of_records.end();
    });
}

Table stats_table(const ToldStats& stats, const std::string& by) {
    Table table;
    append_metrics(table, stats.metrics);
    leave_out_unknown(table);
    append_drops(table, stats);
    const bool is_recorded = stats.file_bytes.has_value();  // its metrics have these values
    if (!is_recorded && stats.routing_packets > 0) {
        table.set("routing_packets", stats.routing_packets);
        table.set("routing_bytes", stats.routing_bytes);
        table.set("routing_load", per(stats.routing_packets, stats.metrics.deliveries));
        table.set("routing_load_bytes", per(stats.routing_bytes, stats.delivered_bytes));
        table.set("data_transmissions", stats.data_transmissions);
    }
    table.set("jitter_mean_s", stats.jitter_mean);
    table.set("jitter_rfc3550_s", stats.jitter_rfc3550);
    table.set("jitter_sd_s", stats.jitter_sd);
    table.set("throughput_bps", stats.throughput);
    for (const Entry& entry : counts_table(stats.counts, stats.format).entries) {
        table.set(entry.key, entry.value);
    }
    if (stats.file_bytes) {
        table.set("file_bytes", *stats.file_bytes);
        table.set("bytes_per_reception", per(*stats.file_bytes, *stats.receptions_in_file));
    }
    if (by.empty()) return table;
    Array rows;
    for (const TraceRow& row : stats.rows) rows.emplace_back(stats_table(row, by));
    table.set("by_" + by, std::move(rows));
    return table;
}

std::string cell_of(const Value& value) {
    if (std::holds_alternative<std::monostate>(value.data)) return "";
    if (!value.string()) return to_json_line(value);
    if (value.string()->find_first_of(",\"\n") == std::string::npos) return *value.string();
    std::string quoted = "\"";
    for (const char c : *value.string()) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + '"';
}

/// The values in one line each, tables within the table under `drops.TTL`; lists are left out.
void flatten(const Table& table, const std::string& before, Table& flat) {
    for (const Entry& entry : table.entries) {
        if (const Table* inner = entry.value.table()) {
            flatten(*inner, before + entry.key + ".", flat);
        } else if (!entry.value.array()) {
            flat.set(before + entry.key, entry.value);
        }
    }
}

std::string csv_line(const Table& table, bool is_head) {
    std::string line;
    for (const Entry& entry : table.entries) {
        if (!line.empty()) line += ',';
        line += is_head ? cell_of(Value(entry.key)) : cell_of(entry.value);
    }
    return line + '\n';
}

void print_stats_csv(const ToldStats& stats, const std::string& by) {
    if (by.empty()) {
        Table flat;
        flatten(stats_table(stats, by), "", flat);
        fmt::print("{}{}", csv_line(flat, true), csv_line(flat, false));
        return;
    }
    fmt::print("{}", csv_line(stats_table(TraceRow{}, by), true));
    for (const TraceRow& row : stats.rows) fmt::print("{}", csv_line(stats_table(row, by), false));
}

void print_flat(const Table& flat) {
    for (const Entry& entry : flat.entries) {
        const bool is_drop = entry.key.starts_with("drops.");
        const std::string name = is_drop ? "dropped " + entry.key.substr(6) : entry.key;
        const std::string cell = cell_of(entry.value);
        fmt::print("{:<20} {}\n", name, cell.empty() ? "-" : cell);
    }
}

void print_stats(const ToldStats& stats, const std::string& by) {
    Table flat;
    flatten(stats_table(stats, by), "", flat);
    print_flat(flat);
    if (by.empty()) return;
    std::vector<std::string> head;
    for (const Entry& entry : stats_table(TraceRow{}, by).entries) head.push_back(entry.key);
    TextTable rows(head);
    for (const TraceRow& row : stats.rows) {
        std::vector<std::string> line;
        for (const Entry& entry : stats_table(row, by).entries)
            line.push_back(cell_of(entry.value));
        rows.add(line);
    }
    fmt::print("\n{}", rows.text());
}

TraceRows rows_by(const std::string& by) {
    if (by == "robot") return TraceRows::robot;
    if (by == "flow") return TraceRows::flow;
    return by == "second" ? TraceRows::second : TraceRows::none;
}

ToldStats stats_of(const TraceStatsArguments& a) {
    const auto strictness = a.strict ? Ns2Strictness::strict : Ns2Strictness::tolerant;
    if (!is_recorded_trace(a.file)) {
        ToldStats stats{ns2_stats(Ns2Source(a.file), strictness, rows_by(a.by)), {}, {}, {}};
        stats.format = stats.counts.format();
        tell_refused(a.file, stats.counts);
        return stats;
    }
    RecordedStats recorded = recorded_stats(a.file, strictness, rows_by(a.by));
    tell_refused(a.file, recorded.stats.counts);
    tell_damage(a.file, recorded.damage);
    return {std::move(recorded.stats), "recorded", recorded.file_bytes, recorded.receptions};
}

}  // namespace

void trace_stats(const TraceStatsArguments& a) {
    const ToldStats stats = stats_of(a);
    if (stats.metrics.messages == 0) notice(a.file + ": no message was sent in this trace");
    if (a.json) {
        fmt::print("{}", to_json(stats_table(stats, a.by)));
    } else if (a.csv) {
        print_stats_csv(stats, a.by);
    } else {
        print_stats(stats, a.by);
    }
}

}  // namespace rovernet::cli
