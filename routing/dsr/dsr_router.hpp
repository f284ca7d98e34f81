// SPDX-License-Identifier: MIT
#pragma once

#include "routing/dsr.hpp"
#include "routing/dsr/dsr_cache.hpp"
#include "routing/dsr/dsr_packets.hpp"
#include "routing/seen_ids.hpp"
#include "routing/send_buffer.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet {

/// Routing protocol with the parameters of a Dsr, without overhearing (see PromiscuousDsrRouter).
/// Numbers in comments are sections of RFC 4728.
///
/// The source route of a message is a header of its frames (Frame::header); a control packet has
/// its route among its bytes. The position of a frame on its route follows from Frame::hops.
class DsrRouter {
  public:
    static constexpr bool routes_unicasts = true;

    /// @throws std::invalid_argument if a parameter is out of its range
    explicit DsrRouter(const Dsr& dsr);

    Hops initial_ttl() const;
    void send(LinkLayer& link, NodeId node, MessageId message);
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions);
    void on_sent(LinkLayer& link, const QueuedFrame& queued, SendResult result);
    void on_timer(LinkLayer& link, NodeId node, std::uint64_t tag);
    void on_switched(LinkLayer& link, NodeId node, bool on);
    void forget(MessageId message);
    void forget_header(std::uint32_t header) { free_headers_.push_back(header); }
    bool keeps(MessageId message) const;
    void describe(const Message& message, const Frame&, PacketStyle style,
                  std::string& text) const {
        dsr::describe(message, style, text);
    }
    FrameHeader header_bytes(const Frame& frame) const;
    /// Shortest route to each destination that a node knows, in the order of destinations.
    std::vector<RouteState> routes(NodeId node, Time now) const;

    /// Source route of a message's frames.
    struct Header {
        dsr::Path path;
        /// Number of times that the message was sent along another route on its way (salvaged).
        std::uint8_t salvage = 0;
        /// Frame::hops of the frame that the first node of the path sends.
        Hops first_hops = 1;
        /// Whether nodes that receive the frame can read the route: false only with profile ns2,
        /// after the first three messages of a flow (flow state), unless salvaged.
        bool is_read = true;
    };
    /// Source route of a frame of a message.
    const Header& header(const Frame& frame) const { return headers_[frame.header - 1]; }
    /// Number of pairs (source, destination) that lost messages after a request for a route had
    /// reached sixteen nodes without finding the destination: the route would be longer, or there
    /// is none. notice() returns a sentence on these pairs for the user; the sentence is empty if
    /// the number is 0.
    std::size_t pairs_too_far() const;
    std::string notice() const;

  private:
    /// Search of a node for a route to a target. The search ends when a route is found; it pauses
    /// while no packet of the node waits for the route.
    struct Search {
        NodeId target;
        /// Number of requests sent for the packets that wait now; the first request reaches only
        /// the neighbours (TTL 1).
        int requests = 0;
        /// Number of times that the wait between two requests was doubled (RFC 4728, 4.3).
        int doublings = 0;
        /// Time at which the wait for a reply ends.
        Time until = start_of_run;
    };
    /// Gratuitous Route Reply (RFC 4728, 4.4) that a node has sent because it overheard a packet of
    /// `source` from `sender`. The node does not send the reply again before `until`.
    struct Shortening {
        NodeId source, sender;
        Time until;
    };
    /// Number of messages that a source sent along its last route to a destination.
    struct Flow {
        dsr::Path path;
        std::uint32_t messages = 0;
    };
    struct Node {
        dsr::Cache cache;
        SeenIds seen;
        SendBuffer buffer;
        std::vector<Search> searches;
        std::vector<Shortening> shortenings;
        /// Last broken link reported to the node, which its next request reports to other nodes.
        std::optional<dsr::Error> error;
        Time error_time = start_of_run;
        std::uint16_t request = 0;
        std::vector<Flow> flows;  ///< one for each destination; only with profile ns2
        /// Time of the next timer event; empty if no timer is set.
        std::optional<Time> timer;
    };
    /// Position of a packet on its route.
    struct Way {
        const dsr::Path& path;
        std::size_t sender;  ///< index in `path` of the node that sent the frame
    };

    Node& node(NodeId id);
    bool is_ns2() const { return dsr_.profile == DsrProfile::ns2; }
    bool has_own(NodeId at, NodeId target);
    std::uint32_t add_header(const Header& header);

    // Messages of applications (dsr_router.cpp).
    void receive_message(LinkLayer& link, const Frame& frame, Reception& reception);
    void receive_on(LinkLayer& link, const Frame& frame, Way way, Reception& reception);
    void send_along(LinkLayer& link, const QueuedFrame& queued, const dsr::Path& path,
                    unsigned salvage, Time at);
    bool is_new_flow(NodeId source, const dsr::Path& path);
    void keep(LinkLayer& link, NodeId at, const QueuedFrame& queued);
    void lose(LinkLayer& link, NodeId at, const SendBuffer::Packet& packet, DropReason reason);
    // Broken links.
    void on_broken(LinkLayer& link, NodeId at, NodeId neighbour, std::span<const QueuedFrame>);
    unsigned salvage_of(const QueuedFrame& queued) const;
    void send_otherwise(LinkLayer& link, NodeId at, const QueuedFrame& queued);

    // Routes: learning, searches and replies (dsr_search.cpp).
    void learn(NodeId at, NodeId sender, const dsr::Path& path, dsr::Cache::Origin origin,
               Time now);
    void shorten(LinkLayer& link, NodeId sender, Way way, const Reception& reception);
    void receive_control(LinkLayer& link, const Frame& frame, const dsr::Packet& packet,
                         Reception& reception);
    Fate receive_request(LinkLayer& link, const Frame& frame, const dsr::Packet& packet,
                         const Reception& reception);
    void pass_on(LinkLayer& link, const Frame& frame, const dsr::Packet& packet,
                 const Reception& reception);
    void send_packet(LinkLayer& link, NodeId at, const dsr::Packet& packet, std::string_view kind,
                     Time when);
    void send_request(LinkLayer& link, Frame frame, const dsr::Packet& packet,
                      std::optional<NodeId> heard_from, Time when);
    void search(LinkLayer& link, NodeId at, NodeId target, Time when);
    void request(LinkLayer& link, NodeId at, Search& search, Time when);
    void proceed(LinkLayer& link, NodeId at, Search& search, Time when);
    void end_searches(LinkLayer& link, NodeId at, Time when);
    void set_timer(LinkLayer& link, NodeId at);
    Duration jitter(LinkLayer& link, NodeId at, MessageId message) const;

    Dsr dsr_;
    std::vector<Node> nodes_;
    // Source routes of frames; number n in Frame::header is entry n - 1.
    std::vector<Header> headers_;
    std::vector<std::uint32_t> free_headers_;
    // Flag of each message, by the index of its MessageId; true: the message has arrived at its
    // destination, so that a salvaged copy that arrives later is a duplicate.
    std::vector<bool> arrived_;
    // Requests of pairs (originator, target) whose path reached sixteen nodes before the target:
    // time of the last one, and whether the pair has lost messages for which it searched.
    struct FullRequest {
        Time last;
        bool has_lost = false;
    };
    std::map<std::pair<NodeId, NodeId>, FullRequest> too_far_;
};

/// DsrRouter that also receives packets for other nodes (overhearing), see Dsr::promiscuous.
struct PromiscuousDsrRouter : DsrRouter {
    static constexpr bool overhears = true;
    using DsrRouter::DsrRouter;
};

}  // namespace rovernet
