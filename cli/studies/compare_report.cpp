// SPDX-License-Identifier: MIT
#include "cli/studies/compare_report.hpp"

#include "cli/display/picture_output.hpp"
#include "cli/terminal/text_table.hpp"
#include "files/csv_field.hpp"
#include "scenario/document/json.hpp"
#include "scenario/document/toml.hpp"
#include "study/advise/study_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rovernet::cli {
namespace {

/// What is compared, as a key of results: a protocol, or else a model, also of any other key.
std::string_view compared_key(const Comparison& c) {
    return c.path == protocol_path ? "protocol" : "model";
}

Table as_table(const Comparison& c, const ComparedModel& m) {
    Table row;
    row.set(compared_key(c), m.model);
    row.set("mean", m.answer.value);
    row.set("low", m.answer.low);
    row.set("high", m.answer.high);
    row.set("n", std::uint64_t{m.answer.values.size()});
    row.set("failed", m.answer.gaps.failed);
    row.set("missing", m.answer.gaps.missing);
    row.set("undefined", m.answer.gaps.undefined);
    const auto& d = m.difference;
    row.set("difference", d ? Value(d->difference.mean) : Value());
    row.set("difference_low", d ? Value(d->low) : Value());
    row.set("difference_high", d ? Value(d->high) : Value());
    row.set("difference_n", d ? Value(std::uint64_t{d->difference.n}) : Value());
    row.set("p", d ? Value(d->p) : Value());
    row.set("detectable", d ? d->detectable : std::nullopt);
    row.set("method", d ? Value(std::string(name_of(d->method))) : Value());
    row.set("above", d ? Value(std::uint64_t{d->above}) : Value());
    row.set("below", d ? Value(std::uint64_t{d->below}) : Value());
    row.set("sign_p", d ? d->sign_p : std::nullopt);
    if (const auto& e = m.equivalence) {
        const auto count = [](const std::optional<std::size_t>& n) {
            return n ? Value(std::uint64_t{*n}) : Value();
        };
        constexpr const char* words[] = {"undecided", "within", "outside"};
        row.set("verdict", words[static_cast<int>(e->verdict)]);
        row.set("decided_at", count(e->decided_at));
        row.set("needed", count(e->needed));
        row.set("decidable", e->decidable);
    }
    row.set("error", m.error);
    row.set("error_n", std::uint64_t{m.error_n});
    row.set("cpu_s", m.cpu_s);
    row.set("cost_s", m.cost ? Value(m.cost->median_s) : Value());
    row.set("cost_low_s", m.cost ? Value(m.cost->low_s) : Value());
    row.set("cost_high_s", m.cost ? Value(m.cost->high_s) : Value());
    row.set("radio_share", m.radio_share);
    return row;
}

Table as_table(const Comparison& c) {
    Table table;
    table.set("metric", c.metric);
    table.set("baseline", c.baseline);
    table.set("dearest", c.most_detailed);
    table.set("confidence", c.confidence);
    if (c.margin) table.set("margin", *c.margin);
    table.set("held", c.held);
    table.set("one_hop", c.one_hop);
    table.set("failed", c.runs.failed);
    table.set("missing", c.runs.missing);
    Array rows, pairs;
    for (const ComparedModel& model : c.models) rows.emplace_back(as_table(c, model));
    for (const PairedVariance& pair : c.pairs) {
        Table row;
        row.set("a", pair.a);
        row.set("b", pair.b);
        row.set("variance_ratio", pair.ratio);
        pairs.emplace_back(std::move(row));
    }
    table.set("cost", c.cost_text);
    table.set("rows", std::move(rows));
    table.set("pairs", std::move(pairs));
    return table;
}

/// One comparison as it is; several as a list.
void print_json(const std::vector<Comparison>& all) {
    if (all.size() == 1) {
        fmt::print("{}", to_json(as_table(all.front())));
        return;
    }
    Array list;
    for (const Comparison& c : all) list.emplace_back(as_table(c));
    Table table;
    table.set("comparisons", std::move(list));
    fmt::print("{}", to_json(table));
}

/// Value in CSV; an empty field if there is none.
std::string cell(const Value& value) {
    const bool is_empty = std::holds_alternative<std::monostate>(value.data);
    return is_empty ? "" : csv_field(plain_text(value));
}

/// A line for each metric and compared value. The verdict on a margin ends the line, if there is
/// one; the baseline has none.
void print_csv(const std::vector<Comparison>& all) {
    bool has_head = false;
    for (const Comparison& c : all) {
        for (const ComparedModel& m : c.models) {
            Table row;
            row.set("metric", c.metric);
            for (Entry& entry : as_table(c, m).entries) row.set(entry.key, std::move(entry.value));
            if (c.margin && !m.equivalence) {
                for (const char* key : {"verdict", "decided_at", "needed", "decidable"})
                    row.set(key, Value());
            }
            std::string head, line;
            for (const Entry& entry : row.entries) {
                const char* const between = head.empty() ? "" : ",";
                head += between + entry.key;
                line += between + cell(entry.value);
            }
            if (!std::exchange(has_head, true)) fmt::print("{}\n", head);
            fmt::print("{}\n", line);
        }
    }
}

std::string interval(double mean, const std::optional<double>& low,
                     const std::optional<double>& high) {
    if (!low || !high) return fmt::format("{:.4g}", mean);
    return fmt::format("{:.4g} ({:.4g} to {:.4g})", mean, *low, *high);
}

std::string cost_text(const std::optional<MediumCost>& cost) {
    if (!cost) return "-";
    return fmt::format("{:.3g} us ({:.3g} to {:.3g})", 1e6 * cost->median_s, 1e6 * cost->low_s,
                       1e6 * cost->high_s);
}

/// Table of a comparison; without errors and costs if `is_brief`. Only models have errors.
void print_table(const Comparison& c, bool is_brief) {
    const bool has_errors = !is_brief && c.path == model_path;
    const bool has_costs = !is_brief && std::ranges::any_of(c.models, [](const ComparedModel& m) {
        return m.cost.has_value();
    });
    const std::string_view what = c.path == model_path || c.path == protocol_path
                                      ? compared_key(c)
                                      : std::string_view(c.path);
    TextTable::Line head{std::string(what), c.metric, "n", "minus " + c.baseline, "n"};
    if (has_errors) head.insert(head.end(), {"error to " + c.most_detailed, "n"});
    if (has_costs) head.insert(head.end(), {"CPU/frame", "of run"});
    TextTable table(std::move(head));
    const auto count = [](std::size_t n) { return fmt::format("{}", n); };
    for (const ComparedModel& m : c.models) {
        const Answer& a = m.answer;
        const auto& d = m.difference;
        TextTable::Line line{m.model, a.value ? interval(*a.value, a.low, a.high) : "none",
                             count(a.values.size()),
                             d ? interval(d->difference.mean, d->low, d->high) : "-",
                             d ? count(d->difference.n) : "-"};
        if (has_errors) {
            line.push_back(m.error ? fmt::format("{:.3g}", *m.error) : "-");
            line.push_back(count(m.error_n));
        }
        if (has_costs) {
            line.push_back(cost_text(m.cost));
            line.push_back(m.radio_share ? fmt::format("{:.2g} %", 100 * *m.radio_share) : "-");
        }
        table.add(std::move(line));
    }
    fmt::print("{}", table.text());
}

/// Notes on the data behind the numbers, and missing runs.
void print_coverage(const Comparison& c) {
    if (!c.held.empty()) fmt::print("{}\n", c.held);
    const std::string lacking = incompleteness(c.runs);
    if (!lacking.empty()) fmt::print("{}\n", lacking);
    for (const ComparedModel& m : c.models) {
        const std::string gaps = m.unpaired.text();
        if (gaps.empty()) continue;
        if (m.model == c.baseline) {
            fmt::print("{} lacks replications: {}\n", m.model, gaps);
        } else {
            fmt::print(
                "{} and {} cannot be compared in some replications, because one of the two has no "
                "value: {}\n",
                m.model, c.baseline, gaps);
        }
    }
}

/// Table of a comparison, and its findings.
void print_findings(const Comparison& c, bool is_brief) {
    print_table(c, is_brief);
    if (!c.cost_text.empty()) fmt::print("{}\n", c.cost_text);
    print_coverage(c);
    const auto is_silent = [](const ComparedModel& m) { return m.sentence.empty(); };
    if (is_brief && std::ranges::all_of(c.models, is_silent)) return;
    fmt::print("\n");
    for (const ComparedModel& m : c.models) {
        if (!m.sentence.empty()) fmt::print("{}\n", m.sentence);
    }
    if (c.margin) fmt::print("\n");
    for (const ComparedModel& m : c.models) {
        if (!m.equivalence_sentence.empty()) fmt::print("{}\n", m.equivalence_sentence);
    }
}

/// Of several metrics: what each of them shows.
void print_text(const std::vector<Comparison>& all) {
    const bool is_brief = all.size() > 1;
    for (const Comparison& c : all) {
        if (&c != &all.front()) fmt::print("\n");
        print_findings(c, is_brief);
    }
    if (!all.front().one_hop.empty()) fmt::print("\n{}\n", all.front().one_hop);
    const Comparison& c = all.front();
    const auto is_known = [](const PairedVariance& pair) { return pair.ratio.has_value(); };
    if (is_brief || std::ranges::none_of(c.pairs, is_known)) return;
    fmt::print(
        "\ngain by common random numbers (runs with equal seeds): variance of unpaired "
        "differences, divided by the variance of paired differences\n");
    for (const PairedVariance& pair : c.pairs) {
        if (pair.ratio) fmt::print("  {:<32} {:.3g}\n", pair.a + ", " + pair.b, *pair.ratio);
    }
}

}  // namespace

void print_comparisons(const std::vector<Comparison>& all, ReportForm form) {
    switch (form) {
        case ReportForm::text: return print_text(all);
        case ReportForm::csv: return print_csv(all);
        case ReportForm::json: return print_json(all);
    }
}

void write_comparison(const std::string& file, const Comparison& comparison, const Store& store) {
    if (comparison.path != protocol_path) {
        return write_picture(file, chart_svg(comparison_charts(comparison), {.width = 480}));
    }
    constexpr double pixels = 1000;  // wide, as in print
    ChartLayout layout;
    layout.scale = pixels / layout.picture_width();
    const Chart chart = protocol_chart(store, {comparison.one_hop, comparison.held});
    write_picture(file, chart_svg({&chart, 1}, layout));
}

}  // namespace rovernet::cli
