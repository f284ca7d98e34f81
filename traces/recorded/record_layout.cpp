// SPDX-License-Identifier: MIT
#include "traces/record_walk.hpp"
#include "traces/recorded/record_code.hpp"

#include <concepts>
#include <optional>
#include <span>
#include <type_traits>

namespace rovernet {
namespace {

/// Layout of the bytes of a field with that name; see record_code.hpp for the letters.
template <class T>
std::string layout_of(std::string_view name) {
    const auto named = [&](std::string_view letters) {
        return std::string(name) + ':' + std::string(letters);
    };
    if constexpr (std::same_as<T, Leg>) {
        return "start:z(after this time) end:v(0 never, else + 1 - start) from:3d "
               "parts:b(1 velocity:3d to:3d, 2 heading:d, 4 turning:d; what is left out is 0, `to` "
               "is `from`)";
    } else if constexpr (std::same_as<T, Reception>) {
        return "node:v fate:b(2 fate + delivered)";
    } else if constexpr (std::same_as<T, std::span<const Reception>>) {
        return "n:v n*time:z(after the one before, the first after this time) "
               "n*node:z(after the one before, the first after the sender) n*fate:b(2 fate + "
               "delivered)";
    } else if constexpr (DescribedPart<T>) {
        std::string all;
        for_each_recorded<T>([&]<class S, class M, FieldUse use>(const RecordField<S, M, use>& f) {
            using Stored = std::conditional_t<(use & or_everyone) != 0, std::optional<M>, M>;
            if (!all.empty()) all += ' ';
            all += layout_of<Stored>(f.name);
        });
        return all;
    } else if constexpr (std::same_as<T, std::optional<NodeId>>) {
        return named("node?");
    } else if constexpr (requires(T value) { value.has_value(); }) {
        return named("v(0 unknown, else + 1)");
    } else if constexpr (std::same_as<T, Vec3>) {
        return named("3d");
    } else if constexpr (std::same_as<T, Time>) {
        return named("z(after this time)");
    } else if constexpr (OneByte<T> || std::same_as<T, const ControlFrame*>) {
        return named("b");
    } else if constexpr (std::same_as<T, double> || Quantitative<T>) {
        return named("d");
    } else {
        return named(std::same_as<T, Duration> || std::signed_integral<T> ? "z" : "v");
    }
}

}  // namespace

std::vector<RecordedKind> recorded_kinds() {
    std::vector<RecordedKind> kinds{
        {"Message",
         "slot:v uid:v origin:v number:v to:node? size:v created:z(before this time) flow:v "
         "is_routed:b port:v kind:s payload:s"}};
    const auto add = [&]<class... R>(RecordList<R...>) {
        (kinds.push_back({R::name, layout_of<R>({})}), ...);
    };
    add(RecordKinds{});
    return kinds;
}

RecordedKind recorded_header() {
    return {"Header", "protocol:s bytes:s(of the next AirSent; addresses are robots)"};
}

}  // namespace rovernet
