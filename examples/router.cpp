// SPDX-License-Identifier: MIT
// A routing protocol of one's own: what finds no route is flooded, and everybody who hears a frame
// first learns the next hop towards the robot that it began at. Route errors tell of broken links.
#include "rovernet.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

using namespace rovernet;
using namespace std::chrono_literals;

struct Learning {
    static constexpr bool routes_unicasts = true;
    std::map<std::pair<NodeId, NodeId>, NodeId> next_hop{};  // at a robot, towards another
    std::set<std::pair<NodeId, std::uint64_t>> seen{};       // by a robot, a message's uid
    Hops initial_ttl() const { return 8; }
    void send(LinkLayer& link, NodeId node, MessageId message) {
        seen.insert({node, link.message(message).uid});
        pass_on(link, {.message = message, .sender = node, .ttl = 8, .hops = 1}, {}, link.now());
    }
    void pass_on(LinkLayer& link, Frame frame, std::optional<NodeId> heard_from, Time at) {
        const auto route = next_hop.find({frame.sender, link.message(frame.message).to});
        frame.next_hop = route == next_hop.end() ? everyone : route->second;
        link.send(frame, heard_from, at);
    }
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions) {
        const Message& message = link.message(frame.message);
        for (Reception& r : receptions) {
            const bool first = seen.insert({r.node, message.uid}).second;
            if (first) next_hop[{r.node, message.origin}] = frame.sender;  // later ones may loop
            r.delivered = first && r.node == message.to;
            r.fate = r.delivered ? Fate::arrived : first ? Fate::waiting : Fate::duplicate;
            if (first && frame.ttl == 1) r.fate = Fate::ttl;
            if (message.kind == "error") {  // whoever routes by its sender passes it on
                const auto route = next_hop.find({r.node, message.to});
                if (route == next_hop.end() || route->second != frame.sender) continue;
                next_hop.erase(route);
                fmt::print("robot {} forgets its way to {}\n", r.node.value, message.to.value);
            }
            if (r.fate != Fate::waiting) continue;
            const double u = link.draw(Purpose::routing_jitter, r.node, frame.message, 0);
            Frame copy = frame;
            copy.sender = r.node, --copy.ttl, ++copy.hops;
            pass_on(link, copy, frame.sender, r.time + 1us + from_seconds(0.005 * u));
        }
    }
    void on_sent(LinkLayer& link, const QueuedFrame& sent, SendResult result) {
        if (result != SendResult::retries) return;
        const Frame& frame = sent.frame;
        const NodeId from = frame.sender, to = link.message(frame.message).to;
        fmt::print("robot {} is not answered by {}\n", from.value, frame.next_hop.value);
        next_hop.erase({from, to});
        const MessageId error = link.originate(from, to, "error", 12, {});
        send(link, from, error), link.release(error);
        pass_on(link, frame, {}, link.now() + 20ms);  // by another way, if there is one
    }
};

constexpr std::string_view scenario = R"(
scenario.duration = "6 s"
propagation = { model = "disc", range = "100 m" }
access.model = "csma"
radio.rate = "1 Mb/s"
robot = [{ name = "0", at = ["0 m", "0 m"] },
 { name = "1", at = ["80 m", "0 m"] },
 { name = "2", at = ["160 m", "0 m"] },
 { name = "3", at = ["240 m", "0 m"], on_receive = { send = "yes", to = "sender", once = false } },
 { name = "4", at = ["80 m", "60 m"] },
 { name = "5", at = ["160 m", "60 m"], off = ["2.5 s"] }]
traffic = [{ kind = "unicast", from = "0", to = "3", payload = "?", start = "1 s", every = "1 s" }]
)";

int main() {
    Session session(ScenarioFile(parse_toml(scenario, "scenario"), "", {}), {}, Router(Learning{}));
    Network& net = session.network();
    net.on_receive({0}, [&](const Message&) { fmt::print("at {:.2f} s\n", seconds(net.now())); });
    session.step(session.end());
}
