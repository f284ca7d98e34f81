// SPDX-License-Identifier: MIT
#pragma once

#include "routing/aodv/aodv_packets.hpp"
#include "routing/aodv/aodv_rules.hpp"
#include "routing/aodv/route_table.hpp"
#include "routing/seen_ids.hpp"
#include "routing/send_buffer.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rovernet {

/// Routing protocol with the parameters of an Aodv. Numbers in comments are sections of RFC 3561.
/// A14, A15 and A16 in comments are rules that the RFC does not state:
///
/// - A14: the sequence number of a route never decreases, not even by a RERR.
/// - A15: no node has a route to itself.
/// - A16: a route to a destination, however it was learnt, ends the search for the destination.
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
    /// Routing table of a node as stored, including expired routes that were not yet updated.
    std::span<const Route> stored_routes(NodeId node) const {
        return node.index() < nodes_.size() ? nodes_[node.index()].routes.stored()
                                            : std::span<const Route>{};
    }

  private:
    /// Search for a route to a destination, for packets that wait for the route.
    struct Search {
        NodeId destination;
        /// TTL of the last request [hops], and number of requests with the largest TTL so far.
        int ttl = 0, full = 0;
        /// Time at which the wait for a reply ends.
        Time until = start_of_run;
        /// Time of the last request; empty before the first request.
        std::optional<Time> begun = std::nullopt;
        /// Hops of the broken route if the search is a local repair; 0 if it is a search by the
        /// source.
        Hops repaired_hops = 0;
        /// Whether no request is sent before `until`: all requests failed, the node has sent too
        /// many requests, or the node is silent after a restart.
        bool pauses = false;
    };
    /// Durations of the last three searches for a destination, each divided by the number of hops
    /// to the destination [s].
    struct Latency {
        NodeId destination;
        std::array<float, 3> times{};
        std::uint8_t next = 0;
    };
    struct Neighbour {
        NodeId node;
        Time last;
    };
    /// Rate limit for packets of one kind: at most ten in a second (6.3, 6.11). Stores the times of
    /// the last ten packets.
    class RateLimit {
      public:
        /// Permission to send a packet: if allowed at `now`, counts the packet.
        /// @return earliest time at which the packet may be sent; `now` if it was counted
        Time take(Time now);

      private:
        std::vector<Time> last_;
    };
    struct Tag {  // of a timer
        static constexpr std::uint64_t searches = 0, hello = 1, silence = 2;
    };
    struct Node {
        /// Sequence number of the node, and RREQ ID of the node's last request.
        std::uint32_t number = 0, request = 0;
        RouteTable routes;
        SeenIds seen;
        SendBuffer buffer;
        std::vector<Search> searches;
        std::vector<Latency> latencies;
        std::vector<Neighbour> neighbours;  ///< neighbours that have sent a HELLO (6.9)
        std::vector<Neighbour> one_way;     ///< blacklist: neighbours a RREP did not reach (6.8)
        RateLimit requests, errors;
        /// Time of the next timer event, for searches and waiting packets; empty if no timer is
        /// set.
        std::optional<Time> timer;
        /// Time of the next timer event for a neighbour that may have fallen silent.
        Time silence_timer = start_of_run;
        /// Time until which the node takes no part in route searches after a restart (6.13).
        Time silent_until = start_of_run;
        std::optional<Time> last_broadcast;
        /// Time until which the node counts as part of a route that carries messages (6.9).
        Time active_until = start_of_run;
        bool is_started = false;
        /// Whether the node was off during the run: other nodes may then have routes over the node.
        bool was_off = false;
    };

    Node& node(NodeId id) {
        if (id.index() >= nodes_.size()) [[unlikely]]
            make_room(id);
        return nodes_[id.index()];
    }
    [[gnu::noinline]] void make_room(NodeId node);
    Route* route(NodeId at, NodeId destination, Time now);
    Route* valid_route(NodeId at, NodeId destination, Time now);
    void refresh(NodeId at, NodeId destination, Time now);
    void use(NodeId at, NodeId destination, NodeId next_hop, Time now);
    bool is_silent(NodeId at, Time now) { return now < node(at).silent_until; }

    void prefetch(std::span<const Reception> receptions, NodeId from, NodeId originator);

    // Messages of applications (aodv_router.cpp).
    void receive_message(LinkLayer& link, const Frame& frame, Reception& reception);
    void send_on(LinkLayer& link, const QueuedFrame& queued, NodeId next_hop, Time at);
    void keep(LinkLayer& link, NodeId at, NodeId destination, const QueuedFrame& queued, Time now);
    void lose(LinkLayer& link, NodeId at, const SendBuffer::Packet& packet, DropReason reason);
    // Broken links (aodv_links.cpp).
    void on_broken(LinkLayer& link, NodeId at, NodeId neighbour, std::span<const QueuedFrame>);
    bool repairs(const Route& route, const QueuedFrame& queued) const;
    std::vector<Search> repairs_of(LinkLayer& link, NodeId at, NodeId neighbour,
                                   std::span<const QueuedFrame> stranded);
    bool is_repaired(NodeId at, NodeId destination);
    /// Options of a route error (RERR): receiver beside the neighbours that used the routes, and
    /// flags.
    struct ErrorOptions {
        std::optional<NodeId> asker = {};  ///< neighbour whose packet could not be forwarded
        bool is_first = false;             ///< true unless the RERR forwards another node's RERR
        bool is_repaired = false;          ///< flag N: the receivers keep their routes
    };
    void send_errors(LinkLayer& link, NodeId at, std::span<const aodv::Error::Lost> lost, Time when,
                     ErrorOptions options);
    void send_error(LinkLayer& link, NodeId at, const aodv::Error& error, NodeId to, Time when);
    void receive_error(LinkLayer& link, const Frame& frame, const aodv::Error& error,
                       const Reception& reception);
    void hear(NodeId at, NodeId neighbour, Time now, bool is_hello);
    bool is_blacklisted(Node& here, NodeId neighbour, Time now) const;
    void refuse(LinkLayer& link, const Frame& frame, NodeId to, const Reception& reception);
    void send_hello(LinkLayer& link, NodeId at);
    void end_silent(LinkLayer& link, NodeId at);

    // Searches (aodv_search.cpp).
    Fate receive_request(LinkLayer& link, const Frame& frame, const aodv::Request& request,
                         const Reception& reception);
    Fate receive_reply(LinkLayer& link, const Frame& frame, const aodv::Reply& reply,
                       const Reception& reception);
    bool answer(LinkLayer& link, NodeId from, const aodv::Request& request,
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
    // Flag of each message that has arrived at its destination, by slot: after a repair of the
    // route, another copy may arrive.
    std::vector<bool> arrived_;
};

}  // namespace rovernet
