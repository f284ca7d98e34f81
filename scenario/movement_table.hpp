// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/files/movement_file.hpp"
#include "sim/error.hpp"
#include "sim/fields.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

template <>
struct EnumNames<MovementSyntax> {
    static constexpr std::array<std::string_view, 2> values = {"strict", "tolerant"};
};

/// [movement]
struct MovementTable {
    std::optional<std::string> file;  ///< ns-2, BonnMotion or SUMO movements
    MovementSyntax syntax = MovementSyntax::strict;
    std::vector<FileRobot> robots = {};  ///< that the file names
    Location where = {};

    static constexpr auto fields() {
        return describe(
            field("file", &MovementTable::file,
                  "movements of ns-2 (setdest), BonnMotion or SUMO (FCD), for the robots it names"),
            field("syntax", &MovementTable::syntax,
                  "strict: a line that means nothing is an error; tolerant: it is left out"));
    }
};

}  // namespace rovernet
