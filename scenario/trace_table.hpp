// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"

#include <array>
#include <string_view>

namespace rovernet {

/// [trace]
enum class Ns2Choice { none, old_format, new_format };
template <>
struct EnumNames<Ns2Choice> {
    static constexpr std::array<std::string_view, 3> values = {"none", "old", "new"};
};
struct TraceTable {
    Ns2Choice ns2 = Ns2Choice::none;
    bool mac = false;  ///< lines of the MAC layer, too

    static constexpr auto fields() {
        return describe(field("ns2", &TraceTable::ns2, "wireless trace format of ns-2.35"),
                        field("mac", &TraceTable::mac, "lines of the MAC layer in it, too"));
    }
};

}  // namespace rovernet
