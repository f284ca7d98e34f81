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

// Movement files as a scenario file names them:
//
//     [movement]
//     file = "scen-50-400-600.tcl"

namespace rovernet {

/// Words of [movement] syntax.
template <>
struct EnumNames<MovementSyntax> {
    static constexpr std::array<std::string_view, 2> values = {"strict", "tolerant"};
};

/// [movement]: a file of other programs that moves the robots which it names. It needs no [[robot]]
/// for them. read_scenario() reads the file through once, so that every mistake in it shows then;
/// play() of experiment/movement_play.hpp plays it in the run.
struct MovementTable {
    /// Movement file of ns-2, BonnMotion or SUMO, relative to the scenario file; none: no robot is
    /// moved so.
    std::optional<std::string> file;
    /// Strictness with which it is read.
    MovementSyntax syntax = MovementSyntax::strict;
    /// Robots that the file names, with their starts [m]; empty without a file. Not a key.
    std::vector<FileRobot> robots = {};
    /// Place of the key `file`, for errors.
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
