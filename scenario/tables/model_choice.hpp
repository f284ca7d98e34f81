// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/tables/reader.hpp"
#include "sim/fields.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

// Table of a scenario file that chooses a model of a list, such as [propagation] or [access]:
//
//     [access]
//     model = "aloha"
//     slot = "1 ms"
//     standard = "802.11g"      key of csma: checked, and stored for a study that swaps the model
//
// Reading, checks, printing and the model itself follow from the list and the models' fields().

namespace rovernet {

/// The chosen model of a list, and the parameters of all listed models.
/// @tparam Models   list: a std::tuple of described structs with a name
/// @tparam Any      type that holds any of these models, such as Propagation
/// @tparam Default  model that is chosen if the file names none
template <class Models, class Any, class Default = std::tuple_element_t<0, Models>>
struct ModelChoice {
    /// Index of the model M in the list `Models`, from 0. M must be in the list.
    template <class M>
    static constexpr std::size_t place_of() {
        return []<class... Each>(std::tuple<Each...>*) {
            static_assert((std::is_same_v<Each, M> || ...), "this model is not in the list Models");
            std::size_t at = 0;
            (void)((std::is_same_v<Each, M> || (++at, false)) || ...);
            return at;
        }(static_cast<Models*>(nullptr));
    }
    /// Calls visit.template operator()<M>() for each model M of the list `Models`, in order.
    template <class Visitor>
    static constexpr void for_each_type(Visitor&& visit) {
        [&]<class... M>(std::tuple<M...>*) {
            (visit.template operator()<M>(), ...);
        }(static_cast<Models*>(nullptr));
    }
    /// Names of all models of the list `Models`, in order.
    static std::vector<std::string> names() {
        std::vector<std::string> out;
        for_each_type([&]<class M>() { out.emplace_back(M::name); });
        return out;
    }

    /// Index of the chosen model in the list `Models`, from 0.
    std::size_t model = place_of<Default>();
    /// Parameters of each listed model, one struct for each.
    Models parameters = {};

    /// Parameters of the model M if it is chosen; otherwise null.
    template <class M>
    const M* as() const {
        return model == place_of<M>() ? &std::get<M>(parameters) : nullptr;
    }
    /// Calls visit(parameters, is_chosen) for each model of the list `Models`, in order.
    template <class Visitor>
    void for_each(Visitor&& visit) const {
        std::size_t at = 0;
        std::apply([&](const auto&... each) { (visit(each, at++ == model), ...); }, parameters);
    }
    template <class Visitor>
    void for_each(Visitor&& visit) {
        std::size_t at = 0;
        std::apply([&](auto&... each) { (visit(each, at++ == model), ...); }, parameters);
    }
    /// Name of the chosen model.
    std::string_view name() const {
        std::string_view out;
        for_each([&]<class M>(const M&, bool chosen) {
            if (chosen) out = M::name;
        });
        return out;
    }
    /// Object of the chosen model, made with its parameters.
    /// @throws std::invalid_argument if a parameter is out of its range
    Any make() const {
        std::optional<Any> made;
        for_each([&](const auto& each, bool chosen) {
            if (chosen) made.emplace(each);
        });
        return std::move(*made);
    }
};

/// Whether the model M has a parameter with this key.
template <Described M>
constexpr bool has_key(std::string_view key) {
    bool has = false;
    for_each_field<M>([&](const auto& f) { has = has || f.name == key; });
    return has;
}

/// Converts a model choice to a table: the inverse of read_model(). The table has the chosen model
/// with its parameters, and the parameters of other models that differ from their defaults.
template <class... Choice>
Table chosen_document(const ModelChoice<Choice...>& choice, std::string_view key = "model") {
    Table table;
    choice.for_each([&]<class M>(const M& each, bool chosen) {
        if (!chosen) return;
        table.set(key, M::name);
        append_fields(table, each);
    });
    choice.for_each([&]<class M>(const M& each, bool) {
        Table given, defaults;
        append_fields(given, each);
        append_fields(defaults, M{});
        append_differing(table, given, defaults);
    });
    return table;
}

/// Converts a model choice to a table: the inverse of read_model(). The table has the chosen model
/// and the parameters of all models. A key shared by models has the value of the chosen model.
template <class... Choice>
Table whole_document(const ModelChoice<Choice...>& choice) {
    const Table chosen = chosen_document(choice);
    Table table;
    table.set("model", choice.name());
    choice.for_each([&](const auto& each, bool) {
        Table all;
        append_fields(all, each);
        for (const Entry& entry : all.entries) {
            const Value* decided = chosen.find(entry.key);
            table.set(entry.key, decided ? *decided : entry.value);
        }
    });
    return table;
}

}  // namespace rovernet
