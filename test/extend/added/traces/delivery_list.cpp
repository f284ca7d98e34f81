// SPDX-License-Identifier: MIT
#include "traces/delivery_list.hpp"

#include <fmt/format.h>

namespace rovernet {

void DeliveryList::begin(const RunInfo& run) {
    name_ = run.name;
    file_.write("time_s,robot,from,hops\n");
}

void DeliveryList::on(const Record& record, const RecordContext& context) {
    const auto& received = std::get<Received>(record);
    const Message& message = context.messages[received.frame.message];
    for (const Reception& r : received.receptions) {
        if (!r.delivered) continue;
        file_.write(fmt::format("{:.9f},{},{},{}\n", seconds(r.time), name_(r.node),
                                name_(message.origin), received.frame.hops));
    }
}

}  // namespace rovernet
