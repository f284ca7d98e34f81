// SPDX-License-Identifier: MIT
#include "live/rosbridge/listener.hpp"

#include "live/rosbridge/front.hpp"

#include <memory>
#include <utility>

namespace rovernet {

FrontListeners rosbridge_listener(const Address& at) {
    return {.entries = {{at, "rosbridge"}},
            .make =
                [](Front::Carrier carrier) {
                    return std::make_unique<RosbridgeFront>(std::move(carrier));
                },
            .is_web = true};
}

}  // namespace rovernet
