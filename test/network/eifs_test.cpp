// SPDX-License-Identifier: MIT
// The time of the next access after a frame that a station did not get, to the nanosecond. Frames
// go at 11 Mb/s behind 192 us: 1000 bytes and the header are on air for 940 us.
#include "models/access/list.hpp"
#include "models/propagation/two_ray.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace eifs_test {
using namespace rovernet;

namespace {

using namespace std::chrono_literals;

constexpr Duration difs = 50us;
constexpr Duration eifs = 10us + 304us + 50us;  // SIFS, the ACK at 1 Mb/s, DIFS

/// Keeps when a node last began to send.
struct LastBegin {
    NodeId node;
    Time time = start_of_run;
    KindMask kinds() const { return kind_of<Transmitted>(); }
    void on(const Record& record, const RecordContext&) {
        const auto& sent = std::get<Transmitted>(record);
        if (sent.frame.sender == node) time = sent.time;
    }
};

/// Station at 0 that wants to send while others do. Over flat ground it decodes frames up to 250 m
/// away. No backoff has a slot, and frames arrive at once.
struct Listener {
    Network net;
    std::shared_ptr<LastBegin> last = std::make_shared<LastBegin>();

    explicit Listener(EifsRule rule, ReceptionModel reception = Sinr{}, double sense = 250)
        : net({.propagation = TwoRay{},
               .reception = reception,
               .access = access(rule),
               .propagation_delay = false,
               .metrics = false}),
          sense_(sense) {
        last->node = add(0);
        net.add_sink(Sink{last});
    }
    NodeId add(double x) {
        Radio radio{.power = Dbm{24.49999779}, .sensitivity = Dbm{-64.37439}, .frequency = {914e6}};
        radio.carrier_sense_threshold = radio.sensitivity - Db{40 * std::log10(sense_ / 250)};
        radio.rate = {11e6};
        radio.antenna_height = {1.5};
        return net.add({.name = {}, .at = {x, 0}, .radio = radio});
    }
    /// `node` asks for the medium at `t`: a DIFS later its frame is on air, if it senses nothing.
    void ask(NodeId node, Duration t, std::uint32_t bytes, NodeId to = everyone) {
        net.at(start_of_run + t, [this, node, bytes, to] {
            net.send(node, to, "", {.size = bytes, .one_hop = true});
        });
    }
    /// Time [ns] from `end` to the begin of the station's next frame.
    Duration waits(Duration end) {
        net.run_for(100ms);
        return last->time - (start_of_run + end);
    }

  private:
    static Csma access(EifsRule rule) {
        return {.cca_time = 13us,
                .turnaround = 5us,
                .cw_min = 0,
                .cw_max = 0,
                .basic_rates = {{{11e6}}},
                .eifs = rule,
                .immediate_access = true};
    }
    double sense_;
};

/// A frame from 200 m away, 50 to 990 us, and one from 100 m on the other side, from 250 us on:
/// the receiver locks on the first, which the second destroys.
/// @param bytes  of the second frame
void collide(Listener& l, std::uint32_t bytes) {
    const NodeId first = l.add(-200), second = l.add(100);
    l.ask(first, 0us, 1000);
    l.ask(second, 200us, bytes);
    l.ask({0}, 500us, 10);
}

}  // namespace

TEST_CASE("eifs: after a frame whose reception began but failed, an EIFS is required") {
    for (const auto& [rule, expected] : {std::pair{EifsRule::standard, eifs},
                                         {EifsRule::ns2, eifs + difs},
                                         {EifsRule::none, difs}}) {
        for (const ReceptionModel& model : {ReceptionModel{Sinr{}}, ReceptionModel{Collision{}}}) {
            Listener l(rule, model);
            collide(l, 200);  // over before the first is
            CHECK(l.waits(990us) == expected);
        }
    }
}

TEST_CASE(
    "eifs: if a frame began while the receiver was locked, only the ns-2 rule requires an EIFS") {
    for (const auto& [rule, expected] : {std::pair{EifsRule::standard, difs},
                                         {EifsRule::ns2, eifs + difs},
                                         {EifsRule::none, difs}}) {
        Listener l(rule);
        collide(l, 2000);  // until 1917 us, long after the EIFS of the first
        CHECK(l.waits(250us + 192us + 1475us) == expected);
    }
}

TEST_CASE("eifs: after an undetected preamble, only the ns-2 rule requires an EIFS") {
    for (const auto& [rule, expected] : {std::pair{EifsRule::standard, difs},
                                         {EifsRule::ns2, eifs + difs},
                                         {EifsRule::none, difs}}) {
        Listener l(rule);
        const NodeId left = l.add(-150), right = l.add(150);  // equally strong
        l.ask(left, 0us, 1000);
        l.ask(right, 0us, 1000);
        l.ask({0}, 500us, 10);
        CHECK(l.waits(990us) == expected);
    }
}

TEST_CASE(
    "eifs: if a frame began while the station was sending, only the ns-2 rule requires an EIFS") {
    for (const auto& [rule, expected] : {std::pair{EifsRule::standard, difs},
                                         {EifsRule::ns2, eifs + difs},
                                         {EifsRule::none, difs}}) {
        Listener l(rule);
        const NodeId other = l.add(-200);
        l.ask({0}, 0us, 10);
        l.ask(other, 0us, 1000);
        l.ask({0}, 500us, 10);
        CHECK(l.waits(990us) == expected);
    }
}

TEST_CASE(
    "eifs: if a station abandons a frame to send an acknowledgement, only the ns-2 rule requires "
    "an EIFS") {
    for (const auto& [rule, expected] : {std::pair{EifsRule::standard, difs},
                                         {EifsRule::ns2, eifs + difs},
                                         {EifsRule::none, difs}}) {
        Listener l(rule);
        const NodeId asker = l.add(100), other = l.add(-200);
        l.ask(asker, 0us, 1000, {0});  // until 990 us; the acknowledgement begins at 1000 us
        l.ask(other, 945us, 1000);     // from 995 us on
        l.ask({0}, 1500us, 10);
        CHECK(l.waits(995us + 940us) == expected);
    }
}

TEST_CASE("eifs: if a frame ends while the station is sending, only a DIFS is required") {
    for (const double x : {-200.0, -400.0}) {  // decodable, and sensed only
        for (const EifsRule rule : {EifsRule::standard, EifsRule::ns2}) {
            Listener l(rule, Sinr{}, 550);
            const NodeId other = l.add(x);
            l.ask({0}, 0us, 1100);  // until 1063 us
            l.ask(other, 0us, 1000);
            l.ask({0}, 500us, 10);
            CHECK(l.waits(50us + 192us + 821us) == difs);
        }
    }
}

TEST_CASE("eifs: after a frame too weak to decode, only the ns-2 rule requires an EIFS") {
    for (const auto& [rule, expected] : {std::pair{EifsRule::standard, difs},
                                         {EifsRule::ns2, eifs + difs},
                                         {EifsRule::none, difs}}) {
        for (const ReceptionModel& model : {ReceptionModel{Sinr{}}, ReceptionModel{Collision{}}}) {
            Listener l(rule, model, 550);
            const NodeId far = l.add(400);
            l.ask(far, 0us, 1000);
            l.ask({0}, 500us, 10);
            CHECK(l.waits(990us) == expected);
        }
    }
}

TEST_CASE("eifs: a frame without errors ends the EIFS, but not with the rule of ns-2") {
    for (const auto& [rule, expected] :
         {std::pair{EifsRule::standard, 215us + difs}, {EifsRule::ns2, eifs + difs}}) {
        Listener l(rule);
        collide(l, 200);
        const NodeId third = l.add(60);  // does not sense the first
        l.ask(third, 941us, 1);          // from 991 to 1205 us
        CHECK(l.waits(990us) == expected);
    }
}

}  // namespace eifs_test
