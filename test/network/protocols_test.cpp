// SPDX-License-Identifier: MIT
// What holds for every listed routing protocol, over radio: records in the order of time, one end
// for every message, and no effect of ids.
#include "mobility/waypoints.hpp"
#include "models/access/list.hpp"
#include "models/propagation/disc.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"
#include "routing/list.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace protocols_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// Time of the last event in a record, and of the first.
template <class R>
std::pair<Time, Time> span_of(const R& record) {
    if constexpr (requires { record.receptions; }) {
        if (record.receptions.empty()) return {start_of_run, start_of_run};
        return {record.receptions.front().time, record.receptions.back().time};
    } else if constexpr (requires { record.reception; }) {
        return {record.reception.time, record.reception.time};
    } else {
        return {record.time, record.time};
    }
}

/// Sink that checks all records: their order, and what became of each message of an application.
struct Checker {
    KindMask kinds() const { return kind_all & ~kind_links; }
    void on(const Record& record, const RecordContext& context) {
        std::visit(
            [&](const auto& each) {
                const auto [first, end] = span_of(each);
                if (first < last && !(first == end && first == start_of_run)) ++out_of_order;
                last = std::max(last, end);
            },
            record);
        if (const auto* sent = std::get_if<Sent>(&record)) {
            ends[context.messages[sent->message].uid] = 0;
        } else if (const auto* got = std::get_if<Received>(&record)) {
            const Message& message = context.messages[got->frame.message];
            if (!message.is_routed_unicast()) return;
            for (const Reception& r : got->receptions) {
                ends[message.uid] += r.delivered || r.fate == Fate::ttl;
            }
        } else if (const auto* lost = std::get_if<Dropped>(&record)) {
            const Message& message = context.messages[lost->frame.message];
            if (message.is_routed_unicast() && !lost->protocol_decides) ++ends[message.uid];
        }
    }
    Time last = start_of_run;
    int out_of_order = 0;
    /// Ends of each message: deliveries and losses.
    std::map<std::uint64_t, int> ends{};
};

/// A grid of robots 150 m apart, with discs of 200 m; some drive through it, one fails for a time.
std::shared_ptr<Checker> run(Router router, AccessModel access, bool arp) {
    const bool routes = router.traits().routes_unicasts;
    Network net({.propagation = Disc{.range = {200}},
                 .reception = Collision{},
                 .access = std::move(access),
                 .arp = {.arp = arp}});
    for (int i = 0; i < 16; ++i) net.add({.name = {}, .at = {150.0 * (i % 4), 150.0 * (i / 4)}});
    net.route(std::move(router));
    auto checker = std::make_shared<Checker>();
    net.add_sink(checker);
    net.move({5}, ToGoal{.to = {900, 150}, .speed = {20}});
    net.at(start_of_run + 3s, [&] { net.switch_off({10}); });
    net.at(start_of_run + 6s, [&] { net.switch_on({10}); });
    for (int i = 0; i < 40; ++i) {
        net.at(start_of_run + 1s + i * 230ms, [&net, i, routes] {
            const NodeId from{static_cast<std::uint32_t>(i % 3)};
            const NodeId to = routes ? NodeId{static_cast<std::uint32_t>(15 - i % 4)} : everyone;
            net.send(from, to, "", {.size = 64});
        });
    }
    net.run_for(20s);
    net.finish();
    return checker;
}

/// Calls visit(router, access, arp) for every listed protocol under every access model.
template <class Visit>
void for_each_case(Visit visit) {
    const auto with = [&]<class Protocol>(const Protocol& protocol) {
        for (const AccessModel& access : {AccessModel(NoAccess{}), AccessModel(Csma{}),
                                          AccessModel(Csma{.rts_threshold = {0}})}) {
            for (const bool arp : {false, true}) {
                const std::string name(Protocol::name);
                INFO(name, " over ", std::string(access.name()), arp ? " with ARP" : "");
                visit(Router(protocol), access, arp);
            }
        }
    };
    std::apply([&](const auto&... each) { (with(each), ...); }, RoutingProtocols{});
}

}  // namespace

TEST_CASE("protocols: with every routing protocol, records are in the order of time") {
    for_each_case([](Router router, const AccessModel& access, bool arp) {
        CHECK(run(std::move(router), access, arp)->out_of_order == 0);
    });
}

TEST_CASE(
    "protocols: if a protocol routes unicasts, each unicast is delivered or lost exactly once") {
    for_each_case([](Router router, const AccessModel& access, bool arp) {
        const bool routes = router.traits().routes_unicasts;
        const auto checker = run(std::move(router), access, arp);
        CHECK(checker->ends.size() == 40);
        for (const auto& each : checker->ends) {
            INFO("message ", each.first);
            if (routes) CHECK(each.second == 1);
        }
    });
}

TEST_CASE("protocols: without an access model, messages that waited for a route do not collide") {
    for (const bool is_dsr : {false, true}) {
        Network net({.propagation = Disc{.range = {100}}, .reception = Collision{}});
        for (int i = 0; i < 4; ++i) net.add({.name = {}, .at = {80.0 * i, 0, 0}});
        net.route(is_dsr ? Router(Dsr{}) : Router(Aodv{}));
        for (int i = 0; i < 10; ++i) net.send(NodeId{0}, NodeId{3}, "waits");
        net.run_for(20s);
        net.finish();
        CHECK(net.metrics().deliveries == 10);
        CHECK(net.metrics().transmissions == 30);
    }
}

}  // namespace protocols_test
