// SPDX-License-Identifier: MIT
#include "live/rosbridge/stream.hpp"

#include <algorithm>

namespace rovernet {
namespace {

constexpr std::size_t most_held = std::size_t{256} << 10U;  // [bytes]

}  // namespace

void RosStream::add(const std::string& id, const RosDelivery& delivery) {
    deliveries_[id] = delivery;
}

RosDelivery RosStream::delivery() const {
    if (deliveries_.empty()) return {};
    RosDelivery all = deliveries_.begin()->second;
    for (const auto& [id, each] : deliveries_) {
        all.interval = std::min(all.interval, each.interval);
        all.queue_length = std::min(all.queue_length, each.queue_length);
        all.encoding = std::max(all.encoding, each.encoding);
    }
    return all;
}

void RosStream::take(std::string_view message, Time now, const Emit& emit) {
    const RosDelivery rules = delivery();
    if (held_.empty() && now >= free_from_) {
        free_from_ = now + rules.interval;
        return emit(message);
    }
    held_.emplace_back(message);
    held_bytes_ += message.size();
    while (held_.size() > rules.queue_length || held_bytes_ > most_held) release();
}

/// Takes the oldest message out of those that are held back.
std::string RosStream::release() {
    std::string message = std::move(held_.front());
    held_.pop_front();
    held_bytes_ -= message.size();
    return message;
}

void RosStream::go_on(Time now, const Emit& emit) {
    while (!held_.empty() && now >= free_from_) {
        free_from_ = now + delivery().interval;
        emit(release());
    }
}

}  // namespace rovernet
