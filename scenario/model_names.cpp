// SPDX-License-Identifier: MIT
#include "scenario/model_names.hpp"

#include "scenario/scenario.hpp"
#include "scenario/tables/value_schema.hpp"

#include <string>
#include <vector>

namespace rovernet {
Table model_names() {
    Table names;
    names.set("propagation", listed(PropagationTable::names()));
    names.set("shadowing", words_of<ShadowingModel>());
    names.set("fading", words_of<FadingModel>());
    names.set("reception", listed(ReceptionTable::names()));
    names.set("access", listed(AccessTable::names()));
    names.set("routing", listed(RoutingTable::names()));
    names.set("move", listed(move_names()));
    return names;
}

}  // namespace rovernet
