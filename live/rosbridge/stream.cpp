// SPDX-License-Identifier: MIT
#include "live/rosbridge/stream.hpp"

#include <algorithm>

namespace rovernet {

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
        if (each.fragment_size) {
            all.fragment_size =
                std::min(*each.fragment_size, all.fragment_size.value_or(*each.fragment_size));
        }
    }
    return all;
}

void RosStream::take(std::string_view message, Time now, const Emit& emit) {
    const RosDelivery rules = delivery();
    if (held_.empty() && now >= free_from_) {
        free_from_ = now + rules.interval;
        return emit(message);
    }
    if (rules.queue_length == 0) return;
    if (held_.size() >= rules.queue_length) held_.pop_front();
    held_.emplace_back(message);
}

void RosStream::go_on(Time now, const Emit& emit) {
    while (!held_.empty() && now >= free_from_) {
        free_from_ = now + delivery().interval;
        const std::string message = std::move(held_.front());
        held_.pop_front();
        emit(message);
    }
}

}  // namespace rovernet
