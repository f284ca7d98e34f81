// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <string_view>

namespace rovernet {

/// Parsed line of an ns-2 movement file.
struct SetdestLine {
    enum class Kind : std::uint8_t {
        nothing,  ///< blank line, comment, or command to ns-2's object god
        place,    ///< `$node_(i) set X_ v`: position before the run
        jump,     ///< `$ns_ at T "$node_(i) set X_ v"`: jump at time T
        setdest,  ///< `$ns_ at T "$node_(i) setdest x y speed"`: motion from time T on
    };
    Kind kind = Kind::nothing;
    std::uint32_t node = 0;
    Time time = {};
    std::uint8_t axis = 0;  ///< coordinate that `place` or `jump` sets: 0 = X_, 1 = Y_, 2 = Z_
    double x = 0;           ///< x of the goal [m]; `place`, `jump`: value for `axis` [m]
    double y = 0;           ///< y of the goal [m]
    double speed = 0;       ///< speed [m/s]
};

/// Error: a command places or moves a node whose name has no brackets, such as `$n0`. Such names
/// are not read, because `$a0` and `$b0` may be different nodes.
class NoBracketsError : public InputError {
  public:
    using InputError::InputError;
};

/// Parses a line of an ns-2 movement file. @throws InputError if the line is invalid
/// @throws NoBracketsError if only the brackets in the name of the node are missing
SetdestLine parse_setdest_line(std::string_view line, const Location& where);

}  // namespace rovernet
