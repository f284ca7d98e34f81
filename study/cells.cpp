// SPDX-License-Identifier: MIT
#include "study/cells.hpp"

#include "scenario/document/toml.hpp"
#include "study/quotient.hpp"
#include "study/statistics/summary.hpp"
#include "study/study.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rovernet {
namespace {

constexpr std::size_t most_shown = 8;  // rows, and reasons of each

/// The part of a point's settings that `paths` name.
Table part_of(const Table& settings, const std::vector<std::string>& paths) {
    Table part;
    for (const std::string& path : paths) {
        if (const Value* value = settings.find(path)) part.set(path, *value);
    }
    return part;
}

bool contains(const std::vector<std::string>& paths, const std::string& path) {
    return std::find(paths.begin(), paths.end(), path) != paths.end();
}

/// Tables in the order in which they come, each with its place.
class Places {
  public:
    std::size_t of(Table table) {
        const auto [found, is_new] = places_.try_emplace(to_toml(table), tables.size());
        if (is_new) tables.push_back(std::move(table));
        return found->second;
    }
    std::vector<Table> tables;

  private:
    std::map<std::string, std::size_t> places_;
};

/// The texts of a list, of which no more than some are shown.
std::string listed(const std::vector<std::string>& texts, std::string_view between) {
    const auto shown = static_cast<std::ptrdiff_t>(std::min(texts.size(), most_shown));
    std::string text = fmt::format("{}", fmt::join(texts.begin(), texts.begin() + shown, between));
    if (texts.size() > most_shown) {
        text += fmt::format("{}and {} more", between, texts.size() - most_shown);
    }
    return text;
}

ValuesOfPoints stored_values(const Store& store, const std::string& metric) {
    ValuesOfPoints values;
    for (const StoredValue& v : store.values(metric)) {
        auto& list = values[v.point];
        if (v.replication >= list.size()) list.resize(v.replication + 1);
        list[v.replication] = v.value;
    }
    return values;
}

}  // namespace

Rows rows_of(const std::vector<StoredPoint>& points, const std::vector<std::string>& group_by) {
    Rows rows;
    if (points.empty()) return rows;
    Places groups;
    std::vector<std::size_t> group_of;
    for (const StoredPoint& p : points)
        group_of.push_back(groups.of(part_of(p.settings, group_by)));
    for (const Entry& entry : points.front().settings.entries) {
        const std::string& path = entry.key;
        if (contains(group_by, path)) continue;
        std::vector<std::string> value_of(groups.tables.size());
        bool in_a_row = false, between_rows = false;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::string text = to_toml(part_of(points[i].settings, {path}));
            std::string& known = value_of[group_of[i]];
            if (known.empty()) known = text;
            in_a_row = in_a_row || known != text;
            between_rows = between_rows || value_of.front() != text;
        }
        if (in_a_row) {
            rows.averaged.push_back(path);
        } else if (between_rows) {
            rows.along.push_back(path);
        }
    }
    Places combinations;
    rows.list.resize(groups.tables.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t c = combinations.of(part_of(points[i].settings, rows.averaged));
        auto& places = rows.list[group_of[i]].points;
        if (c >= places.size()) places.resize(c + 1);
        places[c] = points[i].number;
    }
    for (std::size_t g = 0; g < rows.list.size(); ++g) {
        rows.list[g].settings = std::move(groups.tables[g]);
        rows.list[g].points.resize(combinations.tables.size());
    }
    rows.combinations = std::move(combinations.tables);
    return rows;
}

std::string Gaps::text() const {
    std::vector<std::string> texts;
    const auto add = [&](std::uint64_t count, std::string_view word) {
        if (count > 0) texts.push_back(fmt::format("{} {}", count, word));
    };
    add(failed, "failed");
    add(undefined, "undefined");
    add(missing, "missing");
    return fmt::format("{}", fmt::join(texts, ", "));
}

ValuesOfPoints values_of_points(const Store& store, const std::string& metric) {
    ValuesOfPoints values = stored_values(store, metric);
    const auto quotient = quotient_of(metric);
    if (!values.empty() || !quotient) return values;
    values = stored_values(store, quotient->over);
    ValuesOfPoints under = stored_values(store, quotient->under);
    for (auto& [point, list] : values) {
        under[point].resize(list.size());
        for (std::size_t r = 0; r < list.size(); ++r) {
            const auto& below = under[point][r];
            list[r] =
                list[r] && below && *below != 0 ? std::optional(*list[r] / *below) : std::nullopt;
        }
    }
    return values;
}

Cells::Cells(const Rows& rows, const Inventory& inventory, ValuesOfPoints values)
    : rows_(rows), inventory_(inventory), values_(std::move(values)) {
    for (const Row& row : rows_.list) {
        for (const auto& point : row.points) {
            if (point) replications_ = std::max(replications_, inventory_.at(*point).size());
        }
    }
    in_every_row_.assign(rows_.combinations.size(), std::vector<bool>(replications_, true));
    in_any_row_.assign(replications_, false);
    for (std::size_t row = 0; row < rows_.list.size(); ++row) {
        for (std::size_t c = 0; c < rows_.combinations.size(); ++c) {
            for (std::size_t r = 0; r < replications_; ++r) {
                const bool here = value(row, c, r).has_value();
                in_every_row_[c][r] = in_every_row_[c][r] && here;
                in_any_row_[r] = in_any_row_[r] || here;
            }
        }
    }
}

std::optional<double> Cells::value(std::size_t row, std::size_t c, std::size_t r) const {
    const auto& point = rows_.list[row].points[c];
    if (!point) return std::nullopt;
    const auto found = values_.find(*point);
    if (found == values_.end() || r >= found->second.size()) return std::nullopt;
    return found->second[r];
}

std::map<std::uint32_t, double> Cells::means(std::size_t row, bool common) const {
    std::map<std::uint32_t, double> means;
    std::vector<double> values;
    for (std::size_t r = 0; r < replications_; ++r) {
        values.clear();
        for (std::size_t c = 0; c < rows_.combinations.size(); ++c) {
            const auto v = value(row, c, r);
            if (v && (!common || in_every_row_[c][r])) values.push_back(*v);
        }
        if (!values.empty()) means[static_cast<std::uint32_t>(r)] = summary_of(values)->mean;
    }
    return means;
}

Gaps Cells::gaps(std::size_t row) const {
    RunCounts counts;
    Gaps gaps;
    for (std::size_t c = 0; c < rows_.combinations.size(); ++c) {
        const auto& point = rows_.list[row].points[c];
        if (!point) continue;
        const std::vector<RunState>& states = inventory_.at(*point);
        for (std::size_t r = 0; r < states.size(); ++r) {
            counts.add(states[r]);
            if (states[r] == RunState::finished && !value(row, c, r)) ++gaps.undefined;
        }
    }
    gaps.failed = counts.failed;
    gaps.missing = counts.missing;
    return gaps;
}

std::uint64_t Cells::count() const {
    return std::uint64_t{rows_.combinations.size()} * replications_;
}

std::uint64_t Cells::common() const {
    std::uint64_t common = 0;
    for (const std::vector<bool>& cells : in_every_row_) {
        common += static_cast<std::uint64_t>(std::count(cells.begin(), cells.end(), true));
    }
    return common;
}

std::string_view Cells::reason(std::size_t row, std::size_t c, std::size_t r) const {
    const auto& point = rows_.list[row].points[c];
    if (!point) return "runs that are not in the study";
    const std::vector<RunState>& states = inventory_.at(*point);
    if (r >= states.size() || states[r] == RunState::missing) return "missing runs";
    return states[r] == RunState::failed ? "failed runs" : "runs without a value";
}

std::string Cells::lack(std::size_t row) const {
    std::vector<std::string> reasons;
    std::uint64_t lacking = 0;
    for (std::size_t c = 0; c < rows_.combinations.size(); ++c) {
        std::map<std::string_view, std::uint64_t> counts;
        for (std::size_t r = 0; r < replications_; ++r) {
            if (!value(row, c, r) && in_any_row_[r]) ++counts[reason(row, c, r)];
        }
        for (const auto& [why, count] : counts) {
            lacking += count;
            reasons.push_back(
                fmt::format("{}: {} at {}", why, count, settings_text(rows_.combinations[c])));
        }
    }
    if (reasons.empty()) return "";
    const Table& settings = rows_.list[row].settings;
    return fmt::format("{} has no value in {} of {} cells ({})",
                       settings.entries.empty() ? "the only row" : settings_text(settings), lacking,
                       count(), listed(reasons, "; "));
}

std::string Cells::unbalanced() const {
    std::vector<std::string> lines;
    for (std::size_t row = 0; row < rows_.list.size(); ++row) {
        if (std::string text = lack(row); !text.empty()) lines.push_back("  " + text);
    }
    return lines.empty() ? "" : listed(lines, "\n");
}

}  // namespace rovernet
