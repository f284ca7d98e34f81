// SPDX-License-Identifier: MIT
#include "sim/message_table.hpp"

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
    slots_[id.index()] = {std::move(message), 1, false, origin};
    return id;
}

}  // namespace rovernet
