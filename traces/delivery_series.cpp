// SPDX-License-Identifier: MIT
#include "traces/delivery_series.hpp"

#include <algorithm>

namespace rovernet {

void DeliverySeries::on(const Record& record, const RecordContext& context) {
    if (const auto* sent = std::get_if<Sent>(&record)) {
        const std::size_t slot = sent->message.index();
        if (slot >= known_.size()) known_.resize(slot + 1);
        known_[slot] = {context.messages[sent->message].uid, sent_.size()};
        sent_.push_back(sent->time);
        others_.push_back(std::max(sent->robots, 1U) - 1);
        deliveries_.push_back(0);
    } else if (const auto* received = std::get_if<Received>(&record)) {
        const MessageId message = received->frame.message;
        if (message.index() >= known_.size()) return;
        const Known& known = known_[message.index()];
        if (known.uid != context.messages[message].uid) return;
        for (const Reception& rx : received->receptions) {
            deliveries_[known.place] += rx.delivered ? 1 : 0;
        }
    }
}

std::vector<double> DeliverySeries::delivered() const {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < sent_.size(); ++i) {
        ratios.push_back(others_[i] == 0 ? 0.0 : static_cast<double>(deliveries_[i]) / others_[i]);
    }
    return ratios;
}

}  // namespace rovernet
