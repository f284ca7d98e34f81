// SPDX-License-Identifier: MIT
#include "sim/fields.hpp"

#include "sim/out_of_range.hpp"

#include <fmt/format.h>

namespace rovernet {

void throw_out_of_range(std::string_view owner, std::string_view name, std::string_view range,
                        double got) {
    if (got != got) {
        throw OutOfRange(
            name, fmt::format("{}: {} must be given; expected a value {}", owner, name, range));
    }
    throw OutOfRange(name, fmt::format("{}: {} must be {}, got {}", owner, name, range, got));
}

}  // namespace rovernet
