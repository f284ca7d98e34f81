// SPDX-License-Identifier: MIT
#pragma once

#include "routing/aodv_packets.hpp"
#include "routing/aodv_rules.hpp"
#include "routing/route_table.hpp"
#include "routing/seen_ids.hpp"
#include "routing/send_buffer.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rovernet {

/// Routing protocol of an Aodv. Numbers in comments are sections of RFC 3561, and rules that go
/// beyond its text:
///
/// - A14: the number of a route never falls, also by a RERR.
/// - A15: no node has a route to itself.
/// - A16: a route to a destination, however it was learnt, ends the search for it.
class AodvRouter {
  public:
    static constexpr bool routes_unicasts = true;

    explicit AodvRouter(const AodvRules& rules) : rules_(rules) {}

    Hops initial_ttl() const { return static_cast<Hops>(rules_.ttl); }
    Hops initial_ttl(const Message& message) const {
        return message.to == everyone ? Hops{1} : initial_ttl();
    }
    void send(LinkLayer& link, NodeId node, MessageId message);
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions);
    void on_sent(LinkLayer& link, const QueuedFrame& queued, SendResult result);
    void on_timer(LinkLayer& link, NodeId node, std::uint64_t tag);
    void on_start(LinkLayer& link, NodeId node);
    void on_switched(LinkLayer& link, NodeId node, bool on);
    void forget(MessageId message);
    bool keeps(MessageId message) const;
    void describe(const Message& message, const Frame& frame, PacketStyle style,
                  std::string& text) const {
        aodv::describe(message, frame, style, text);
    }

    /// Routing table of a node at `now`, in the order of destinations.
    std::vector<RouteState> routes(NodeId node, Time now) const;
    /// Routing table of a node as it is stored: a route whose time is over is in it.
    std::span<const Route> stored_routes(NodeId node) const {
        return node.index() < nodes_.size() ? nodes_[node.index()].routes.stored()
                                            : std::span<const Route>{};
    }

  private:
    /// Search for a route, for packets that wait.
    struct Search {
        NodeId destination;
        /// TTL of the last request, and number of requests with the largest TTL so far.
        int ttl = 0, full = 0;
        /// End of the wait for an answer.
        Time until = start_of_run;
        /// Time of the last request; none before the first one.
        std::optional<Time> begun = std::nullopt;
        /// Hops of the broken route, if a node on the way repairs it; 0: it is the source's search.
        Hops repaired_hops = 0;
        /// Whether no request is sent before `until`: all searches failed, or the node has sent too
        /// many requests, or is silent.
        bool pauses = false;
    };
    /// Mean time of the last three searches for a destination, for each hop [s].
    struct Latency {
        NodeId destination;
        std::array<float, 3> times{};
        std::uint8_t next = 0;
    };
    struct Neighbour {
        NodeId node;
        Time last;
    };
    /// Times of the last ten packets of a kind, of which a node sends no more in a second (6.3,
    /// 6.11).
    class RateLimit {
      public:
        /// Counts a packet. @return time from which it may be sent
        Time take(Time now);

      private:
        std::vector<Time> last_;
    };
    struct Node {
        /// Own sequence number, and number of the last request.
        std::uint32_t number = 0, request = 0;
        RouteTable routes;
        SeenIds seen;
        SendBuffer buffer;
        std::vector<Search> searches;
        std::vector<Latency> latencies;
        std::vector<Neighbour> neighbours;  ///< from which there were HELLOs (6.9)
        std::vector<Neighbour> one_way;     ///< neighbours to which a RREP failed (6.8)
        RateLimit requests, errors;
        /// Time of the next timer of searches and of the buffer; none if none is set.
        std::optional<Time> timer;
        /// End of the silence after a restart.
        Time silent_until = start_of_run;
        std::optional<Time> last_broadcast;
        /// Time until which the node counts as part of a route that carries messages (6.9).
        Time active_until = start_of_run;
        bool is_started = false;
        bool was_off = false;  ///< during the run, so that others may have routes over the node
    };

    Node& node(NodeId id);
    Route* route(NodeId at, NodeId destination, Time now);
    Route* valid_route(NodeId at, NodeId destination, Time now);
    void refresh(NodeId at, NodeId destination, Time now);
    void use(NodeId at, NodeId destination, NodeId next_hop, Time now);
    bool is_silent(NodeId at, Time now) { return now < node(at).silent_until; }

    // Messages of applications (aodv_router.cpp).
    void receive_message(LinkLayer& link, const Frame& frame, Reception& reception);
    void send_on(LinkLayer& link, const QueuedFrame& queued, NodeId next_hop, Time at);
    void keep(LinkLayer& link, NodeId at, NodeId destination, const QueuedFrame& queued, Time now);
    void lose(LinkLayer& link, NodeId at, const SendBuffer::Packet& packet, DropReason reason);
    // Broken links.
    void on_broken(LinkLayer& link, NodeId at, NodeId neighbour, std::span<const QueuedFrame>);
    bool repairs(const Route& route, const QueuedFrame& queued) const;
    std::vector<Search> repairs_of(LinkLayer& link, NodeId at, NodeId neighbour,
                                   std::span<const QueuedFrame> stranded);
    bool is_repaired(NodeId at, NodeId destination);
    /// Whom a RERR reaches beside the neighbours that used its routes.
    struct ErrorOptions {
        std::optional<NodeId> asker = {};  ///< neighbour whose packet could not be forwarded
        bool is_first = false;             ///< it is not the report of another node, passed on
        bool is_repaired = false;          ///< flag N: the routes remain
    };
    void send_errors(LinkLayer& link, NodeId at, std::span<const aodv::Error::Lost> lost, Time when,
                     ErrorOptions options);
    void send_error(LinkLayer& link, NodeId at, const aodv::Error& error, NodeId to, Time when);
    void receive_error(LinkLayer& link, const Frame& frame, const aodv::Error& error,
                       const Reception& reception);
    void hear(NodeId at, NodeId neighbour, Time now, bool is_hello);
    void send_hello(LinkLayer& link, NodeId at);

    // Searches (aodv_search.cpp).
    Fate receive_request(LinkLayer& link, const Frame& frame, const aodv::Request& request,
                         const Reception& reception);
    Fate receive_reply(LinkLayer& link, const Frame& frame, const aodv::Reply& reply,
                       const Reception& reception);
    void forward_request(LinkLayer& link, const Frame& frame, aodv::Request request,
                         const Reception& reception);
    void meet(NodeId at, NodeId neighbour, Time now);
    bool learn(NodeId at, const Route& offered, Time now);
    void reply(LinkLayer& link, NodeId at, const aodv::Reply& reply, Time when);
    void tell_way_back(LinkLayer& link, const Reception& r, const aodv::Request& request);
    void search(LinkLayer& link, NodeId at, NodeId destination, Time when);
    void proceed(LinkLayer& link, NodeId at, Search& search, Time when);
    void request(LinkLayer& link, NodeId at, Search& search, Time when);
    int first_ttl(const Route* known) const;
    bool widen(Search& search) const;
    Duration wait(NodeId at, const Search& search);
    Time due(const Search& search) const;
    void give_up(LinkLayer& link, NodeId at, Search& search);
    void end_search(LinkLayer& link, NodeId at, NodeId destination, Time when);
    void note_latency(NodeId at, const Search& search, Hops hops, Time now);
    void set_timer(LinkLayer& link, NodeId at);
    Duration jitter(LinkLayer& link, NodeId at, MessageId message) const;

    AodvRules rules_;
    std::vector<Node> nodes_;
    // Messages that have arrived at their destination, by slot: a repaired route may bring a copy.
    std::vector<bool> arrived_;
};

}  // namespace rovernet
