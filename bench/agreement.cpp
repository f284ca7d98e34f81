// SPDX-License-Identifier: MIT
// Saturated cells against theory and against what ns-2 and ns-3 delivered. Prints one line a case;
// exit 1 if one is outside of its band.

#include "bench/aloha.hpp"
#include "bench/broadcast_cell.hpp"
#include "models/access/list.hpp"
#include "models/propagation/disc.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"
#include "study/validation/cases/bianchi.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace rovernet;
using namespace std::chrono_literals;

namespace {

constexpr Duration warm_up = 1s;
int failures = 0;

/// Counts the bits of payload that get through, and the frames.
struct Count {
    std::uint64_t bits = 0, frames = 0, attempts = 0;
    std::uint64_t again = 0;  // frames that get through of those who sent just before, too
    Time round = start_of_run;
    std::set<NodeId> senders = {}, senders_before = {};  // of this round and of the last

    KindMask kinds() const { return kind_of<Transmitted>() | kind_of<Received>(); }
    void on(const Record& record, const RecordContext& context) {
        if (const auto* sent = std::get_if<Transmitted>(&record)) {
            ++attempts;
            if (sent->time > round) senders_before = std::exchange(senders, {});
            round = sent->time;
            senders.insert(sent->frame.sender);
            return;
        }
        const auto& r = std::get<Received>(record);
        for (const Reception& each : r.receptions) {
            if (!each.delivered) continue;
            again += senders_before.contains(r.frame.sender);
            ++frames;
            bits += 8 * context.messages[r.frame.message].size;
        }
    }
};

/// Keeps a message at its receivers: nobody forwards anything.
struct Cell {
    int n;
    Csma csma;
    std::uint32_t payload;  ///< [bytes]
    Radio radio;
    bool broadcast = false;
    std::uint64_t seed = 1;

    Count run(Duration length) const {
        Network net({.seed = seed,
                     .propagation = Disc{.range = {1}},
                     .reception = Collision{},
                     .access = csma,
                     .event_limit = ~std::uint64_t{0},
                     .metrics = false});
        std::vector<NodeId> nodes;
        for (int i = 0; i < n + (n == 1); ++i)
            nodes.push_back(net.add({.name = "", .at = {}, .radio = radio}));
        for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
            const NodeId to = broadcast ? everyone : nodes[(i + 1) % nodes.size()];
            net.at(start_of_run,
                   [&net, from = nodes[i], to, size = payload] { net.saturate(from, to, size); });
        }
        net.run_for(warm_up);
        const auto count = std::make_shared<Count>();
        net.add_sink(Sink{count});
        net.run_for(length);
        return *count;
    }
};

void report(const std::string& what, double ours, double theirs, double band) {
    const double off = ours / theirs - 1;
    const bool good = std::abs(off) <= band;
    failures += !good;
    fmt::print("{:<44} {:>10.5f} {:>10.5f} {:>+8.2f} % of {:.1f} %{}\n", what, ours, theirs,
               100 * off, 100 * band, good ? "" : "  OUTSIDE");
    std::fflush(stdout);
}

void bianchi(Duration length) {
    for (const auto& [window, stages] : {std::pair{32, 3}, std::pair{32, 5}, std::pair{128, 3}}) {
        for (const bool asks : {false, true}) {
            const BianchiCell cell{.window = window, .stages = stages, .asks = asks};
            for (const int n : {1, 2, 5, 10, 20, 50}) {
                const Count got = Cell{.n = n,
                                       .csma = cell.csma(),
                                       .payload = cell.payload,
                                       .radio = {.rate = cell.rate, .preamble = cell.preamble}}
                                      .run(length);
                report(fmt::format("Bianchi W={} m={} n={} {}", window, stages, n,
                                   asks ? "RTS" : "basic"),
                       static_cast<double>(got.bits) / 1e6 / seconds(length),
                       cell.theory().throughput(n), 0.01);
            }
        }
    }
}

/// Delivered packets in 20 s of ns-2.35: 1 Mb/s, 1003 bytes of payload, 1037 at the MAC.
void ns2_unicast(Duration length) {
    struct Row {
        int n;
        double basic, rts;
    };
    for (const Row& row : {Row{1, 2186, 2034}, Row{5, 2006, 2058}, Row{10, 1899, 2053},
                           Row{20, 1725, 2040}, Row{50, 1490, 2008}}) {
        for (const bool asks : {false, true}) {
            const Csma csma{.rts_threshold = asks ? 0U : 100'000U, .header = 34};
            const Count got =
                Cell{.n = row.n, .csma = csma, .payload = 1003, .radio = {.rate = {1e6}}}.run(
                    length);
            report(fmt::format("ns-2 delivered in 20 s, n={} {}", row.n, asks ? "RTS" : "basic"),
                   static_cast<double>(got.frames) * 20 / seconds(length),
                   asks ? row.rts : row.basic, 0.02);
        }
    }
}

/// The share of the time in which payload reaches a station of a cell that sends broadcasts.
/// Peers: bench/peers/measured/cells.csv.
void broadcast(Duration length) {
    struct Row {
        int n;
        double ns2, ns3;
    };
    const BroadcastCell cell{.header = 36};
    for (const Row& row : {Row{2, 0.895, 0.890}, Row{5, 0.812, 0.822}, Row{10, 0.691, 0.699},
                           Row{20, 0.490, 0.498}, Row{50, 0.216, 0.200}}) {
        const Count got = Cell{.n = row.n,
                               .csma = cell.csma(),
                               .payload = cell.payload,
                               .radio = {.rate = cell.rate},
                               .broadcast = true}
                              .run(length);
        const double share = static_cast<double>(got.bits) / (row.n - 1) / 1e6 / seconds(length);
        const double formula = cell.throughput(row.n);
        const std::string name = fmt::format("broadcast n={}", row.n);
        if (row.n <= 10) {
            report(name + ", formula", share, formula, 0.02);
        } else {
            fmt::print("{:<44} {:>10.5f} {:>10.5f}\n", name + ", formula", share, formula);
            report(name + ", ns-2", share, row.ns2, 0.10);
            report(name + ", ns-3", share, row.ns3, 0.10);
            fmt::print("  of them sent by one that sent just before    {:>9.5f}\n",
                       static_cast<double>(got.again) / static_cast<double>(got.frames) * share);
        }
    }
}

/// S = G exp(-2 G), and G exp(-G) with slots.
void aloha() {
    constexpr int frames = 400'000;  // 1 % is 2.5 standard deviations or more
    for (const double load : {0.1, 0.5, 1.0}) {
        report(fmt::format("pure ALOHA, G={}", load), bench::aloha_throughput(load, 0ms, frames),
               load * std::exp(-2 * load), 0.01);
        report(fmt::format("slotted ALOHA, G={}", load), bench::aloha_throughput(load, 1ms, frames),
               load * std::exp(-load), 0.01);
    }
}

}  // namespace

int main(int argc, char** argv) {
    const auto length = std::chrono::seconds{argc > 1 ? std::atoi(argv[1]) : 60};
    if (length < 1s) {
        fmt::print(stderr, "agreement: expected a length [s] of 1 or more, found {}\n", argv[1]);
        return 2;
    }
    fmt::print("{:<44} {:>10} {:>10} {:>10}\n", "", "rovernet", "expected", "off");
    bianchi(length);
    ns2_unicast(length);
    broadcast(length);
    aloha();
    return failures > 0;
}
