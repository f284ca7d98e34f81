// SPDX-License-Identifier: MIT
// AODV over radio: the small graphs as discs of 250 m, under an ideal MAC and under 802.11 with
// RTS; every message ends once, and records do not go back in time.
#include "models/access/list.hpp"
#include "models/propagation/disc.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"
#include "routing/aodv.hpp"
#include "routing/aodv/aodv_packets.hpp"
#include "traces/metrics.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace aodv_network_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

const std::vector<Vec3> line5{{0, 0}, {200, 0}, {400, 0}, {600, 0}, {800, 0}};
const std::vector<Vec3> diamond{{60, 300}, {250, 430}, {250, 170}, {440, 300}};
const std::vector<Vec3> grid{{0, 0},     {200, 0}, {400, 0},   {0, 200},  {200, 200},
                             {400, 200}, {0, 400}, {200, 400}, {400, 400}};

/// Sink that counts packets by kind, and the ends of each message.
struct Ends {
    std::map<std::string, int> packets{};
    std::map<std::uint64_t, int> delivered{}, dropped{};
    Time last = start_of_run;
    bool in_order = true;

    KindMask kinds() const {
        return kind_of<Transmitted>() | kind_of<Routed>() | kind_of<Received>() |
               kind_of<Dropped>();
    }
    void on(const Record& record, const RecordContext& context) {
        const auto count = [&](const Frame& frame) {
            ++packets[std::string(context.messages[frame.message].kind)];
        };
        const auto at = [&](Time time) {
            in_order = in_order && time >= last;
            last = time;
        };
        if (const auto* sent = std::get_if<Transmitted>(&record)) {
            at(sent->time);
            if (sent->frame.next_hop == everyone) count(sent->frame);
        } else if (const auto* routed = std::get_if<Routed>(&record)) {
            at(routed->time);
            count(routed->frame);
        } else if (const auto* got = std::get_if<Received>(&record)) {
            const Message& message = context.messages[got->frame.message];
            for (const Reception& r : got->receptions) {
                at(r.time);
                if (!message.kind.empty()) continue;
                if (r.delivered) ++delivered[message.uid];
                if (r.fate == Fate::ttl) ++dropped[message.uid];
            }
        } else if (const auto* lost = std::get_if<Dropped>(&record)) {
            at(lost->time);
            const Message& message = context.messages[lost->frame.message];
            const bool ends = message.kind.empty() && !lost->protocol_decides;
            if (ends && lost->reason != DropReason::held) ++dropped[message.uid];
        }
    }
};

struct Run {
    Run(const std::vector<Vec3>& places, std::uint32_t to, std::optional<std::uint32_t> vanishes,
        AccessModel access, Aodv aodv = {}) {
        aodv.jitter = {};
        Network net({.propagation = Disc{.range = {250}}, .access = std::move(access)});
        for (const Vec3& place : places) net.add({.name = {}, .at = place});
        net.route(aodv);
        ends = std::make_shared<Ends>();
        metrics = std::make_shared<Metrics>();
        net.add_sink(ends);
        net.add_sink(metrics);
        for (int i = 0; i < 36; ++i) {
            net.at(start_of_run + 1s + i * 250ms,
                   [&net, to] { net.send({0}, {to}, "", {.size = 64}); });
        }
        net.run_until(start_of_run + 4900ms);
        before = ends->packets;
        if (vanishes) net.switch_off({*vanishes});
        net.run_until(start_of_run + 12s);
        net.finish();
        for (const auto& [kind, count] : ends->packets) after[kind] = count - before[kind];
    }
    int sum(const std::map<std::uint64_t, int>& of) const {
        int all = 0;
        for (const auto& [uid, count] : of) all += count;
        return all;
    }

    std::shared_ptr<Ends> ends;
    std::shared_ptr<Metrics> metrics;
    std::map<std::string, int> before{}, after{};
};

/// Packets of a kind.
int of(const std::map<std::string, int>& packets, std::string_view kind) {
    const auto found = packets.find(std::string(kind));
    return found == packets.end() ? 0 : found->second;
}

void check_ends(const Run& run, int delivered, int lost) {
    CHECK(run.ends->in_order);
    CHECK(run.sum(run.ends->delivered) == delivered);
    CHECK(run.sum(run.ends->dropped) == lost);
    for (const auto& [uid, count] : run.ends->delivered) {
        CHECK(count == 1);
        CHECK_FALSE(run.ends->dropped.contains(uid));
    }
    for (const auto& [uid, count] : run.ends->dropped) CHECK(count == 1);
}

}  // namespace

TEST_CASE(
    "aodv over radio: packet counts equal those on graphs with an ideal MAC, also after a node "
    "vanishes") {
    struct Case {
        const char* name;
        const std::vector<Vec3>& places;
        std::uint32_t to, vanishes;
        std::vector<int> before, after;  // RREQ, RREP, RERR, messages
        int delivered, lost;
    };
    const std::vector<Case> cases{{"line", line5, 4, 3, {8, 4, 0, 64}, {9, 0, 2, 3}, 16, 1},
                                  {"diamond", diamond, 3, 1, {4, 2, 0, 32}, {2, 2, 0, 39}, 35, 1},
                                  {"grid", grid, 8, 5, {15, 4, 0, 64}, {7, 4, 2, 79}, 35, 1}};
    for (const Case& each : cases) {
        CAPTURE(each.name);
        const Run run(each.places, each.to, each.vanishes, NoAccess{});
        const auto counts = [](const std::map<std::string, int>& p) {
            return std::vector<int>{of(p, aodv::request_kind), of(p, aodv::reply_kind),
                                    of(p, aodv::error_kind), of(p, "")};
        };
        CHECK(counts(run.before) == each.before);
        CHECK(counts(run.after) == each.after);
        check_ends(run, each.delivered, each.lost);
        const MetricValues metrics = run.metrics->values();
        REQUIRE(metrics.routing);
        const std::vector<int> b = counts(run.before), a = counts(run.after);
        CHECK(metrics.routing->packets ==
              static_cast<std::uint64_t>(b[0] + b[1] + b[2] + a[0] + a[1] + a[2]));
        CHECK(metrics.routed->data == static_cast<std::uint64_t>(b[3] + a[3]));
        CHECK(metrics.messages == 36);
        CHECK(metrics.delivery_ratio == doctest::Approx(each.delivered / 36.0));
    }
}

TEST_CASE("aodv over radio: with 802.11 and RTS, packet counts equal those of ns-2.35") {
    const Run run(line5, 4, 3, Csma{.rts_threshold = 0}, {.profile = AodvProfile::ns2});
    CHECK(of(run.before, aodv::request_kind) == 4);
    CHECK(of(run.before, aodv::reply_kind) == 4);
    CHECK(of(run.after, aodv::request_kind) == 18);
    CHECK(of(run.after, aodv::error_kind) == 2);
    check_ends(run, 16, 12);  // eleven waited until the search failed
}

}  // namespace aodv_network_test
