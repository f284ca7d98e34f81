// SPDX-License-Identifier: MIT
#include "traces/delivery_series.hpp"

#include "test/traces/record_stream.hpp"

#include <doctest/doctest.h>

#include <memory>

namespace delivery_series_test {
using namespace rovernet;
using namespace rovernet::testing;

TEST_CASE("delivery series: packets that no application sent do not change the series") {
    Stream stream;
    const auto series = std::make_shared<DeliverySeries>();
    stream.sinks = {series};
    for (int i = 0; i < 3; ++i) stream.place(Vec3{10.0 * i, 0, 0});
    // A router's own packets, before and between the messages, with the run's uids.
    const auto own = [&](std::uint64_t uid) {
        return stream.messages.add(
            {.origin = NodeId{1}, .uid = uid, .created = at(0), .payload = {}});
    };
    stream.receive(frame(own(100), NodeId{1}, 1, 1), {{at(10), NodeId{0}, Fate::waiting, true}});
    const auto first = stream.send(at(1'000), NodeId{0}, 1);
    stream.receive(frame(own(101), NodeId{1}, 1, 1), {{at(1'100), NodeId{0}, Fate::arrived, true}});
    stream.receive(frame(first, NodeId{0}, 1, 1), {{at(1'500), NodeId{1}, Fate::waiting, true}});
    stream.messages.release(first);
    const auto reused = own(102);  // takes the place of the message in the table
    CHECK(reused == first);
    stream.receive(frame(reused, NodeId{1}, 1, 1), {{at(1'600), NodeId{2}, Fate::waiting, true}});
    CHECK(series->sent() == std::vector<Time>{at(1'000)});
    CHECK(series->delivered() == std::vector<double>{0.5});
}

}  // namespace delivery_series_test
