// SPDX-License-Identifier: MIT
#include "experiment/replay/ns2_record.hpp"

#include "experiment/run.hpp"
#include "scenario/scenario_file.hpp"
#include "test/traces/record_stream.hpp"
#include "traces/metrics.hpp"
#include "traces/ns2/ns2_reader.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <string>

namespace ns2_record_test {
using namespace rovernet;
using namespace rovernet::testing;

TEST_CASE("an ns-2 trace that is converted to a recorded trace keeps its metrics and positions") {
    const TempFolder folder;
    RunOptions to;
    to.folder = folder / ".";
    run_scenario(load_scenario(ROVERNET_EXAMPLES "/rescue/rescue.toml",
                               {.set = {"trace.ns2=new", "trace.record=true"}}),
                 to);
    const std::string path = folder / "ns2.mcap";
    CHECK(record_ns2_trace(folder / "trace.tr", path, {}).size() == 2);

    const auto of_ns2 = std::make_shared<Metrics>(), of_record = std::make_shared<Metrics>();
    read_ns2_trace(folder / "trace.tr", of_ns2);
    RecordedReader reader(path);
    CHECK(reader.run().robots.size() == 5);
    reader.read(Sink(of_record));
    CHECK(reader.damage().empty());
    const MetricValues a = of_ns2->values(), b = of_record->values();
    CHECK(a.messages > 10);
    CHECK(a.messages == b.messages);
    CHECK(a.transmissions == b.transmissions);
    CHECK(a.receptions == b.receptions);
    CHECK(a.deliveries == b.deliveries);

    // Robots are where they were, to the digits of ns-2; frames last at least their airtime.
    RecordedReader original(folder / "trace.mcap"), again(path);
    std::size_t frames = 0;
    for (const Record* record = nullptr; (record = again.next());) {
        const auto* sent = std::get_if<AirSent>(record);
        if (!sent) continue;
        while (original.now() < sent->time) original.next();
        const NodeId from = sent->air.frame.sender;
        const Vec3 here = again.context().legs.position(from, sent->time);
        const Vec3 there = original.context().legs.position(from, sent->time);
        constexpr double digits = 0.03;  // [m], of positions and speeds in the trace
        CHECK(std::sqrt(squared_distance(here, there)) < digits);
        CHECK((sent->airtime == Duration{0} || sent->airtime > 190us));
        CHECK(sent->airtime < 1ms);
        ++frames;
    }
    CHECK(frames == a.transmissions);
}

TEST_CASE(
    "if an ns-2 trace has no MAC lines, and only then, a notice says that it lacks lost frames") {
    for (const bool mac : {false, true}) {
        CAPTURE(mac);
        const TempFolder folder;
        RunOptions to;
        to.folder = folder / ".";
        run_scenario(load_scenario(ROVERNET_EXAMPLES "/rescue/rescue.toml",
                                   {.set = {"trace.ns2=old", "reception.model=collision",
                                            mac ? "trace.mac=true" : "trace.mac=false"}}),
                     to);
        const auto notices = record_ns2_trace(folder / "trace.tr", folder / "ns2.mcap", {});
        REQUIRE(notices.size() == 2);
        CHECK((notices[1].find("contains no lost frames") == std::string::npos) == mac);
    }
}

}  // namespace ns2_record_test
