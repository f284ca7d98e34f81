// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/tables/model_choice.hpp"
#include "scenario/tables/reader.hpp"
#include "sim/out_of_range.hpp"

#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

// Reader of a table that chooses a model of a list, see ModelChoice.

namespace rovernet {

/// Checks that the file gives all parameters of the chosen model that have no default.
/// @param what  kind of the model, for the error message: "propagation model"
/// @throws InputError at `where`, naming the first missing parameter
template <class... Choice>
void check_given(const ModelChoice<Choice...>& choice, std::string_view what, Location where) {
    choice.for_each([&]<class M>(const M& each, bool chosen) {
        for_each_field<M>([&](const auto& f) {
            const auto number = number_in(each.*f.member);
            if (chosen && number && *number != *number)
                throw_not_given(where, what, M::name, f.name, f.meaning);
        });
    });
}

/// Checks that the chosen model can be made: its constructor checks parameters together.
/// @throws InputError at the parameter that the model refuses, or at the table if it lacks the key
template <class... Choice>
void check_made(const ModelChoice<Choice...>& choice, const Value& value) {
    try {
        (void)choice.make();
    } catch (const OutOfRange& error) {
        const Value* given = value.table()->find(error.parameter());
        throw InputError(given ? given->where : value.where, error.what());
    } catch (const std::invalid_argument& error) {
        throw InputError(value.where, error.what());
    }
}

/// Reads the parameters of all models of a choice. The chosen model must accept the values of its
/// keys. One of the other models must accept the value of a key that the chosen model lacks.
template <class... Choice>
void read_parameters(TableReader& table, ModelChoice<Choice...>& out) {
    std::set<std::string_view> accepted;
    out.for_each([&]<class M>(M& each, bool chosen) {
        for_each_field<M>([&](const auto& f) {
            const bool is_read = chosen ? table.read(f.name, each.*f.member, f.range)
                                        : table.read_if_valid(f.name, each.*f.member, f.range);
            if (is_read) accepted.insert(f.name);
        });
    });
    out.for_each([&]<class M>(M& each, bool) {
        for_each_field<M>([&](const auto& f) {
            if (!accepted.contains(f.name)) table.read(f.name, each.*f.member, f.range);
        });
    });
}

/// Reads the chosen model, and the given parameters of all listed models, from a table. A key that
/// several models have sets the parameter of each of these models. The value must be in the range
/// of the chosen model, or, if the chosen model lacks the key, of any model. Every other model
/// ignores a value outside of its range.
/// @param key   key whose value is the name of the model: "model"
/// @param what    kind of the model, for error messages: "propagation model"
/// @param common  described structs whose keys the table has in addition to the models' keys
/// @throws InputError at the first mistake, such as a missing parameter of the chosen model
template <class... Choice, Described... Common>
void read_model(const Value& value, std::string table_name, std::string_view key,
                std::string_view what, ModelChoice<Choice...>& out, Common&... common) {
    TableReader table(value, std::move(table_name));
    table.take(key);
    out.for_each([&]<class M>(const M&, bool) {
        for_each_field<M>([&](const auto& f) { table.take(f.name); });
    });
    table.expect<Common...>();
    if (const Value* word = table.take(key)) out.model = read_choice(*word, what, out.names());
    read_parameters(table, out);
    (table.read_fields(common), ...);
    check_given(out, what, value.where);
    check_made(out, value);
}

}  // namespace rovernet
