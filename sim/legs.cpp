// SPDX-License-Identifier: MIT
#include "sim/legs.hpp"

namespace rovernet {

NodeId Legs::add(const Leg& leg) {
    const NodeId node{static_cast<std::uint32_t>(legs_.size())};
    legs_.push_back(leg);
    versions_.push_back(0);
    return node;
}

void Legs::replace(NodeId node, const Leg& leg) {
    legs_[node.index()] = leg;
    ++versions_[node.index()];
}

}  // namespace rovernet
