// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/ids.hpp"

namespace rovernet {

/// Command to switch the robot's radio on or off.
struct RadioCommand {
    static constexpr std::string_view name = "radio";

    bool is_on = true;  ///< false: the radio neither sends nor receives

    static constexpr auto fields() {
        return describe(field("radio", &RadioCommand::is_on, "whether the radio is on"));
    }
    void carry_out(auto& robots, NodeId robot) const {
        is_on ? robots.network().switch_on(robot) : robots.network().switch_off(robot);
    }
};

}  // namespace rovernet
