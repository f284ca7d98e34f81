// SPDX-License-Identifier: MIT
#include "cli/studies/advise_report.hpp"

#include "cli/terminal/text_table.hpp"
#include "scenario/document/json.hpp"
#include "scenario/document/toml.hpp"
#include "study/advise/advise_cost.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace rovernet::cli {
namespace {

/// Copy of a table without the keys that the model that it names does not have.
template <class Choice>
Table own_keys(const Table& table) {
    const Value* word = table.find("model");
    Table out;
    for (const Entry& entry : table.entries) {
        bool is_own = entry.key == "model";
        Choice::for_each_type([&]<class M>() {
            const bool named = word && word->string() && *word->string() == M::name;
            is_own = is_own || (named && has_key<M>(entry.key));
        });
        if (is_own) out.set(entry.key, entry.value);
    }
    return out;
}

std::string_view verdict_of(const JudgedCandidate& each) {
    switch (each.decision.verdict()) {
        case Equivalence::within: return "sufficient";
        case Equivalence::outside: return "insufficient";
        default: return each.needed ? "undecided" : "not needed";  // or open, if it was stopped
    }
}

/// Replications that a verdict rests on, or all that were compared.
std::size_t replications_of(const JudgedCandidate& each) {
    return each.decision.decided_at().value_or(each.decision.n());
}

std::string interval_text(double mean, const std::optional<MeanInterval>& interval) {
    if (!interval) return fmt::format("{:.3g}", mean);
    return fmt::format("{:.3g} ({:.3g} to {:.3g})", mean, interval->low, interval->high);
}

std::string micros_text(const CandidateCost& cost) {
    if (!cost.transmission_s) return "-";
    return fmt::format("{:.3g} us ({:.3g} to {:.3g})", 1e6 * *cost.transmission_s,
                       1e6 * *cost.low_s, 1e6 * *cost.high_s);
}

std::string share_of_run(const CandidateCost& cost) {
    return cost.share ? fmt::format("{:.2g} %", 100 * *cost.share) : "-";
}

/// Tables of a scenario file, with the keys that the models take.
std::string toml_of(const CandidateModel& path_loss, const CandidateModel& reception) {
    Table table;
    table.set("propagation", own_keys<PropagationTable>(path_loss.table));
    table.set("reception", own_keys<ReceptionTable>(reception.table));
    return to_toml(table);
}

std::string toml_of_choice(const Advice& advice) {
    const AdviceCandidates& c = advice.candidates;
    return toml_of(c.path_losses[advice.path_loss], c.receptions[advice.reception]);
}

std::string toml_of_reference(const Advice& advice) {
    const AdviceCandidates& c = advice.candidates;
    return toml_of(c.path_losses.back(), c.receptions.back());
}

std::string reference_of(const Advice& advice) {
    const AdviceCandidates& c = advice.candidates;
    return c.name_of(c.reference_path_loss(), c.reference_reception());
}

void print_judged(const Advice& advice) {
    const bool costs = advice.reference_cost.run_s > 0;
    TextTable::Line head = {"candidate", "verdict", "n", "bias", "run error"};
    if (costs) head.insert(head.end(), {"CPU/transmission", "of run", "CPU/run"});
    TextTable table(head);
    const auto add = [&](TextTable::Line line, const CandidateCost& cost) {
        if (costs) {
            line.insert(line.end(), {micros_text(cost), share_of_run(cost),
                                     fmt::format("{:.3g} ms", 1e3 * cost.run_s)});
        }
        table.add(std::move(line));
    };
    const auto number = [](std::size_t n) { return n > 0 ? fmt::format("{}", n) : "-"; };
    for (const JudgedCandidate& each : advice.judged) {
        const bool compared = each.decision.n() > 0;
        add({each.name, std::string(verdict_of(each)), number(replications_of(each)),
             compared ? interval_text(each.bias, each.bias_interval) : "-",
             compared ? interval_text(each.run_error, each.run_error_interval) : "-"},
            each.cost);
    }
    add({reference_of(advice), "reference", number(advice.replications), "-", "-"},
        advice.reference_cost);
    fmt::print("{}", table.text());
}

/// Parameters of the models, and models that could not be judged.
void print_models(const Advice& advice) {
    for (const CandidateModel& model : advice.candidates.path_losses) {
        if (!model.fitted.empty()) fmt::print("{}: fitted {}\n", model.name, model.fitted);
        if (!model.note.empty()) {
            fmt::print(
                "{}: judged with the parameters of the scenario file, because the fit failed: {}\n",
                model.name, model.note);
        }
    }
    for (const std::string& text : advice.candidates.left_out) {
        fmt::print("not judged: {}\n", text);
    }
}

void print_report(const Advice& advice) {
    const DecisionRule& rule = advice.rule;
    fmt::print(
        "{} in {} replications, compared with {}: tolerance {:.4g} {}, confidence {:.4g} % for all "
        "{} combinations of models together\n\n",
        advice.metric, advice.replications, reference_of(advice), rule.tolerance,
        rule.criterion == ErrorCriterion::mean ? "for the mean" : "for a single run",
        100 * (1 - rule.alpha), rule.family);
    print_judged(advice);
    fmt::print(
        "\nn: replications on which the verdict is based; bias: mean difference from the "
        "reference; run error: mean absolute difference of a single run from the reference\n");
    if (!advice.cost_text.empty()) fmt::print("{}\n", advice.cost_text);
    print_models(advice);
    fmt::print("\n{}\n", advice_text(advice));
    if (advice.knows_nothing()) return;
    fmt::print("\n{}", advice.saves_nothing() ? toml_of_reference(advice) : toml_of_choice(advice));
}

void set_interval(Table& row, const std::string& name, const std::optional<double>& mean,
                  const std::optional<MeanInterval>& interval) {
    row.set(name, mean);
    row.set(name + "_low", interval ? Value(interval->low) : Value());
    row.set(name + "_high", interval ? Value(interval->high) : Value());
}

void set_cost(Table& row, const CandidateCost& cost) {
    const auto known = [](double v) { return v > 0 ? Value(v) : Value(); };
    row.set("cpu_run_s", known(cost.run_s));
    row.set("cost_tx_s", cost.transmission_s);
    row.set("cost_tx_low_s", cost.low_s);
    row.set("cost_tx_high_s", cost.high_s);
    row.set("radio_share", cost.share);
}

Table row_of(const Advice& advice, const JudgedCandidate& each) {
    constexpr const char* steps[] = {"path loss", "reception", "both"};
    const auto count = [](const std::optional<std::size_t>& n) {
        return n ? Value(std::uint64_t{*n}) : Value();
    };
    Table row;
    row.set("step", steps[static_cast<int>(each.step)]);
    row.set("path_loss", advice.candidates.path_losses[each.path_loss].name);
    row.set("reception", advice.candidates.receptions[each.reception].name);
    row.set("verdict", verdict_of(each));
    row.set("n", std::uint64_t{each.decision.n()});
    row.set("decided_at", count(each.decision.decided_at()));
    row.set("needed", count(each.decision.needed()));
    row.set("deciding_tolerance", each.decision.deciding_tolerance());
    const auto known = [&](double mean) {
        return each.decision.n() > 0 ? std::optional(mean) : std::nullopt;
    };
    set_interval(row, "bias", known(each.bias), each.bias_interval);
    set_interval(row, "run_error", known(each.run_error), each.run_error_interval);
    row.set("fitted", advice.candidates.path_losses[each.path_loss].fitted);
    set_cost(row, each.cost);
    return row;
}

Table as_json(const Advice& advice) {
    const AdviceCandidates& c = advice.candidates;
    Table table, reference, choice;
    table.set("metric", advice.metric);
    table.set("criterion", advice.rule.criterion == ErrorCriterion::mean ? "mean" : "run");
    table.set("tolerance", advice.rule.tolerance);
    table.set("confidence", 1 - advice.rule.alpha);
    table.set("method", advice.rule.by_betting() ? "betting" : "t");
    table.set("family", std::uint64_t{advice.rule.family});
    table.set("replications", std::uint64_t{advice.replications});
    reference.set("path_loss", c.path_losses.back().name);
    reference.set("reception", c.receptions.back().name);
    reference.set("toml", toml_of_reference(advice));
    set_cost(reference, advice.reference_cost);
    table.set("reference", std::move(reference));
    Array rows, left_out;
    for (const JudgedCandidate& each : advice.judged) rows.emplace_back(row_of(advice, each));
    for (const std::string& text : c.left_out) left_out.emplace_back(text);
    table.set("candidates", std::move(rows));
    table.set("left_out", std::move(left_out));
    choice.set("path_loss", c.path_losses[advice.path_loss].name);
    choice.set("reception", c.receptions[advice.reception].name);
    choice.set("toml", toml_of_choice(advice));
    table.set("choice", advice.knows_nothing() ? Value() : Value(std::move(choice)));
    table.set("stopped", advice.stopped);
    table.set("saves_nothing", advice.saves_nothing());
    table.set("advice", advice_text(advice));
    table.set("cost", advice.cost_text);
    return table;
}

}  // namespace

void print_advice(const Advice& advice, bool json) {
    if (json) {
        fmt::print("{}", to_json(as_json(advice)));
    } else {
        print_report(advice);
    }
}

}  // namespace rovernet::cli
