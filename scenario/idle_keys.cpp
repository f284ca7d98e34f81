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
        note_variation();
        note_parts_of_models();
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
        const std::string place = key.key_where.text();
        if (place.empty()) return;  // `advise` sets whole tables: nobody wrote this key
        add_notice(scenario_.notices,
                   fmt::format("{}: the key \"{}\" has no effect{}", place, key.key, why));
    }

    template <class Choice>
    void note_other_models(std::string_view table, std::string_view key, const Choice& choice);
    /// Notices a key that has an effect only for some values of the key `of` of its table.
    /// @param is_idle  whether `of` has a different value, and `key` differs from its default
    /// @param needed   assignment that would give the key an effect, such as `scheme = "location"`
    void note_unless(std::string_view table, std::string_view key, std::string_view of,
                     bool is_idle, std::string_view needed);
    template <class Model, class T>
    void note_part(std::string_view table, const Model& model, std::string_view key,
                   T Model::*member, std::string_view of, bool is_active, std::string_view needed);
    void note_variation();
    void note_parts_of_models();
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
    if (varies || !chosen) return varies;
    const Location &choice = chosen->value.where, &parameter = key.value.where;
    // These options of `compare` try several values.
    constexpr std::string_view several[] = {"--models ", "--protocols ", "--vary "};
    const bool tries_several = std::ranges::any_of(
        several, [&](std::string_view option) { return choice.source.starts_with(option); });
    return choice.is_option && (tries_several || !parameter.is_option);
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
             fmt::format(" with [{}] {} = \"{}\": only {} {} this key", table, key, choice.name(),
                         in_words(users), users.size() == 1 ? "uses" : "use"));
    }
}

void IdleKeys::note_unless(std::string_view table, std::string_view key, std::string_view of,
                           bool is_idle, std::string_view needed) {
    const Entry* entry = given(table, key);
    if (!entry || !is_idle || is_for_other(table, *entry, of)) return;
    note(*entry, fmt::format(" without [{}] {}", table, needed));
}

/// Notices a key of a model that differs from its default while the key `of` switches it off.
template <class Model, class T>
void IdleKeys::note_part(std::string_view table, const Model& model, std::string_view key,
                         T Model::*member, std::string_view of, bool is_active,
                         std::string_view needed) {
    note_unless(table, key, of, !is_active && model.*member != Model{}.*member, needed);
}

void IdleKeys::note_variation() {
    const Shadowing& s = scenario_.shadowing;
    note_part("shadowing", s, "sigma", &Shadowing::sigma, "model", s.model != ShadowingModel::none,
              "model = \"link\" or \"field\"");
    note_part("shadowing", s, "decorrelation_distance", &Shadowing::decorrelation_distance, "model",
              s.model == ShadowingModel::field, "model = \"field\"");
    const Fading& f = scenario_.fading;
    note_part("fading", f, "coherence", &Fading::coherence, "model", f.model != FadingModel::none,
              "model = \"rayleigh\", \"rician\" or \"nakagami\"");
    note_part("fading", f, "k_factor", &Fading::k_factor, "model", f.model == FadingModel::rician,
              "model = \"rician\"");
    note_part("fading", f, "m", &Fading::m, "model", f.model == FadingModel::nakagami,
              "model = \"nakagami\"");
}

/// Notices keys of the chosen models and protocols that other keys of these models switch off.
void IdleKeys::note_parts_of_models() {
    if (const auto* two_ray = scenario_.propagation.as<TwoRay>()) {
        const bool is_exact = two_ray->form == TwoRayForm::exact;
        note_part("propagation", *two_ray, "polarization", &TwoRay::polarization, "form", is_exact,
                  "form = \"exact\"");
        note_part("propagation", *two_ray, "ground_permittivity", &TwoRay::ground_permittivity,
                  "form", is_exact, "form = \"exact\"");
    }
    if (const auto* aodv = scenario_.routing.as<Aodv>()) {
        note_part("routing", *aodv, "gratuitous", &Aodv::gratuitous, "destination_only",
                  !aodv->destination_only, "destination_only = false");
    }
    if (const auto* suppression = scenario_.routing.as<Suppression>()) {
        note_part("routing", *suppression, "range", &Suppression::range, "scheme",
                  suppression->scheme == SuppressionScheme::location, "scheme = \"location\"");
        note_part("routing", *suppression, "hello", &Suppression::hello, "scheme",
                  suppression->scheme == SuppressionScheme::cluster, "scheme = \"cluster\"");
    }
    note_unless("access", "arp_timeout", "arp", !scenario_.arp.arp, "arp = true");
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
