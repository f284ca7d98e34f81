// SPDX-License-Identifier: MIT
// Address resolution: requests and replies on air, the one frame that waits, and its ends.
#include "network/arp.hpp"

#include "models/access/list.hpp"
#include "models/propagation/disc.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"
#include "routing/aodv.hpp"
#include "traces/ns2/ns2_trace.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace arp_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// Frames on air and losses, one word each: "REQUEST 0>1", "REPLY 1>0", "data 0>1"; "drop ARP 0".
struct Words {
    std::vector<std::string> all{};

    KindMask kinds() const {
        return kind_of<Transmitted>() | kind_of<Dropped>() | kind_of<Received>();
    }
    void on(const Record& record, const RecordContext& context) {
        const auto name = [&](const Message& message, NodeId from) {
            const std::string_view kind = message.kind;
            const auto blank = kind.find(' ');
            const std::string what(blank == kind.npos ? "data" : kind.substr(blank + 1));
            return what + " " + std::to_string(from.value) + ">" + std::to_string(message.to.value);
        };
        if (const auto* sent = std::get_if<Transmitted>(&record)) {
            all.push_back(name(context.messages[sent->frame.message], sent->frame.sender));
        } else if (const auto* lost = std::get_if<Dropped>(&record)) {
            all.push_back("drop " + std::string(lost->loss().code) + " " +
                          std::to_string(lost->node.value));
        } else if (const auto* got = std::get_if<Received>(&record)) {
            for (const Reception& r : got->receptions) delivered += r.delivered;
        }
    }
    int delivered = 0;
};

/// Robots 200 m apart in a row, with radios of 250 m.
struct Row {
    explicit Row(int robots, ArpSettings arp = {.arp = true})
        : net({.propagation = Disc{.range = {250}}, .access = Csma{}, .arp = arp}) {
        for (int i = 0; i < robots; ++i) net.add({.name = {}, .at = {200.0 * i, 0}});
        net.add_sink(words);
    }
    void say(std::uint32_t from, std::uint32_t to) {
        net.send({from}, {to}, "", {.size = 64, .one_hop = true});
    }
    std::string heard() {
        return fmt::format("{}", fmt::join(std::exchange(words->all, {}), ", "));
    }

    Network net;
    std::shared_ptr<Words> words = std::make_shared<Words>();
};

}  // namespace

TEST_CASE(
    "arp: a robot requests a neighbour's address only once, and the neighbour learns the robot's "
    "address") {
    Row row(3);
    row.say(1, 0);
    row.net.run_for(1s);
    CHECK(row.heard() == "REQUEST 1>0, REPLY 0>1, data 1>0");
    for (const auto& [from, to] : {std::pair{1U, 0U}, {0U, 1U}, {2U, 1U}}) {  // 2 heard the request
        row.say(from, to);
        row.net.run_for(1s);
    }
    CHECK(row.heard() == "data 1>0, data 0>1, data 2>1");
    CHECK(row.words->delivered == 4);
}

TEST_CASE("arp: if ARP is off, no address is requested") {
    Row row(2, {});
    row.say(0, 1);
    row.net.run_for(1s);
    CHECK(row.heard() == "data 0>1");
}

TEST_CASE(
    "arp: only one frame waits for an address, and a later frame replaces the waiting frame") {
    Row row(2);
    row.say(0, 1);
    row.say(0, 1);
    row.net.run_for(1s);
    CHECK(row.heard() == "drop ARP 0, REQUEST 0>1, REPLY 1>0, REQUEST 0>1, REPLY 1>0, data 0>1");
}

TEST_CASE("arp: a neighbour that does not answer gets three requests") {
    Row row(2);
    row.net.switch_off({1});
    row.say(0, 1);
    row.net.run_until(start_of_run + 3 * Arp::answer_time - 1ms);
    CHECK(row.heard() == "REQUEST 0>1, REQUEST 0>1, REQUEST 0>1");
    row.net.run_for(1s);
    CHECK(row.heard() == "drop ARP 0");
    row.net.switch_on({1});
    row.say(0, 1);
    row.net.run_for(1s);
    CHECK(row.heard() == "REQUEST 0>1, REPLY 1>0, data 0>1");
}

TEST_CASE(
    "arp: the fourth frame to a silent neighbour is dropped, and ends the search for the address") {
    Row row(2);
    row.net.switch_off({1});
    for (int i = 0; i < 4; ++i) {
        row.net.at(start_of_run + 100ms * i, [&] { row.say(0, 1); });
    }
    row.net.run_for(10s);
    CHECK(row.heard() ==
          "REQUEST 0>1, drop ARP 0, REQUEST 0>1, drop ARP 0, REQUEST 0>1, drop ARP 0, drop ARP 0");
}

TEST_CASE("arp: an address is forgotten after arp_timeout") {
    Row row(2, {.arp = true, .arp_timeout = 2s});
    row.say(0, 1);
    row.net.run_until(start_of_run + 1900ms);
    row.say(0, 1);
    row.net.run_until(start_of_run + 2100ms);
    CHECK(row.heard() == "REQUEST 0>1, REPLY 1>0, data 0>1, data 0>1");
    row.say(0, 1);
    row.net.run_for(1s);
    CHECK(row.heard() == "REQUEST 0>1, REPLY 1>0, data 0>1");
    CHECK_THROWS_AS(Row(2, {.arp = true, .arp_timeout = Duration{0}}), std::invalid_argument);
}

TEST_CASE("arp: if a robot is switched off, its frame that waits for an address is lost") {
    Row row(2);
    row.net.switch_off({1});
    row.net.run_for(1ms);
    row.say(0, 1);
    row.net.run_for(1s);
    row.net.switch_off({0});
    row.net.switch_on({1});
    row.net.run_for(10s);
    CHECK(row.heard() == "REQUEST 0>1, drop END 0");
}

TEST_CASE(
    "arp: a neighbour that does not answer is reported to the routing protocol as a broken link") {
    Row row(3);
    row.net.route(Aodv{.profile = AodvProfile::ns2, .jitter = {}});
    row.net.send({0}, {2}, "", {.size = 64});
    row.net.run_for(1s);
    CHECK(row.words->delivered == 1);
    row.heard();
    row.net.place({2}, {5000, 0});
    row.net.switch_off({1}), row.net.switch_on({1});  // it forgets what it knew
    row.net.send({0}, {2}, "", {.size = 64});
    row.net.run_for(20s);
    CHECK(row.heard().find("drop NRTE 1") != std::string::npos);
}

TEST_CASE("arp: ns-2 traces have ARP packets only at the MAC, in the format of ns-2") {
    for (const bool is_old : {true, false}) {
        std::string lines;
        Row row(2);
        row.net.add_sink(
            Sink{Ns2Trace([&](std::string_view text) { lines += text; },
                          is_old ? Ns2Format::old_format : Ns2Format::new_format, MacTrace::on)});
        row.say(0, 1);
        row.net.run_for(1s);
        row.net.finish();
        CHECK(lines.find("RTR  --- 1 ARP") == lines.npos);
        const std::string_view request =
            is_old ? "806] ------- [REQUEST 0/0 0/1]\n"
                   : "-Mt 806 -P arp -Po REQUEST -Pms 0 -Ps 0 -Pmd 0 -Pd 1 \n";
        const std::string_view reply =
            is_old ? "806] ------- [REPLY 1/1 0/0]\n"
                   : "-Mt 806 -P arp -Po REPLY -Pms 1 -Ps 1 -Pmd 0 -Pd 0 \n";
        CHECK(lines.find(request) != lines.npos);
        CHECK(lines.find(reply) != lines.npos);
    }
}

}  // namespace arp_test
