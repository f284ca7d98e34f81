// SPDX-License-Identifier: MIT
#pragma once

#include "network/robot.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace rovernet::cli {

/// Words for a robot that is absent or off: ", not departed". Empty for a robot that is on.
inline std::string presence_text(std::string_view presence) {
    if (presence == name_of(Presence::on)) return "";
    std::string text = ", " + std::string(presence);
    std::replace(text.begin(), text.end(), '_', ' ');
    return text;
}

}  // namespace rovernet::cli
