// SPDX-License-Identifier: MIT
#include "pictures/map/model_text.hpp"

#include "models/medium/shadowed.hpp"
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

/// Appends ": KEY VALUE, KEY VALUE".
template <class T>
void append_text(std::string& text, const T& described) {
    Table parameters;
    append_fields(parameters, described);
    const char* between = ": ";
    for (const auto& entry : parameters.entries) {
        text += fmt::format("{}{} {}", std::exchange(between, ", "), entry.key,
                            value_text(entry.value));
    }
}

}  // namespace

std::string model_text(const Propagation& model) {
    if (const Shadowed* shadowed = model.as<Shadowed>()) {
        std::string text = model_text(shadowed->base()) + ", with shadowing";
        append_text(text, shadowed->shadowing());
        return text;
    }
    std::string text(model.name());
    for_each_model([&]<class M>() {
        if (const M* listed = model.as<M>()) append_text(text, *listed);
    });
    return text;
}

}  // namespace rovernet
