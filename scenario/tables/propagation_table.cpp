// SPDX-License-Identifier: MIT
#include "scenario/tables/propagation_table.hpp"

#include "scenario/tables/read_model.hpp"

namespace rovernet {

void read_propagation(const Value& value, PropagationTable& out) {
    read_model(value, "[propagation]", "model", "propagation model", out);
}

Propagation median_propagation(const Value& value) {
    PropagationTable table;
    read_propagation(value, table);
    return table.make().median();
}

}  // namespace rovernet
