// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/list.hpp"
#include "models/propagation/disc.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"
#include "sim/random.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rovernet::bench {

/// Throughput of the access model "aloha" [-]: share of the time in which a frame is received
/// without a collision. Many robots in one place send Poisson traffic to one receiver.
/// @param load  offered load G [-]: mean number of frames that begin in the duration of a frame
/// @param slot  0: pure ALOHA; otherwise the duration of a frame, 1 ms
inline double aloha_throughput(double load, Duration slot, int frames) {
    struct Count {
        std::uint64_t delivered = 0;
        KindMask kinds() const { return kind_of<Received>(); }
        void on(const Record& record, const RecordContext&) {
            for (const Reception& r : std::get<Received>(record).receptions)
                delivered += r.delivered;
        }
    };
    constexpr std::uint32_t robots = 200;
    static constexpr std::uint32_t bytes = 125;  // airtime of 1 ms at 1 Mb/s
    constexpr double frame = 1e-3;
    Network net({.propagation = Disc{.range = {1}},
                 .reception = Collision{},
                 .access = Aloha{.slot = slot},
                 .event_limit = ~std::uint64_t{0},
                 .metrics = false});
    const auto count = std::make_shared<Count>();
    net.add_sink(Sink{count});
    const Radio receiver{.rate = {1e6}, .preamble = Duration{0}};
    Radio sender = receiver;
    // senders receive nothing, which saves time and does not affect the result
    sender.sensitivity = Dbm{200};
    std::vector<NodeId> nodes = {net.add({.name = "", .at = {}, .radio = receiver})};
    for (std::uint32_t i = 0; i < robots; ++i) {
        nodes.push_back(net.add({.name = "", .at = {}, .radio = sender}));
    }
    Time t = start_of_run;
    for (int i = 0; i < frames; ++i) {
        Key key{.seed = 5, .purpose = Purpose::order, .index = static_cast<std::uint64_t>(i)};
        t += from_seconds(exponential(key) * frame / load);
        key.a = 1;
        const NodeId from = nodes[1 + below(key, robots)];
        net.at(t, [&net, from, to = nodes[0]] { net.send(from, to, "", {.size = bytes}); });
    }
    net.run_until(t + std::chrono::seconds{1});
    return static_cast<double>(count->delivered) * frame / seconds(t);
}

}  // namespace rovernet::bench
