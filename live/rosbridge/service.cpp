// SPDX-License-Identifier: MIT
#include "live/rosbridge/service.hpp"

#include "live/rosbridge/topic.hpp"
#include "network/network.hpp"

namespace rovernet {

std::optional<RosService> find_service(std::string_view name, const Network& network) {
    name = plain_name(name);
    for (const RosServiceType& type : ros_services) {
        if (!type.is_of_robot && name == type.name) return RosService{&type};
        if (!type.is_of_robot) continue;
        if (const auto robot = robot_before(name, type.name, network)) {
            return RosService{&type, *robot};
        }
    }
    return std::nullopt;
}

}  // namespace rovernet
