// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Member of a ROS message: "float64[36] covariance".
struct RosMember {
    std::string type;  ///< of one element: "float64"
    std::string name;
    std::optional<int> elements;  ///< of an array; 0: any number of them; none: it is no array
};

/// Type of messages and its definition: lines of "type name", as in .msg files.
struct RosType {
    std::string_view name, definition;

    std::vector<RosMember> members() const;
};

/// Type of that name, "pkg/Type"; null if this server has no messages of it.
const RosType* find_type(std::string_view name);
/// A type and all that it has inside, itself first, each once.
std::vector<const RosType*> types_within(const RosType& type);

}  // namespace rovernet
