// SPDX-License-Identifier: MIT
// The flood of bench/peers in rovernet, for bench/peers/run: prints one line of JSON.
//   --movement=FILE --model=threshold|csma|csma_collision --header=36 --messages=20 --interval=3
//   --ttl=100 --jitter=0.05
//   --loss=two_ray --payload=64 --seed=1 --cca_us=13 --turnaround_us=5
//   --eifs=standard|ns2
// The loss is log-distance from the crossover on, of the same levels, unless it is two_ray.
// threshold: a disc of 250 m. csma: 802.11b at 1 Mb/s over flat ground as ns-2 has it by default
// (250 m decoded, 550 m sensed), with noise, interference and bit errors; csma_collision: with
// ns-2's rule of reception instead. The header is that of 802.11 and LLC (ns-2: 34).

#include "bench/peers/peer.hpp"
#include "bench/peers/usage.hpp"
#include "experiment/movement_play.hpp"
#include "mobility/files/movement_file.hpp"
#include "models/access/list.hpp"
#include "models/propagation/disc.hpp"
#include "models/propagation/log_distance.hpp"
#include "models/propagation/two_ray.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"
#include "routing/flood.hpp"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

using namespace rovernet;

namespace {

struct Count {
    std::uint64_t transmissions = 0, receptions = 0;
    std::map<std::uint64_t, std::uint64_t> delivered = {};  // by message

    KindMask kinds() const {
        return kind_of<Sent>() | kind_of<Transmitted>() | kind_of<Received>();
    }
    void on(const Record& record, const RecordContext& context) {
        if (const auto* sent = std::get_if<Sent>(&record)) {
            delivered[context.messages[sent->message].uid] = 0;
        } else if (std::holds_alternative<Transmitted>(record)) {
            ++transmissions;
        } else {
            const auto& r = std::get<Received>(record);
            const std::uint64_t uid = context.messages[r.frame.message].uid;
            for (const Reception& each : r.receptions) {
                receptions += is_decoded(each.fate);
                if (each.delivered) ++delivered[uid];
            }
        }
    }
};

/// The two-ray model beyond its crossover at 4 pi h^2 / wavelength; nobody cares below.
constexpr Meters crossover{86.20219};

NetworkSettings settings(const Options& options, bool listens) {
    NetworkSettings out{.seed = static_cast<std::uint64_t>(options.number("seed", 1)),
                        .metrics = false};
    if (listens) {
        out.propagation =
            LogDistance{.exponent = 4, .sigma = Db{0}, .reference_distance = crossover};
        if (options.text("loss", "") == "two_ray") out.propagation = TwoRay{};
        if (options.text("model", "") == "csma") {
            out.reception = Sinr{};
        } else {
            out.reception = Collision{};
        }
        Csma csma{.header = static_cast<std::uint32_t>(options.number("header", 36))};
        if (options.text("eifs", "standard") == "ns2") csma.eifs = EifsRule::ns2;
        const auto us = [&](const char* name, Duration otherwise) {
            return from_seconds(1e-6 * options.number(name, 1e6 * seconds(otherwise)));
        };
        csma.cca_time = us("cca_us", csma.timing().cca_time);
        csma.turnaround = us("turnaround_us", csma.timing().turnaround);
        out.access = csma;
    } else {
        out.propagation = Disc{.range = {250}};
    }
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    const Options options(argc, argv);
    const bool listens = options.text("model", "threshold").starts_with("csma");
    const Usage begin = Usage::now();
    Network net(settings(options, listens));
    MovementFile file(options.text("movement", ""), MovementSyntax::tolerant);
    std::vector<NodeId> nodes;
    net.reserve(file.robots().size());
    for (const FileRobot& robot : file.robots()) {
        Radio radio = listens ? ns2_radio() : Radio{.rate = {1e6}};
        radio.antenna_height = {1.5};
        nodes.push_back(net.add({.name = robot.name, .at = robot.start, .radio = radio}));
    }
    const auto count = nodes.size();
    play(net, std::move(file), nodes);
    net.route(Flood{.ttl = static_cast<int>(options.number("ttl", 100)),
                    .upgrade = false,
                    .jitter = from_seconds(options.number("jitter", 0.05))});
    const auto tally = std::make_shared<Count>();
    net.add_sink(Sink{tally});
    const int messages = static_cast<int>(options.number("messages", 20));
    const double interval = options.number("interval", 3);
    const auto payload = static_cast<std::uint32_t>(options.number("payload", 64));
    for (int k = 0; k < messages; ++k) {
        const NodeId from = nodes[static_cast<std::size_t>(37 * k) % count];
        net.at(start_of_run + from_seconds(1 + k * interval),
               [&net, from, payload] { net.send(from, everyone, "", {.size = payload}); });
    }
    const Usage ready = Usage::now();
    net.run_until(start_of_run + from_seconds(1 + messages * interval + 5));
    const Usage done = Usage::now();

    std::vector<double> shares;
    double sum = 0;
    for (const auto& [uid, got] : tally->delivered) {
        shares.push_back(static_cast<double>(got) / static_cast<double>(count - 1));
        sum += shares.back();
    }
    fmt::print(
        "{{\"peer\":\"rovernet{}\",\"nodes\":{},\"messages\":{},\"delivery_ratio\":{:.6f},"
        "\"transmissions\":{},\"receptions\":{},\"setup_cpu_s\":{:.6f},\"run_cpu_s\":{:.6f},"
        "\"rss_mb\":{:.1f},\"delivery_by_message\":[{:.6f}]}}\n",
        listens ? "_" + options.text("model", "") : "", count, messages,
        sum / static_cast<double>(shares.size()), tally->transmissions, tally->receptions,
        ready.cpu_s - begin.cpu_s, done.cpu_s - ready.cpu_s, done.rss_mb, fmt::join(shares, ","));
}
