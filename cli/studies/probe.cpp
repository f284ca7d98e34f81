// SPDX-License-Identifier: MIT
#include "study/probe/probe.hpp"

#include "cli/runs/run_commands.hpp"
#include "cli/terminal/text_table.hpp"
#include "cli/terminal/waiting.hpp"
#include "models/propagation/disc.hpp"
#include "scenario/document/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rovernet::cli {
namespace {

/// Numbers that are 0 at this many digits have no sign.
std::string db_text(double db, int digits = 2) {
    const std::string text = fmt::format("{:+.{}f}", db, digits);
    return text.find_first_not_of("+-0.") == text.npos ? "0" : text + " dB";
}

const char* state_text(const LinkEffect& e) {
    if (!e.flips()) return e.is_up() ? "up" : "down";
    return e.is_up() ? "down -> up" : "up -> down";
}

/// The model disc has no levels: what it changes is links.
bool has_levels(const Probe& probe) { return probe.model != Disc::name; }

/// Null for a number of decibels that the model does not have.
Value level(bool has_levels, double db) { return has_levels ? Value(db) : Value(); }

Table as_table(const PerturbationEffect& p, bool levels) {
    Table table;
    table.set("name", p.name);
    table.set("nothing", p.nothing.empty() ? Value() : Value(p.nothing));
    table.set("changed", std::uint64_t{p.changed});
    table.set("flips", std::uint64_t{p.flips});
    table.set("worst_db", level(levels, p.worst));
    table.set("rms_db", level(levels, p.rms));
    table.set("steepest_db_per_mm", level(levels, p.steepest));
    table.set("lost", p.lost);
    table.set("gained", p.gained);
    return table;
}

Table as_table(const LinkEffect& e, bool levels) {
    Table table;
    table.set("link", e.link);
    table.set("perturbation", e.perturbation);
    table.set("distance_m", e.distance);
    table.set("budget_db", level(levels, e.budget));
    table.set("loss_db", level(levels, e.before));
    table.set("perturbed_loss_db", level(levels, e.after));
    table.set("change_db", level(levels, e.change()));
    table.set("db_per_mm", level(levels && e.moved > 0, e.steepness()));
    table.set("cliff", e.is_cliff());
    table.set("was_up", e.was_up());
    table.set("is_up", e.is_up());
    return table;
}

Table as_table(const MessageEffect& m, bool /*levels*/) {
    Table table;
    table.set("perturbation", m.perturbation);
    table.set("from", m.from);
    table.set("number", std::uint64_t{m.number});
    table.set("sent_s", seconds(m.sent));
    table.set("at", m.at);
    table.set("gained", m.gained);
    return table;
}

template <class Effect>
Array array_of(const std::vector<Effect>& all, std::size_t most, bool levels) {
    Array array;
    for (const Effect& each : all) {
        if (array.size() < most) array.push_back(as_table(each, levels));
    }
    return array;
}

Table as_table(const Probe& probe, std::size_t most) {
    Table table;
    table.set("model", probe.model);
    table.set("links", std::uint64_t{probe.links});
    table.set("messages_until_s", seconds(probe.until));
    table.set("deliveries", probe.deliveries);
    const bool levels = has_levels(probe);
    table.set("perturbations", array_of(probe.perturbations, probe.perturbations.size(), levels));
    table.set("effects", array_of(probe.effects, most, levels));
    table.set("messages", array_of(probe.messages, most, levels));
    return table;
}

void print_perturbations(const Probe& probe, bool messages) {
    TextTable table(
        {"perturbation", "links changed", "flips", "worst", "rms", "dB/mm", "lost", "gained"});
    for (const PerturbationEffect& p : probe.perturbations) {
        if (!p.nothing.empty()) {
            table.add({p.name, "-", "-", "-", "-", "-", "-", "-"});
            continue;
        }
        const auto count = [&](std::uint64_t n) { return messages ? fmt::format("{}", n) : "-"; };
        const bool levels = has_levels(probe);
        table.add({p.name, fmt::format("{}", p.changed), fmt::format("{}", p.flips),
                   levels ? db_text(p.worst) : "-", levels ? fmt::format("{:.2f} dB", p.rms) : "-",
                   levels && p.steepest > 0 ? fmt::format("{:.2g}", p.steepest) : "-",
                   count(p.lost), count(p.gained)});
    }
    fmt::print(
        "{}links changed: links whose loss changes; flips: links that go up or down; worst, rms: "
        "largest and root mean square change of a loss;\ndB/mm: largest change of a loss per mm "
        "that an antenna moved; lost, gained: receptions of messages that the perturbation removes "
        "or adds\n",
        table.text());
    for (const PerturbationEffect& p : probe.perturbations) {
        if (!p.nothing.empty()) fmt::print("{}: left out, because {}\n", p.name, p.nothing);
    }
}

std::string more_text(std::size_t all, std::size_t most) {
    return all > most ? fmt::format("... and {} more; a larger --top lists them\n", all - most)
                      : "";
}

void print_effects(const Probe& probe, std::size_t most) {
    TextTable table({"link", "perturbation", has_levels(probe) ? "loss" : "distance", "change",
                     "dB/mm", "budget", "state"});
    const std::size_t n = std::min(most, probe.effects.size());
    for (std::size_t i = 0; i < n; ++i) {
        const LinkEffect& e = probe.effects[i];
        if (!has_levels(probe)) {
            table.add({e.link, e.perturbation, fmt::format("{:.6g} m", e.distance), "-", "-", "-",
                       state_text(e)});
            continue;
        }
        table.add({e.link, e.perturbation, fmt::format("{:.2f} dB", e.before),
                   db_text(e.change(), std::abs(e.change()) < 0.01 ? 6 : 2),
                   e.moved > 0 ? fmt::format("{:.2g}", e.steepness()) : "-",
                   fmt::format("{:.2f} dB", e.budget), state_text(e)});
    }
    if (n == 0) return;
    const auto cliffs = std::count_if(probe.effects.begin(), probe.effects.end(),
                                      [](const LinkEffect& e) { return e.is_cliff(); });
    fmt::print(
        "\nlinks: first the {} cliffs (losses that change by more than {:g} dB per mm), then the "
        "links that go up or down\n",
        cliffs, LinkEffect::cliff);
    fmt::print("{}{}", table.text(), more_text(probe.effects.size(), most));
}

void print_messages(const Probe& probe, std::size_t most) {
    std::uint64_t all = 0;
    for (const PerturbationEffect& p : probe.perturbations) all += p.lost + p.gained;
    const std::size_t n = std::min(most, probe.messages.size());
    if (n == 0) return;
    TextTable table({"message", "sent", "perturbation", "robot", "gets it"});
    for (std::size_t i = 0; i < n; ++i) {
        const MessageEffect& m = probe.messages[i];
        table.add({fmt::format("{} of {}", m.number, m.from),
                   fmt::format("{:.6g} s", seconds(m.sent)), m.perturbation, m.at,
                   m.gained ? "no -> yes" : "yes -> no"});
    }
    fmt::print(
        "\nmessages that a robot gets only without the perturbation (yes -> no) or only with the "
        "perturbation (no -> yes)\n{}{}",
        table.text(), more_text(all, most));
}

}  // namespace

void probe(const ProbeArguments& a) {
    const Scenario scenario = scenario_of(a);
    ProbeSize size{.links = a.links};
    if (a.no_messages) size.events = 0;
    Probe found;
    {
        Waiting waiting("probing " + a.file);
        found = rovernet::probe(scenario, size, [&](double share) { waiting.tell(share); });
    }
    if (a.json) {
        fmt::print("{}", to_json(as_table(found, a.top)));
        return;
    }
    fmt::print("{} links at {} times, losses computed by {}", found.links, size.times, found.model);
    if (!a.no_messages) {
        fmt::print(
            "; {} receptions of messages until {:.6g} s{}", found.deliveries, seconds(found.until),
            found.whole_run ? "" : " (messages are compared only during the first million events)");
    }
    fmt::print("\n\n");
    print_perturbations(found, !a.no_messages);
    print_effects(found, a.top);
    print_messages(found, a.top);
}

}  // namespace rovernet::cli
