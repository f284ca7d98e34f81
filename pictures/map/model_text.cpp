// SPDX-License-Identifier: MIT
#include "pictures/map/model_text.hpp"

#include "models/propagation/list.hpp"
#include "scenario/tables/reader.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <utility>
#include <variant>

namespace rovernet {
namespace {

std::string value_text(const Value& value) {
    if (const std::string* quantity = value.string()) return *quantity;
    if (const auto* number = std::get_if<double>(&value.data)) return fmt::format("{}", *number);
    if (const auto* n = std::get_if<std::int64_t>(&value.data)) return fmt::format("{}", *n);
    return value.description();
}

}  // namespace

std::string model_text(const Propagation& model) {
    std::string text(model.name());
    for_each_model([&]<class M>() {
        const M* listed = model.as<M>();
        if (!listed) return;
        Table parameters;
        append_fields(parameters, *listed);
        const char* between = ": ";
        for (const auto& entry : parameters.entries) {
            text += fmt::format("{}{} {}", std::exchange(between, ", "), entry.key,
                                value_text(entry.value));
        }
    });
    return text;
}

}  // namespace rovernet
