// SPDX-License-Identifier: MIT
#include "models/access/list.hpp"
#include "models/propagation/disc.hpp"
#include "models/propagation/two_ray.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"
#include "study/validation/cases/bianchi.hpp"
#include "study/validation/validation_charts.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

// Access to the medium: saturated cells against Bianchi's model, and the time of the next access
// after a frame that was not decoded.

namespace rovernet {
namespace {

using namespace std::chrono_literals;

/// Counts frames that are sent and that get through, and keeps when `node` last began to send.
struct AirCount {
    NodeId node{0};
    double sent = 0, delivered = 0;
    Time begin = start_of_run;

    KindMask kinds() const { return kind_of<Transmitted>() | kind_of<Received>(); }
    void on(const Record& record, const RecordContext&) {
        if (const auto* frame = std::get_if<Transmitted>(&record)) {
            ++sent;
            if (frame->frame.sender == node) begin = frame->time;
            return;
        }
        for (const Reception& r : std::get<Received>(record).receptions) delivered += r.delivered;
    }
};

/// Errors of a cell of `n` saturated stations, relative: of its throughput, and of the share of its
/// frames that collide.
struct CellErrors {
    double throughput, collisions;
};
CellErrors cell_errors(int n) {
    constexpr double length = 200;  // [s], 20,000 frames
    const BianchiCell cell;
    Network net({.propagation = Disc{.range = {1}},
                 .reception = Collision{},
                 .access = cell.csma(),
                 .propagation_delay = false,
                 .event_limit = ~std::uint64_t{0},
                 .metrics = false});
    std::vector<NodeId> nodes;
    for (int i = 0; i < std::max(n, 2); ++i) {
        nodes.push_back(net.add(
            {.name = "", .at = {}, .radio = {.rate = cell.rate, .preamble = cell.preamble}}));
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
        net.at(start_of_run, [&net, from = nodes[i], to = nodes[(i + 1) % nodes.size()]] {
            net.saturate(from, to, BianchiCell::payload);
        });
    }
    const auto count = std::make_shared<AirCount>();
    net.add_sink(Sink{count});
    net.run_for(from_seconds(length));
    const Bianchi theory = cell.theory();
    const double share = count->delivered * theory.payload / (cell.rate.value * length);
    const double alone = std::pow(1 - theory.attempt_probability(n), n - 1);
    return {std::abs(share / theory.throughput(n) - 1),
            std::abs((1 - count->delivered / count->sent) - (1 - alone))};
}

/// Case of a station at 0 that wants to send while others do. Over flat ground frames are decoded
/// up to 250 m; at 11 Mb/s 1000 bytes and their header are on air from 50 to 990 us.
struct Missed {
    EifsRule rule;
    double sense;         ///< [m] up to which frames are sensed
    double first;         ///< [m] place of who sends 1000 bytes from 50 us on
    double second;        ///< [m] place of who sends from 250 us on; 0: nobody does
    std::uint32_t bytes;  ///< that it sends
    Duration expected;    ///< begin of the station's frame
};

Duration next_access(const Missed& c) {
    const Csma csma{.cca_time = 13us,
                    .turnaround = 5us,
                    .cw_min = 0,
                    .cw_max = 0,
                    .basic_rates = {{{11e6}}},
                    .eifs = c.rule,
                    .immediate_access = true};
    Network net({.propagation = TwoRay{},
                 .reception = Sinr{},
                 .access = csma,
                 .propagation_delay = false,
                 .metrics = false});
    Radio radio{.power = Dbm{24.49999779}, .sensitivity = Dbm{-64.37439}, .frequency = {914e6}};
    radio.rate = {11e6};
    radio.antenna_height = {1.5};
    radio.carrier_sense_threshold = radio.sensitivity - Db{40 * std::log10(c.sense / 250)};
    for (const double x : {0.0, c.first, c.second}) {
        net.add({.name = {}, .at = {x, 0}, .radio = radio});
    }
    const auto ask = [&](std::uint32_t node, Duration t, std::uint32_t bytes) {
        net.at(start_of_run + t, [&net, node, bytes] {
            net.send(NodeId{node}, everyone, "", {.size = bytes, .one_hop = true});
        });
    };
    const auto count = std::make_shared<AirCount>();
    net.add_sink(Sink{count});
    ask(1, 0us, 1000);
    if (c.second != 0) ask(2, 200us, c.bytes);
    ask(0, 500us, 10);
    net.run_for(20ms);
    return count->begin - start_of_run;
}

}  // namespace

void check_access(Promises& promises) {
    Promise throughput{
        "throughput of 1 to 20 saturated stations, against Bianchi's model (relative error)", "",
        0.012, 0, 0};
    Promise collisions{
        "share of frames that collide if 1 to 20 stations are saturated, against Bianchi's model",
        "", 0.012, 0, 0};
    for (const int n : {1, 5, 20}) {
        const CellErrors errors = cell_errors(n);
        throughput.add(errors.throughput);
        collisions.add(errors.collisions);
    }
    constexpr Duration difs = 50us, eifs = 10us + 304us + difs;
    Promise access{
        "time at which a station sends after a frame that the station did not decode, against the "
        "rules of EIFS",
        "ns", 0, 0, 0};
    for (const Missed& c : {
             Missed{EifsRule::standard, 250, -200, 100, 200, 990us + eifs},
             Missed{EifsRule::standard, 250, -200, 100, 2000, 1917us + difs},
             Missed{EifsRule::standard, 550, 400, 0, 0, 990us + difs},
             Missed{EifsRule::ns2, 550, 400, 0, 0, 990us + eifs + difs},
             Missed{EifsRule::none, 250, -200, 100, 200, 990us + difs},
         }) {
        access.add(static_cast<double>((next_access(c) - c.expected).count()));
    }
    for (const Promise& each : {throughput, collisions, access}) promises.push_back(each);
}

}  // namespace rovernet
