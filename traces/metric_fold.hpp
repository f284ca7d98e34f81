// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"

#include <optional>
#include <type_traits>

namespace rovernet {

/// Calls visit(name, value) for each metric of a described struct, in order: a count, a number, an
/// optional number, or the DropCounts. The metrics of an optional struct, such as the latency, are
/// visited one by one, each as an optional number.
template <Described T, class Visitor>
void for_each_metric(const T& values, Visitor&& visit) {
    for_each_field<T>([&](const auto& f) {
        const auto& value = values.*f.member;
        if constexpr (requires { std::decay_t<decltype(*value)>::fields(); }) {
            for_each_field<std::decay_t<decltype(*value)>>([&](const auto& part) {
                visit(part.name, value ? std::optional((*value).*part.member) : std::nullopt);
            });
        } else {
            visit(f.name, value);
        }
    });
}

}  // namespace rovernet
