// SPDX-License-Identifier: MIT
#include "live/rosbridge/listener.hpp"

#include "live/rosbridge/front.hpp"

#include <memory>
#include <utility>

namespace rovernet {

FrontListeners rosbridge_listener(const Address& at) {
    return {.entries = {{.at = at, .what = "rosbridge", .is_web = true}},
            .make = [](Front::Carrier carrier) {
                return std::make_unique<RosbridgeFront>(std::move(carrier));
            }};
}

}  // namespace rovernet
