// SPDX-License-Identifier: MIT
#include "scenario/idle_keys.hpp"

#include "scenario/affected.hpp"
#include "scenario/tables/model_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {
namespace {

/// Search for keys of a document that have no effect.
class IdleKeys {
  public:
    IdleKeys(const Value& document, Scenario& scenario)
        : document_(*document.table()), scenario_(scenario) {}

    void look() {
        note_other_models("propagation", "model", scenario_.propagation);
        note_other_models("reception", "model", scenario_.reception);
        note_other_models("access", "model", scenario_.access);
        note_other_models("routing", "protocol", scenario_.routing);
        note_schemes();
        note_arp();
        note_traces();
        note_open_field();
    }

  private:
    /// Entry of a key of a table; null if the document lacks the key.
    const Entry* given(std::string_view table, std::string_view key) const;
    /// Whether a key of the table may be meant for other values of the key `of`: the study varies
    /// `of`, or only the command line sets it.
    bool is_for_other(std::string_view table, const Entry& key, std::string_view of) const;
    void note(const Entry& key, const std::string& why) {
        add_notice(scenario_.notices,
                   fmt::format("{}: {} has no effect{}", key.key_where.text(), key.key, why));
    }

    template <class Choice>
    void note_other_models(std::string_view table, std::string_view key, const Choice& choice);
    void note_schemes();
    void note_arp();
    void note_traces();
    void note_open_field();

    const Table& document_;
    Scenario& scenario_;
};

const Entry* IdleKeys::given(std::string_view table, std::string_view key) const {
    const Value* value = document_.find(table);
    if (!value || !value->table()) return nullptr;
    const auto& entries = value->table()->entries;
    const auto found =
        std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.key == key; });
    return found == entries.end() ? nullptr : &*found;
}

bool IdleKeys::is_for_other(std::string_view table, const Entry& key, std::string_view of) const {
    const std::string path = fmt::format("{}.{}", table, of);
    const auto& vary = scenario_.study.vary;
    const bool varies = std::any_of(vary.begin(), vary.end(), [&](const Vary& each) {
        return each.path == path || each.path == table;
    });
    const Entry* chosen = given(table, of);
    return varies || (chosen && chosen->value.where.is_option && !key.value.where.is_option);
}

/// "flood, aodv and dsr".
std::string in_words(const std::vector<std::string_view>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) text += i + 1 < names.size() ? ", " : " and ";
        text += names[i];
    }
    return text;
}

/// Notices keys of a table that choose parameters of other models than the chosen one.
template <class Choice>
void IdleKeys::note_other_models(std::string_view table, std::string_view key,
                                 const Choice& choice) {
    Table changed;
    choice.for_each([&]<class M>(const M& each, bool) {
        Table now, usual;
        append_fields(now, each);
        append_fields(usual, M{});
        append_differing(changed, now, usual);
    });
    for (const Entry& parameter : changed.entries) {
        const Entry* entry = given(table, parameter.key);
        std::vector<std::string_view> users;
        bool is_used = false;
        choice.for_each([&]<class M>(const M&, bool chosen) {
            if (!has_key<M>(parameter.key)) return;
            users.push_back(M::name);
            is_used = is_used || chosen;
        });
        if (!entry || is_used || is_for_other(table, *entry, key)) continue;
        note(*entry,
             fmt::format(" under [{}] {} = \"{}\": only {} {} this key", table, key, choice.name(),
                         in_words(users), users.size() == 1 ? "uses" : "use"));
    }
}

/// Notices keys of a scheme of `suppression` other than the chosen one.
void IdleKeys::note_schemes() {
    const Suppression* chosen = scenario_.routing.as<Suppression>();
    if (!chosen) return;
    struct Use {
        std::string_view key;
        SuppressionScheme scheme;
        bool is_usual;
    };
    for (const auto& [key, scheme, is_usual] :
         {Use{"range", SuppressionScheme::location, false},
          Use{"hello", SuppressionScheme::cluster, chosen->hello == Suppression{}.hello}}) {
        const Entry* entry = given("routing", key);
        if (!entry || is_usual || chosen->scheme == scheme ||
            is_for_other("routing", *entry, "scheme") ||
            is_for_other("routing", *entry, "protocol"))
            continue;
        note(*entry, fmt::format(" under [routing] scheme = \"{}\": only the scheme \"{}\" uses "
                                 "this key",
                                 name_of(chosen->scheme), name_of(scheme)));
    }
}

void IdleKeys::note_arp() {
    const Entry* entry = given("access", "arp_timeout");
    if (!entry || scenario_.arp.arp || is_for_other("access", *entry, "arp")) return;
    note(*entry, " without [access] arp = true");
}

void IdleKeys::note_traces() {
    const TraceTable& trace = scenario_.trace;
    if (trace.links && !trace.record) {
        if (const Entry* entry = given("trace", "links"))
            note(*entry, ": without [trace] record = true, no recorded trace is written");
    }
    if (trace.mac && !trace.record && trace.ns2 == Ns2Choice::none) {
        if (const Entry* entry = given("trace", "mac"))
            note(*entry, ": without [trace] ns2 = \"new\" or \"old\", no ns-2 trace is written");
    }
}

void IdleKeys::note_open_field() {
    const SceneTable& scene = scenario_.scene;
    if (scene.has_maps() || scene.world) return;
    if (const Entry* entry = given("scene", "wall_height"))
        note(*entry, ": the scene is an open field without walls");
    Affected materials;
    for (const MaterialTable& material : scene.materials) {
        materials.add([&] {
            return fmt::format(
                "{}: material \"{}\" has no effect: the scene is an open field without walls",
                material.where.text(), material.name);
        });
    }
    materials.note(scenario_.notices);
}

}  // namespace

void note_idle_keys(const Value& document, Scenario& scenario) {
    if (document.table()) IdleKeys(document, scenario).look();
}

}  // namespace rovernet
