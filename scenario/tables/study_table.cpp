// SPDX-License-Identifier: MIT
#include "scenario/tables/study_table.hpp"

#include "scenario/document/toml.hpp"
#include "scenario/tables/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

namespace rovernet {
namespace {

constexpr double most_values = 100'000;  // of one key

/// A number, or a number with its unit.
struct Amount {
    double number;
    std::string unit;  ///< with the blank before it; empty for a bare number
    bool whole;
};

std::optional<Amount> amount_of(const Value& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value.data)) {
        return Amount{static_cast<double>(*whole), "", true};
    }
    if (const auto* number = std::get_if<double>(&value.data)) return Amount{*number, "", false};
    const std::string* text = value.string();
    if (!text) return std::nullopt;
    Amount amount{0, "", false};
    const char* const end = text->data() + text->size();
    const auto [unit, error] = std::from_chars(text->data(), end, amount.number);
    if (error != std::errc{}) return std::nullopt;
    amount.unit.assign(unit, end);
    return amount;
}

Amount read_amount(const Value& range, std::string_view path, std::string_view key) {
    const Value* value = range.table()->find(key);
    if (!value) {
        throw InputError(range.where, fmt::format("vary.\"{}\": the key \"{}\" is missing; for "
                                                  "example {{ from = 1, to = 10, step = 1 }}",
                                                  path, key));
    }
    const auto amount = amount_of(*value);
    if (amount && std::isfinite(amount->number)) return *amount;
    throw InputError(value->where,
                     fmt::format("{}: found {}; expected a number or a quantity such as \"10 m\"",
                                 key, value->description()));
}

/// Number without the digits that are only the rounding of a sum: 0.3, not 0.30000000000000004.
double without_noise(double v) {
    const std::string text = fmt::format("{:.12g}", v);
    std::from_chars(text.data(), text.data() + text.size(), v);
    return v;
}

Value value_at(double number, const Amount& like, bool whole) {
    if (whole) return static_cast<std::int64_t>(std::llround(number));
    if (like.unit.empty()) return without_noise(number);
    return fmt::format("{}{}", without_noise(number), like.unit);
}

/// The values from, from + step ... to.
Array expand(const Value& range, std::string_view path) {
    TableReader keys(range, fmt::format("vary.\"{}\"", path));
    keys.expect({"from", "to", "step"});
    const Amount from = read_amount(range, path, "from");
    const Amount to = read_amount(range, path, "to");
    const Amount step = read_amount(range, path, "step");
    if (from.unit != to.unit || from.unit != step.unit) {
        throw InputError(range.where,
                         fmt::format("vary.\"{}\": \"from\", \"to\" and \"step\" have different "
                                     "units; expected the same unit in all three",
                                     path));
    }
    constexpr double slack = 1e-9;  // of a step: where rounding has moved the end
    const double steps = std::floor((to.number - from.number) / step.number + slack);
    if (step.number == 0 || steps < 0) {
        throw InputError(
            range.where,
            fmt::format("vary.\"{}\": the step never leads from {} to {}; expected a step > 0 if "
                        "\"from\" <= \"to\", or a step < 0 if \"from\" >= \"to\"",
                        path, from.number, to.number));
    }
    if (steps >= most_values) {
        throw InputError(
            range.where,
            fmt::format("vary.\"{}\": found more than {} values; expected a larger step", path,
                        most_values));
    }
    Array values;
    for (double i = 0; i <= steps; ++i) {
        values.push_back(value_at(from.number + i * step.number, from, from.whole && step.whole));
        values.back().where = range.where;
    }
    return values;
}

/// Whether a table in place of values is a range { from, to, step }, and not a longer path.
bool is_range(const Table& table) {
    return std::any_of(table.entries.begin(), table.entries.end(), [](const Entry& entry) {
        const bool known = entry.key == "from" || entry.key == "to" || entry.key == "step";
        return known && !entry.value.array() && !entry.value.table();
    });
}

Array values_of(const Value& value, const std::string& path) {
    if (value.table()) return expand(value, path);
    if (value.array() && !value.array()->empty()) return *value.array();
    throw InputError(
        value.where,
        fmt::format("vary.\"{}\": found {}; expected a list of values, such as "
                    "vary.\"propagation.model\" = [\"friis\", \"itu_indoor\"], or {{ from = 1, "
                    "to = 10, step = 1 }}",
                    path, value.array() ? "an empty list" : value.description()));
}

/// The keys below a table with their paths; `leaf` says whether a table is a value itself.
void flatten(const Table& table, const std::string& above, const auto& leaf, const auto& visit) {
    for (const Entry& entry : table.entries) {
        const std::string path = above.empty() ? entry.key : above + "." + entry.key;
        const Table* inner = entry.value.table();
        if (inner && !leaf(*inner)) {
            flatten(*inner, path, leaf, visit);
        } else {
            visit(path, entry);
        }
    }
}

std::vector<Vary> read_vary(const Value& value) {
    std::vector<Vary> list;
    std::set<std::string> seen;
    flatten(TableReader(value, "[study] vary").table(), "", is_range,
            [&](const std::string& path, const Entry& entry) {
                if (!seen.insert(path).second) {
                    throw InputError(
                        entry.key_where,
                        fmt::format("vary.\"{}\" is given twice; expected each key once", path));
                }
                list.push_back({path, entry.key_where, values_of(entry.value, path)});
            });
    return list;
}

const Vary& varied(const StudyTable& study, const std::string& path, const Location& where,
                   std::string_view in) {
    std::vector<std::string> paths;
    for (const Vary& vary : study.vary) {
        if (vary.path == path) return vary;
        paths.push_back(vary.path);
    }
    const std::string near = did_you_mean(path, paths);
    throw InputError(
        where, fmt::format("{}: \"{}\" is not a key of \"vary\"; expected one of \"{}\"{}{}", in,
                           path, fmt::join(paths, "\", \""), near.empty() ? "" : "; ", near));
}

void read_zip(const Value& value, StudyTable& study) {
    read_value(value, "zip", study.zip);
    std::set<std::string> seen;
    for (std::size_t i = 0; i < study.zip.size(); ++i) {
        const auto& group = study.zip[i];
        const Location& where = (*value.array())[i].where;
        for (const std::string& path : group) {
            if (!seen.insert(path).second) {
                throw InputError(
                    where,
                    fmt::format("zip: \"{}\" is listed twice; expected each key once", path));
            }
            const std::size_t n = varied(study, path, where, "zip").values.size();
            const std::size_t first = varied(study, group.front(), where, "zip").values.size();
            if (n == first) continue;
            throw InputError(where, fmt::format("zip: \"{}\" has {} values and \"{}\" has {}; "
                                                "expected the same number of values",
                                                group.front(), first, path, n));
        }
    }
}

/// @throws InputError for a value that the key never has in the study: it would exclude nothing
void check_varied(const Vary& vary, const Value& value) {
    constexpr std::size_t most_shown = 20;
    std::vector<std::string> texts, words;
    for (const Value& each : vary.values) {
        texts.push_back(to_toml(each));
        words.push_back(plain_text(each));
        if (texts.back() == to_toml(value)) return;
    }
    const std::string near = did_you_mean(plain_text(value), words);
    const bool is_cut = texts.size() > most_shown;
    texts.resize(std::min(texts.size(), most_shown));
    throw InputError(
        value.where,
        fmt::format("exclude: found {} = {}, which is not among the values of \"vary\"; "
                    "expected one of {}{}{}{}",
                    vary.path, to_toml(value), fmt::join(texts, ", "), is_cut ? ", ..." : "",
                    near.empty() ? "" : "; ", near));
}

void read_exclude(const Value& value, StudyTable& study) {
    const Array* list = value.array();
    if (!list) {
        throw InputError(value.where,
                         fmt::format("exclude: found {}; expected a list of tables, such as "
                                     "[{{ \"propagation.model\" = \"disc\" }}]",
                                     value.description()));
    }
    for (const Value& item : *list) {
        Exclusion exclusion;
        const auto no_leaf = [](const Table&) { return false; };
        flatten(TableReader(item, "exclude").table(), "", no_leaf,
                [&](const std::string& path, const Entry& entry) {
                    const Vary& vary = varied(study, path, entry.key_where, "exclude");
                    const Array* several = entry.value.array();
                    exclusion.push_back(
                        {path, entry.key_where, several ? *several : Array{entry.value}});
                    for (const Value& each : exclusion.back().values) check_varied(vary, each);
                });
        study.exclude.push_back(std::move(exclusion));
    }
}

void read_warmup(const Value& value, Duration duration, Warmup& warmup) {
    if (value.string() && *value.string() == "mser5") {
        warmup.mser5 = true;
        return;
    }
    try {
        read_value(value, "warmup", warmup.given);
    } catch (const InputError& error) {
        throw InputError(value.where, error.message() + ", or \"mser5\"");
    }
    if (warmup.given < Duration{0}) {
        throw InputError(value.where, fmt::format("warmup: found {}; expected a time >= 0 s",
                                                  value.description()));
    }
    if (warmup.given >= duration) {
        throw InputError(value.where,
                         fmt::format("warmup: found {}; expected less than [scenario] duration = "
                                     "{}, because otherwise no message would count",
                                     value.description(), to_toml(to_value(duration))));
    }
}

/// @throws InputError for STaR-Bets of a number of replications that is not fixed
void check_interval(const TableReader& table, const StudyTable& study) {
    if (!study.precision || study.interval != IntervalMethod::star) return;
    throw InputError(table.table().find("interval")->where,
                     "interval = \"star\" needs a number of replications that is fixed beforehand, "
                     "but `precision` adds replications; expected \"betting\" or \"t\"");
}

}  // namespace

StudyTable read_study(const Value& value, Duration duration) {
    StudyTable study;
    TableReader table(value, "[study]");
    table.expect<StudyTable>({"warmup", "vary", "zip", "exclude"});
    table.read_fields(study);
    check_interval(table, study);
    if (const Value* metrics = table.table().find("metrics")) {
        for (const Value& metric : *metrics->array()) study.metric_places.push_back(metric.where);
    }
    if (const Value* warmup = table.take("warmup")) read_warmup(*warmup, duration, study.warmup);
    if (const Value* vary = table.take("vary")) study.vary = read_vary(*vary);
    if (const Value* zip = table.take("zip")) read_zip(*zip, study);
    if (const Value* exclude = table.take("exclude")) read_exclude(*exclude, study);
    return study;
}

Table study_document(const StudyTable& study) {
    Table table;
    append_fields(table, study);
    table.set("warmup", study.warmup.mser5 ? Value("mser5") : to_value(study.warmup.given));
    const auto as_table = [](const std::vector<Vary>& list) {
        Table out;
        for (const Vary& vary : list) out.set(vary.path, vary.values);
        return out;
    };
    if (!study.vary.empty()) table.set("vary", as_table(study.vary));
    if (!study.zip.empty()) table.set("zip", to_value(study.zip));
    Array exclude;
    for (const Exclusion& each : study.exclude) exclude.emplace_back(as_table(each));
    if (!exclude.empty()) table.set("exclude", std::move(exclude));
    return table;
}

}  // namespace rovernet
