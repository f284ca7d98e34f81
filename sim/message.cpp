// SPDX-License-Identifier: MIT
#include "sim/message.hpp"

#include <utility>

namespace rovernet {

MessageId MessageTable::add(Message message) {
    MessageId id{static_cast<std::uint32_t>(slots_.size())};
    if (free_.empty()) {
        slots_.emplace_back();
    } else {
        id = free_.back();
        free_.pop_back();
    }
    const NodeId origin = message.origin;
    slots_[id.index()] = {std::move(message), 1, false, 0, origin};
    return id;
}

std::vector<std::pair<MessageId, NodeId>> MessageTable::on_their_way() const {
    std::vector<std::pair<MessageId, NodeId>> all;
    for (MessageId id{0}; id.index() < slots_.size(); ++id.value) {
        const auto& [message, holders, has_ended, first_ttl, at] = slots_[id.index()];
        const bool is_brought =
            message.is_routed && message.to != everyone && !message.is_routing_packet();
        if (holders > 0 && (is_brought ? at != message.to : !has_ended)) all.emplace_back(id, at);
    }
    return all;
}

}  // namespace rovernet
