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

// Movement files in a scenario file:
//
//     [movement]
//     file = "scen-50-400-600.tcl"

namespace rovernet {

/// Names of MovementSyntax in scenario files: values of the key syntax of [movement].
template <>
struct EnumNames<MovementSyntax> {
    static constexpr std::array<std::string_view, 2> values = {"strict", "tolerant"};
};

/// [movement]: a movement file of another program. Robots named in the file need no [[robot]].
/// read_scenario() reads the whole file once, so that every mistake is reported before the run;
/// play() of experiment/movement_play.hpp moves the robots in the run.
struct MovementTable {
    /// Movement file of ns-2, BonnMotion or SUMO, relative to the scenario file; none: no movement
    /// file.
    std::optional<std::string> file;
    /// Handling of invalid lines in the movement file: an error, or skipped with a notice.
    MovementSyntax syntax = MovementSyntax::strict;
    /// Robots named in the movement file, with their start positions [m]; empty without a file. Not
    /// a key of the table.
    std::vector<FileRobot> robots = {};
    /// File position of the key `file`, for error messages.
    Location where = {};

    static constexpr auto fields() {
        return describe(
            field("file", &MovementTable::file,
                  "movement file of ns-2 (setdest), BonnMotion or SUMO (FCD); it moves the robots "
                  "that it names"),
            field("syntax", &MovementTable::syntax,
                  "strict: a line that cannot be read is an error; tolerant: such lines are "
                  "ignored"));
    }
};

}  // namespace rovernet
