// SPDX-License-Identifier: MIT
#include "scenario/tables/propagation_table.hpp"

#include "scenario/tables/reader.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace rovernet {
namespace {

template <class Visitor>
void for_each_parameters(PropagationModels& parameters, Visitor&& visit) {
    std::apply([&](auto&... each) { (visit(each), ...); }, parameters);
}

std::vector<std::string> model_names() {
    std::vector<std::string> names;
    for_each_model([&]<class M>() { names.emplace_back(M::name); });
    return names;
}

}  // namespace

void read_propagation(const Value& value, PropagationTable& out) {
    TableReader table(value, "[propagation]");
    if (const Value* model = table.take("model")) {
        out.model = read_choice(*model, "propagation model", model_names());
    }
    // Keys of any listed model may stand here, so that a sweep can swap the model.
    for_each_parameters(out.parameters, [&](auto& model) { table.read_fields(model); });
    table.reject_unknown();
    std::size_t index = 0;
    for_each_parameters(out.parameters, [&]<class M>(const M& model) {
        const bool chosen = index++ == out.model;
        for_each_field<M>([&](const auto& f) {
            const auto number = number_in(model.*f.member);
            if (chosen && number && *number != *number) {
                throw InputError(value.where,
                                 fmt::format("propagation model \"{}\" needs the key \"{}\", {}; "
                                             "for example {} = \"50 m\"",
                                             M::name, f.name, f.meaning, f.name));
            }
        });
    });
}

Propagation PropagationTable::make() const {
    std::optional<Propagation> made;
    std::size_t index = 0;
    std::apply(
        [&](const auto&... each) {
            ((index++ == model ? (void)(made.emplace(each)) : void()), ...);
        },
        parameters);
    return std::move(*made);
}

Propagation median_propagation(const Value& value) {
    PropagationTable table;
    read_propagation(value, table);
    return table.make().median();
}

}  // namespace rovernet
