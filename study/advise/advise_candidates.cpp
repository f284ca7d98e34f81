// SPDX-License-Identifier: MIT
#include "study/advise/advise_candidates.hpp"

#include "models/propagation/rays.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario_file.hpp"
#include "scenario/tables/read_value.hpp"
#include "scenario/tables/reader.hpp"
#include "study/calibration/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <variant>

namespace rovernet {
namespace {

/// [propagation] with this model and the scenario's parameters.
Table propagation_with(const Scenario& scenario, const std::string& model) {
    PropagationTable propagation = scenario.propagation;
    const auto names = PropagationTable::names();
    propagation.model =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), model) - names.begin());
    Table table = chosen_document(propagation);
    std::erase_if(table.entries, [](const Entry& entry) {
        return entry.value.string() && entry.value.string()->starts_with("nan");  // not given
    });
    return table;
}

/// Takes a model's own shadowing off where the scenario has one for all models.
void leave_shadowing_to(const Scenario& scenario, Table& propagation) {
    const bool for_all = scenario.shadowing.model != ShadowingModel::none;
    if (for_all && propagation.find("sigma")) propagation.set("sigma", "0 dB");
}

/// Calls visit(forms) with the forms of the model with this name, if it has some: from the cheapest
/// to the most detailed one.
template <class Visitor>
void visit_forms(std::string_view model, Visitor&& visit) {
    for_each_model([&]<class M>() {
        if constexpr (requires { M::forms(); }) {
            if (M::name == model) visit(M::forms());
        }
    });
}

/// Calls visit(field) for each key in which two of the forms differ.
template <class M, std::size_t n, class Visitor>
void for_each_differing(const std::array<M, n>& forms, Visitor&& visit) {
    for_each_field<M>([&](const auto& f) {
        const auto differs = [&](const M& form) { return form.*f.member != forms[0].*f.member; };
        if (std::any_of(forms.begin(), forms.end(), differs)) visit(f);
    });
}

/// Overrides a table with the keys in which a form differs from others.
template <class M, std::size_t n>
void lay_over(Table& table, const M& form, const std::array<M, n>& forms) {
    for_each_differing(forms, [&](const auto& f) { append_field(table, f.name, form.*f.member); });
}

/// Tables [propagation] and [reception] of one combination.
Table settings_of(const Table& propagation, const Table& reception) {
    Table settings;
    settings.set("propagation", propagation);
    settings.set("reception", reception);
    return settings;
}

const std::string& word_at(const Table& table, std::string_view key) {
    return *table.find(key)->string();
}

/// Tables of the reference, and the places of options that change them.
struct Reference {
    Table propagation, reception;
    Location where;  // of an option that changes it; else the file
};

/// Options for the reference, as a document.
Value said_of_reference(const std::vector<std::string>& options) {
    Value said{Table{}};
    for (const std::string& text : options) {
        if (!text.starts_with("propagation.") && !text.starts_with("reception.")) {
            throw InputError(
                {"--reference " + text, 0, 0, true},
                "expected propagation.KEY=VALUE or reception.KEY=VALUE, such as "
                "propagation.model=multi_wall; to change other keys for all models, use --set");
        }
        set_option(said, text, "--reference " + text);
    }
    return said;
}

Reference reference_for(const Scenario& scenario, const CandidateQuestion& question) {
    const Value said = said_of_reference(question.reference);
    const auto told = [&](const char* table, const char* key) -> const Value* {
        const Value* of = said.table()->find(table);
        return of && of->table() ? of->table()->find(key) : nullptr;
    };
    const auto names = PropagationTable::names();
    std::string model(!scenario.walls                        ? TwoRay::name
                      : scenario.walls->storeys().size() > 1 ? MultiWall::name
                                                             : Rays::name);
    const Value* named = told("propagation", "model");
    if (named) model = names[read_choice(*named, "propagation model", names)];
    Reference out{propagation_with(scenario, model), {}, {scenario.file}};
    visit_forms(model, [&](const auto& forms) { lay_over(out.propagation, forms.back(), forms); });
    out.reception = whole_document(scenario.reception);
    out.reception.set("model", ReceptionTable::names().back());
    for (const auto& [name, table] :
         {std::pair{"propagation", &out.propagation}, std::pair{"reception", &out.reception}}) {
        const Value* over = said.table()->find(name);
        if (!over || !over->table()) continue;
        for (const Entry& entry : over->table()->entries) {
            table->set(entry.key, entry.value);
            out.where = entry.value.where;
        }
    }
    return out;
}

/// Whether a form is cheaper than the reference: less detailed in one of the keys in which forms
/// differ, and more detailed in none.
template <class M, std::size_t n>
bool is_cheaper(const M& form, const M& reference, const std::array<M, n>& forms) {
    bool less = false, more = false;
    for_each_differing(forms, [&](const auto& f) {
        less = less || form.*f.member < reference.*f.member;
        more = more || form.*f.member > reference.*f.member;
    });
    return less && !more;
}

/// Whether a model is a candidate where the question names none.
bool is_usual(const std::string& model, const std::string& reference, bool on_map) {
    const auto names = PropagationTable::names();
    const auto place = [&](const std::string& name) {
        return std::find(names.begin(), names.end(), name) - names.begin();
    };
    if (on_map) return place(model) < place(reference);
    bool is_indoor = false;
    for_each_model([&]<class M>() {
        if constexpr (requires { M::is_indoor; }) is_indoor = is_indoor || M::name == model;
    });
    return !is_indoor;
}

/// Cheaper forms of the reference's model. Each is named by all keys in which any two of them, or
/// one and the reference, differ: "rays order=2 diffraction=knife_edge".
std::vector<CandidateModel> cheaper_forms_of(const Table& reference) {
    const std::string& model = word_at(reference, "model");
    PropagationTable propagation;
    read_propagation(Value(reference), propagation);
    std::vector<CandidateModel> out;
    visit_forms(model, [&]<class M, std::size_t n>(const std::array<M, n>& forms) {
        for (const M& form : forms) {
            if (!is_cheaper(form, *propagation.as<M>(), forms)) continue;
            out.push_back({model, model, reference, "", ""});
            lay_over(out.back().table, form, forms);
        }
    });
    for (const Entry& entry : reference.entries) {
        const auto text_in = [&](const CandidateModel& each) {
            return plain_text(*each.table.find(entry.key));
        };
        const bool differ = std::any_of(out.begin(), out.end(), [&](const CandidateModel& each) {
            return text_in(each) != plain_text(entry.value);
        });
        if (!differ) continue;
        for (CandidateModel& each : out)
            each.name += fmt::format(" {}={}", entry.key, text_in(each));
    }
    return out;
}

/// All path losses that may be candidates, in the order of their detail.
std::vector<CandidateModel> possible_path_losses(const Scenario& scenario, const Table& reference) {
    const std::string& of_reference = word_at(reference, "model");
    std::vector<CandidateModel> out;
    for (const std::string& model : PropagationTable::names()) {
        if (model == of_reference) {
            for (CandidateModel& form : cheaper_forms_of(reference)) out.push_back(std::move(form));
            continue;
        }
        Table table = propagation_with(scenario, model);
        leave_shadowing_to(scenario, table);
        out.push_back({model, model, table, "", ""});
    }
    return out;
}

/// Checks the names of --models: a listed model, or a form of the reference's as it is printed.
/// @throws InputError at the option for another
void check_models(const CandidateQuestion& question, const std::vector<CandidateModel>& possible) {
    std::vector<std::string> names = PropagationTable::names();
    for (const CandidateModel& each : possible) {
        if (each.name != each.model) names.push_back(each.name);
    }
    for (const std::string& asked : question.models) {
        Value value{asked};
        value.where = {fmt::format("--models {}", fmt::join(question.models, ",")), 0, 0, true};
        read_choice(value, "propagation model", names);
    }
}

std::vector<CandidateModel> path_losses_for(const Scenario& scenario,
                                            const CandidateQuestion& question,
                                            const Table& reference) {
    const std::string& of_reference = word_at(reference, "model");
    std::vector<CandidateModel> out = possible_path_losses(scenario, reference);
    check_models(question, out);
    const auto& asked = question.models;
    const auto is_asked = [&](const std::string& name) {
        return std::find(asked.begin(), asked.end(), name) != asked.end();
    };
    std::erase_if(out, [&](const CandidateModel& each) {
        if (!asked.empty()) return !is_asked(each.model) && !is_asked(each.name);
        return each.model != of_reference &&
               !is_usual(each.model, of_reference, scenario.walls != nullptr);
    });
    return out;
}

/// "exponent 2.91, excess 3.2 dB" of the keys that a fit found.
std::string fitted_text(const Table& propagation) {
    std::vector<std::string> texts;
    for (const Entry& entry : propagation.entries) {
        if (entry.key != "model") texts.push_back(entry.key + " " + plain_text(entry.value));
    }
    return fmt::format("{}", fmt::join(texts, ", "));
}

/// Whether a table [propagation] is valid: a fit may exceed a parameter's range.
bool can_be_had(const Table& propagation, const Scenario& scenario) {
    PropagationTable out = scenario.propagation;
    try {
        read_propagation(Value(propagation), out);
    } catch (const InputError&) {
        return false;
    }
    return true;
}

/// Uses the parameters of a fit if there are any, and they are valid.
void take_fit(CandidateModel& candidate, const CalibratedModel& fitted, const Scenario& scenario) {
    candidate.note = fitted.failure;
    const Value* propagation = fitted.settings.find("propagation");
    if (!fitted.failure.empty() || !fitted.is_fitted() || !propagation) return;
    Table table = candidate.table;
    for (const Entry& entry : propagation->table()->entries) table.set(entry.key, entry.value);
    leave_shadowing_to(scenario, table);
    if (!can_be_had(table, scenario)) return;
    candidate.table = std::move(table);
    candidate.fitted = fitted_text(*propagation->table());
}

void fit_candidates(std::vector<CandidateModel>& candidates, const Scenario& reference,
                    const std::function<void(double)>& tell) {
    const Calibration fits = calibrate_to_model(reference, "", tell, beyond_radio);
    for (CandidateModel& candidate : candidates) {
        const auto fitted = std::find_if(
            fits.models.begin(), fits.models.end(),
            [&](const CalibratedModel& each) { return each.model == candidate.model; });
        if (fitted != fits.models.end()) take_fit(candidate, *fitted, reference);
    }
}

/// Reason, known before the run, why a scenario cannot run; empty: none.
std::string obstacle(const ScenarioFile& file, const Scenario& base, const Table& settings) {
    try {
        Scenario scenario = file.scenario(settings);
        if (!scenario.walls) scenario.walls = base.walls;
        const Propagation model = scenario.propagation.make();
        model.check_frequency(scenario.radio.frequency);
        if (scenario.walls) model.check_scene(*scenario.walls);
    } catch (const InputError& error) {
        return error.message();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

/// Finds which combinations can run, and leaves path losses out that no reception goes with.
void lay_out(AdviceCandidates& c, const ScenarioFile& file, const Scenario& base) {
    std::uint32_t point = 0;
    for (std::size_t p = 0; p < c.path_losses.size();) {
        std::vector<std::optional<std::uint32_t>> row;
        std::string why;
        const std::uint32_t before = point;
        for (const CandidateModel& reception : c.receptions) {
            const auto settings = settings_of(c.path_losses[p].table, reception.table);
            const std::string found = obstacle(file, base, settings);
            row.push_back(found.empty() ? std::optional(point++) : std::nullopt);
            if (!found.empty()) why = found;
        }
        if (point == before) {
            c.left_out.push_back(fmt::format("{}: {}", c.path_losses[p].name, why));
            c.path_losses.erase(c.path_losses.begin() + static_cast<std::ptrdiff_t>(p));
            continue;
        }
        c.points.push_back(std::move(row));
        ++p;
    }
}

}  // namespace

std::size_t AdviceCandidates::reception_of(std::size_t path_loss) const {
    std::size_t r = reference_reception();
    while (r > 0 && !points[path_loss][r]) --r;
    return r;
}

std::size_t AdviceCandidates::family() const {
    std::size_t count = 0;
    for (const auto& row : points) {
        count += static_cast<std::size_t>(
            std::count_if(row.begin(), row.end(), [](const auto& point) { return point; }));
    }
    return count - 1;
}

std::string AdviceCandidates::name_of(std::size_t path_loss, std::size_t reception) const {
    return fmt::format("{} + {}", path_losses[path_loss].name, receptions[reception].name);
}

std::vector<Vary> AdviceCandidates::vary() const {
    Vary propagation{"propagation", {}, {}}, reception{"reception", {}, {}};
    const auto add = [](Vary& vary, const std::vector<CandidateModel>& models) {
        for (const CandidateModel& each : models) {
            vary.values.emplace_back(each.table);
            vary.values.back().where = Location{"candidate " + each.name};
        }
    };
    add(propagation, path_losses);
    add(reception, receptions);
    return {propagation, reception};
}

std::vector<Exclusion> AdviceCandidates::exclude() const {
    std::vector<Exclusion> out;
    for (std::size_t p = 0; p < points.size(); ++p) {
        for (std::size_t r = 0; r < receptions.size(); ++r) {
            if (points[p][r]) continue;
            out.push_back({Vary{"propagation", {}, {Value(path_losses[p].table)}},
                           Vary{"reception", {}, {Value(receptions[r].table)}}});
        }
    }
    return out;
}

AdviceCandidates candidates_for(const std::string& path, const ScenarioOptions& options,
                                const CandidateQuestion& question,
                                const std::function<void(double)>& tell) {
    const Scenario base = load_scenario(path, options);
    const ScenarioFile file(path, options);
    const Reference reference = reference_for(base, question);
    const Table settings = settings_of(reference.propagation, reference.reception);
    if (const std::string why = obstacle(file, base, settings); !why.empty()) {
        throw InputError(reference.where, "the reference model cannot run: " + why);
    }
    Scenario scenario = file.scenario(settings);
    if (!scenario.walls) scenario.walls = base.walls;
    AdviceCandidates out;
    out.on_map = base.walls != nullptr;
    out.path_losses = path_losses_for(base, question, reference.propagation);
    if (!question.as_given) fit_candidates(out.path_losses, scenario, tell);
    const std::string& model = word_at(reference.propagation, "model");
    out.path_losses.push_back({model, model, reference.propagation, "", ""});
    for (const std::string& name : ReceptionTable::names()) {
        Table table = reference.reception;
        table.set("model", name);
        out.receptions.push_back({name, name, table, "", ""});
        if (name == word_at(reference.reception, "model")) break;
    }
    lay_out(out, file, base);
    return out;
}

}  // namespace rovernet
