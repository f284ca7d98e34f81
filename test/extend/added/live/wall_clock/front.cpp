// SPDX-License-Identifier: MIT
#include "live/wall_clock/front.hpp"

#include <chrono>
#include <memory>
#include <string>

namespace rovernet {

void WallClockFront::tell() {
    const std::string time = std::to_string(seconds(session_->network().now()));
    for (const Connection each : clients_) carrier_.send(each, time);
    next_ += std::chrono::seconds(1);
}

FrontListeners wall_clock_listener(const Address& at) {
    return {.entries = {{.at = at, .what = "wall clock", .is_web = true}},
            .make = [](Front::Carrier carrier) {
                return std::make_unique<WallClockFront>(std::move(carrier));
            }};
}

}  // namespace rovernet
