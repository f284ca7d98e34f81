// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Member of a ROS message: "float64[36] covariance".
struct RosMember {
    std::string type;  ///< type of one element of the member: "float64"
    std::string name;
    std::optional<int> elements;  ///< number of elements of an array; 0: variable; none: no array
};

/// Message type with its definition: lines of "type name", as in .msg files.
struct RosType {
    std::string_view name, definition;

    std::vector<RosMember> members() const;
};

/// ROS message type with this name, "pkg/Type"; null if this server does not use it.
const RosType* find_type(std::string_view name);
/// A ROS message type and all types nested in it, the type itself first, each once.
std::vector<const RosType*> types_within(const RosType& type);

}  // namespace rovernet
