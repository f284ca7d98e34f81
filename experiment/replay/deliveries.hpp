// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <compare>
#include <cstdint>
#include <tuple>
#include <variant>
#include <vector>

namespace rovernet {

/// Delivery of an application's message to a robot. A message has the same origin and number in
/// every run of a scenario, so that the deliveries in two runs can be compared.
struct Delivery {
    NodeId origin;
    std::uint32_t number;  ///< number of the message among the messages of its origin, from 0
    NodeId at;
    Time sent;

    /// Compares deliveries by message (origin, number), then by receiver; `sent` is ignored.
    friend auto operator<=>(const Delivery& a, const Delivery& b) {
        return std::tie(a.origin, a.number, a.at) <=> std::tie(b.origin, b.number, b.at);
    }
    friend bool operator==(const Delivery& a, const Delivery& b) { return (a <=> b) == 0; }
};

/// Calls use(delivery, reception) for each reception of an application's message in a record. The
/// delivery describes the reception as if the message were delivered; the fate in `reception`
/// states whether it was.
template <class Use>
void for_each_reception(const Record& record, const RecordContext& context, Use use) {
    const auto* received = std::get_if<Received>(&record);
    if (!received) return;
    const Message& message = context.messages[received->frame.message];
    if (!message.kind.empty()) return;
    for (const Reception& each : received->receptions)
        use(Delivery{message.origin, message.number, each.node, message.created}, each);
}

/// Sink that stores every delivery of an application's message, in order of time. Memory: 24 bytes
/// for each delivery.
struct Deliveries {
    std::vector<Delivery> all = {};

    KindMask kinds() const { return kind_of<Received>(); }
    void on(const Record& record, const RecordContext& context) {
        for_each_reception(record, context, [&](const Delivery& delivery, const Reception& each) {
            if (each.delivered) all.push_back(delivery);
        });
    }
};

}  // namespace rovernet
