// SPDX-License-Identifier: MIT
// What a user of the installed package may write: a propagation model, a router, a movement and a
// sink of their own, as plain structs, without rebuilding the library; and the run of a file.
#include <fmt/format.h>

#include <rovernet.hpp>

using namespace rovernet;
using namespace std::chrono_literals;

/// A decibel per metre.
struct Fog {
    static constexpr std::string_view name = "fog";

    void loss(const LinkBatch& links, Db /*cutoff*/, std::span<double> out_db) const {
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

/// One metre a second towards where the x axis begins.
struct Homing {
    Step next_leg(Mover& mover) {
        return Straight{.to = {0, mover.position.y}, .speed = MetersPerSecond{1}}.next_leg(mover);
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

double moved_into_range() {
    Network net{{.propagation = Disc{.range = {10}}}};
    const auto a = net.add({.name = "a", .at = {0, 0}});
    const auto b = net.add({.name = "b", .at = {20, 0}, .move = Homing{}});
    net.route(Shout{});
    double heard_at = -1;
    net.on_receive(b, [&](const Message&) { heard_at = net.position(b).x; });
    net.at(start_of_run + 12s, [&] { net.send(a, everyone, "home"); });
    net.run_for(13s);
    return heard_at;
}

int main(int /*argc*/, char** argv) {
    Network net{{.propagation = Fog{}}};
    const auto a = net.add({.name = "a", .at = {0, 0}});
    net.add({.name = "near", .at = {91, 0}});
    net.add({.name = "far", .at = {92, 0}});
    net.route(Shout{});
    net.add_sink(Listener{});
    net.at(start_of_run + 1s, [&] { net.send(a, everyone, "hello"); });
    net.run_for(2s);
    fmt::print("delivery ratio {}\n", net.metrics().delivery_ratio.value_or(-1));
    fmt::print("heard {:.1f} m from home\n", moved_into_range());

    Session session(ScenarioFile(argv[1], {}));
    session.step(session.end());
    fmt::print("the file's run delivers {}\n", session.network().metrics().deliveries);
}
