// SPDX-License-Identifier: MIT
// The flows of bench/peers in rovernet, for bench/peers/run: prints one line of JSON.
//   --cell=FILE --sense=250 --rate=1 --payload=1000 --seconds=20 --seed=1
//   --reception=collision|collision_later|sinr --eifs=standard|ns2 --header=34
//   --answers=lowest|standard --cca_us=13 --turnaround_us=5
// FILE and what it means: see peers/flows.tcl. Answers go at 1 Mb/s, as in ns-2, or by the
// standard's basic rates, as in ns-3. The header is that of ns-2; of 802.11 and LLC alone it is 36.

#include "bench/peers/peer.hpp"
#include "models/access/list.hpp"
#include "models/propagation/two_ray.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace rovernet;

namespace {

struct CellFile {
    std::vector<Vec3> places = {};
    std::vector<std::pair<std::uint32_t, std::uint32_t>> flows = {};

    explicit CellFile(const std::string& path) {
        std::ifstream file(path);
        std::string what;
        double a = 0, b = 0;
        while (file >> what >> a >> b) {
            if (what == "node") places.push_back({a, b, 0});
            if (what == "flow")
                flows.emplace_back(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
        }
    }
};

/// Counts what each sender got through.
struct Count {
    std::map<NodeId, std::uint64_t> delivered = {};

    KindMask kinds() const { return kind_of<Received>(); }
    void on(const Record& record, const RecordContext&) {
        const auto& received = std::get<Received>(record);
        for (const Reception& r : received.receptions)
            delivered[received.frame.sender] += r.delivered;
    }
};

ReceptionModel reception(const std::string& name) {
    if (name == "sinr") return Sinr{};
    return Collision{.capture =
                         name == "collision_later" ? CaptureOrder::later : CaptureOrder::first};
}

Csma access(const Options& options) {
    Csma csma{.header = static_cast<std::uint32_t>(options.number("header", 34))};
    if (options.text("eifs", "standard") == "ns2") csma.eifs = EifsRule::ns2;
    const auto us = [&](const char* name, Duration otherwise) {
        return from_seconds(1e-6 * options.number(name, 1e6 * seconds(otherwise)));
    };
    csma.cca_time = us("cca_us", csma.timing().cca_time);
    csma.turnaround = us("turnaround_us", csma.timing().turnaround);
    if (options.text("answers", "lowest") == "lowest") csma.basic_rates = {{{1e6}}};
    return csma;
}

Radio radio(const Options& options) {
    Radio radio = ns2_radio();
    // Power falls with the fourth power of the distance.
    const double sense = options.number("sense", 250);
    radio.carrier_sense_threshold = radio.sensitivity - Db{40 * std::log10(sense / 250)};
    radio.rate = {1e6 * options.number("rate", 1)};
    radio.antenna_height = {1.5};
    return radio;
}

}  // namespace

int main(int argc, char** argv) {
    using namespace std::chrono_literals;
    const Options options(argc, argv);
    const CellFile cell(options.text("cell", ""));
    Network net({.seed = static_cast<std::uint64_t>(options.number("seed", 1)),
                 .propagation = TwoRay{},
                 .reception = reception(options.text("reception", "collision")),
                 .access = access(options),
                 .event_limit = ~std::uint64_t{0},
                 .metrics = false});
    for (const Vec3 at : cell.places) net.add({.name = {}, .at = at, .radio = radio(options)});
    const auto payload = static_cast<std::uint32_t>(options.number("payload", 1000));
    for (const auto& [from, to] : cell.flows) {
        net.at(start_of_run, [&net, from = NodeId{from}, to = NodeId{to}, payload] {
            net.saturate(from, to, payload);
        });
    }
    net.run_for(1s);
    const auto count = std::make_shared<Count>();
    net.add_sink(Sink{count});
    const double length = options.number("seconds", 20);
    net.run_for(from_seconds(length));

    std::vector<double> each;
    double sum = 0;
    for (const auto& [from, to] : cell.flows) {
        each.push_back(static_cast<double>(count->delivered[NodeId{from}]) / length);
        sum += each.back();
    }
    fmt::print("{{\"peer\": \"rovernet\", \"frames_per_s\": {:.2f}, \"by_flow\": [{:.2f}]}}\n", sum,
               fmt::join(each, ", "));
}
