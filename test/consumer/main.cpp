// SPDX-License-Identifier: MIT
// What a user of the installed package may write: a propagation model, a router and a sink of their
// own, as plain structs, without rebuilding the library.
#include <fmt/format.h>

#include <rovernet.hpp>

using namespace rovernet;
using namespace std::chrono_literals;

/// A decibel per metre.
struct Fog {
    static constexpr std::string_view name = "fog";

    void loss(const LinkBatch& links, Db /*give_up*/, std::span<double> out_db) const {
        for (std::size_t i = 0; i < out_db.size(); ++i) out_db[i] = links.distance(i);
    }
};

/// One hop and no more.
struct Shout {
    std::uint8_t initial_ttl() const { return 1; }
    void send(LinkLayer& link, NodeId node, MessageId message) {
        link.send({.message = message, .sender = node, .ttl = 1, .hops = 1}, {}, link.now());
    }
    void on_receive(LinkLayer&, const Frame&, std::span<Reception> receptions) {
        for (auto& reception : receptions) {
            reception.delivered = true;
            reception.fate = Fate::ttl;
        }
    }
};

/// Says who hears something.
struct Listener {
    KindMask kinds() const { return kind_of<Received>(); }
    void on(const Record& record, const RecordContext& context) {
        const auto& received = std::get<Received>(record);
        for (const auto& reception : received.receptions) {
            fmt::print("robot {} hears \"{}\"\n", reception.node.value,
                       context.messages[received.frame.message].payload);
        }
    }
};

int main() {
    Network net{{.propagation = Fog{}}};
    const auto a = net.add({.name = "a", .at = {0, 0}});
    net.add({.name = "near", .at = {91, 0}});
    net.add({.name = "far", .at = {92, 0}});
    net.route(Shout{});
    net.add_sink(Listener{});
    net.at(start_of_run + 1s, [&] { net.broadcast(a, "hello"); });
    net.run_for(2s);
    fmt::print("delivery ratio {}\n", net.metrics().delivery_ratio.value_or(-1));
}
